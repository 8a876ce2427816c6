"""The pictures of fields: lines, maps, edges of contact, coefficients, heights and spectra of the surface."""
import copy
import dataclasses
import math

from axes import Axis, a_decade, decades, label_of_unit, step_of
from picture import GAP, MOST_CURVES, MOST_EDGES, MOST_PANELS, P, P_BAR, P_STAR, RIGHT, X, Y, CannotBeDrawn, \
    Quantity, entry

# Points of a map along a side that a picture can show.
MOST_PIXELS = 800
# A colour map ends at this part of its numbers if the largest is so many times as large, and then says the largest.
SHOWN, FAR = 0.995, 1.25
SHOWN_TENSION = 0.8   # with adhesion tension is infinite at the edge of contact
SAMPLE = 300000   # numbers of a map from which this is found
# An outline is this part of the spots' width wide, at most the second number in points. One thinner than the third is
# not drawn: where spots have few pixels it would hide them.
PART_OF_SPOT, WIDEST, THINNEST = 0.08, 0.8, 0.3
# Closed forms along lines, by the number of dimensions: the columns of pressures and gaps.
ALONG_LINES = {1: (["westergaard_pressure_over_pstar"], ["westergaard_gap_over_amplitude"]),
               2: (["hertz_pressure_over_pstar", "crack_pressure_over_pstar"], ["crack_gap_over_amplitude"])}
# Densities this far below the largest are rounding of the heights, and not shown.
ROUNDING = 1e-12
FEW = 6   # so few points of spectra are larger, and those along x and y of two sizes
# What maps are of: column, unit, and its symbol.
FIELDS = ("pressure", "p*", P), ("gap", "Delta", GAP)
MISSING = math.nan


def lines(picture, along=None):
    """Lines, pressure above gap, and closed forms along lines, dashed, alone or with the lines."""
    first, tables, solved = picture.table, picture.tables, picture.table.kind != "theory_lines"
    theory = picture.beside.get("theory_lines") if solved else first
    dimension = min(int(max(table.column("line"))) for table in tables)
    loads = picture.loads(MOST_CURVES)
    length = Quantity(tables, "distance", "cell_x")
    longest = [length.factors[0]*max(distance for distance, line in zip(first.column("distance"), first.column("line"))
                                     if line == number) for number in range(1, dimension + 1)]
    unit, step = (248 if dimension == 1 else 508)/sum(longest), Axis.of(longest[:1], "").step
    picture.grid([unit*one for one in longest], 157, down=2, gaps=(30, 15), room=(72, 150, 67, 34), shared="xy")

    for n, ((field, unit_of, symbol), forms) in enumerate(zip(FIELDS, ALONG_LINES[dimension])):
        # What is drawn: the number of the run, its columns, numbers, look and title.
        drawn = [(run, columns, columns[field], look, title) for load in loads * solved
                 for run, columns, look, title in picture.curves_of(load)]
        size = first.numbers.get(unit_of, 1.0)
        for load in loads if theory else ():
            # In 2-D Hertz's for light loads and the crack's for heavy ones, where they are positive.
            block, look = theory.blocks[load.place], f"lines {load.colour} lw {'1.2 dt (4, 3)' if solved else 1.5}"
            title = None if solved else load.name
            drawn += [(0, block.columns, [size*number if dimension == 1 or number > 0 else MISSING
                                          for number in block.columns[name]], look, title) for name in forms
                      if dimension == 1 or name.startswith("hertz") == (block.pbar_over_pstar < 0.4)]
        numbers = [[number for at, _, some, *_ in drawn if at == run for number in some if math.isfinite(number)]
                   for run in range(len(tables))]
        found = Quantity(tables, numbers, unit_of)
        y = found.axis(symbol, field, may_be_wide=False)
        for line in range(1, dimension + 1):
            curves = []
            for run, columns, some, look, title in drawn:
                rows = zip(length.of(columns["distance"], run), found.of(some, run), columns["line"])
                curves.append(picture.curve(look, *zip(*((x, y) for x, y, k in rows if k == line)), title=title))
            if solved and theory:
                curves.append(entry("lines lc rgb black lw 1.2 dt (4, 3)", "closed forms"))
            label = along or "distance" + (" along " + ("x", "the diagonal")[line - 1] if dimension == 2 else "")
            picture.panel(n*dimension + line - 1, Axis(0.0, longest[line - 1], step, label=length.label(label)), y,
                          curves + picture.runs("lines"), key=RIGHT if n == 0 and line == dimension else "")


