"""The pictures against the load: summaries, closed forms, details, spots and their sizes, histograms."""
import dataclasses
import math
import pathlib

from axes import Axis, Scale, a_decade, axis, decades, marked_up
from picture import AREA, DELTA, GAP, MEAN_GAP, MOST_CURVES, OVER, P, P_BAR, P_MAX, P_STAR, RIGHT, X, Y, \
    CannotBeDrawn, Quantity, entry, mean_pressure_axis
from table import NoPicture, Table

# Converged values, of the tree or, installed, beside this folder.
HERE = pathlib.Path(__file__).resolve().parent
REFERENCE = HERE.parent.parent/"outputs"/"reference"/"wave_2d.dat"
if not REFERENCE.is_file():
    REFERENCE = HERE.parent/"reference"/"wave_2d.dat"
# The status of a load that is not accurate. Below are those of solutions, above those of loads that are not solved.
NOT_ACCURATE = 10
NO_UNIT = ("", "-", "#")   # units of columns without one
LINEAR_LAW = "linear_area_fraction"
NONE = 0.5   # less than one spot, on a logarithmic axis
FEW = 10     # fewer spots are counted on a linear axis
MANY = 30    # so many points are joined without marks
# Above the points whose error is unknown or as large as the value.
OPEN = "points lc rgb '#ffffff' pt 7 ps 0.35*mark"
OPEN_ENTRY = "keyentry with points lc rgb blue pt 6 ps 0.7*mark title 'error unknown or as large as the value'"
ABOVE = "at graph 0, 1.03 left bottom vertical maxrows 3 samplen 1.5"   # the place of a key
# The panels of summaries: column, unit, symbol, words, whether the axis may be logarithmic, where it ends.
SUMMARY = (("contact_area_fraction", "", AREA, "contact area", True, 1.0),
           ("mean_gap", "Delta", MEAN_GAP, "mean gap", False, "Delta"),
           ("peak_pressure", "p*", P_MAX, "peak pressure", True, None))
# Converged values of the profile, normalised: Westergaard's and Kuznetsov's closed forms.
CLOSED_FORMS = (lambda load: 2/math.pi*math.asin(math.sqrt(load)),
                lambda load: 1 - load + (load*math.log(load) if load > 0 else 0.0), lambda load: 2*math.sqrt(load))
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
# Quantities of details, and those of theory, which are the first: column and label.
DETAILS = {"contact_area_fraction": f"contact area {AREA}",
           "mean_gap_over_amplitude": f"mean gap {MEAN_GAP}/{DELTA}",
           "peak_pressure_over_pstar": f"peak pressure {P_MAX}/{P_STAR}",
           "trough_gap_over_amplitude": f"gap at trough {GAP}/{DELTA}",
           "saddle_gap_over_amplitude": f"gap at saddle {GAP}/{DELTA}",
           "saddle_pressure_over_pstar": f"pressure at saddle {P}/{P_STAR}",
           "elastic_energy_over_pstar_amplitude": f"elastic energy/({P_STAR}{DELTA})", "perimeter": "perimeter"}

# The quantities that have bounds: name, unit, whether their distance is over the quantity itself, and title.
# The mean gap is a constant less the approach: their bounds have the same distance.
BOUNDS = (("energy", "pstar_amplitude", True, "complementary energy, over itself"),
          ("approach", "amplitude", False, f"approach and mean gap, over {DELTA}"))


