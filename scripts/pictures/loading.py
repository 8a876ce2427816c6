"""The pictures against the load: summaries, closed forms, details, spots and their sizes, histograms."""
import math
import os

from axes import Axis, axis, decades
from picture import AREA, AREA_0, DELTA, GAP, MEAN_GAP, MOST_CURVES, OPEN, OPEN_ENTRY, P, P_BAR, P_MAX, P_STAR, X, Y, \
    CannotBeDrawn, Picture, Quantity, bars, entry, load_names, mean_pressure_axis, mean_pressures, runs_of, shaded, shown
from table import Table

REFERENCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "outputs", "reference", "wave_2d.dat")
# The status of a grid whose errors may be unknown. Those of the paper's series are NaN too, but never known.
UNRESOLVED = 4
# The status of a load that is not accurate. Below are those of solutions, above those of loads that are not solved.
NOT_ACCURATE = 10
LINEAR_LAW = "linear_area_fraction"
NONE = 0.5   # less than one spot, on a logarithmic axis
MANY = 30    # so many points are joined without marks
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
DETAILS = {"contact_area_fraction": f"contact area {AREA}/{AREA_0}",
           "mean_gap_over_amplitude": f"mean gap {MEAN_GAP}/{DELTA}",
           "peak_pressure_over_pstar": f"peak pressure {P_MAX}/{P_STAR}",
           "trough_gap_over_amplitude": f"gap at trough {GAP}/{DELTA}",
           "saddle_gap_over_amplitude": f"gap at saddle {GAP}/{DELTA}",
           "saddle_pressure_over_pstar": f"pressure at saddle {P}/{P_STAR}",
           "elastic_energy_over_pstar_amplitude": f"elastic energy/({P_STAR}{DELTA})", "perimeter": "perimeter"}


def summary(tables, beside, choice, folder):
    """Summaries: contact area, mean gap and peak pressure against the mean pressure."""
    first, alone = tables[0], len(tables) == 1
    load, x = mean_pressure_axis(tables)
    # The paper's series is shown beside converged values: its waves have one shape, whatever their size. Its points are
    # not joined: the curve is that of the converged values.
    reference = None
    if alone and first.method in ("beale", "series"):
        reference = Table(REFERENCE).blocks[0].columns if "cell_y" in first.numbers else CLOSED_FORMS
    with_linear_law = alone and bool(first.column(LINEAR_LAW))
    panels, is_open, codes = [], False, [code for table in tables for code in table.column("status_code")]
    for column, error_column, head, over, symbol, words, wide in (
            ("contact_area_fraction", "contact_area_fraction_error", "", AREA_0, AREA, "contact area", x.wide),
            ("mean_gap", "mean_gap_over_amplitude_error", "Delta", DELTA, MEAN_GAP, "mean gap", False),
            ("peak_pressure", "peak_pressure_over_pstar_error", "p*", P_STAR, P_MAX, "peak pressure", x.wide)):
        found = Quantity(tables, column, head, over, may_be_wide=wide)
        runs = [with_errors(table, load, found, run, column, error_column, head) for run, table in enumerate(tables)]
        up_to = {"": 1.0, "Delta": found.factors[0]*first.numbers.get(head, 0.0)}.get(head)
        y = found.axis(symbol, words, [end for run in runs for _, value, error, _ in run for end in bars(value, error)],
                       may_be_wide=wide, up_to=up_to)
        openings = [point[:2] for point in runs[0] if alone and has_no_bar(*point[1:])]
        is_open = is_open or bool(openings)
        panels.append((found, y, runs, openings, found.factors[0]*first.numbers.get(head, 0.0 if head else 1.0)))
    entries = []
    if reference:
        entries += [entry("lines ls 31", "closed form" if reference is CLOSED_FORMS else "converged"),
                    entry("points ls 11", "the paper's series")]
    if with_linear_law:
        entries += [entry("lines ls 33", "2 p̄/(E* h'), h' the rms slope")]
    entries += runs_of(tables, "linespoints")
    entries += [OPEN_ENTRY]*is_open
    entries += [entry("points ls 42", "not accurate")]*(NOT_ACCURATE in codes)
    entries += [entry("points ls 41", "not solved")]*any(code > NOT_ACCURATE for code in codes)
    # Heights of title and key in points: the names of several runs may need two rows.
    title_high, key_high = (28, 24*(len(entries) > 0)) if alone else (0, 40)
    picture = Picture(folder, (780, 272 + title_high + key_high), tables)
    full = first.numbers.get("p*", 0.0)*load.factors[0]   # p* on the axis
    for n, (found, y, runs, openings, unit) in enumerate(panels):
        curves = []
        if reference is CLOSED_FORMS:
            loads = [k/200 for k in range(201)]
            if x.wide:
                loads = [min(1.0, x.low/full*(x.high/x.low)**part) for part in loads]
            points = [(full*one, unit*reference[n](one)) for one in loads]
        elif reference:
            points = [(full*at, unit*one) for at, one in zip(reference["pbar_over_pstar"], reference[list(DETAILS)[n]])]
        if reference:
            curves = [picture.curve("lines ls 31", *zip(*points))]
        if with_linear_law and n == 0:
            curves.append(curve_of_points(picture, "lines ls 33", zip(
                *(of([number for block in first.blocks for number in block.columns[name]]) for of, name in (
                    (load.of, "mean_pressure"), (found.of, LINEAR_LAW)))), joined=True))
        looks = [11 if reference else 31 + r for r in range(len(runs))]
        if not reference:
            curves += [curve_of_points(picture, f"lines ls {look}", (
                point for point in run if point[3] <= NOT_ACCURATE), joined=True) for run, look in zip(runs, looks)]
        curves += [curve_of_bars(picture, look, run) for run, look in zip(runs, looks)]
        curves += [curve_of_points(picture, f"points ls {look}", (point for point in run if point[3] < NOT_ACCURATE))
                   for run, look in zip(runs, looks)]
        curves.append(curve_of_points(picture, OPEN, openings))
        rows = [point for run in runs for point in run]
        curves.append(curve_of_points(picture, "points ls 41", (point for point in rows if point[3] > NOT_ACCURATE)))
        curves.append(curve_of_points(picture, "points ls 42", (point for point in rows if point[3] == NOT_ACCURATE)))
        top = 1 - (title_high + key_high + 10)/picture.height
        picture.panel((0.09 + 0.33*n, 0.32 + 0.33*n, 67.5/picture.height, top), x, y, curves)
    picture.key(entries, title_high, key_high)
    return picture


