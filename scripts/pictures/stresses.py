"""The pictures of stresses below the surface."""
import bisect
import math
import sys

from axes import Axis, axis, chosen, step_of
from fields import CELL, cell_of, closed, matched, outline, panel_of
from loading import NOT_ACCURATE, curve_of_bars, curve_of_points, with_errors
from picture import DEPTH, MOST_CURVES, MOST_PANELS, MOST_PIXELS, OPEN, OPEN_ENTRY, P_STAR, X, Y, CannotBeDrawn, \
    Picture, Quantity, bars, entry, load_names, mean_pressure_axis, runs_of, shaded, shown

# The columns of stresses that can be shown, and their labels: symbol and words.
SYMBOLS = {"von_mises": ("{/:Italic σ}_{vM}", "von Mises stress"),
           "largest_shear": ("{/:Italic τ}_{max}", "shear stress"),
           "stress_pressure": ("−{/:Italic σ_{kk}}/3", ""),
           **{f"stress_{axes}": (f"{{/:Italic σ_{{{axes}}}}}", "") for axes in ("xx", "yy", "zz", "xy", "xz", "yz")},
           **{f"principal_{i}": (f"{{/:Italic σ}}_{i}", "") for i in (1, 2, 3)}}
# The order of panels below the crest; those of shear components are left out where symmetry makes them vanish.
BELOW_CREST = ("stress_xx", "stress_yy", "stress_zz", "von_mises", "stress_xy", "stress_xz", "stress_yz",
               "largest_shear")
VANISHING = 1e-6   # of the largest stress
LEAST_ROWS = 161   # of the picture of a section


def of_body(table, choice):
    """A table with the blocks of one body alone. That there is another is said unless the body was chosen."""
    body = choice.body or 1
    blocks = [block for block in table.blocks if block.body == body]
    if not blocks:
        raise CannotBeDrawn(f"it has no stresses of body {body}")
    if choice.body is None and len(blocks) < len(table.blocks):
        print(f"plot: {table.path}: the first body is shown; --body 2 shows the second", file=sys.stderr)
    return table.with_blocks(blocks)


