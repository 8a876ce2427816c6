"""What all pictures are made of: quantities on axes, and panels of curves and images as commands of gnuplot."""
import array
import math
import os
import re
import sys

from axes import Axis, Scale, axis, chosen, lines_of, quoted

# Symbols in gnuplot's enhanced mode.
P, P_BAR, DELTA, GAP, MEAN_GAP, X, Y, DEPTH, SLIP, TRACTION = (f"{{/:Italic {one}}}" for one in (
    "p", "p̄", "Δ", "g", "ḡ", "x", "y", "z", "s", "Q"))
P_STAR, P_MAX, AREA_0, AREA = P + "*", P + "_{max}", "{/:Italic A}_0", "{/:Italic A}"
# At most so many loads are shown as panels, as curves, or as edges of contact.
MOST_PANELS, MOST_CURVES, MOST_EDGES = 4, 8, 20
# Points of a map along a side that a picture can show.
MOST_PIXELS = 800
# Sizes of the letters of titles in points, and the width of a letter over its size, about.
LARGEST, SMALLEST, LETTER = 15.0, 10.0, 0.45
SMALL = "font ',12'"
KEY = f"spacing 1.15 samplen 3.2 noautotitle Left reverse {SMALL}"
# Points that are not accurate, and that are not solved; points whose error is unknown or as large as the value.
STYLES = ["set style line 41 lc rgb red lw 1.3 pt 2 ps mark", "set style line 42 lc rgb red lw 1.3 pt 6 ps 1.3*mark"]
OPEN = "points lc rgb '#ffffff' pt 7 ps 0.35*mark"
OPEN_ENTRY = "keyentry with points lc rgb blue pt 6 ps 0.7*mark title 'error unknown or as large as the value'"


class CannotBeDrawn(ValueError):
    """There is nothing to be shown."""


class Choice:
    """What the command line chooses to be shown: numbers of loads and of depths, None for as many as there is room for;
    the column of a colour map; the number of the body, None for the first.
    """

    def __init__(self, loads=None, depths=None, variable="von_mises", body=None):
        self.loads, self.depths, self.variable, self.body = loads, depths, variable, body


class Quantity:
    """A quantity of several tables: its scale, and the factor for each table.

    column: its name, or a function that gives the numbers of a table. name: of the number of the head by which they are
    divided if their unit has no label. over: its symbol, '' if they are not to be divided. may_be_wide: whether the
    axis may be logarithmic, then without powers of ten in its label.
    """

    def __init__(self, tables, column, name="", over="", may_be_wide=False):
        self.tables, self.name = tables, column
        numbers_of = column if callable(column) else lambda table: table.column(column)
        labels = {table.label(name) for table in tables}
        unit = labels.pop() if len(labels) == 1 else ""
        divisors = [1.0 if unit or not name or not over else table.numbers.get(name) or 0.0 for table in tables]
        if not all(divisors):
            over, divisors = "", [1.0]*len(tables)
        numbers = [number/divisor for table, divisor in zip(tables, divisors) for number in numbers_of(table)]
        most = max((abs(number) for number in numbers), default=0.0)
        self.scale = Scale(1.0 if may_be_wide and axis(numbers)[-1] else most, unit, over, tables[0].size_of(name))
        self.factors = [self.scale.factor/divisor for divisor in divisors]
        self.label = self.scale.label

    def of(self, numbers, run=0):
        """Numbers of a table on the axis."""
        return [self.factors[run]*number for number in numbers]

    def all(self, column=None):
        """All finite numbers of a column, its own unless another is named, on the axis."""
        return [number for run, table in enumerate(self.tables)
                for number in self.of(table.column(column or self.name), run)]

    def axis(self, symbol, words="", numbers=None, **kind):
        """Its axis, for its own numbers unless others are given."""
        return Axis(*axis(self.all() if numbers is None else numbers, **kind), self.label(symbol, words))


def bars(value, error):
    """The ends of an error bar, as far as the error is known and smaller than the value."""
    reach = error if error < value else 0.0   # an error that is unknown is NaN
    return value - reach, value + reach


def of_loads(table):
    """The mean pressures of the blocks."""
    return [table.numbers.get("p*", 1.0)*block.pbar_over_pstar for block in table.blocks
            if math.isfinite(block.pbar_over_pstar)]


def mean_pressures(table):
    """The mean pressure of each row of a table with a row for each load that has it over p* alone. With free edges,
    where there is no p*, it is that of the summary of the same run."""
    columns = table.blocks[0].columns
    if "p*" in table.numbers:
        return [table.numbers["p*"]*number for number in columns["pbar_over_pstar"]]
    if not table.summary:
        raise CannotBeDrawn("its loads are in the summary of the run, which is not beside it")
    known = table.summary.blocks[0].columns
    of_load = dict(zip(known["load"], known["mean_pressure"]))
    return [of_load.get(load, math.nan) for load in columns["load"]]


def mean_pressure_axis(tables, column="mean_pressure"):
    """The mean pressure and its axis."""
    load = Quantity(tables, column, "p*", P_STAR, may_be_wide=True)
    full = load.factors[0]*tables[0].numbers.get("p*", 0.0) if len(tables) == 1 else 0.0
    numbers = load.all() if isinstance(column, str) else load.of(column(tables[0]))
    return load, load.axis(P_BAR, "mean pressure", numbers, up_to=full)