def summary(picture):
    """Summaries: contact area, mean gap and peak pressure against the mean pressure."""
    first = picture.table
    # The paper's series is shown beside converged values: its waves have one shape, whatever their size. Its points are
    # not joined: the curve is that of the converged values.
    reference, entries = None, []
    if picture.alone and first.method in ("beale", "series"):
        reference = Table(REFERENCE).columns if "cell_y" in first.numbers else CLOSED_FORMS
        entries += [entry("lines ls 31", "closed form" if reference is CLOSED_FORMS else "converged"),
                    entry("points ls 11", "the paper's series")]
    with_linear_law = picture.alone and bool(first.column(LINEAR_LAW))
    if with_linear_law:
        slope = "{/:Italic h}'"
        entries.append(entry("lines ls 33", f"2{P_BAR}/({{/:Italic E}}* {slope}), {slope} the rms slope"))

    def beside(n, load, x, found):
        """The curves that are no solutions: converged values, and for the area the linear law of light loads."""
        full = first.numbers.get("p*", 0.0)*load.factors[0]   # p* on the axis
        unit = found.factors[0]*first.numbers.get(SUMMARY[n][1], 1.0)
        if reference is CLOSED_FORMS:
            parts = [k/200 for k in range(201)]
            loads = [min(1.0, x.low/full*(x.high/x.low)**part) for part in parts] if x.wide else parts
            values = list(map(reference[n], loads))
        elif reference:
            loads, values = (reference[name] for name in ("pbar_over_pstar", list(DETAILS)[n]))
        if reference:
            yield picture.curve("lines ls 31", [full*one for one in loads], [unit*one for one in values])
        if with_linear_law and n == 0:
            columns = first.columns
            yield picture.curve("lines ls 33", load.of(columns["mean_pressure"]), found.of(columns[LINEAR_LAW]),
                                joined=True)

    runs = [(run, table, 11 if reference else 31 + run) for run, table in enumerate(picture.tables)]
    with_errors(picture, SUMMARY, runs, entries, beside, joined=not reference)


def bounds(picture):
    """The distance between the guaranteed bounds of energy and of approach against the mean pressure."""
    table, columns = picture.table, picture.table.columns
    pressures = [table.numbers.get("p*", 1.0)*load for load in columns["pbar_over_pstar"]]
    load, x = mean_pressure_axis([table], [pressures])
    curves, drawn = [], []
    for n, (name, unit, over, title) in enumerate(BOUNDS):
        lower, upper = (columns[f"{name}_{side}_over_{unit}"] for side in ("lower", "upper"))
        widths = [(high - low)/((high + low)/2 if over else 1.0) if high > low else math.nan
                  for low, high in zip(lower, upper)]
        drawn += [width for width in widths if width > 0]
        curves.append(picture.curve(f"linespoints ls {31 + n}", load.of(pressures), widths, title=title,
                                    joined=True))
    if not drawn:
        raise CannotBeDrawn("it has no bounds: the grid lacks waves of the surface, or no load is solved")
    picture.single(x, decades(drawn, "distance between the bounds"), curves, key="top right")


def with_errors(picture, shown, runs, entries, beside, joined=True, also=lambda n, found: [],
                key=lambda n: ""):
    """Panels against the mean pressure with the points of runs, error bars, and marks of what is not accurate.

    shown: the panels, as in SUMMARY. runs: the number of each run, its table, and the number of its style. entries: of
    the key. beside: makes the other curves of a panel, of its number, the load, its axis, and the quantity. joined:
    whether points are. also: numbers that the axis of a panel shows too. key: where that of a panel is.
    """
    load, x = mean_pressure_axis(picture.tables)
    panels, is_open, codes = [], False, [code for _, table, _ in runs for code in table.column("status_code")]
    for column, unit, *label, may_be_wide, up_to in shown:
        found = Quantity(picture.tables, column, unit, may_be_wide=x.wide and may_be_wide)
        rows = [points_of(table, load, found, run, column) for run, table, _ in runs]
        reach = {"Delta": found.factors[0]*picture.table.numbers.get("Delta", 0.0)}.get(up_to, up_to)
        ends = [end for run in rows for _, value, error, *_ in run
                for end in ((value - error, value + error) if error < value else (value,))]
        y = found.axis(*label, numbers=also(len(panels), found) + ends, may_be_wide=x.wide and may_be_wide, up_to=reach)
        is_open = is_open or any(point[4] for run in rows for point in run)
        panels.append((found, y, rows))
    entries = entries + picture.runs("linespoints") + [OPEN_ENTRY]*(is_open and picture.alone)
    entries += [entry("points ls 42", "not accurate")]*(NOT_ACCURATE in codes)
    entries += [entry("points ls 41", "not solved")]*any(code > NOT_ACCURATE for code in codes)
    # Heights of title and key in points: the names of several runs may need two rows.
    title_high, key_high = (28, 24*(len(entries) > 0)) if picture.alone else (0, 40)
    picture.grid(180, 195, len(panels), gaps=(80, 0), room=(70, 16, 67, title_high + key_high + 10))
    for n, (found, y, rows) in enumerate(panels):
        curves = list(beside(n, load, x, found))

        def points(look, run, kept, **kind):
            return picture.curve(look, *zip(*(point[:2] for point in run if kept(point) and math.isfinite(point[1]))),
                                 **kind)

        for run, (*_, look) in zip(rows, runs):
            if joined:
                curves.append(points(f"lines ls {look}", run, lambda point: point[3] <= NOT_ACCURATE, joined=True))
            bars = [(at, value - error, 0.0, 2*error) for at, value, error, *_ in run if 0 < error < value]
            curves.append(picture.curve(f"vectors ls {look} dt solid nohead", *zip(*bars)))
            curves.append(points(f"points ls {look}", run, lambda point: point[3] < NOT_ACCURATE))
        together = [point for run in rows for point in run]
        curves.append(points(OPEN, together, lambda point: point[4] and picture.alone))
        curves.append(points("points ls 41", together, lambda point: point[3] > NOT_ACCURATE))
        curves.append(points("points ls 42", together, lambda point: point[3] == NOT_ACCURATE))
        picture.panel(n, x, y, curves, key=key(n))
    picture.key(entries, title_high + 0.5*key_high)


