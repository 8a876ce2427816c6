"""What the pictures of fields show: lines, maps, edges of contact, coefficients. See facts.py."""
import array
import math
import os

from axes import axis, chosen, quoted, step_of
from variables import MOST_CURVES, MOST_EDGES, MOST_PANELS, CannotBeDrawn, array_of, load_facts, \
    numbers_in, of_column, of_loads, put_range, put_scale, shown

# Points of a map along a side that a picture can show.
MOST_PIXELS = 800
# A colour map ends at this part of its numbers if the largest is so many times as large, and then says the largest.
SHOWN, FAR = 0.995, 1.25
SAMPLE = 300000   # numbers of a map from which this is found
# An outline is this part of the spots' width wide, at most the second number in points. One thinner than the third is
# not drawn: where spots have few pixels it would hide them.
PART_OF_SPOT, WIDEST, THINNEST = 0.08, 0.8, 0.3


def matched(tables, loads, most):
    """For each load to be shown, its place in each table: the loads that all tables have."""
    first = tables[0]
    common = []
    for i, block in enumerate(first.blocks):
        found = [next((j for j, other in enumerate(table.blocks)
                       if math.isclose(other.pbar_over_pstar, block.pbar_over_pstar, rel_tol=1e-6)), None)
                 for table in tables[1:]]
        if None not in found:
            common.append([i] + found)
    if not common:
        raise CannotBeDrawn("the tables have no load in common")
    places = shown(first, loads, most) if len(tables) == 1 else [common[i][0] for i in chosen(len(common), most)]
    return [places_of_load for places_of_load in common if places_of_load[0] in places]


# Closed forms along lines, by the number of dimensions: the columns of pressures and gaps.
ALONG_LINES = {1: (["westergaard_pressure_over_pstar"], ["westergaard_gap_over_amplitude"]),
               2: (["hertz_pressure_over_pstar", "crack_pressure_over_pstar"], ["crack_gap_over_amplitude"])}


def is_light(block):
    return block.pbar_over_pstar < 0.4


def lines(tables, beside, choice, folder):
    """Lines, and closed forms along lines, alone or with the lines."""
    first, solved = tables[0], tables[0].kind == "lines"
    theory = beside.get("theory_lines") if solved else first
    dimension = min(int(max(table.column("line"))) for table in tables)
    forms = ALONG_LINES[dimension]

    def in_units(column, unit, names):
        if solved:
            return of_column(column)
        # In 2-D the Hertz pressure is shown for light loads and the crack for heavy ones, where they are positive.
        blocks = {name: [i for i, block in enumerate(first.blocks) if dimension == 1 or
                         (name.startswith("hertz") == is_light(block))] for name in names}
        return lambda table: [0.0] + [number*table.numbers.get(unit, 1.0) for name in names
                                      for number in table.column(name, blocks[name]) if number > 0]

    places = matched(tables, choice.loads, MOST_PANELS if len(tables) > 1 else MOST_CURVES)
    facts = load_facts(first, [place[0] for place in places])
    facts += array_of("block_of", [str(place[r]) for r in range(len(tables)) for place in places])
    facts += array_of("light", [str(int(is_light(first.blocks[place[0]]))) for place in places])
    longest = [max(distance for distance, line in zip(first.column("distance"), first.column("line")) if line == number)
               for number in range(1, dimension + 1)]
    length = numbers_in(tables, of_column("distance"), "cell_x", "")
    for name, column, unit, over, symbol, words, names in (
            ("pressure", "pressure", "p*", "p_star", "p", "pressure", forms[0]),
            ("gap", "gap", "Delta", "Delta", "gap_symbol", "gap", forms[1])):
        numbers = in_units(column, unit, names)
        found = numbers_in(tables, numbers, unit, over)
        facts += put_scale(name, found, symbol, words)
        on_axis = [number*factor for table, factor in zip(tables, found[1]) for number in numbers(table)]
        facts += put_range(name, on_axis, may_be_wide=False)
        facts.append(f"{name}_of_theory = {found[1][0]*first.numbers.get(unit, 1.0)!r}")
        facts += [f"{name}_forms = '{' '.join(names) if theory else ''}'"]
    facts += [f"length_label = {length[0].label(quoted('distance' if dimension == 1 else 'distance along x'))}"]
    facts += array_of("length_factor", [repr(factor) for factor in length[1]])
    facts += array_of("longest", [repr(number*length[1][0]) for number in longest])
    facts += [f"diagonal_label = {length[0].label(quoted('distance along the diagonal'))}", f"dimension = {dimension}",
              f"solved = {int(solved)}", f"length_step = {axis([longest[0]*length[1][0]])[2]!r}"]
    if solved and not theory:
        # gnuplot wants the file even if it plots nothing of it.
        os.symlink(os.path.abspath(first.path), os.path.join(folder, "theory_lines"))
    return "lines", (470 if dimension == 1 else 760, 430), facts


