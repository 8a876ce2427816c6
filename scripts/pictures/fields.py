"""The pictures of fields: lines, maps, edges of contact, coefficients, heights and spectra of the surface."""
import math

from axes import Axis, axis, chosen, decades, label_of_unit, step_of
from picture import DELTA, GAP, MOST_CURVES, MOST_EDGES, MOST_PANELS, MOST_PIXELS, P, P_BAR, P_STAR, SMALL, X, Y, \
    CannotBeDrawn, Picture, Quantity, entry, load_names, of_loads, runs_of, shaded, shown

# A colour map ends at this part of its numbers if the largest is so many times as large, and then says the largest.
SHOWN, FAR = 0.995, 1.25
SAMPLE = 300000   # numbers of a map from which this is found
# An outline is this part of the spots' width wide, at most the second number in points. One thinner than the third is
# not drawn: where spots have few pixels it would hide them.
PART_OF_SPOT, WIDEST, THINNEST = 0.08, 0.8, 0.3
# Closed forms along lines, by the number of dimensions: the columns of pressures and gaps.
ALONG_LINES = {1: (["westergaard_pressure_over_pstar"], ["westergaard_gap_over_amplitude"]),
               2: (["hertz_pressure_over_pstar", "crack_pressure_over_pstar"], ["crack_gap_over_amplitude"])}
# Densities this far below the largest are rounding of the heights, and not shown.
ROUNDING = 1e-12
# What maps are of: column, unit, its symbol, and that of the quantity.
FIELDS = ("pressure", "p*", P_STAR, P), ("gap", "Delta", DELTA, GAP)
# The look of an image over a cell of true shape.
CELL = "unset grid", "set border 15 lw 0.7 front", "set size ratio -1"
MISSING = math.nan


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


def lines(tables, beside, choice, folder):
    """Lines, pressure above gap, and closed forms along lines, dashed, alone or with the lines."""
    first, solved, alone = tables[0], tables[0].kind == "lines", len(tables) == 1
    theory = beside.get("theory_lines") if solved else first
    dimension = min(int(max(table.column("line"))) for table in tables)
    places = matched(tables, choice.loads, MOST_CURVES if alone else MOST_PANELS)
    names = load_names(first, [place[0] for place in places])
    length = Quantity(tables, "distance", "cell_x")
    picture = Picture(folder, (470 if dimension == 1 else 760, 430), tables, ", ".join(names))
    longest = [length.factors[0]*max(distance for distance, line in zip(first.column("distance"), first.column("line"))
                                     if line == number) for number in range(1, dimension + 1)]
    left, right, between = 72/picture.width, 1 - 150/picture.width, 0 if dimension == 1 else 0.04
    step, unit = axis(longest[:1])[2], (right - left - between)/sum(longest)
    dashes = "1.2 dt (4, 3)" if solved else "1.5 dt solid"

    def form(block, name):
        """A closed form: in 2-D Hertz's for light loads and the crack's for heavy ones, where they are positive."""
        holds = dimension == 1 or name.startswith("hertz") == (block.pbar_over_pstar < 0.4)
        return [number if holds and (dimension == 1 or number > 0) else MISSING for number in block.columns[name]]

    for (field, unit_of, over, symbol), forms, bottom in zip(FIELDS, ALONG_LINES[dimension], (0.555, 0.155)):
        size = first.numbers.get(unit_of, 1.0)

        def numbers_of(table):
            if solved:
                return table.column(field)
            return [0.0] + [size*number for name in forms for block in table.blocks
                            for number in form(block, name) if number > 0]

        found = Quantity(tables, numbers_of, unit_of, over)
        on_axis = [one for run, table in enumerate(tables) for one in found.of(numbers_of(table), run)]
        y = found.axis(symbol, field, on_axis, may_be_wide=False)
        start = left
        for line in range(1, dimension + 1):
            along = "distance" + (" along " + ("x", "the diagonal")[line - 1] if dimension == 2 else "")

            def curve(look, run, block, numbers, title=None):
                places = zip(length.of(block.columns["distance"], run), numbers, block.columns["line"])
                return picture.curve(f"lines {look}", *zip(*((x, y) for x, y, k in places if k == line)), title=title)

            curves = []
            for i, place in enumerate(places if solved else ()):
                for run, table in enumerate(tables):
                    block = table.blocks[place[run]]
                    look = shaded(i, len(places)) if alone else f"ls {31 + run}"
                    curves.append(curve(look, run, block, found.of(block.columns[field], run), names[i]*alone))
            for name in forms if theory else ():
                for i, place in enumerate(places):
                    block = theory.blocks[place[0]]
                    curves.append(curve(shaded(i, len(places), dashes), 0, block,
                                        found.of(size*number for number in form(block, name))))
            curves += [entry(f"lines lc rgb black lw {dashes}", "closed forms")]*bool(solved and theory)
            curves += runs_of(tables, "lines")
            x = Axis(0.0, longest[line - 1], step, label=length.label(along), numbers=field == "gap")
            picture.panel((start, start + unit*longest[line - 1], bottom, bottom + 0.365),
                          x.bare(field != "gap"), y.bare(line > 1), curves,
                          key=f"at screen {right + 0.015}, 0.93 left top samplen 2 spacing 1 "
                          "font ',10.5'" if field == "pressure" and line == dimension else "")
            start += unit*longest[line - 1] + between
    return picture


