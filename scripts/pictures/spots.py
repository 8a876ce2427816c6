"""What the pictures of contact spots and of histograms show. See facts.py."""
import os

from axes import axis
from variables import MOST_CURVES, array_of, load_facts, numbers_in, of_column, put_range, \
    put_scale, shown


NONE = 0.5   # less than one spot, on a logarithmic axis


def spots(tables, beside, choice, folder):
    """Numbers of spots and pools, their areas, and percolation, against the mean pressure."""
    table = tables[0]
    def pressures(table):
        return [table.numbers.get("p*", 1.0)*number for number in table.column("pbar_over_pstar")]

    load = numbers_in(tables, pressures, "p*", "p_star", may_be_wide=True)
    means = [load[1][0]*pressure for pressure in pressures(table)]
    wide = axis(means)[-1]
    full = load[1][0]*table.numbers.get("p*", 1.0)
    facts = put_scale("load", load, "p_bar", "mean pressure") + put_range("load", means, up_to=full)
    facts += [f"full = {full!r}"]
    numbers = table.column("spots") + table.column("closed_pools")
    areas = [number for name in ("spots_area_fraction", "largest_spot_area_fraction", "closed_pools_area_fraction")
             for number in table.column(name)]
    facts += put_range("number", numbers) + put_range("area", areas, may_be_wide=wide, up_to=1.0)
    facts.append("if (number_step < 1) { number_step = 1 }")
    return "spots", (900, 310), facts


def spot_sizes(tables, beside, choice, folder):
    """How many spots and pools of each load have at least an area."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_CURVES)
    areas = [area for area in table.column("area_fraction", places) if area > 0]
    least = min(areas, default=0.1)/1.6
    for i, place in enumerate(places, 1):
        columns = table.blocks[place].columns
        # A pool carries no load, but its rank begins again from 1.
        sizes = list(zip(columns["rank"], columns["area_fraction"]))
        first = next((k for k in range(1, len(sizes)) if sizes[k][0] <= sizes[k - 1][0]), len(sizes))
        for kind, part in (("spots", sizes[:first]), ("pools", sizes[first:])):
            with open(os.path.join(folder, f"{kind}{i}"), "w", encoding="ascii") as file:
                # From the largest downwards, to the edge of the picture; none lies below it.
                steps = [(area, rank) for rank, area in part if area > 0] or [(least, NONE)]
                steps = [(steps[0][0], NONE), *steps, (least, steps[-1][1])]
                file.writelines(["area number\n"] + [f"{area!r} {rank!r}\n" for area, rank in steps])
    facts = load_facts(table, places) + [f"least = {least!r}", f"most = {max(areas, default=1.0)*1.6!r}"]
    facts += [f"highest = {1.6*max(table.column('rank', places), default=1.0)!r}"]
    return "spot_sizes", (600, 360), facts


def histogram(tables, beside, choice, folder):
    """Densities of pressure over the contact, and of gap over the open area."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_CURVES)
    facts = load_facts(table, places) + array_of("block_of", [str(place) for place in places])
    for name, unit, over, symbol, words in (("pressure", "p*", "p_star", "p", "pressure"),
                                            ("gap", "Delta", "Delta", "gap_symbol", "gap")):
        found = numbers_in(tables, of_column(name), unit, over)
        facts += put_scale(name, found, symbol, words)
        facts += put_range(name, [found[1][0]*number for number in table.column(name, places)], may_be_wide=False)
        size = table.numbers.get(unit, 1.0)
        # A bin in which nearly all of the area lies would hide the others.
        heights = sorted(size*number for number in table.column(name + "_density", places))
        facts += [f"{name}_size = {size!r}"]
        facts += put_range(name + "_density", [0.0] + [number for number in heights
                                                       if number <= 3*heights[int(0.98*(len(heights) - 1))]],
                           may_be_wide=False)
    return "histogram", (800, 320), facts
