"""What the pictures of stresses below the surface show. See facts.py."""
import array
import bisect
import math
import os
import sys

from axes import axis, chosen, quoted, step_of
from fields import MOST_PIXELS, cell_of, matched, outlines, write_closed
from loading import ends_of_bars
from variables import MOST_CURVES, MOST_PANELS, CannotBeDrawn, array_of, load_facts, \
    mean_pressure_axis, names_of, numbers_in, of_column, put_range, put_scale, scaled, shown

# The columns of stresses that can be shown, and their labels: gnuplot's symbol and words.
SYMBOLS = {"von_mises": ("'{/:Italic σ}_{vM}'", "von Mises stress"),
           "largest_shear": ("'{/:Italic τ}_{max}'", "shear stress"),
           "stress_pressure": ("'−{/:Italic σ_{kk}}/3'", ""),
           **{f"stress_{axes}": (f"'{{/:Italic σ_{{{axes}}}}}'", "") for axes in ("xx", "yy", "zz", "xy", "xz", "yz")},
           **{f"principal_{i}": (f"'{{/:Italic σ}}_{i}'", "") for i in (1, 2, 3)}}
# The order of panels below the crest; those of shear components are left out where symmetry makes them vanish.
BELOW_CREST = ("stress_xx", "stress_yy", "stress_zz", "von_mises", "stress_xy", "stress_xz", "stress_yz",
               "largest_shear")
VANISHING = 1e-6   # of the largest stress
SHEAR = "largest_shear_over_pstar"
LEAST_ROWS = 161   # of the picture of a section


def of_body(table, choice):
    """A table with the blocks of one body alone. That there is another is said unless the body was chosen."""
    body = choice.body or 1
    blocks = [block for block in table.blocks if block.body == body]
    if not blocks:
        raise CannotBeDrawn(f"it has no stresses of body {body}")
    if choice.body is None and len(blocks) < len(table.blocks):
        if any(block.body != body for block in table.blocks):
            print(f"plot: {table.path}: the first body is shown; --body 2 shows the second", file=sys.stderr)
    return table.with_blocks(blocks)


def below_crest(tables, beside, choice, folder):
    """Stresses on the line below the crest: a panel for each, depth downwards."""
    tables = [of_body(table, choice) for table in tables]
    places = matched(tables, choice.loads, MOST_PANELS if len(tables) > 1 else MOST_CURVES)
    facts = load_facts(tables[0], [place[0] for place in places])
    facts += array_of("block_of", [str(table.blocks[place[r]].place)
                                   for r, table in enumerate(tables) for place in places])
    size = {name: max((abs(number) for table in tables for number in table.column(name)), default=0.0)
            for name in BELOW_CREST}
    names = [name for name in BELOW_CREST if size[name] > VANISHING*max(size.values())] or ["von_mises"]
    found = numbers_in(tables, lambda table: [number for name in names for number in table.column(name)],
                       "p*", "p_star")
    facts += array_of("column_of", [quoted(name) for name in names])
    facts += array_of("label_of", [found[0].label(SYMBOLS[name][0]) for name in names])
    facts += array_of("stress_factor", [repr(factor) for factor in found[1]])
    limits = [axis(scaled(tables, found[1], name), may_be_wide=False) for name in names]
    for word, k in (("low", 0), ("high", 1)):
        facts += array_of(f"{word}_of", [repr(limit[k]) for limit in limits])
    # Panels are narrow: fewer tics, even fewer of numbers of four characters.
    facts += array_of("step_of", [repr(step_of((2.2 if max(-10*limit[0], limit[1]) >= 1000 else 1.5)
                                               *(limit[1] - limit[0]))) for limit in limits])
    depth = numbers_in(tables, of_column("depth"), "cell_x", "")
    facts += put_scale("depth", depth, "depth_symbol", "depth")
    deepest = max(scaled(tables, depth[1], "depth")) or 1.0
    facts += [f"deepest = {deepest!r}", f"depth_step = {step_of(deepest)!r}"]
    across = min(len(names), 5 if len(names) < 6 else 4)
    down = math.ceil(len(names)/across)
    return "stress_line", (228 + 132*across, 45 + 235*down), \
        facts + [f"panels = {len(names)}", f"across = {across}", f"down = {down}"]


def section(tables, beside, choice, folder):
    """A vertical section: a panel for each load, depth downwards."""
    table = of_body(tables[0], choice)
    places = shown(table, choice.loads, MOST_PANELS)
    length = numbers_in(tables, lambda table: table.column("distance") + table.column("depth"), "cell_x", "")
    facts = colours(table, choice.variable, places) + load_facts(table, places)
    facts += put_scale("length", length, quoted("distance"))
    facts += [f"y_label = {length[0].label('depth_symbol', 'depth')}", "downwards = 1", "depths_shown = 1"]
    facts += array_of("depth_name", [quoted("")])
    for number, place in enumerate(places, 1):
        columns, rows = write_section(table.blocks[place].columns, choice.variable,
                                      os.path.join(folder, f"map{number}-1"))
    sides = [length[1][0]*max(table.column(side)) for side in ("distance", "depth")]
    facts += [f"columns = {columns}", f"rows = {rows}"] + outlines(None, table, places, 1.0, 1.0, folder)
    return "stress_map", *panels(sides, len(places), facts)