def with_errors(table, load, found, run, column, error_column, head=""):
    """The points of a run on the axes: load, value, error, status. head: unit of the errors, '' if they have that of
    the value."""
    unit = table.numbers.get(head, 0.0) if head else 1.0
    return [(load.factors[run]*x, found.factors[run]*y, found.factors[run]*unit*error, code) for block in table.blocks
            for x, y, error, code in zip(*(block.columns[name] for name in (
                "mean_pressure", column, error_column, "status_code")))]


def has_no_bar(value, error, code):
    """Whether a good row has an error as large as the value, or one that is unknown: then it is NaN."""
    return code < NOT_ACCURATE and error > 0 and error >= value or code == UNRESOLVED and math.isnan(error)


def curve_of_points(picture, look, points, joined=False):
    """The points that there are, joined in the order of their loads."""
    there = [point[:2] for point in points if not any(map(math.isnan, point[:2]))]
    curve = picture.curve(look, *zip(*there)) if there else None
    return curve.replace(" with ", " smooth unique with ") if curve and joined else curve


def curve_of_bars(picture, look, points):
    rows = [(x, value - error, 0.0, 2*error) for x, value, error, _ in points if 0 < error < value]
    return picture.curve(f"vectors ls {look} dt solid nohead", *zip(*rows))


def load_axis(table):
    """The loads of a table over p*, and their axis."""
    loads = table.column("pbar_over_pstar")
    if not loads:
        raise CannotBeDrawn("it has no loads over p*: a surface with free edges has no p*")
    return loads, Axis(*axis(loads, up_to=1.0), f"mean pressure {P_BAR}/{P_STAR}")