def maps(tables, beside, choice, folder):
    """Maps: a column of panels for each load, pressure above gap."""
    table = tables[0]
    height = len(set(table.blocks[0].columns["y"]))
    places = shown(table, choice.loads, MOST_CURVES if height == 1 else MOST_PANELS)
    facts = load_facts(table, places)
    facts += array_of("block_of", [str(place) for place in places])
    length = numbers_in(tables, cell_of, "cell_x", "")
    facts += put_scale("length", length, "x_symbol") + [f"y_label = {length[0].label('y_symbol')}"]
    for name, unit, over, symbol in (("pressure", "p*", "p_star", "p"), ("gap", "Delta", "Delta", "gap_symbol")):
        ends = ends_of(table, name, places)
        found = numbers_in(tables, lambda table: ends, unit, over)
        facts += put_scale(name, found, symbol, name)
        numbers = [found[1][0]*number for number in ends]
        facts += put_range(name, numbers, may_be_wide=False)
        if height > 1:
            columns = [table.blocks[place].columns[name] for place in places]
            facts += end_of_colours(name, (found[1][0]*number for column in columns
                                           for number in column[::1 + len(column)//SAMPLE]), max(numbers))
    cell = [length[1][0]*side for side in cell_of(table)]
    facts += array_of("cell", [repr(side) for side in cell])
    facts += [f"length_step = {step_of(max(3*min(cell), max(cell)))!r}"]
    for number, place in enumerate(places, 1):
        columns, rows = write_closed(table, place, os.path.join(folder, f"map{number}"))
    facts += [f"columns = {columns}", f"rows = {rows}"]
    if height == 1:
        return "map_1d", (470, 430), facts
    # Panels of about the same area, whatever the cell's shape.
    stretch = min(max(math.sqrt(cell[1]/cell[0]), 0.45), 2.2)
    wide, tall = 150/stretch, 150*stretch
    facts += outlines(beside.get("contour"), table, places, length[1][0], wide, folder)
    # The paper's series has contact where the pressure exceeds a level.
    facts += [f"edge_pressure = {table.numbers.get('edge_level', 0.0)*table.numbers.get('p*', 1.0)!r}"]
    across, down = (3, 1) if len(places) == 1 else (len(places), 3)
    size = (96 + across*(wide + 30) + (160 if down == 1 else 80), 46 + down*(tall + 16) + 60)
    return "map", size, facts + [f"panel_wide = {wide!r}", f"panel_tall = {tall!r}"]


def end_of_colours(name, numbers, largest):
    """Where a colour map ends, and what its label says of a largest number that lies beyond."""
    found = sorted(number for number in numbers if number > 0) or [1.0]
    most = found[int(SHOWN*(len(found) - 1))]
    if largest <= FAR*most:
        return [f"{name}_most = {max(found[-1], largest)!r}", f"{name}_beyond = ''"]
    return [f"{name}_most = {most!r}", f'{name}_beyond = "\\n".{quoted(f"largest {largest:.4g}")}']


def ends_of(table, name, places):
    """The least and the greatest number of a column: a map has too many for a list of all."""
    columns = [table.blocks[place].columns[name] for place in places]
    return [end(end(column) for column in columns) for end in (min, max)]


def cell_of(table):
    """The sides of the cell: as in the head, otherwise from the points, of which the last is not written."""
    sides = []
    for axis_name in "xy":
        places = sorted(set(table.blocks[0].columns[axis_name]))
        step = places[1] - places[0] if len(places) > 1 else 1.0
        sides.append(table.numbers.get(f"cell_{axis_name}", len(places)*step))
    return sides if len(set(table.blocks[0].columns["y"])) > 1 else sides[:1]


def write_closed(table, place, path, names=("pressure", "gap")):
    """Writes x, y and the named columns of a map for gnuplot's binary format. The first column and row stand once more
    behind the last, of a mirrored map the last ones: the cell is closed. Points that a picture cannot show are left
    out. Returns the numbers of points.
    """
    block = table.blocks[place].columns
    columns = len(set(block["x"]))
    rows = len(block["x"])//columns
    step = max(1, math.ceil(max(columns, rows)/MOST_PIXELS))
    cell = cell_of(table)
    across = list(range(0, columns, step)) + [columns]
    down = list(range(0, rows, step)) + ([rows] if rows > 1 else [])
    with open(path, "wb") as file:
        for j in down:
            numbers = array.array("d")
            for i in across:
                place_of = (j % rows)*columns + i % columns
                point = min(j, rows - 1)*columns + min(i, columns - 1) if table.mirrored else place_of
                numbers.extend((block["x"][place_of] + (cell[0] if i == columns else 0.0),
                                block["y"][place_of] + (cell[1] if j == rows > 1 else 0.0),
                                *(block[name][point] for name in names)))
            numbers.tofile(file)
    return len(across), len(down)


def copies(table, numbers, side):
    """The cells, counted from 0, in which copies of a curve are to be drawn so that the cell shows all of it.

    numbers: its places along a side. Curves across the border of a mirrored map are their own mirror images.
    """
    return range(1) if table.mirrored else range(-math.floor(max(numbers)/side), 1 - math.floor(min(numbers)/side))


def outlines(contour, table, places, factor, wide, folder):
    """Writes the edges of contact of loads as they are drawn over one cell, to the files edge1, edge2 ..., and the
    widths of their lines in points: thinner where spots are small, 0 where lines would hide them.

    table: has the loads as blocks. factor: of lengths on the axis. wide: the width of the cell's picture in points.
    """
    cell, widths = cell_of(table), []
    for number, place in enumerate(places, 1):
        block = next((block for block in (contour.blocks if contour else ())
                      if block.load == table.blocks[place].load), None)
        lines, length, area = ["x y", "-1 -1"], 0.0, 0.0   # gnuplot wants a point even if there is no edge
        for x, y in curves_of(block):
            for i in copies(contour, x, cell[0]):
                for j in copies(contour, y, cell[1]):
                    lines += [""] + [f"{factor*(i*cell[0] + u):.7g} {factor*(j*cell[1] + v):.7g}" for u, v in zip(x, y)]
            length += sum(map(math.dist, zip(x, y), zip(x[1:], y[1:])))
            # Contact lies on the left: holes count as negative. A band's edge does not end where it began.
            closed = math.dist((x[0], y[0]), (x[-1], y[-1])) < 1e-6*cell[0]
            area += sum(u*w - t*v for u, v, t, w in zip(x, y, x[1:], y[1:]))/2 if closed else math.prod(cell)/4
        spots = min(abs(area), abs(math.prod(cell) - abs(area)))
        width = PART_OF_SPOT*wide/cell[0]*2*spots/length if length else 0.0
        widths.append(min(WIDEST, width) if width > THINNEST else 0.0)
        with open(os.path.join(folder, f"edge{number}"), "w", encoding="ascii") as file:
            file.write("\n".join(lines) + "\n")
    return array_of("edge_width", [repr(width) for width in widths])


def curves_of(block):
    """The places along x and y of each curve of a load, which may have none."""
    if block:
        number, x, y = (block.columns[name] for name in ("curve", "x", "y"))
        starts = [k for k in range(len(number)) if k == 0 or number[k] != number[k - 1]] + [len(number)]
        for start, end in zip(starts, starts[1:]):
            yield x[start:end], y[start:end]


def edges(tables, beside, choice, folder):
    """Contours: all loads on one cell, coloured by the load; in 1-D the strips of contact, one above the other."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_EDGES)
    load = numbers_in(tables, of_loads, "p*", "p_star")
    p_star = table.numbers.get("p*", 1.0)
    on_axis = [load[1][0]*p_star*table.blocks[place].pbar_over_pstar for place in places]
    length = numbers_in(tables, cell_in_head, "cell_x", "")
    cell = [length[1][0]*side for side in cell_in_head(table)]
    facts = put_scale("load", load, "p_bar", "mean pressure")
    facts += array_of("load_of", [repr(number) for number in on_axis])
    facts += array_of("block_of", [str(place) for place in places]) + [f"loads_shown = {len(places)}"]
    facts += put_range("load", on_axis, up_to=load[1][0]*table.numbers.get("p*", 0.0))
    facts += put_scale("length", length, "x_symbol") + [f"y_label = {length[0].label('y_symbol')}"]
    facts += array_of("cell", [repr(side) for side in cell])
    facts += [f"length_step = {step_of(max(1.5*min(cell), max(cell)))!r}"]
    if len(cell) == 1:
        found = copies(table, table.column("x", places), cell_in_head(table)[0])
        return "contour_1d", (480, 320), facts + [f"first_copy = {found[0]}", f"last_copy = {found[-1]}"]
    stretch = min(max(math.sqrt(cell[1]/cell[0]), 0.45), 2.2)
    wide, tall = 300/stretch, 300*stretch
    facts += outlines(table, table, places, length[1][0], wide, folder)
    return "contour", (wide + 180, tall + 105), facts + [f"panel_wide = {wide!r}", f"panel_tall = {tall!r}"]


def cell_in_head(table):
    return [table.numbers[name] for name in ("cell_x", "cell_y") if name in table.numbers]


def series(tables, beside, choice, folder):
    """Coefficients: their sizes against the harmonic, coloured by the load."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_CURVES)
    sizes = [abs(number) for number in table.column("pressure_over_pstar", places) if number]
    facts = load_facts(table, places) + array_of("block_of", [str(place) for place in places])
    facts += [f"dimension = {2 if any(table.column('j')) else 1}"]
    # Coefficients of exactly zero are no less than the least that is shown.
    top = max(sizes, default=1.0)
    low = max(min(sizes, default=top/10), 1e-16*top)
    highest = max(map(math.hypot, table.column("i"), table.column("j")))
    facts += [f"least = {10.0**math.floor(math.log10(low))!r}", f"most = {10.0**math.ceil(math.log10(1.001*top))!r}"]
    return "coefficients", (560, 340), facts + [f"highest = {highest!r}"]
