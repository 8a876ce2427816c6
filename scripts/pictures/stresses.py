"""The pictures of stresses below the surface."""
import bisect
import math
import sys

from axes import Axis, axis, step_of
from fields import MOST_PIXELS, cells, closed, length_of, outline
from loading import with_errors
from picture import DEPTH, MOST_CURVES, MOST_PANELS, RIGHT, X, CannotBeDrawn, Quantity, entry, shown

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
# The panels of the largest stresses, as in loading.SUMMARY.
LARGEST = (("largest_von_mises", "p*", *SYMBOLS["von_mises"], True, None),
           ("largest_shear", "p*", *SYMBOLS["largest_shear"], True, None),
           ("von_mises_depth", "cell_x", DEPTH, "depth", True, None),
           ("stress_over_yield_stress", "", "largest stress over yield stress", "", True, None))


def of_body(table, choice):
    """A table with the blocks of one body alone. That there is another is said unless the body was chosen."""
    body = choice.body or 1
    blocks = [block for block in table.blocks if block.body == body]
    if not blocks:
        raise CannotBeDrawn(f"it has no stresses of body {body}")
    if choice.body is None and len(blocks) < len(table.blocks):
        print(f"plot: {table.path}: the first body is shown; --body 2 shows the second", file=sys.stderr)
    return table.with_blocks(blocks)


def below_crest(picture):
    """Stresses on the line below the crest: a panel for each, depth downwards."""
    tables = [of_body(table, picture.choice) for table in picture.tables]
    loads = picture.loads(MOST_CURVES, tables)
    size = {name: max((abs(number) for table in tables for number in table.column(name)), default=0.0)
            for name in BELOW_CREST}
    names = [name for name in BELOW_CREST if size[name] > VANISHING*max(size.values())] or ["von_mises"]
    stress = Quantity(tables, [[number for name in names for number in table.column(name)] for table in tables], "p*")
    depth = Quantity(tables, "depth", "cell_x")
    deepest = max(depth.numbers) or 1.0
    across = min(len(names), 5 if len(names) < 6 else 4)
    picture.grid(98, 175, across, math.ceil(len(names)/across), (34, 60), (78, 150, 70, 38), "y")
    y = Axis(deepest, 0, step_of(deepest), label=depth.label(DEPTH, "depth"), font=",12")
    for n, name in enumerate(names):
        low, high, *_ = axis([number for run, table in enumerate(tables)
                              for number in stress.of(table.column(name), run)], may_be_wide=False)
        # Panels are narrow: fewer tics, even fewer of numbers of four characters.
        x = Axis(low, high, step_of((2.2 if max(-10*low, high) >= 1000 else 1.5)*(high - low)),
                 label=stress.label(SYMBOLS[name][0]), font=",12")
        curves = [picture.curve(look, *zip(*sorted(zip(stress.of(columns[name], run), depth.of(columns["depth"], run)),
                                                   key=lambda point: point[1])), title=title)
                  for load in loads for run, columns, look, title in picture.curves_of(load)]
        picture.panel(n, x, y, curves + picture.runs("lines"), key=RIGHT if n + 1 == across else "")


def section(picture):
    """A vertical section: a panel for each load, depth downwards."""
    table = of_body(picture.table, picture.choice)
    loads = picture.loads(MOST_PANELS, [table])
    stress = stress_of(picture, [load.blocks[0] for load in loads])
    sides = [max(table.column("distance")), max(table.column("depth"))]
    length = Quantity([table], [sides], "cell_x")
    wide, deep = length.of(sides)
    drawn = [picture.image(*resampled(load.columns, variable_of(picture), length.factors[0], stress.factors[0]))
             for load in loads]
    cells(picture, loads, [("", [[f"{image}:3 with image"] for image in drawn], colours_of(stress), "")],
          common=stress.label(*SYMBOLS[variable_of(picture)]),
          section=(((0, wide), (deep, 0)), (length.label("distance"), length.label(DEPTH, "depth"))))