def theory(tables, beside, choice, folder):
    """Closed forms against the load, normalised, with the points of the summary."""
    table, (loads, x) = tables[0], load_axis(tables[0])
    picture, solved = Picture(folder, (860, 400), tables), beside.get("summary")
    for n, (column, label) in enumerate(list(DETAILS.items())[:3]):
        found = [form for form in FORMS if form.endswith(column) and table.column(form)]
        # Asymptotes leave the range of the quantity far from where they hold.
        most, up_to = (2.0, None) if column.startswith("peak") else (1.0, 1.0)
        numbers = [number for form in found for number in table.column(form) if 0 <= number <= most]
        y = Axis(*axis(numbers + [0.0], may_be_wide=x.wide and "gap" not in column, up_to=up_to), label)
        columns = table.blocks[0].columns
        curves = [picture.curve(f"lines ls {k}", columns["pbar_over_pstar"], columns[form], title=FORMS[form])
                  for k, form in enumerate(found, 31)]
        if solved:
            columns = solved.blocks[0].columns
            curves.append(picture.curve("lines ls 36 lw 2.5" if len(loads) > MANY else "points ls 11",
                                        columns["pbar_over_pstar"], columns[column], title="solved"))
        picture.panel((0.085 + 0.325*n, 0.325*(n + 1), 0.18, 0.62), x, y, curves,
                      key="at graph -0.02, 1.03 left bottom font ',10.5' spacing 1.05 samplen 2.4")
    return picture


