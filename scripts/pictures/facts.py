"""What the pictures show, for each kind of table: the variables that scripts/pictures/KIND.gp wants.

Each function of FACTS takes the tables to be drawn together (one, unless runs are compared), the tables of the same run
by kind as far as COMPANIONS lists them, the numbers of the loads to be shown or None, and the folder from which gnuplot
reads. It returns the name of the gnuplot commands, the size of the picture in points of 1/72 inch and the commands that set the variables.
"""
import array
import math
import os
import sys

from axes import Scale, axis, chosen, quoted, step_of

REFERENCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "outputs", "reference", "wave_2d.dat")
# At most so many loads are shown as panels, or as curves.
MOST_PANELS, MOST_CURVES, MOST_EDGES = 4, 8, 20
# Points of a map along a side that a picture can show.
MOST_PIXELS = 800


class CannotBeDrawn(ValueError):
    """There is nothing to be shown."""


def put_range(name, numbers, **kind):
    low, high, step, wide = axis(numbers, **kind)
    return [f"{name}_low = {low!r}", f"{name}_high = {high!r}", f"{name}_step = {step!r}", f"{name}_wide = {int(wide)}"]


def array_of(name, words):
    return [f"array {name}[{len(words)}] = [{', '.join(words)}]"]


def numbers_in(tables, column, name, over, may_be_wide=False):
    """The scale of a column of several tables, and the factor for each table.

    column: gives the numbers of a table. name: of the number of the head by which they are divided if their unit has no
    label. over: its symbol in gnuplot. may_be_wide: whether the axis may be logarithmic, then without powers of ten
    in its label.
    """
    labels = {table.label(name) for table in tables}
    unit = labels.pop() if len(labels) == 1 else ""
    divisors = [1.0 if unit else table.numbers.get(name) or 0.0 for table in tables]
    if not all(divisors):
        over, divisors = "", [1.0]*len(tables)
    numbers = [number/divisor for table, divisor in zip(tables, divisors) for number in column(table)]
    most = max((abs(number) for number in numbers), default=0.0)
    scale = Scale(1.0 if may_be_wide and axis(numbers)[-1] else most, unit, over)
    return scale, [scale.factor/divisor for divisor in divisors]


def put_scale(name, found, symbol, words=""):
    scale, factors = found
    return [f"{name}_label = {scale.label(symbol, words)}"] + array_of(f"{name}_factor", [repr(f) for f in factors])


def of_column(name):
    return lambda table: table.column(name)


def of_loads(table):
    """The mean pressures of the blocks."""
    p_star = table.numbers.get("p*", 1.0)
    return [p_star*block.pbar_over_pstar for block in table.blocks if math.isfinite(block.pbar_over_pstar)]


def scaled(tables, factors, name):
    return [number*factor for table, factor in zip(tables, factors) for number in table.column(name)]


def names_of(tables):
    """The names of the cases; with their folders where the names alone are the same."""
    names = [os.path.basename(table.stem) for table in tables]
    if len(set(names)) < len(names):
        names = [os.path.join(*table.stem.split(os.sep)[-2:]) for table in tables]
    return names


def titles(tables):
    """The name above the picture, none if runs are compared, and the names of the runs."""
    names = names_of(tables)
    return [f"title_words = {quoted(names[0] if len(names) == 1 else '')}"] + \
        array_of("run_names", [quoted(name) for name in names])


def shown(table, loads, most):
    """The places of the blocks to be shown. What is left out is said."""
    if loads is not None:
        places = [i for i, block in enumerate(table.blocks) if block.load in loads]
        if not places:
            raise CannotBeDrawn(f"it has none of the loads {', '.join(str(load) for load in loads)}")
        return places
    places = chosen(len(table.blocks), most)
    if len(places) < len(table.blocks):
        numbers = ",".join(str(table.blocks[i].load) for i in places)
        print(f"plot: {table.path}: {len(places)} of its {len(table.blocks)} loads are shown, --loads {numbers}; "
              "choose others with --loads", file=sys.stderr)
    return places


def ends_of_bars(table, name, error_name, unit):
    """The values of a column and the ends of their error bars, as far as these are smaller than the values."""
    errors = [unit*error for error in table.column(error_name)]
    values = table.column(name)
    if len(errors) != len(values):
        return values
    return values + [value + sign*error for value, error in zip(values, errors) if error < value for sign in (-1, 1)]