def maps(tables, beside, choice, folder):
    """Maps: a column of panels for each load, contact above pressure above gap; side by side for one load."""
    table = tables[0]
    flat = len(set(table.blocks[0].columns["y"])) == 1
    places = shown(table, choice.loads, MOST_CURVES if flat else MOST_PANELS)
    names = load_names(table, places)
    length = Quantity(tables, cell_of, "cell_x")
    cell = length.of(cell_of(table))
    found, axes = [], []
    for name, unit, over, symbol in FIELDS:
        ends = ends_of(table, name, places)
        found.append(Quantity(tables, lambda table, ends=ends: ends, unit, over))
        axes.append(found[-1].axis(symbol, name, found[-1].of(ends), may_be_wide=False))
    x, y = (Axis(0.0, side, step_of(max(3*min(cell), max(cell))), label=length.label(symbol)) for side, symbol in zip(
        (*cell, 1.0), (X, Y)))
    if flat:
        picture = Picture(folder, (470, 430), tables)
        for row, (bottom, top) in enumerate(((0.555, 0.92), (0.155, 0.52))):
            fields = [closed(table, place, length.factors[0], lambda *field, row=row: found[row].of((field[row],)))
                      for place in places]
            picture.panel((72/470, 1 - 150/470, bottom, top), x.bare(row == 0), axes[row], [
                picture.curve("lines " + shaded(i, len(places)), rows[0][::3], rows[0][2::3], title=names[i])
                for i, (rows, *_) in enumerate(fields)],
                          key="" if row else f"at screen {1 - 143/470}, 0.93 left top samplen 2")
        return picture
    # Panels of about the same area, whatever the cell's shape.
    wide, tall = panel_of(cell, 150)
    x, y = (Axis(one.low, one.high, one.step, label=one.label, font=",12") for one in (x, y))
    beside_each_other = len(places) == 1
    across, down = (3, 1) if beside_each_other else (len(places), 3)
    size = 96 + across*(wide + 30) + (160 if down == 1 else 80), 46 + down*(tall + 16) + 60
    picture = Picture(folder, size, tables)
    # The paper's series has contact where the pressure exceeds a level.
    level = table.numbers.get("edge_level", 0.0)*table.numbers.get("p*", 1.0)

    def fields(pressure, gap):
        """What panels show, white where there is nothing of it: contact, the pressure in it, the gap beside it."""
        is_contact = pressure > level
        return (0.75 if is_contact else MISSING, found[0].factors[0]*pressure if is_contact else MISSING,
                MISSING if is_contact else found[1].factors[0]*gap)

    images = [picture.image(*closed(table, place, length.factors[0], fields)) for place in places]
    edges = [outline(picture, beside.get("contour"), table, place, length.factors[0], wide) for place in places]
    for n in range(3):
        colours = [f"eval {'of_gap' if n == 2 else 'of_contact'}", "set cbrange [0:1]", "unset colorbox"]
        if n:
            most, label = end_of_colours(table, FIELDS[n - 1][0], places, found[n - 1], axes[n - 1].label)
            colours[1] = f"set cbrange [0:{most!r}]"
        for i, image in enumerate(images):
            left = 96 + (n*(wide + 30) + 85*(n == 2) if beside_each_other else i*(wide + 30))
            top = picture.height - 46 - (0 if beside_each_other else n*(tall + 16))
            if n and i == len(places) - 1:
                bar = picture.box(left + wide + 8, 0, top - 0.95*tall, top - 0.05*tall)
                colours[2:] = picture.colours(bar, 9, label, "font ',11' offset -0.6, 0", SMALL)
            named = n == 0 and i == 0 and not beside_each_other
            y_axis = y.with_label(("contact", y.label), options="offset -1.2, 0") if named else \
                y.bare(i > 0 or (beside_each_other and n > 0))
            picture.panel(picture.box(left, left + wide, top - tall, top), x.bare(not beside_each_other and n < 2),
                          y_axis, [f"{image}:{3 + n} with image", edges[i]], *CELL, *colours,
                          title=names[i] if n == 0 else "")
    return picture