def planes(picture):
    """Planes: a panel for each load and depth; of profiles curves."""
    table, variable = of_body(picture.table, picture.choice), variable_of(picture)
    depths = sorted({block.columns["depth"][0] for block in table.blocks})
    at_depth = [table.with_blocks([block for block in table.blocks if block.columns["depth"][0] == depth])
                for depth in depths]
    numbers = shown(table, range(1, len(depths) + 1), MOST_PANELS, picture.choice.depths, "depths")
    flat = len(table.cell) == 1
    loads = picture.loads(MOST_CURVES if flat else MOST_PANELS, at_depth[:1])
    stress = stress_of(picture, [at_depth[k].blocks[load.place] for k in numbers for load in loads])
    length = length_of(table)
    names = [length.scale.value(DEPTH, length.factors[0]*depths[k]) for k in numbers]

    def points(k, load):
        return closed(at_depth[k], load.place, lambda number: stress.of((number,)), (variable,))

    if not flat:
        rows = [(name, [[picture.image(*points(k, load)) + ":3 with image",
                         outline(picture, table, load, dashes="dt (3, 3)")] for load in loads], colours_of(stress), "")
                for k, name in zip(numbers, names)]
        cells(picture, loads, rows, common=stress.label(*SYMBOLS[variable]))
        return
    picture.grid(158, 184, len(names), gaps=(32, 0), room=(78, 143, 56, 50), shared="y")
    side = length.numbers[0]
    x = Axis(0, side, step_of(1.5*side), label=length.label(X), font=",12")
    y = stress.axis(*SYMBOLS[variable], may_be_wide=False)
    for n, (k, name) in enumerate(zip(numbers, names)):
        rows = [points(k, load)[0][0] for load in loads]
        curves = [picture.curve(f"lines {load.colour} lw 1.5", row[::3], row[2::3], title=load.name)
                  for load, row in zip(loads, rows)]
        picture.panel(n, x, y, curves, title=name, key=RIGHT if n + 1 == len(names) else "")


def stress_of(picture, blocks):
    """The stress that is shown, of these blocks."""
    return Quantity([picture.table.with_blocks(blocks)], variable_of(picture), "p*")


def variable_of(picture):
    """The column that is shown."""
    return picture.choice.variable or "von_mises"


def colours_of(stress):
    """The colours of a stress: where there is tension and compression the first is orange."""
    most = max(map(abs, stress.numbers), default=0.0) or 1.0
    negative, positive = (any(sign*number > VANISHING*most for number in stress.numbers) for sign in (-1, 1))
    return ["eval of_sign" if negative and positive else "eval of_size", *["set palette negative"]*(not positive),
            f"set cbrange [{-most if negative else 0}:{most if positive or not negative else 0}]"]


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


def largest(picture):
    """The largest stresses against the mean pressure, with error bars, their depth, their ratio to the yield stress."""
    alone, body = picture.alone, picture.choice.body
    bodies = [int(max(table.column("body"))) for table in picture.tables]
    first, last = (body, body) if body else (1, bodies[0] if alone else 1)
    if last > min(bodies):
        raise CannotBeDrawn(f"it has no stresses of body {last}")
    # Runs that are compared show one body of each. A row of each body stands below that of the other.
    runs = [(run, table.of_rows("body", one), 30 + (one if alone else run + 1))
            for run, table in enumerate(picture.tables) for one in range(first, last + 1)]
    with_yield = any(table.column("stress_over_yield_stress") for table in picture.tables)
    entries = [entry("linespoints ls 31", "first body"), entry("linespoints ls 32", "second body")]

    def beside(n, load, x, found):
        """Depths of the largest shear stress, and the yield stress."""
        if n == 2 and alone:
            for run, table, _ in runs:
                columns = table.columns
                yield picture.curve("points ls 11 ps 1.3*mark", load.of(columns["mean_pressure"], run),
                                    found.of(columns["shear_depth"], run))
            yield entry("points ls 31", "von Mises")
            yield entry("points ls 11 ps 1.3*mark", "shear")
        if n == 3:
            yield "1 with lines ls 2"

    def also(n, found):
        """From 0, so that what differs by rounding looks equal."""
        others = [number for run, table, _ in runs for number in found.of(table.column("shear_depth"), run)]
        return [0.0, *others*(n == 2), *[1.0]*(n == 3)]

    with_errors(picture, LARGEST[:4 if with_yield else 3], runs, entries*(alone and last > first), beside, also=also,
                key=lambda n: "bottom right samplen 2"*(n == 2 and alone))