def below_crest(tables, beside, choice, folder):
    """Stresses on the line below the crest: a panel for each, depth downwards."""
    alone, tables = len(tables) == 1, [of_body(table, choice) for table in tables]
    places = matched(tables, choice.loads, MOST_CURVES if alone else MOST_PANELS)
    loads = load_names(tables[0], [place[0] for place in places])
    size = {name: max((abs(number) for table in tables for number in table.column(name)), default=0.0)
            for name in BELOW_CREST}
    names = [name for name in BELOW_CREST if size[name] > VANISHING*max(size.values())] or ["von_mises"]
    stress = Quantity(tables, lambda table: [number for name in names for number in table.column(name)], "p*", P_STAR)
    depth = Quantity(tables, "depth", "cell_x")
    deepest = max(depth.all()) or 1.0
    across = min(len(names), 5 if len(names) < 6 else 4)
    picture = Picture(folder, (228 + 132*across, 45 + 235*math.ceil(len(names)/across)), tables, ", ".join(loads))
    y = Axis(deepest, 0, step_of(deepest), label=depth.label(DEPTH, "depth"), font=",12")
    for n, name in enumerate(names):
        low, high, *_ = axis(stress.all(name), may_be_wide=False)
        # Panels are narrow: fewer tics, even fewer of numbers of four characters.
        x = Axis(low, high, step_of((2.2 if max(-10*low, high) >= 1000 else 1.5)*(high - low)),
                 label=stress.label(SYMBOLS[name][0]), font=",12")
        curves = []
        for i, place in enumerate(places):
            for run, table in enumerate(tables):
                columns = table.blocks[place[run]].columns
                curves.append(picture.curve("lines " + (shaded(i, len(places)) if alone else f"ls {31 + run}"),
                                            stress.of(columns[name], run), depth.of(columns["depth"], run),
                                            title=loads[i] if alone else None))
        curves += runs_of(tables, "lines")
        left, top = 78 + 132*(n % across), picture.height - 38 - 235*(n//across)
        picture.panel(picture.box(left, left + 98, top - 175, top), x, y.bare(n % across > 0), curves,
                      key=key_at(picture, 78 + 132*across) if n + 1 == across else "")
    return picture


def key_at(picture, left):
    return f"at screen {left/picture.width}, graph 1 left top samplen 2"


def section(tables, beside, choice, folder):
    """A vertical section: a panel for each load, depth downwards."""
    table = of_body(tables[0], choice)
    places = shown(table, choice.loads, MOST_PANELS)
    stress = stress_of(table, choice.variable, places)
    length = Quantity([table], lambda table: table.column("distance") + table.column("depth"), "cell_x")
    wide, deep = (length.of((max(table.column(side)),))[0] for side in ("distance", "depth"))
    images = [[resampled(table.blocks[place].columns, choice.variable, length.factors[0], stress.factors[0])]
              for place in places]
    return panels(folder, tables, (wide, deep), images, load_names(table, places), [""], stress, (0, deep)[::-1],
                  [length.label("distance"), length.label(DEPTH, "depth")], choice.variable)


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
    length = Quantity([table], lambda table: cell_of(table) + depths, "cell_x")
    stress = stress_of(table, choice.variable, range(len(table.blocks)))
    loads = load_names(at_depth[0], places)
    names = [length.scale.value(DEPTH, length.factors[0]*depths[k]) for k in numbers]
    images = [[closed(at_depth[k], place, length.factors[0], lambda number: stress.of((number,)), (choice.variable,))
               for k in numbers] for place in places]
    sides = length.of(cell_of(table))
    if not flat:
        factor, contour = length.factors[0], beside.get("contour")
        return panels(folder, tables, sides, images, loads, names, stress, (0, sides[1]),
                      [length.label(X), length.label(Y)], choice.variable, lambda picture, i, wide: outline(
                          picture, contour, at_depth[0], places[i], factor, wide, dashes="dt (3, 3)"))
    picture = Picture(folder, (221 + 190*len(numbers), 290), tables)
    x = Axis(0, sides[0], step_of(1.5*sides[0]), label=length.label(X), font=",12")
    y = stress.axis(*SYMBOLS[choice.variable], may_be_wide=False)
    for j, name in enumerate(names):
        curves = [picture.curve("lines " + shaded(i, len(places)), rows[0][::3], rows[0][2::3], title=loads[i])
                  for i, (rows, *_) in enumerate(of_load[j] for of_load in images)]
        picture.panel(picture.box(78 + 190*j, 236 + 190*j, 56, 240), x, y.bare(j > 0), curves, title=name,
                      key=key_at(picture, 78 + 190*len(names)) if j + 1 == len(names) else "")
    return picture


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


def stress_of(table, name, places):
    """The stress that is shown."""
    if name not in SYMBOLS:
        raise CannotBeDrawn(f"there is no stress '{name}'; there are {', '.join(SYMBOLS)}")
    return Quantity([table.with_blocks([table.blocks[place] for place in places])], name, "p*", P_STAR)


def panels(folder, tables, sides, images, loads, depths, stress, range_y, labels, variable, edge=lambda *_: None):
    """A stress as colours: a panel for each load and depth, side by side if there is one load; edges over it.

    sides: of a panel. images: rows and their numbers for Picture.image, of each load for each depth. loads, depths:
    what they are called. range_y: from the lower edge to the upper one. labels: of the axes. edge: makes a curve.
    """
    wide, tall = panel_of(sides, 150, 0.7, 1.5)
    by_load = len(loads) > 1
    across, down = (len(loads), len(depths)) if by_load else (len(depths), 1)
    picture = Picture(folder, (112 + across*(wide + 24) + 75, max(46 + down*(tall + 16) + 60, 230)), tables)
    numbers = stress.all() or [0.0]
    most = max(map(abs, numbers)) or 1.0
    negative, positive = min(numbers) < -VANISHING*most, max(numbers) > VANISHING*most
    # Where there is tension and compression the first is orange.
    colours = ["eval of_sign" if negative and positive else "eval of_size"] + ["set palette negative"]*(not positive)
    colours.append(f"set cbrange [{-most if negative else 0}:{most if positive or not negative else 0}]")
    x = Axis(0, sides[0], step_of(2*sides[0]), label=labels[0], font=",12")
    y = Axis(*range_y, step_of(2*sides[1]), label=labels[1], font=",12")
    top = picture.height - 46
    bar = picture.box(102 + across*(wide + 24) - 16, 0, top - (down - 1)*(tall + 16) - tall, top)
    bar = picture.colours(bar, 9, stress.label(*SYMBOLS[variable]), "font ',11' offset -0.6, 0",
                          "font ',11'" if tall < 160 and down == 1 else "font ',14'")
    for r in range(down):
        for c in range(across):
            i, j = (c, r) if by_load else (0, c)
            above, beside_it = (loads[i], depths[j]) if by_load else (depths[j], loads[i])
            # One panel has its load above; a section has no depths.
            if not above:
                above, beside_it = beside_it, ""
            left, upper = 102 + c*(wide + 24), top - r*(tall + 16)
            y_axis = y.bare(c > 0)
            if beside_it and c == 0:
                y_axis = y.with_label((beside_it, y.label), options="offset -1.2, 0")
            picture.panel(picture.box(left, left + wide, upper - tall, upper), x.bare(r + 1 < down), y_axis,
                          [picture.image(*images[i][j]) + ":3 with image", edge(picture, i, wide)], *CELL[:2], *colours,
                          *(bar if c + 1 == across and r + 1 == down else ["unset colorbox"]),
                          title=above if r == 0 else "")
    return picture


def resampled(block, name, factor, factor_of_stress):
    """Distance and depth times a factor, and a column of a section, interpolated to equally spaced depths, which an
    image needs: rows for Picture.image and the numbers of points.
    """
    depths = sorted(set(block["depth"]))
    columns = len(block["depth"])//len(depths)
    if len(depths) < 2:
        raise CannotBeDrawn("a section of one depth is no picture")
    steps = [after - before for before, after in zip(depths, depths[1:])]
    rows = min(MOST_PIXELS, max(LEAST_ROWS, 1 + math.ceil((depths[-1] - depths[0])/min(steps) - 1e-6)))
    order = sorted(range(len(depths)), key=lambda k: block["depth"][k*columns])
    records = []
    for row in range(rows):
        depth = depths[0] + (depths[-1] - depths[0])*row/(rows - 1)
        k = min(max(bisect.bisect(depths, depth) - 1, 0), len(depths) - 2)
        part, record = (depth - depths[k])/steps[k], []
        for i in range(columns):
            above, below = (block[name][order[m]*columns + i] for m in (k, k + 1))
            record += (factor*block["distance"][i], factor*depth, factor_of_stress*(above + part*(below - above)))
        records.append(record)
    return records, columns, rows


def largest(tables, beside, choice, folder):
    """The largest stresses against the mean pressure, with error bars, their depth, their ratio to the yield stress."""
    alone, (load, x) = len(tables) == 1, mean_pressure_axis(tables)
    bodies = [int(max(table.column("body"))) for table in tables]
    first, last = (choice.body,)*2 if choice.body else (1, bodies[0] if alone else 1)
    if last > min(bodies):
        raise CannotBeDrawn(f"it has no stresses of body {last}")
    # Runs that are compared show one body of each. A row of each body stands below that of the other.
    shown_runs = [(run, table.of_rows("body", body), 30 + (body if alone else run + 1))
                  for run, table in enumerate(tables) for body in range(first, last + 1)]
    stress = Quantity(tables, "largest_von_mises", "p*", P_STAR, may_be_wide=x.wide)
    depth = Quantity(tables, lambda table: table.column("von_mises_depth") + table.column("shear_depth"), "cell_x",
                     may_be_wide=x.wide)
    estimated = alone and tables[0].method not in ("beale", "series")
    panels_of, is_open = [], False
    for name, found, error_name, label in (
            ("largest_von_mises", stress, "largest_von_mises_error", SYMBOLS["von_mises"]),
            ("largest_shear", stress, "largest_shear_error", SYMBOLS["largest_shear"]),
            ("von_mises_depth", depth, "shear_depth", (DEPTH, "depth")),
            ("stress_over_yield_stress", Quantity(tables, "stress_over_yield_stress"), "stress_over_yield_stress_error",
             ("largest stress over yield stress",))):
        numbers, is_depth = found.all(name), name == "von_mises_depth"
        runs = [(with_errors(table, load, found, run, name, error_name), look) for run, table, look in shown_runs]
        if found is stress:
            numbers += [end for run, table in enumerate(tables) for _, value, error, _ in with_errors(
                table, load, found, run, name, error_name) for end in bars(value, error)]
        elif is_depth:
            numbers += found.all("shear_depth")
        elif numbers:
            numbers.append(1.0)
        else:
            break
        openings = [point for run, _ in runs for point in run
                    if estimated and not is_depth and point[3] < NOT_ACCURATE and not point[2] < point[1]]
        is_open = is_open or name == "largest_shear" and any(value > 0 for _, value, _, _ in openings)
        # From 0, so that what differs by rounding looks equal.
        panels_of.append((runs, openings, found.axis(*label, numbers=[0.0] + numbers, may_be_wide=x.wide), is_depth))
    entries = runs_of(tables, "linespoints")
    if alone and last > first:
        entries += [entry("linespoints ls 31", "first body"), entry("linespoints ls 32", "second body")]
    entries += [OPEN_ENTRY]*is_open
    if any(code >= NOT_ACCURATE for table in tables for code in table.column("status_code")):
        entries.append(entry("points ls 42", "not accurate or not solved"))
    title_high, key_high = (28, 24*bool(entries)) if alone else (0, 40)
    picture = Picture(folder, (260*len(panels_of), 272 + title_high + key_high), tables)
    for n, (runs, openings, y, is_depth) in enumerate(panels_of):
        curves = ["1 with lines ls 2"]*(n == 3)
        curves += [curve_of_points(picture, f"lines ls {look}", run, joined=True) for run, look in runs]
        curves += [curve_of_bars(picture, look, run) for run, look in runs if not is_depth]
        curves += [curve_of_points(picture, f"points ls {look}", run) for run, look in runs]
        curves.append(curve_of_points(picture, OPEN, openings))
        if is_depth and alone:
            curves += [curve_of_points(picture, "points ls 11 ps 1.3*mark", ((at, other) for at, _, other, _ in run))
                       for run, _ in runs]
        curves += [curve_of_points(picture, "points ls 42", (point for point in run if point[3] >= NOT_ACCURATE))
                   for run, _ in runs]
        if is_depth and alone:
            curves += [entry("points ls 31", "von Mises"), entry("points ls 11 ps 1.3*mark", "shear")]
        box = picture.box(260*n + 70, 260*n + 250, 67.5, picture.height - title_high - key_high - 10)
        picture.panel(box, x, y, curves, key="bottom right samplen 2" if is_depth and alone else "")
    picture.key(entries, title_high, key_high)
    return picture