def names_of(tables):
    """The names of the cases; with their folders where the names alone are the same."""
    names = [os.path.basename(table.stem) for table in tables]
    if len(set(names)) < len(names):
        names = [os.path.join(*table.stem.split(os.sep)[-2:]) for table in tables]
    # Bytes that are not UTF-8 cannot be shown.
    return [name.encode("utf-8", "replace").decode("utf-8") for name in names]


def unmarked(text):
    """A text for gnuplot's enhanced mode that is shown as it is."""
    return re.sub(r"([\\{}_@&~^])", r"\\\1", text)


def fitted(case, title, width):
    """The words of a title, and the size of its letters: the deck's title with the case before it if there is room.

    Long titles are set smaller, and cut if they are still too long.
    """
    room = 0.95*width/LETTER
    words = title or case
    if title and title.casefold() != case.casefold() and len(f"{case}: {title}")*LARGEST <= room:
        words = f"{case}: {title}"
    size = max(SMALLEST, min(LARGEST, room/len(words)))
    most = int(room/size)
    return (words if len(words) <= most else words[:most - 1].rstrip() + "…"), size


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


def load_names(table, places):
    """What the loads are called."""
    load = Quantity([table], of_loads, "p*", P_STAR)
    p_star = table.numbers.get("p*", 1.0)
    return [load.scale.value(P_BAR, load.factors[0]*p_star*table.blocks[i].pbar_over_pstar) for i in places]


def shaded(i, count, width=1.5):
    """The look of the curve of a load: from light loads, pale, to heavy ones."""
    return f"lc palette cb {0.6 if count == 1 else i/(count - 1)} lw {width}"


class Picture:
    """A picture of panels, as commands of gnuplot that follow those of figure_style.gp. Sizes are in points."""

    def __init__(self, folder, size, tables, loads=""):
        """folder: of files for gnuplot. loads: those of runs that are compared, shown in place of a title."""
        self.folder, (self.width, self.height) = folder, size
        words, font = loads, SMALL
        if len(tables) == 1:
            words, points = fitted(names_of(tables)[0], tables[0].title, self.width)
            font = f"noenhanced font ',{points:.3g}'"
        self.count = 0
        self.commands = [*STYLES, "set border 3 lw 0.7", "set tics nomirror out",
                         "set grid lc rgb '#d9d9d9' lw 0.7 dt solid", "set cbrange [0:1]", "set multiplot",
                         f"set label 1 {quoted(words)} at screen 0.5, screen {1 - 15/self.height} center {font}"]

    def curve(self, look, *columns, title=None):
        """A curve or an image as gnuplot's plot wants it, of a look such as 'lines ls 31'; None without numbers."""
        rows = [" ".join(map(repr, row)) for row in zip(*columns)]
        if not rows:
            return entry(look, title) if title else None
        self.count += 1
        self.commands += [f"$data{self.count} << END", *rows, "END"]
        return f"$data{self.count} using {':'.join(map(str, range(1, len(columns) + 1)))} {with_look(look, title)}"

    def image(self, records, across, down):
        """A file of records of x, y and fields, which `field` draws. records: their rows."""
        self.count += 1
        path = os.path.join(self.folder, f"image{self.count}")
        with open(path, "wb") as file:
            for row in records:
                array.array("d", row).tofile(file)
                fields = len(row)//across
        return f"{quoted(path)} binary record=({across}, {down}) format='{'%double'*fields}' using 1:2"

    def panel(self, box, x, y, curves, *commands, key="", title=""):
        """Draws a panel. box: its left, right, bottom and top over the picture's, None for gnuplot's margin.

        commands: others before it is drawn. key: where it is; without it there is none.
        """
        for side, place in zip("lrbt", box):
            self.commands.append(f"unset {side}margin" if place is None else f"set {side}margin at screen {place!r}")
        self.commands += x.commands("x") + y.commands("y")
        self.commands += ["set key default", f"set key {KEY} {key}"] if key else ["unset key"]
        self.commands += [f"set title {quoted(title)} offset 0, -0.6 {SMALL}" if title else "unset title", *commands]
        self.commands += ["plot " + ", ".join(filter(None, curves or ["NaN"])), "unset label 1"]

    def box(self, left, right, bottom, top):
        """A box for `panel`, from points."""
        return left/self.width, right/self.width, bottom/self.height, top/self.height

    def colours(self, box, wide, label, options="", font=""):
        """The commands of a bar of colours in a box."""
        return [f"set colorbox user origin screen {box[0]!r}, screen {box[2]!r} size screen {wide/self.width!r}, "
                f"screen {box[3] - box[2]!r}", f"set cblabel {lines_of(label)} offset -0.5, 0 {font}",
                f"set cbtics {options}"]

    def key(self, entries, title_high, key_high):
        """A key as wide as the picture, below the title."""
        where = f"at screen 0.5, {1 - (title_high + 0.5*key_high)/self.height} center center horizontal maxrows 1"
        self.panel((0.02, 0.985, 0.9, 0.99), Axis(0, 1), Axis(0, 1), ["NaN", *entries], "unset border", "unset tics",
                   "unset grid", key=where + " samplen 2 width 1")


def with_look(look, title):
    return f"with {look}" + (f" title {quoted(title)}" if title else "")


def entry(look, title):
    """An entry of a key without a curve."""
    return f"keyentry {with_look(look, title)}"


def runs_of(tables, kind):
    """The entries of a key for runs that are compared."""
    names = names_of(tables) if len(tables) > 1 else []
    return [entry(f"{kind} ls {31 + run}", unmarked(name)) for run, name in enumerate(names)]