def points_of(table, load, found, run, column):
    """The points of a run on the axes: load, value, error, status, and whether a good row has an error that is unknown
    or as large as the value. The paper's series knows no errors: it has no such rows."""
    columns = table.columns
    errors = columns.get(f"{column}_error")
    estimated = errors is not None and table.method not in ("beale", "series")
    errors = found.of(errors or [math.nan]*len(columns[column]), run)
    return [(at, value, error, code, estimated and code < NOT_ACCURATE and not (error == 0 or error < value))
            for at, value, error, code in zip(load.of(columns["mean_pressure"], run), found.of(columns[column], run),
                                              errors, columns["status_code"])]


def load_axis(table):
    """The loads of a table over p*, and their axis."""
    loads = table.column("pbar_over_pstar")
    if not loads:
        raise NoPicture("it has no loads over p*: a surface with free edges has no p*")
    return loads, Axis.of(loads, f"mean pressure {P_BAR}/{P_STAR}", up_to=1.0)


def theory(picture):
    """Closed forms against the load, normalised, with the points of the summary."""
    table, (loads, x) = picture.table, load_axis(picture.table)
    picture.grid(206, 176, 3, gaps=(73, 0), room=(73, 23, 72, 152))
    solved = picture.beside.get("summary")
    for n, (column, label) in enumerate(list(DETAILS.items())[:3]):
        found = [form for form in FORMS if form.endswith(column) and table.column(form)]
        # Asymptotes leave the range of the quantity far from where they hold.
        most, up_to = (2.0, None) if column.startswith("peak") else (1.0, 1.0)
        numbers = [0.0] + [number for form in found for number in table.column(form) if 0 <= number <= most]
        y = Axis.of(numbers, label, may_be_wide=x.wide and "gap" not in column, up_to=up_to)
        # Between few loads a line is no closed form: marks show where its numbers are.
        look = "lines ls {}" if len(loads) > MANY else "linespoints ls {} pt 7 ps 0.4*mark"
        drawn = [(look.format(k), table, form, FORMS[form]) for k, form in enumerate(found, 31)]
        if solved:
            drawn.append(("lines ls 36 lw 2.5" if len(loads) > MANY else "points ls 11", solved, column, "solved"))
        picture.panel(n, x, y, [
            picture.curve(look, of.columns["pbar_over_pstar"], of.columns[name], title=title)
            for look, of, name, title in drawn],
                      key="at graph -0.02, 1.03 left bottom font ',10.5' spacing 1.05 samplen 2.4")