def summary(tables, beside, loads, folder):
    load = numbers_in(tables, of_column("mean_pressure"), "p*", "p_star", may_be_wide=True)
    means = scaled(tables, load[1], "mean_pressure")
    wide = axis(means)[-1]
    gap = numbers_in(tables, of_column("mean_gap"), "Delta", "Delta")
    peak = numbers_in(tables, of_column("peak_pressure"), "p*", "p_star", may_be_wide=wide)
    first = tables[0]
    facts = put_scale("load", load, "p_bar", "mean pressure") + put_scale("gap", gap, "mean_gap", "mean gap")
    facts += put_scale("peak", peak, "p_max", "peak pressure")
    full = load[1][0]*first.numbers.get("p*", 0.0) if len(tables) == 1 else 0.0
    facts += put_range("load", means, up_to=full)
    ends = [ends_of_bars(table, "contact_area_fraction", "contact_area_fraction_error", 1.0) for table in tables]
    ends = [end for some in ends for end in some]
    area = Scale(1.0 if wide and axis(ends)[-1] else max(ends, default=1.0), over="area_0")
    facts += put_range("area", [end*area.factor for end in ends], may_be_wide=wide, up_to=1.0)
    facts += [f"area_factor = {area.factor!r}", f"area_label = {area.label('area', 'contact area')}"]
    ends = [[end*factor for end in ends_of_bars(table, "mean_gap", "mean_gap_over_amplitude_error",
                                                table.numbers.get("Delta", 0.0))]
            for table, factor in zip(tables, gap[1])]
    facts += put_range("gap", [end for some in ends for end in some], may_be_wide=False,
                       up_to=gap[1][0]*first.numbers.get("Delta", 0.0))
    ends = [[end*factor for end in ends_of_bars(table, "peak_pressure", "peak_pressure_over_pstar_error",
                                                table.numbers.get("p*", 0.0))]
            for table, factor in zip(tables, peak[1])]
    facts += put_range("peak", [end for some in ends for end in some], may_be_wide=wide)
    facts += array_of("p_star_of", [repr(table.numbers.get("p*", 0.0)) for table in tables])
    facts += array_of("Delta_of", [repr(table.numbers.get("Delta", 0.0)) for table in tables])
    codes = [code for table in tables for code in table.column("status_code")]
    # The paper's series is shown beside converged values: its waves have one shape, whatever their size.
    reference = ""
    if len(tables) == 1 and first.method == "beale":
        reference = "table" if "cell_y" in first.numbers else "closed form"
    # gnuplot wants the file even if it plots nothing of it.
    os.symlink(os.path.realpath(REFERENCE), os.path.join(folder, "reference"))
    entries = []
    if reference:
        entries += [("lines ls 31", "converged" if reference == "table" else "closed form"),
                    ("points ls 11", "the paper's series")]
    if len(tables) > 1:
        entries += [(f"linespoints ls {30 + r}", name) for r, name in enumerate(names_of(tables), 1)]
    entries += [("points ls 42", "not accurate")] if 10 in codes else []
    entries += [("points ls 41", "not solved")] if any(code > 10 for code in codes) else []
    key = "".join(f", keyentry with {style} title key_title[{k}] noenhanced" for k, (style, _) in enumerate(entries, 1))
    facts += array_of("key_title", [quoted(words) for _, words in entries] or ["''"])
    return "summary", (780, 300), facts + [f"reference = '{reference}'", f"key_entries = {quoted(key)}"]


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


def load_facts(table, places):
    """How many loads are shown, and what they are called."""
    scale, factor = numbers_in([table], of_loads, "p*", "p_star")
    names = [scale.value("p_bar", table.numbers.get("p*", 1.0)*table.blocks[i].pbar_over_pstar*factor[0]) for i in places]
    return [f"loads_shown = {len(places)}"] + array_of("load_name", names)


# Closed forms along lines, by the number of dimensions: the columns of pressures and gaps.
ALONG_LINES = {1: (["westergaard_pressure_over_pstar"], ["westergaard_gap_over_amplitude"]),
               2: (["hertz_pressure_over_pstar", "crack_pressure_over_pstar"], ["crack_gap_over_amplitude"])}