def details(tables, beside, choice, folder):
    """Details: a panel for each quantity against the load, and the errors of all, in the colours of their panels."""
    table, (loads, x) = tables[0], load_axis(tables[0])
    picture, columns = Picture(folder, (780, 700), tables), tables[0].blocks[0].columns
    for n, (name, label) in enumerate([*DETAILS.items(), ("", "errors, in the colours above")]):
        left, top = 0.09 + 0.33*(n % 3), 0.945 - 0.905/3*(n//3)
        if name:
            found = Quantity(tables, name, "cell_x" if name == "perimeter" else "")
            if name != "perimeter":
                found.factors = [1.0]
            y = found.axis(label, may_be_wide=x.wide).with_label(found.label(label) if name == "perimeter" else label)
            curves = [picture.curve(f"linespoints ls {31 + n} dt solid ps {0 if len(loads) > MANY else 0.7}*mark",
                                    columns["pbar_over_pstar"], found.of(columns[name]))]
        else:
            errors = [error for one in DETAILS for error in table.column(one + "_error") if error > 0] or [0.1, 0.5]
            y = decades([max(error, 1e-18) for error in errors], label)
            curves = [curve_of_points(picture, f"lines ls {k} dt solid", zip(
                columns["pbar_over_pstar"], columns[one + "_error"])) for k, one in enumerate(DETAILS, 31)]
        picture.panel((left, left + 0.235, top - 0.725/3, top), x.bare(n < 6), y, curves)
    return picture


def spots(tables, beside, choice, folder):
    """Numbers of spots and pools, their areas, and percolation, against the mean pressure."""
    table, columns = tables[0], tables[0].blocks[0].columns
    load, x = mean_pressure_axis(tables, lambda table: list(filter(math.isfinite, mean_pressures(table))))
    places = load.of(mean_pressures(table))
    picture = Picture(folder, (900, 310), tables)
    up = 67.5, picture.height - 95
    numbers, areas = {"spots": 31, "closed_pools": 32}, {"spots": 31, "largest_spot": 33, "closed_pools": 32}
    y = axis([number for name in numbers for number in table.column(name)])
    picture.panel(picture.box(75, 290, *up), x, Axis(*y[:2], max(y[2], 1.0), y[3], "number"), [
        picture.curve(f"linespoints ls {look} ps 0.7*mark", places, columns[name], title=name.replace("_", " "))
        for name, look in numbers.items()], key="at graph 0, 1.03 left bottom vertical maxrows 3 samplen 1.5")
    fractions = [number for name in areas for number in table.column(f"{name}_area_fraction")]
    y = axis(fractions, may_be_wide=x.wide, up_to=1.0)
    picture.panel(picture.box(375, 590, *up), x, Axis(*y, f"area {AREA}/{AREA_0}"), [
        picture.curve(f"linespoints ls {look} ps 0.7*mark", places, columns[f"{name}_area_fraction"],
                      title={"spots": "contact"}.get(name, name.replace("_", " ")))
        for name, look in areas.items()], key="at graph 0, 1.03 left bottom vertical maxrows 3 samplen 1.5")
    rows = [(part, along) for part in ("gap", "contact") for along in "yx"]
    names = ", ".join(f"'{part}, {X if along == 'x' else Y}' {place}" for place, (part, along) in enumerate(rows, 1))
    picture.panel(picture.box(705, 865, *up), x, Axis(0.5, 4.5), [
        curve_of_points(picture, f"points ls {31 if part == 'contact' else 32}", (
            (at, place) for at, percolates in zip(places, columns[f"{part}_percolates_{along}"]) if percolates == 1))
        for place, (part, along) in enumerate(rows, 1)], "set format y '%s'", f"set ytics ({names})",
        "set label 2 'percolates along' at graph 0.5, 1.04 center font ',12'")
    return picture


def spot_sizes(tables, beside, choice, folder):
    """How many spots and pools of each load have at least an area, as steps downwards."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_CURVES)
    areas = [area for area in table.column("area_fraction", places) if area > 0]
    least = min(areas, default=0.1)/1.6
    picture, kinds = Picture(folder, (600, 360), tables), ([], [])
    names = load_names(table, places)
    for i, place in enumerate(places):
        columns = table.blocks[place].columns
        # A pool carries no load, but its rank begins again from 1.
        sizes = list(zip(columns["rank"], columns["area_fraction"]))
        first = next((k for k in range(1, len(sizes)) if sizes[k][0] <= sizes[k - 1][0]), len(sizes))
        for curves, part, width, title in (
                (kinds[0], sizes[:first], 1.5, names[i]), (kinds[1], sizes[first:], 0.8, None)):
            # From the largest downwards, to the edge of the picture; none lies below it.
            steps = [(area, rank) for rank, area in part if area > 0] or [(least, NONE)]
            steps = [(steps[0][0], NONE), *steps, (least, steps[-1][1])]
            curves.append(picture.curve(f"steps {shaded(i, len(places), width)}", *zip(*steps), title=title))
    x = Axis(least, max(areas, default=1.0)*1.6, wide=True, label=f"area {AREA}/{AREA_0}")
    y = Axis(0.8, 1.6*max(table.column("rank", places), default=1.0), wide=True, label="number of at least this area")
    box = picture.box(80, picture.width - 165, 67.5, picture.height - 42)
    # Spots are blue; pools, orange and thin, have a plot of their own over this one, for its colours.
    looks = [entry("lines lc rgb blue lw 1.5", "spots"), entry("lines lc rgb red lw 0.8", "pools")]
    picture.panel(box, x, y, kinds[0] + looks,
                  key=f"at screen {1 - 155/picture.width}, graph 1 left top samplen 1.5")
    picture.panel(box, x, y, kinds[1], "unset grid", "eval of_gap", "set cbrange [-0.2:1]")
    return picture


def histogram(tables, beside, choice, folder):
    """Densities of pressure over the contact, and of gap over the open area, times p* and Delta."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_CURVES)
    names, picture = load_names(table, places), Picture(folder, (800, 320), tables)
    for left, name, unit, over, symbol in ((82, "pressure", "p*", P_STAR, P), (387, "gap", "Delta", DELTA, GAP)):
        found, size = Quantity(tables, name, unit, over), table.numbers.get(unit, 1.0)
        x = found.axis(symbol, name, found.of(table.column(name, places)), may_be_wide=False)
        # A bin in which nearly all of the area lies would hide the others.
        heights = sorted(size*number for number in table.column(name + "_density", places))
        heights = [0.0] + [number for number in heights if number <= 3*heights[int(0.98*(len(heights) - 1))]]
        y = Axis(*axis(heights, may_be_wide=False), f"density of {name} × {over}")
        curves = [picture.curve("histeps " + shaded(i, len(places), 1.2), found.of(columns[name]),
                                [size*number for number in columns[name + "_density"]], title=names[i])
                  for i, columns in enumerate(table.blocks[place].columns for place in places)]
        picture.panel(picture.box(left, left + 215, 67.5, picture.height - 42), x, y, curves,
                      key="at graph 1.03, 1 left top samplen 1.5" if name == "gap" else "")
    return picture