def planes(tables, beside, choice, folder):
    """Planes: a panel for each load and depth; of profiles curves."""
    table = of_body(tables[0], choice)
    depths = sorted({block.columns["depth"][0] for block in table.blocks})
    at_depth = [table.with_blocks([block for block in table.blocks if block.columns["depth"][0] == depth])
                for depth in depths]
    numbers = shown_depths(table, len(depths), choice.depths)
    flat = len(set(table.blocks[0].columns["y"])) == 1
    places = shown(at_depth[0], choice.loads, MOST_CURVES if flat else MOST_PANELS)
    table = table.with_blocks([at_depth[k].blocks[place] for k in numbers for place in places])
    length = numbers_in([table], lambda table: cell_of(table) + depths, "cell_x", "")
    facts = colours(table, choice.variable, range(len(table.blocks))) + load_facts(at_depth[0], places)
    facts += put_scale("length", length, "x_symbol") + [f"y_label = {length[0].label('y_symbol')}", "downwards = 0"]
    facts += array_of("depth_name", [length[0].value("depth_symbol", length[1][0]*depths[k]) for k in numbers])
    facts.append(f"depths_shown = {len(numbers)}")
    for i, place in enumerate(places, 1):
        for j, k in enumerate(numbers, 1):
            columns, rows = write_closed(at_depth[k], place, os.path.join(folder, f"map{i}-{j}"), (choice.variable,))
    facts += [f"columns = {columns}", f"rows = {rows}"]
    sides = [length[1][0]*side for side in cell_of(table)]
    if flat:
        facts += [f"longest = {sides[0]!r}", f"length_step = {step_of(1.5*sides[0])!r}"]
        return "stress_planes_1d", (221 + 190*len(numbers), 290), facts
    size, variables = panels(sides, len(places), facts, len(numbers))
    return "stress_map", size, variables + outlines(beside.get("contour"), at_depth[0], places, length[1][0],
                                                    panel_of(sides)[0], folder)


def shown_depths(table, count, wanted):
    """The places of the depths to be shown. What is left out is said."""
    if wanted is None:
        places = chosen(count, MOST_PANELS)
        if len(places) < count:
            print(f"plot: {table.path}: {len(places)} of its {count} depths are shown, --depths "
                  f"{','.join(str(place + 1) for place in places)}; choose others with --depths", file=sys.stderr)
        return places
    places = [number - 1 for number in sorted(set(wanted)) if 1 <= number <= count]
    if not places:
        raise CannotBeDrawn(f"it has none of the depths {', '.join(str(number) for number in wanted)}")
    return places


def colours(table, name, places):
    """Label, factor and range of the stress that is shown."""
    if name not in SYMBOLS:
        raise CannotBeDrawn(f"there is no stress '{name}'; there are {', '.join(SYMBOLS)}")
    numbers = table.column(name, places)
    found = numbers_in([table], lambda table: numbers, "p*", "p_star")
    on_axis = [found[1][0]*number for number in numbers] or [0.0]
    most = max(map(abs, on_axis)) or 1.0
    return put_scale("stress", found, *SYMBOLS[name]) + put_range("stress", on_axis, may_be_wide=False) + \
        [f"negative = {int(min(on_axis) < -VANISHING*most)}", f"positive = {int(max(on_axis) > VANISHING*most)}",
         f"most = {most!r}"]


def panel_of(sides):
    """Width and height of a panel in points: about the same area, whatever the sides."""
    stretch = min(max(math.sqrt(sides[1]/sides[0]), 0.7), 1.5)
    return 150/stretch, 150*stretch


def panels(sides, loads, facts, depths=1):
    """The size of a picture of panels for loads and depths, side by side if there is one load, and its variables."""
    wide, tall = panel_of(sides)
    across, down = (loads, depths) if loads > 1 else (depths, 1)
    size = (112 + across*(wide + 24) + 75, max(46 + down*(tall + 16) + 60, 230))
    return size, facts + array_of("side", [repr(side) for side in sides]) + \
        array_of("step_of", [repr(step_of(2*side)) for side in sides]) + \
        [f"panel_wide = {wide!r}", f"panel_tall = {tall!r}", f"across = {across}", f"down = {down}"]