def is_light(block):
    return block.pbar_over_pstar < 0.4


def lines(tables, beside, loads, folder):
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

    places = matched(tables, loads, MOST_PANELS if len(tables) > 1 else MOST_CURVES)
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
        facts += put_range(name, [number*factor for table, factor in zip(tables, found[1]) for number in numbers(table)],
                           may_be_wide=False)
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
    return "lines", (430 if dimension == 1 else 710, 430), facts




def fields(tables, beside, loads, folder):
    """Maps: a column of panels for each load, pressure above gap."""
    table = tables[0]
    height = len(set(table.blocks[0].columns["y"]))
    places = shown(table, loads, MOST_CURVES if height == 1 else MOST_PANELS)
    facts = load_facts(table, places)
    facts += array_of("block_of", [str(place) for place in places])
    length = numbers_in(tables, of_column("x"), "cell_x", "")
    facts += put_scale("length", length, "x_symbol") + [f"y_label = {length[0].label('y_symbol')}"]
    for name, unit, over, symbol in (("pressure", "p*", "p_star", "p"), ("gap", "Delta", "Delta", "gap_symbol")):
        found = numbers_in(tables, lambda table: table.column(name, places), unit, over)
        facts += put_scale(name, found, symbol, name)
        numbers = [found[1][0]*number for number in table.column(name, places)]
        facts += put_range(name, numbers, may_be_wide=False) + [f"{name}_most = {max(numbers, default=0) or 1.0!r}"]
    cell = [length[1][0]*side for side in cell_of(table)]
    facts += array_of("cell", [repr(side) for side in cell]) + [f"length_step = {step_of(max(3*min(cell), max(cell)))!r}"]
    for number, place in enumerate(places, 1):
        columns, rows = write_closed(table, place, os.path.join(folder, f"map{number}"))
    facts += [f"columns = {columns}", f"rows = {rows}"]
    if height == 1:
        return "map_1d", (430, 430), facts
    facts += edge_facts(beside.get("contour"), [table.blocks[place].load for place in places], cell_of(table))
    if "contour" not in beside:
        # gnuplot wants the file even if it plots nothing of it.
        os.symlink(os.path.realpath(REFERENCE), os.path.join(folder, "contour"))
    # Panels of about the same area, whatever the cell's shape.
    stretch = min(max(math.sqrt(cell[1]/cell[0]), 0.45), 2.2)
    wide, tall = 150/stretch, 150*stretch
    across = 2 if len(places) == 1 else len(places)
    down = 1 if len(places) == 1 else 2
    size = (70 + across*(wide + 16) + 75 + (75 if down == 1 else 0), 46 + down*(tall + 16) + 60)
    return "map", size, facts + [f"panel_wide = {wide!r}", f"panel_tall = {tall!r}"]


def cell_of(table):
    """The sides of the cell: as in the head, otherwise from the points, of which the last is not written."""
    sides = []
    for axis_name in "xy":
        places = sorted(set(table.blocks[0].columns[axis_name]))
        step = places[1] - places[0] if len(places) > 1 else 1.0
        sides.append(table.numbers.get(f"cell_{axis_name}", len(places)*step))
    return sides if len(set(table.blocks[0].columns["y"])) > 1 else sides[:1]


def write_closed(table, place, path):
    """Writes x, y, pressure and gap of a map for gnuplot's binary format, with the first column and row once more behind
    the last: the cell is closed. Points that a picture cannot show are left out. Returns the numbers of points."""
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
                point = (j % rows)*columns + i % columns
                numbers.extend((block["x"][point] + (cell[0] if i == columns else 0.0),
                                block["y"][point] + (cell[1] if j == rows > 1 else 0.0),
                                block["pressure"][point], block["gap"][point]))
            numbers.tofile(file)
    return len(across), len(down)


def edge_facts(contour, numbers, cell):
    """The blocks of contours of loads, -1 without, and the cells in which copies of the curves are to be drawn."""
    places, low, high = [-1]*len(numbers), [0, 0], [0, 0]
    if contour:
        blocks = {block.load: i for i, block in enumerate(contour.blocks)}
        places = [blocks.get(number, -1) for number in numbers]
        for axis_name, side, k in zip("xy", cell, (0, 1)):
            found = contour.column(axis_name, [place for place in places if place >= 0]) or [0.0]
            low[k], high[k] = -math.floor(max(found)/side), -math.floor(min(found)/side)
    return array_of("edge_of", [str(place) for place in places]) + array_of("first_copy", [str(k) for k in low]) \
        + array_of("last_copy", [str(k) for k in high])