def maps(picture):
    """Maps: a column of panels a load, contact above pressure above gap; side by side for one load; or regions."""
    table = picture.table
    if picture.choice.variable == "regions":
        draw_regions(picture)
        return
    if len(table.cell) == 1:
        take_as_lines(picture)
        lines(picture, X)
        return
    loads = picture.loads(MOST_PANELS)
    found, rows = [], [("contact", ["eval of_contact", "set cbrange [0:1]"], "")]
    for (name, unit, symbol), colours in zip(FIELDS, ("eval of_contact", "eval of_gap")):
        columns = [load.columns[name] for load in loads]
        # A map has too many numbers for a list of all.
        ends = [end(map(end, columns)) for end in (min, max)]
        found.append(Quantity([table], [ends], unit))
        label, factor = found[-1].label(symbol, name), found[-1].factors[0]
        numbers = sorted(factor*number for column in columns for number in column[::1 + len(column)//SAMPLE]
                         if number < 0 or number > 0)
        pulls = table.adhesive and ends[0] < 0
        most = max(of_sorted([number for number in numbers if number > 0], SHOWN),
                   of_sorted([-number for number in reversed(numbers) if number < 0], SHOWN_TENSION)*pulls) or 1.0
        largest = factor*max(map(abs, ends) if pulls else ends)
        most, label = (max(most, largest), label) if largest <= FAR*most else \
            (most, (label, f"from −{-factor*ends[0]:.4g} to {factor*ends[1]:.4g}" if pulls else
                    f"largest {largest:.4g}"))
        # As the pictures of stresses: pressure is blue, tension orange.
        rows.append(("", ["eval of_sign", "set palette negative"] if pulls else [colours], label))
        rows[-1][1].append(f"set cbrange [{-most if pulls else 0}:{most!r}]")

    def fields(pressure, gap):
        """What panels show, white where there is nothing of it: contact, the pressure in it, the gap beside it."""
        is_contact = table.is_contact(pressure, gap)
        return (0.75 if is_contact else MISSING, found[0].factors[0]*pressure if is_contact else MISSING,
                MISSING if is_contact else found[1].factors[0]*gap)

    drawn = [(picture.image(*closed(table, load.place, fields)), outline(picture, table, load)) for load in loads]
    cells(picture, loads, [(name, [[f"{image}:{3 + n} with image", edge] for image, edge in drawn], colours, label)
                           for n, (name, colours, label) in enumerate(rows)])


def of_sorted(numbers, part):
    """The number below which a part of sorted numbers lies; 0 if there are none."""
    return numbers[int(part*(len(numbers) - 1))] if numbers else 0.0


def draw_regions(picture):
    """Maps, a panel for each load: spots of contact in colours, and the gap by whether it percolates."""
    table = picture.table
    if not table.numbers:
        raise CannotBeDrawn("regions of a map in numpy's format need the summary of the same run beside it")
    # With free edges, where there is no p*, nothing is repeated.
    if len(table.cell) == 1 or "p*" not in table.numbers:
        raise CannotBeDrawn("regions are those of a surface that is repeated along x and y")
    try:
        import regions
    except ImportError:
        raise CannotBeDrawn("regions need numpy: python3 -m pip install numpy") from None
    loads = picture.loads(MOST_PANELS)
    spots, drawn, entries = picture.beside.get("spots"), [], {}
    for place, load in enumerate(loads):
        columns, many = load.columns, len(set(load.columns["x"]))
        contact = table.is_contact(*(regions.np.reshape(columns[name], (-1, many)) for name in ("pressure", "gap")))
        colours = regions.regions(contact, table.mirrored)
        columns["region"] = colours.ravel().tolist()
        row = {name: some[load.place] for name, some in spots.columns.items()} if spots else {}
        known = regions.legend(colours, row)
        if len(loads) > 1:
            # One key for all panels: an axis stands above its panel. Along one alone both gap and contact percolate.
            along = {words.rpartition(" along ")[2] for words, _ in known if " along " in words}
            loads[place] = load._replace(name=", along ".join([load.name, *along]))
            known = regions.legend(colours, {})
        entries |= dict(known)
        drawn.append([f"{picture.image(*closed(table, load.place, lambda kind: (kind,), ('region',)))}:3 with image"])
    palette = ", ".join(f"{n} '{colour}'" for n, colour in enumerate(regions.COLOURS))
    last = len(regions.COLOURS) - 1
    look = [f"set palette maxcolors {last + 1} defined ({palette})", f"set cbrange [0:{last}]"]
    cells(picture, loads, [("", drawn, look, "")],
          key=[entry(f"points pt 5 ps 1.5*mark lc rgb '{colour}'", words) for words, colour in entries.items()])


def length_of(table):
    """The sides of the cell as a quantity."""
    return Quantity([table], [table.cell], "cell_x")


def cells(picture, loads, rows, common=None, size=150, section=None, key=()):
    """Panels of colours over a cell: a column for each load and a row for each field, side by side if there is one
    load.

    loads: None without. rows: name of the row, curves of each load, commands of its colours, and the label of a bar, ''
    without. common: the label of one bar for all. size: of a panel. section: the ranges of its axes and their labels in
    place of those of the cell; it does not have the true shape. key: entries of a key at the right.
    """
    length, names = length_of(picture.table), [load.name for load in loads] if loads else [""]*len(rows[0][1])
    (range_x, range_y), labels = section or (([0.0, side] for side in length.numbers), map(length.label, (X, Y)))
    sides = [max(range_x), max(range_y)]
    wide, tall = panel_of(sides, size, 0.7, 1.5) if section else panel_of(sides, size)
    by_load = len(names) > 1
    gaps = 24 if by_load else [109 if label else 24 for *_, label in rows[:-1]]
    across, down = (len(names), len(rows)) if by_load else (len(rows), 1)
    picture.grid(wide, tall, across, down, (gaps, 16), (96, 190 if key else 100, 60, 46), "xy")
    font = ",12" if size < 200 else ",14"
    x, y = (Axis(*ends, step_of(360*side/points), label=label, font=font)
            for ends, side, points, label in zip((range_x, range_y), sides, (wide, tall), labels))
    look = ["unset grid", "set border 15 lw 0.7 front", *["set size ratio -1"]*(not section)]
    for r, (row, curves_of_loads, colours, label) in enumerate(rows):
        for c, (name, curves) in enumerate(zip(names, curves_of_loads)):
            n = r*across + c if by_load else r
            above, beside = (name if r == 0 else "", row) if by_load else (row or name*(r == 0), name*bool(row))
            y_axis = y if n % across or not beside else \
                dataclasses.replace(y, label=(beside, y.label), options="offset -1.2, 0")
            bar = ["unset colorbox"]
            if label and c == len(names) - 1:
                bar = picture.colours(n, n, label)
            elif common and n == across*down - 1:
                bar = picture.colours(across - 1, n, common)
            is_last = c == len(names) - 1 and r == 0
            picture.panel(n, x, y_axis, [*curves, *(key if is_last else ())], *look, *colours, *bar, title=above,
                          key=RIGHT if key and is_last else "")


def take_as_lines(picture):
    """Puts a table of one line in place of the map of a profile."""
    blocks = []
    for place, block in enumerate(picture.table.blocks):
        (row,), *_ = closed(picture.table, place, lambda *numbers: numbers, factor=1.0)
        blocks.append(copy.copy(block))
        blocks[-1].columns = {"distance": row[::4], "pressure": row[2::4], "gap": row[3::4],
                              "line": [1.0]*(len(row)//4)}
    picture.table = picture.table.with_blocks(blocks)
    picture.table.names = list(blocks[0].columns)
    picture.tables, picture.beside = [picture.table], {}


def panel_of(cell, size, least=0.45, most=2.2):
    """Width and height of a panel of true shape in points: about the same area, whatever the cell's shape."""
    stretch = min(max(math.sqrt(cell[1]/cell[0]), least), most)
    return size/stretch, size*stretch


def closed(table, place, field, names=("pressure", "gap"), factor=None):
    """The points of a map in rows for Picture.image: x and y on the axes, or times a factor, and what `field` makes of
    the named columns. The first column and row stand once more behind the last, of a mirrored map the last ones: the
    cell is closed. Points that a picture cannot show are left out. Returns the rows and the numbers of points.
    """
    block, factor = table.blocks[place].columns, factor or length_of(table).factors[0]
    columns = len(set(block["x"]))
    rows = len(block["x"])//columns
    step = max(1, math.ceil(max(columns, rows)/MOST_PIXELS))
    cell, records = table.cell, []
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


def outline(picture, table, load, contour=None, size=150, look=None, dashes=""):
    """The edges of contact of a load over one cell, thinner where spots are small, None where lines would hide them.

    table: has the cell. contour: the edges, in place of those beside it. size: of a panel, as of `cells`. look: of
    lines that are not left out, in place of that of outlines.
    """
    contour, factor = contour or picture.beside.get("contour"), length_of(table).factors[0]
    wide = panel_of(table.cell, size)[0]
    blocks = [block for block in (contour.blocks if contour else ()) if block.load == load.blocks[0].load]
    if not blocks:
        return None
    cell, xs, ys, length, area = table.cell, [], [], 0.0, 0.0
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


def edges(picture):
    """Contours: all loads on one cell, coloured by the load; in 1-D the strips of contact, one above the other."""
    table, sides = picture.table, picture.table.cell
    loads, length, p_star = picture.loads(MOST_EDGES), length_of(table), table.numbers.get("p*", 1.0)
    found = Quantity([table], [[p_star*load.blocks[0].pbar_over_pstar for load in loads]], "p*")
    axis = found.axis(P_BAR, "mean pressure", up_to=found.factors[0]*table.numbers.get("p*", 0.0))
    loads = list(zip(loads, found.numbers))
    if len(sides) > 1:
        colours = [f"set cbrange [{axis.low!r}:{axis.high!r}]",
                   *(("set logscale cb", "set format cb '10^{%T}'") if axis.wide else ())]
        drawn = [outline(picture, table, load, table, 300, f"lc palette cb {at!r}") for load, at in loads]
        cells(picture, None, [("", [drawn], colours, axis.label)], size=300)
        return
    strips, marks = [], []
    # A curve is the two ends of a strip, which is drawn as a vector from the first to the second: lines would begin
    # with small spikes, as gnuplot rounds their first point to whole pixels.
    every = [x for load, _ in loads for x in load.columns["x"]]
    for load, at in loads:
        for x, _ in curves_of(load.blocks[0]):
            for k in copies(table, every, sides[0]):
                ends = length.of(k*sides[0] + one for one in x)
                strips.append((ends[0], at, ends[-1] - ends[0], 0.0))
                marks += [(end, at) for end in ends]
    side = length.numbers[0]
    picture.single(Axis(0.0, side, step_of(1.5*side), label=length.label(X)), axis, [
        picture.curve("vectors nohead lc rgb blue lw 2", *zip(*strips)),
        picture.curve("points lc rgb blue pt 7 ps 0.4*mark", *zip(*marks))])


def series(picture):
    """The sizes of coefficients against the harmonic, a colour for each load."""
    table, loads = picture.table, picture.loads(MOST_CURVES)
    dimension = 2 if any(table.column("j")) else 1
    # Coefficients of exactly zero are no less than the least that is shown.
    sizes = [abs(number) for load in loads for number in load.columns["pressure_over_pstar"] if number]
    top = max(sizes, default=1.0)
    low = max(min(sizes, default=top/10), 1e-16*top)
    y = decades([low, top], f"coefficient |{{/:Italic A_{'i' if dimension == 1 else '{ij}'}}}|/{P_STAR}", 1.001)
    highest = max(map(math.hypot, table.column("i"), table.column("j")))
    harmonic = "{/:Italic i}" if dimension == 1 else "({/:Italic i}^2 + {/:Italic j}^2)^{1/2}"
    curves = [picture.curve(f"points {load.colour} lw 1.2 pt 7 ps 0.7*mark", map(math.hypot, *(
        load.columns[name] for name in "ij")), map(abs, load.columns["pressure_over_pstar"]), title=load.name)
              for load in loads]
    picture.single(Axis(0, highest + 0.5, label="harmonic " + harmonic), y, curves, key=RIGHT, right=160)


def spectra(picture):
    """Power spectra: the radial one, and those along x and y, both logarithmic; of a profile the one along it."""
    blocks = picture.table.blocks
    kinds = [("spectrum_2d", 4, "", blocks[:1]), ("spectrum_1d", 3, "_1", blocks[1:])] if len(blocks) == 3 else \
        [("spectrum_1d", 3, "_1", blocks)]

    def points(columns, column):
        """Zeros, such as the mean, have no place on these axes; there a curve is interrupted."""
        least = ROUNDING*max(columns[column])
        return [(q, c) if q > 0 and c > least else (MISSING, MISSING)
                for q, c in zip(columns["wave_number"], columns[column])]

    found = [[points(block.columns, column) for block in of_kind] for column, _, _, of_kind in kinds]
    numbers = [q for of_kind in found for some in of_kind for q, _ in some if q > 0]
    if not numbers:
        raise CannotBeDrawn("there are no waves")
    unit = label_of_unit(picture.table.label("cell_x"))
    x = Axis(*a_decade(numbers), wide=True, label="wave number {/:Italic q}" + (unit and f" [rad/{unit}]"))
    picture.grid(240, 216, len(kinds), gaps=(90, 0), room=(80, 24, 72, 42))
    for n, (of_kind, (_, power, index, _)) in enumerate(zip(found, kinds)):
        sizes = [c for some in of_kind for _, c in some if c > 0] or [1.0]
        y = decades(sizes, f"spectrum {{/:Italic C}}{index}" + (unit and f" [{unit}^{power}]"), 1.001)
        several, few = len(of_kind) == 2, len(sizes) <= FEW
        picture.panel(n, x, y, [picture.curve(f"linespoints ls {31 + k} ps {1.6 - 0.7*k if few else 0.5}*mark",
                                              *zip(*some), title=f"along {(X, Y)[k]}" if several else None)
                                for k, some in enumerate(of_kind)], key="top right samplen 2" if several else "")


def heights(picture):
    """Heights over the mean as colours over one cell, grey at the mean; of profiles a curve."""
    table = picture.table
    ends = [end(table.columns["height"]) for end in (min, max)]
    height, length = Quantity([table], [ends], "Delta"), length_of(table)
    rows = closed(table, 0, lambda number: height.of((number,)), ("height",))
    if len(table.cell) > 1:
        most = max(map(abs, height.numbers)) or 1.0
        cells(picture, None, [("", [[picture.image(*rows) + ":3 with image"]], [
            "eval of_sign", f"set cbrange [{-most!r}:{most!r}]"], height.label("height"))], size=260)
        return
    side, row = length.numbers[0], rows[0][0]
    picture.single(Axis(0.0, side, step_of(side), label=length.label(X)), height.axis("height", may_be_wide=False),
                   [picture.curve("lines ls 31", row[::3], row[2::3])])