def details(picture):
    """Details: a panel for each quantity against the load, and the errors of all, in the colours of their panels."""
    table, (loads, x) = picture.table, load_axis(picture.table)
    columns, size = table.columns, 0 if len(loads) > MANY else 0.7
    picture.grid(180, 170, 3, 3, shared="x")
    for n, (name, label) in enumerate(DETAILS.items()):
        found = Quantity([table], name, "cell_x" if name == "perimeter" else "", may_be_wide=x.wide)
        picture.panel(n, x, found.axis(label, may_be_wide=x.wide), [picture.curve(
            f"linespoints ls {31 + n} dt solid ps {size}*mark", columns["pbar_over_pstar"], found.of(columns[name]))])
    errors = [error for one in DETAILS for error in table.column(one + "_error") if error > 0] or [0.1, 0.5]
    picture.panel(8, x, decades([max(error, 1e-18) for error in errors], "errors, in the colours above"), [
        picture.curve(f"lines ls {k} dt solid", columns["pbar_over_pstar"], columns[one + "_error"], joined=True)
        for k, one in enumerate(DETAILS, 31)])


def pressures_of(table):
    """The mean pressure of each row of a table with rows of loads."""
    columns = table.columns
    if "mean_pressure" in columns:
        return columns["mean_pressure"]
    if "p*" in table.numbers:
        return [table.numbers["p*"]*number for number in columns["pbar_over_pstar"]]
    if not table.summary:
        raise CannotBeDrawn("its loads are in the summary of the run, which is not beside it")
    known = table.summary.columns
    of_load = dict(zip(known["load"], known["mean_pressure"]))
    return [of_load.get(load, math.nan) for load in columns["load"]]


def column(picture):
    """A column of a table with a row for each load against the mean pressure, with error bars."""
    name, body = picture.choice.variable, picture.choice.body
    tables = [table.of_rows("body", body or 1) if "body" in table.names else table for table in picture.tables]
    shown = [one for one in tables[0].names if any(map(math.isfinite, tables[0].columns[one]))]
    if name not in shown:
        words = "has no number" if name in tables[0].names else "is not there"
        raise CannotBeDrawn(f"--variable {name}: this column {words}; those with numbers are {', '.join(shown)}")
    units = {table.column_units.get(name, "") for table in tables}
    if len(units) > 1:
        raise CannotBeDrawn(f"--variable {name}: its units differ, {' and '.join(sorted(units))}")
    unit = units.pop()
    scale = Scale(max(map(abs, (number for table in tables for number in table.column(name)))),
                  "" if unit in NO_UNIT else unit)
    pressures = [pressures_of(table) for table in tables]
    load, x = mean_pressure_axis(tables, [list(filter(math.isfinite, some)) for some in pressures])
    curves, ends = [], []
    for run, table in enumerate(tables):
        values = [scale.factor*number for number in table.columns[name]]
        errors = [scale.factor*number for number in table.columns.get(name + "_error", [math.nan]*len(values))]
        at = load.of(pressures[run], run)
        bars = [(one, value - error, 0.0, 2*error) for one, value, error in zip(at, values, errors)
                if 0 < error < abs(value)]
        ends += values + [end for _, low, _, high in bars for end in (low, low + high)]
        curves.append(picture.curve(f"vectors ls {31 + run} dt solid nohead", *zip(*bars)))
        curves.append(picture.curve(f"linespoints ls {31 + run}", at, values))
    y = Axis.of(ends, scale.label(marked_up(name)), may_be_wide=x.wide)
    picture.single(x, y, curves + picture.runs("linespoints"), key="" if picture.alone else ABOVE, left=100)


def spots(picture):
    """Numbers of spots and pools, their areas, and percolation, against the mean pressure."""
    table, columns, loads = picture.table, picture.table.columns, pressures_of(picture.table)
    load, x = mean_pressure_axis([table], [list(filter(math.isfinite, loads))])
    picture.grid(215, 148, 3, gaps=([85, 115], 0), room=(75, 20, 67, 95))
    number = axis(table.column("spots") + table.column("closed_pools"))
    names = {"spots": 31, "largest_spot": 33, "closed_pools": 32}
    fractions = [part for name in names for part in table.column(f"{name}_area_fraction")]
    for n, ending, y in ((0, "", Axis(*number[:2], max(number[2], 1.0), number[3], "number")),
                         (1, "_area_fraction", Axis.of(fractions, f"area {AREA}", may_be_wide=x.wide, up_to=1.0))):
        picture.panel(n, x, y, [
            picture.curve(f"linespoints ls {look} ps 0.7*mark", load.of(loads), columns[name + ending],
                          title="contact" if name == "spots" and n == 1 else name.replace("_", " "))
            for name, look in names.items() if name + ending in columns], key=ABOVE)
    rows = [(part, along) for part in ("gap", "contact") for along in "yx"]
    names = ", ".join(f"'{part}, {X if along == 'x' else Y}' {place}" for place, (part, along) in enumerate(rows, 1))
    picture.panel(2, x, Axis(0.5, 4.5), [
        picture.curve(f"points ls {31 if part == 'contact' else 32}", load.of(loads), [
            place if percolates == 1 else math.nan for percolates in columns[f"{part}_percolates_{along}"]])
        for place, (part, along) in enumerate(rows, 1)], "set format y '%s'", f"set ytics ({names})",
        "set label 2 'percolates along' at graph 0.5, 1.04 center font ',12'")