def edges(tables, beside, loads, folder):
    """Contours: all loads on one cell, coloured by the load; in 1-D the strips of contact, one above the other."""
    table = tables[0]
    places = shown(table, loads, MOST_EDGES)
    load = numbers_in(tables, of_loads, "p*", "p_star")
    p_star = table.numbers.get("p*", 1.0)
    on_axis = [load[1][0]*p_star*table.blocks[place].pbar_over_pstar for place in places]
    length = numbers_in(tables, lambda table: [*cell_in_head(table)], "cell_x", "")
    cell = [length[1][0]*side for side in cell_in_head(table)]
    facts = put_scale("load", load, "p_bar", "mean pressure") + array_of("load_of", [repr(number) for number in on_axis])
    facts += array_of("block_of", [str(place) for place in places]) + [f"loads_shown = {len(places)}"]
    facts += put_range("load", on_axis, up_to=load[1][0]*p_star)
    facts += put_scale("length", length, "x_symbol") + [f"y_label = {length[0].label('y_symbol')}"]
    facts += array_of("cell", [repr(side) for side in cell])
    facts += [f"length_step = {step_of(max(1.5*min(cell), max(cell)))!r}"]
    if len(cell) == 1:
        return "contour_1d", (480, 320), facts + edge_facts(table, [table.blocks[i].load for i in places], [*cell_in_head(table), 1])
    facts += edge_facts(table, [table.blocks[place].load for place in places], cell_in_head(table))
    stretch = min(max(math.sqrt(cell[1]/cell[0]), 0.45), 2.2)
    wide, tall = 300/stretch, 300*stretch
    return "contour", (wide + 170, tall + 105), facts + [f"panel_wide = {wide!r}", f"panel_tall = {tall!r}"]


def cell_in_head(table):
    return [table.numbers[name] for name in ("cell_x", "cell_y") if name in table.numbers]


def series(tables, beside, loads, folder):
    """Coefficients: their sizes against the harmonic, coloured by the load."""
    table = tables[0]
    places = shown(table, loads, MOST_CURVES)
    sizes = [abs(number) for number in table.column("pressure_over_pstar", places) if number]
    facts = load_facts(table, places) + array_of("block_of", [str(place) for place in places])
    facts += [f"dimension = {2 if any(table.column('j')) else 1}"]
    # Coefficients of exactly zero are no less than the least that is shown.
    top = max(sizes, default=1.0)
    low = max(min(sizes, default=top/10), 1e-16*top)
    return "coefficients", (560, 340), facts + [f"least = {10.0**math.floor(math.log10(low))!r}",
                                                f"most = {10.0**math.ceil(math.log10(1.001*top))!r}",
                                                f"highest = {max(map(math.hypot, table.column('i'), table.column('j')))!r}"]


# The closed forms of a table of theory, in the order in which they are drawn.
FORMS = {"kuznetsov_mean_gap_over_amplitude": "Kuznetsov, (20)",
         "westergaard_contact_area_fraction": "Westergaard, (7)",
         "westergaard_peak_pressure_over_pstar": "Westergaard, (4)",
         "hertz_line_contact_area_fraction": "Hertz, light loads, (8)",
         "line_crack_contact_area_fraction": "crack, heavy loads, (11)",
         "hertz_contact_area_fraction": "Hertz, light loads, (23)",
         "crack_contact_area_fraction": "crack, heavy loads, (24)",
         "light_longer_contact_area_fraction": "light loads, more terms",
         "closure_longer_contact_area_fraction": "heavy loads, more terms",
         "light_eq29_mean_gap_over_amplitude": "light loads, (29)",
         "crack_mean_gap_over_amplitude": "crack, heavy loads, (30)",
         "light_longer_mean_gap_over_amplitude": "light loads, more terms",
         "closure_longer_mean_gap_over_amplitude": "heavy loads, more terms",
         "light_lattice_mean_gap_over_amplitude": "(29), the whole lattice",
         "hertz_peak_pressure_over_pstar": "Hertz, light loads"}