def end_of_colours(table, name, places, found, label):
    """Where a colour map ends, and its label, which says a largest number that lies beyond."""
    columns = [table.blocks[place].columns[name] for place in places]
    numbers = sorted(found.factors[0]*number for column in columns for number in column[::1 + len(column)//SAMPLE]
                     if number > 0) or [1.0]
    most, largest = numbers[int(SHOWN*(len(numbers) - 1))], found.factors[0]*max(map(max, columns))
    if largest <= FAR*most:
        return max(numbers[-1], largest), label
    return most, (label, f"largest {largest:.4g}")


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


def cell_in_head(table):
    return [table.numbers[name] for name in ("cell_x", "cell_y") if name in table.numbers]


def panel_of(cell, size, least=0.45, most=2.2):
    """Width and height of a panel of true shape in points: about the same area, whatever the cell's shape."""
    stretch = min(max(math.sqrt(cell[1]/cell[0]), least), most)
    return size/stretch, size*stretch


def closed(table, place, factor, field, names=("pressure", "gap")):
    """The points of a map in rows for Picture.image: x and y times a factor, and what `field` makes of the named
    columns. The first column and row stand once more behind the last, of a mirrored map the last ones: the cell is
    closed. Points that a picture cannot show are left out. Returns the rows and the numbers of points.
    """
    block = table.blocks[place].columns
    columns = len(set(block["x"]))
    rows = len(block["x"])//columns
    step = max(1, math.ceil(max(columns, rows)/MOST_PIXELS))
    cell, records = cell_of(table), []
    across = list(range(0, columns, step)) + [columns]
    for j in list(range(0, rows, step)) + ([rows] if rows > 1 else []):
        record = []
        for i in across:
            place_of = (j % rows)*columns + i % columns
            point = min(j, rows - 1)*columns + min(i, columns - 1) if table.mirrored else place_of
            record += (factor*(block["x"][place_of] + (cell[0] if i == columns else 0.0)),
                       factor*(block["y"][place_of] + (cell[1] if j == rows > 1 else 0.0)),
                       *field(*(block[name][point] for name in names)))
        records.append(record)
    return records, len(across), len(records)


def copies(table, numbers, side):
    """The cells, counted from 0, in which copies of a curve are to be drawn so that the cell shows all of it.

    numbers: its places along a side. Curves across the border of a mirrored map are their own mirror images.
    """
    return range(1) if table.mirrored else range(-math.floor(max(numbers)/side), 1 - math.floor(min(numbers)/side))


def outline(picture, contour, table, place, factor, wide, look=None, dashes=""):
    """The edges of contact of a load over one cell, thinner where spots are small, None where lines would hide them.

    table: has the load as a block. factor: of lengths on the axis. wide: the width of the cell's picture in points.
    look: of lines that are not left out, in place of that of outlines.
    """
    blocks = [block for block in (contour.blocks if contour else ()) if block.load == table.blocks[place].load]
    if not blocks:
        return None
    cell, xs, ys, length, area = cell_of(table) if table is not contour else cell_in_head(table), [], [], 0.0, 0.0
    for x, y in curves_of(blocks[0]):
        for i in copies(contour, x, cell[0]):
            for j in copies(contour, y, cell[1]):
                xs += [MISSING, *(factor*(i*cell[0] + u) for u in x)]
                ys += [MISSING, *(factor*(j*cell[1] + v) for v in y)]
        length += sum(map(math.dist, zip(x, y), zip(x[1:], y[1:])))
        # Contact lies on the left: holes count as negative. A band's edge does not end where it began.
        is_closed = math.dist((x[0], y[0]), (x[-1], y[-1])) < 1e-6*cell[0]
        area += sum(u*w - t*v for u, v, t, w in zip(x, y, x[1:], y[1:]))/2 if is_closed else math.prod(cell)/4
    spots = min(abs(area), abs(math.prod(cell) - abs(area)))
    width = PART_OF_SPOT*wide/cell[0]*2*spots/length if length else 0.0
    width = min(WIDEST, width) if width > THINNEST else 0.0
    if look:
        return picture.curve(f"lines {look} lw {1.6*width or 0.25}", xs, ys)
    return picture.curve(f"lines lc rgb outline lw {width} {dashes}", xs, ys) if width else None


def curves_of(block):
    """The places along x and y of each curve of a load."""
    number, x, y = (block.columns[name] for name in ("curve", "x", "y"))
    starts = [k for k in range(len(number)) if k == 0 or number[k] != number[k - 1]] + [len(number)]
    for start, end in zip(starts, starts[1:]):
        yield x[start:end], y[start:end]


def edges(tables, beside, choice, folder):
    """Contours: all loads on one cell, coloured by the load; in 1-D the strips of contact, one above the other."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_EDGES)
    load, length = Quantity(tables, of_loads, "p*", P_STAR), Quantity(tables, cell_in_head, "cell_x")
    p_star, sides = table.numbers.get("p*", 1.0), cell_in_head(table)
    loads = load.of(p_star*table.blocks[place].pbar_over_pstar for place in places)
    loads_axis = load.axis(P_BAR, "mean pressure", loads, up_to=load.factors[0]*table.numbers.get("p*", 0.0))
    if len(sides) > 1:
        return over_a_cell(folder, tables, length, sides, lambda picture, wide: [
            outline(picture, table, table, place, length.factors[0], wide, f"lc palette cb {at!r}")
            for place, at in zip(places, loads)], loads_axis.label, 300,
            f"set cbrange [{loads_axis.low!r}:{loads_axis.high!r}]",
            *(("set logscale cb", "set format cb '10^{%T}'") if loads_axis.wide else ()))
    picture, strips, marks = Picture(folder, (480, 320), tables), [], []
    # A curve is the two ends of a strip, which is drawn as a vector from the first to the second: lines would begin
    # with small spikes, as gnuplot rounds their first point to whole pixels.
    for place, at in zip(places, loads):
        for x, _ in curves_of(table.blocks[place]):
            for k in copies(table, table.column("x", places), sides[0]):
                ends = length.of(k*sides[0] + one for one in x)
                strips.append((ends[0], at, ends[-1] - ends[0], 0.0))
                marks += [(end, at) for end in ends]
    picture.panel((None, None, None, 1 - 42/320),
                  Axis(0.0, length.of(sides)[0], step_of(1.5*length.of(sides)[0]), label=length.label(X)), loads_axis, [
                   picture.curve("vectors nohead lc rgb blue lw 2", *zip(*strips)),
                   picture.curve("points lc rgb blue pt 7 ps 0.4*mark", *zip(*marks))])
    return picture


def over_a_cell(folder, tables, length, sides, draw, label, size, *commands):
    """A picture of one cell with a bar of colours. draw: makes the curves of a picture and the width of its panel."""
    cell = length.of(sides)
    wide, tall = panel_of(cell, size)
    picture = Picture(folder, (wide + 180, tall + 105), tables)
    step = step_of(max(1.5*min(cell), max(cell)))
    x, y = (Axis(0.0, side, step, label=length.label(symbol)) for side, symbol in zip(cell, (X, Y)))
    bar = picture.box(80 + wide + 14, 0, 66 + 0.1*tall, 66 + 0.9*tall)
    bar = picture.colours(bar, 12, label, f"{SMALL} offset -0.5, 0")
    picture.panel(picture.box(80, 80 + wide, 66, 66 + tall), x, y, draw(picture, wide), *CELL, *commands, *bar)
    return picture


def series(tables, beside, choice, folder):
    """The sizes of coefficients against the harmonic, a colour for each load."""
    table = tables[0]
    places = shown(table, choice.loads, MOST_CURVES)
    names, picture = load_names(table, places), Picture(folder, (560, 340), tables)
    dimension = 2 if any(table.column("j")) else 1
    # Coefficients of exactly zero are no less than the least that is shown.
    sizes = [abs(number) for number in table.column("pressure_over_pstar", places) if number]
    top = max(sizes, default=1.0)
    low = max(min(sizes, default=top/10), 1e-16*top)
    y = decades([low, top], f"coefficient |{{/:Italic A_{'i' if dimension == 1 else '{ij}'}}}|/{P_STAR}", 1.001)
    highest = max(map(math.hypot, table.column("i"), table.column("j")))
    harmonic = "{/:Italic i}" if dimension == 1 else "({/:Italic i}^2 + {/:Italic j}^2)^{1/2}"
    curves = []
    for i, place in enumerate(places):
        columns = table.blocks[place].columns
        numbers = map(math.hypot, columns["i"], columns["j"]), map(abs, columns["pressure_over_pstar"])
        curves.append(picture.curve(f"points {shaded(i, len(places), 1.2)} pt 7 ps 0.7*mark", *numbers, title=names[i]))
    picture.panel((0.15, 0.72, 0.2, 1 - 42/340), Axis(0, highest + 0.5, label="harmonic " + harmonic), y, curves,
                  key="at graph 1.03, 1 left top samplen 1.5")
    return picture


def spectra(tables, beside, choice, folder):
    """Power spectra: the radial one, and those along x and y, both logarithmic; of a profile the one along it."""
    table = tables[0]
    blocks = table.blocks
    kinds = [("spectrum_2d", 4, "C", blocks[:1]), ("spectrum_1d", 3, "C_1", blocks[1:])] if len(blocks) == 3 else \
        [("spectrum_1d", 3, "C_1", blocks)]
    found = {}
    for column, _, _, of_kind in kinds:
        # Zeros, such as the mean, have no place on these axes; there a curve is interrupted.
        found[column] = []
        for columns in (block.columns for block in of_kind):
            least = ROUNDING*max((c for c in columns[column] if c > 0), default=math.inf)
            found[column].append([(q, c) if q > 0 and c > least else (MISSING, MISSING)
                                  for q, c in zip(columns["wave_number"], columns[column])])
    numbers = [q for of_kind in found.values() for some in of_kind for q, _ in some if q > 0]
    if not numbers:
        raise CannotBeDrawn("there are no waves")
    low, high = min(numbers)/1.5, max(numbers)*1.5
    if math.floor(math.log10(low)) == math.floor(math.log10(high)):
        # An axis needs a power of ten to have a number.
        low, high = 10.0**math.floor(math.log10(low)), 10.0**math.ceil(math.log10(high))
    unit = label_of_unit(table.label("cell_x"))
    x = Axis(low, high, wide=True, label="wave number {/:Italic q}" + (unit and f" [rad/{unit}]"))
    picture = Picture(folder, (90 + 330*len(kinds), 330), tables)
    for n, (column, power, symbol, of_kind) in enumerate(kinds):
        sizes = [c for some in found[column] for _, c in some if c > 0] or [1.0]
        y = decades(sizes, f"spectrum {{/:Italic C}}{symbol[1:]}" + (unit and f" [{unit}^{power}]"), 1.001)
        curves = [picture.curve(f"linespoints ls {31 + k} ps 0.5*mark", *zip(*some),
                                title=f"along {(X, Y)[k]}" if len(of_kind) == 2 else None)
                  for k, some in enumerate(found[column])]
        picture.panel(picture.box(80 + 330*n, 320 + 330*n, 72, 288), x, y, curves,
                      key="top right samplen 2" if len(of_kind) == 2 else "")
    return picture


def heights(tables, beside, choice, folder):
    """Heights over the mean as colours over one cell, grey at the mean; of profiles a curve."""
    table = tables[0]
    columns, rows = table.points
    block = table.blocks[0].columns["height"]
    # Without a head the sides are numbers of points.
    sides = (cell_in_head(table) + [1.0])[:2] if table.numbers else [columns, rows]
    ends = [min(block), max(block)]
    height = Quantity(tables, lambda table: ends, "Delta", DELTA)
    length = Quantity(tables, lambda table: sides[:1 if rows == 1 else 2], "cell_x")
    cell = length.of(sides)
    step = max(1, math.ceil(max(columns, rows)/MOST_PIXELS))
    across = range(0, columns, step)
    records = [[one for i in across for one in (
        cell[0]*i/columns, cell[1]*j/rows, height.factors[0]*block[j*columns + i])] for j in range(0, rows, step)]
    if rows > 1:
        most = height.factors[0]*max(map(abs, ends)) or 1.0
        return over_a_cell(folder, tables, length, sides, lambda picture, wide: [
            picture.image(records, len(across), len(records)) + ":3 with image"], height.label("height"), 260,
            "eval of_sign", f"set cbrange [{-most!r}:{most!r}]")
    picture = Picture(folder, (430, 250), tables)
    picture.panel((0.2, 0.95, 0.27, 1 - 42/250), Axis(0.0, cell[0], step_of(cell[0]), label=length.label(X)),
                  height.axis("height", numbers=height.of(ends), may_be_wide=False),
                  [picture.curve("lines ls 31", records[0][::3], records[0][2::3])])
    return picture