def write_section(block, name, path):
    """Writes distance, depth and a column of a section for gnuplot's binary format, interpolated to equally spaced
    depths, which an image needs. Returns the numbers of points.
    """
    depths = sorted(set(block["depth"]))
    columns = len(block["depth"])//len(depths)
    if len(depths) < 2:
        raise CannotBeDrawn("a section of one depth is no picture")
    steps = [after - before for before, after in zip(depths, depths[1:])]
    rows = min(MOST_PIXELS, max(LEAST_ROWS, 1 + math.ceil((depths[-1] - depths[0])/min(steps) - 1e-6)))
    order = sorted(range(len(depths)), key=lambda k: block["depth"][k*columns])
    with open(path, "wb") as file:
        for row in range(rows):
            depth = depths[0] + (depths[-1] - depths[0])*row/(rows - 1)
            k = min(max(bisect.bisect(depths, depth) - 1, 0), len(depths) - 2)
            part = (depth - depths[k])/steps[k]
            numbers = array.array("d")
            for i in range(columns):
                above, below = (block[name][order[m]*columns + i] for m in (k, k + 1))
                numbers.extend((block["distance"][i], depth, above + part*(below - above)))
            numbers.tofile(file)
    return columns, rows


def largest(tables, beside, choice, folder):
    """The largest stresses against the mean pressure, with error bars, their depth, their ratio to the yield stress."""
    facts, wide = mean_pressure_axis(tables)
    stress = numbers_in(tables, of_column("largest_von_mises"), "p*", "p_star", may_be_wide=wide)
    depth = numbers_in(tables, lambda table: table.column("von_mises_depth") + table.column("shear_depth"),
                       "cell_x", "", may_be_wide=wide)
    ratio = numbers_in(tables, of_column("stress_over_yield_stress"), "", "")
    labels, limits, factors = [], [], []
    for name, found, label in (
            ("largest_von_mises", stress, stress[0].label(*SYMBOLS["von_mises"])),
            ("largest_shear", stress, stress[0].label(*SYMBOLS["largest_shear"])),
            ("von_mises_depth", depth, depth[0].label("depth_symbol", "depth")),
            ("stress_over_yield_stress", ratio, quoted("largest stress over yield stress"))):
        numbers = scaled(tables, found[1], name)
        if name.startswith("largest"):
            numbers += ends_of_bars(tables, found[1], name, name + "_over_pstar_error", "p*")
        elif name == "von_mises_depth":
            numbers += scaled(tables, found[1], "shear_depth")
        elif name == "stress_over_yield_stress":
            if not numbers:
                break
            numbers.append(1.0)
        labels.append(label)
        # From 0, so that what differs by rounding looks equal.
        limits.append(axis([0.0] + numbers, may_be_wide=wide))
        factors += found[1]
    facts += array_of("label_of", labels) + array_of("factor_of", [repr(factor) for factor in factors])
    for word, k in (("low", 0), ("high", 1), ("step", 2)):
        facts += array_of(f"{word}_of", [repr(limit[k]) for limit in limits])
    facts += array_of("wide_of", [str(int(limit[3])) for limit in limits])
    facts += array_of("p_star_of", [repr(table.numbers.get("p*", 0.0)) for table in tables])
    bodies = [int(max(table.column("body"))) for table in tables]
    if choice.body:
        least = most = choice.body
    else:
        least, most = 1, bodies[0] if len(tables) == 1 else 1
    if most > min(bodies):
        raise CannotBeDrawn(f"it has no stresses of body {most}")
    facts += array_of("bodies_of", [str(count) for count in bodies]) + [f"first_body = {least}", f"last_body = {most}"]
    entries = []
    if len(tables) > 1:
        entries += [(f"linespoints ls {30 + r}", name) for r, name in enumerate(names_of(tables), 1)]
    elif most > least:
        entries += [("linespoints ls 31", "first body"), ("linespoints ls 32", "second body")]
    estimated = len(tables) == 1 and tables[0].method not in ("beale", "series")
    facts.append(f"estimated = {int(estimated)}")
    if estimated and any(not error < value for block in tables[0].blocks for value, error, code in zip(
            *(block.columns[name] for name in (SHEAR, SHEAR + "_error", "status_code"))) if 0 < value and code < 10):
        entries.append(("points lc rgb blue pt 6 ps 0.7*mark", "error unknown or as large as the value"))
    if any(code >= 10 for table in tables for code in table.column("status_code")):
        entries.append(("points ls 42", "not accurate or not solved"))
    key = "".join(f", keyentry with {style} title key_title[{k}] noenhanced" for k, (style, _) in enumerate(entries, 1))
    facts += array_of("key_title", [quoted(words) for _, words in entries] or ["''"])
    title_high, key_high = (28, 24*bool(entries)) if len(tables) == 1 else (0, 40)
    facts += [f"title_high = {title_high}", f"key_high = {key_high}", f"panels = {len(labels)}"]
    return "stress_largest", (260*len(labels), 272 + title_high + key_high), facts + [f"key_entries = {quoted(key)}"]