IN_THEORY = {"area": "contact_area_fraction", "gap": "mean_gap_over_amplitude", "peak": "peak_pressure_over_pstar"}


def theory(tables, beside, loads, folder):
    """Closed forms against the load, normalised, with the points of the summary."""
    table = tables[0]
    facts = put_range("load", table.column("pbar_over_pstar"), up_to=1.0)
    wide = axis(table.column("pbar_over_pstar"))[-1]
    columns, names, last = [], [], [0]
    for panel, ending in IN_THEORY.items():
        found = [(form, words) for form, words in FORMS.items() if form.endswith(ending) and table.column(form)]
        last.append(len(columns) + len(found))
        columns += [quoted(name) for name, _ in found]
        names += [quoted(words) for _, words in found]
        # Asymptotes leave the range of the quantity far from where they hold.
        numbers = [number for name, _ in found for number in table.column(name) if 0 <= number <= (2 if panel == "peak" else 1)]
        facts += put_range(panel, numbers + [0.0], may_be_wide=wide and panel != "gap", up_to=None if panel == "peak" else 1.0)
    facts += array_of("form_column", columns) + array_of("form_name", names)
    facts += array_of("forms_before", [str(number) for number in last])
    facts += [f"solved = {int('summary' in beside)}", f"many = {int(len(table.column('pbar_over_pstar')) > 30)}"]
    if "summary" not in beside:
        os.symlink(os.path.realpath(REFERENCE), os.path.join(folder, "summary"))
    return "theory", (860, 400), facts


# Quantities of details: column, label as gnuplot's expression.
DETAILS = (("contact_area_fraction", "'contact area '.area.'/'.area_0"),
           ("mean_gap_over_amplitude", "'mean gap '.mean_gap.'/'.Delta"),
           ("peak_pressure_over_pstar", "'peak pressure '.p_max.'/'.p_star"),
           ("trough_gap_over_amplitude", "'gap at trough '.gap_symbol.'/'.Delta"),
           ("saddle_gap_over_amplitude", "'gap at saddle '.gap_symbol.'/'.Delta"),
           ("saddle_pressure_over_pstar", "'pressure at saddle '.p.'/'.p_star"),
           ("elastic_energy_over_pstar_amplitude", "'elastic energy/('.p_star.Delta.')'"),
           ("perimeter", "perimeter_label"))


def details(tables, beside, loads, folder):
    """Details: a panel for each quantity against the load, and the errors of all."""
    table = tables[0]
    wide = axis(table.column("pbar_over_pstar"))[-1]
    facts = put_range("load", table.column("pbar_over_pstar"), up_to=1.0)
    perimeter = numbers_in(tables, of_column("perimeter"), "cell_x", "")
    facts += [f"perimeter_label = {perimeter[0].label(quoted('perimeter'))}"]
    factors = [perimeter[1][0] if name == "perimeter" else 1.0 for name, _ in DETAILS]
    facts += array_of("column_of", [quoted(name) for name, _ in DETAILS]) + array_of("label_of", [label for _, label in DETAILS])
    facts += array_of("factor_of", [repr(factor) for factor in factors])
    ranges = [axis([factor*number for number in table.column(name)], may_be_wide=wide)
              for (name, _), factor in zip(DETAILS, factors)]
    for name, k in (("low", 0), ("high", 1), ("step", 2)):
        facts += array_of(f"{name}_of", [repr(limits[k]) for limits in ranges])
    facts += array_of("wide_of", [str(int(limits[3])) for limits in ranges])
    facts.append(f"many = {int(len(table.column('pbar_over_pstar')) > 30)}")
    errors = [error for name, _ in DETAILS for error in table.column(name + "_error") if error > 0]
    facts += [f"error_low = {10.0**math.floor(math.log10(max(min(errors, default=0.1), 1e-18)))!r}",
              f"error_high = {10.0**math.ceil(math.log10(max(errors, default=0.5)))!r}"]
    return "details", (780, 700), facts


COMPANIONS = {"lines": ("theory_lines",), "map": ("contour",), "theory": ("summary",)}
FACTS = {"summary": summary, "lines": lines, "map": fields, "theory_lines": lines, "contour": edges,
         "coefficients": series, "theory": theory, "details": details}