def spot_sizes(picture):
    """How many spots and pools of each load have at least an area, as steps downwards."""
    loads, kinds = picture.loads(MOST_CURVES), ([], [])
    areas = [area for load in loads for area in load.columns["area_fraction"] if area > 0]
    ranks = [rank for load in loads for rank in load.columns["rank"]]
    least, most = a_decade(areas or [0.1, 1.0])
    few = max(ranks, default=1) < FEW
    picture.grid(355, 251, room=(80, 165, 67, 42))
    for load in loads:
        columns = load.columns
        # A pool carries no load, but its rank begins again from 1.
        sizes = list(zip(columns["rank"], columns["area_fraction"]))
        first = next((k for k in range(1, len(sizes)) if sizes[k][0] <= sizes[k - 1][0]), len(sizes))
        for curves, part, width, title in (
                (kinds[0], sizes[:first], 1.5, load.name), (kinds[1], sizes[first:], 0.8, None)):
            # From the largest downwards, to the edge of the picture; none lies below it.
            steps = [(area, rank) for rank, area in part if area > 0] or [(least, 0.0 if few else NONE)]
            steps = [(steps[0][0], 0.0 if few else NONE), *steps, (least, steps[-1][1])]
            curves.append(picture.curve(f"steps {load.colour} lw {width}", *zip(*steps), title=title))
    x = Axis(least, most, wide=True, label=f"area {AREA}")
    y = Axis(0.8, 1.6*max(ranks, default=1.0), wide=True, label="number of at least this area")
    if few:
        y = dataclasses.replace(y, low=0.0, high=max(ranks, default=1.0) + 0.5, step=1.0, wide=False)
    # Spots are blue; pools, orange and thin, have a plot of their own over this one, for its colours.
    looks = [entry("lines lc rgb blue lw 1.5", "spots"), entry("lines lc rgb red lw 0.8", "pools")]
    picture.panel(0, x, y, kinds[0] + looks, key=RIGHT)
    picture.panel(0, x, y, kinds[1], "unset grid", "eval of_gap", "set cbrange [-0.2:1]")


def histogram(picture):
    """Densities of pressure over the contact, and of gap over the open area, times p* and Delta."""
    loads = picture.loads(MOST_CURVES)
    picture.grid(215, 211, 2, gaps=(98, 0), room=(98, 174, 67, 42))
    for n, (name, unit, symbol) in enumerate((("pressure", "p*", P), ("gap", "Delta", GAP))):
        numbers = [number for load in loads for number in load.columns[name]]
        found, size = Quantity(picture.tables, [numbers], unit), picture.table.numbers.get(unit)
        # Without p*, with free edges, densities are those over the numbers on the axis.
        unit_of = found.scale.unit and f" [1/{marked_up(found.scale.unit)}]"
        factor, over = (size, f" × {OVER[unit]}") if size else (1/found.factors[0], unit_of)
        # A bin in which nearly all of the area lies would hide the others.
        heights = sorted(factor*number for load in loads for number in load.columns[name + "_density"])
        heights = [0.0] + [number for number in heights if number <= 3*heights[int(0.98*(len(heights) - 1))]]
        y = Axis.of(heights, f"density of {name}{over}", may_be_wide=False)
        curves = [picture.curve(f"histeps {load.colour} lw 1.2", found.of(load.columns[name]), [
            factor*number for number in load.columns[name + "_density"]], title=load.name) for load in loads]
        picture.panel(n, found.axis(symbol, name, may_be_wide=False), y, curves, key=RIGHT if n else "")
