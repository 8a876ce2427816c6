"""What all pictures are made of: quantities on axes, the loads that are shown, and a grid of panels as commands of
gnuplot."""
import array
import collections
import math
import os
import sys

from axes import Axis, Scale, axis, chosen, lines_of, quoted

# Symbols in gnuplot's enhanced mode.
P, P_BAR, DELTA, GAP, MEAN_GAP, X, Y, DEPTH, SLIP, TRACTION, APPROACH = (f"{{/:Italic {one}}}" for one in (
    "p", "p̄", "Δ", "g", "ḡ", "x", "y", "z", "s", "Q", "δ"))
P_STAR, P_MAX, AREA = P + "*", P + "_{max}", "{/:Italic A}/{/:Italic A}_0"
# The numbers of the head by which quantities are divided if their unit has no label.
OVER = {"p*": P_STAR, "Delta": DELTA}
# At most so many loads are shown as panels, as curves, or as edges of contact.
MOST_PANELS, MOST_CURVES, MOST_EDGES = 4, 8, 20
# Sizes of the letters of titles in points, and the width of a letter over its size, about.
LARGEST, SMALLEST, LETTER = 15.0, 10.0, 0.45
SMALL = "font ',12'"
KEY = f"spacing 1.25 samplen 3.2 noautotitle Left reverse {SMALL}"
RIGHT = "at graph 1.03, 1 left top samplen 1.5"   # the place of a key that names loads
# Points that are not accurate, and that are not solved.
STYLES = ["set style line 41 lc rgb red lw 1.3 pt 2 ps mark", "set style line 42 lc rgb red lw 1.3 pt 6 ps 1.3*mark"]

# A load that is shown: its place in the first table, its block of each table, what it is called, and its colour, from
# light loads, pale, to heavy ones.
class Load(collections.namedtuple("Load", "place blocks name colour")):
    __slots__ = ()
    columns = property(lambda self: self.blocks[0].columns)


class CannotBeDrawn(ValueError):
    """There is nothing to be shown."""


class Quantity:
    """A quantity of several tables: its scale, and the factor for each table.

    column: its name, or the numbers of each table. unit: the number of the head that has its unit, by which it is
    divided if that has no label. may_be_wide: whether the axis may be logarithmic, then without powers of ten in its
    label.
    """

    def __init__(self, tables, column, unit="", may_be_wide=False):
        numbers_of = [table.column(column) for table in tables] if isinstance(column, str) else column
        labels, over = {table.label(unit) for table in tables}, OVER.get(unit, "")
        label = labels.pop() if len(labels) == 1 else ""
        divisors = [1.0 if label or not over else table.numbers.get(unit) or 0.0 for table in tables]
        if not all(divisors):
            over, divisors = "", [1.0]*len(tables)
        numbers = [number/divisor for divisor, some in zip(divisors, numbers_of) for number in some]
        most = 1.0 if may_be_wide and axis(numbers)[-1] else max(map(abs, numbers), default=0.0)
        self.scale = Scale(most, label, over, tables[0].size_of(unit))
        self.factors = [self.scale.factor/divisor for divisor in divisors]
        self.numbers = [self.scale.factor*number for number in numbers]   # all of them on the axis
        self.label = self.scale.label

    def of(self, numbers, run=0):
        """Numbers of a table on the axis."""
        return [self.factors[run]*number for number in numbers]

    def axis(self, symbol, words="", numbers=None, **kind):
        """Its axis, for its own numbers unless others are given."""
        return Axis.of(self.numbers if numbers is None else numbers, self.label(symbol, words), **kind)


def mean_pressure_axis(tables, column="mean_pressure"):
    """The mean pressure and its axis."""
    load = Quantity(tables, column, "p*", may_be_wide=True)
    full = load.factors[0]*tables[0].numbers.get("p*", 0.0) if len(tables) == 1 else 0.0
    return load, load.axis(P_BAR, "mean pressure", up_to=full)


def names_of(tables):
    """The names of the cases; with their folders where the names alone are the same."""
    names = [os.path.basename(table.stem) for table in tables]
    if len(set(names)) < len(names):
        names = [os.path.join(*table.stem.split(os.sep)[-2:]) for table in tables]
    # Bytes that are not UTF-8 cannot be shown.
    return [name.encode("utf-8", "replace").decode("utf-8") for name in names]


def fitted(case, title, width, ending=""):
    """The words of a title, and the size of its letters: the deck's title with the case before it if there is room, and
    an ending.

    Long titles are set smaller, and cut before the ending if they are still too long.
    """
    room = 0.95*width/LETTER
    words = title or case
    if title and title.casefold() != case.casefold() and len(f"{case}: {title}{ending}")*LARGEST <= room:
        words = f"{case}: {title}"
    size = max(SMALLEST, min(LARGEST, room/len(words + ending)))
    most = int(room/size) - len(ending)
    return (words if len(words) <= most else words[:most - 1].rstrip() + "…") + ending, size


def wanted_places(table, numbers, wanted, kind):
    """The places of the numbers of loads or depths that are wanted. Those that are not there are said."""
    places = [place for place, number in enumerate(numbers) if number in wanted]
    missing = ", ".join(str(number) for number in wanted if number not in numbers)
    first, last = min(numbers), max(numbers)
    there_are = ", ".join(map(str, sorted(set(numbers))))
    if last > first + 1 and set(range(first, last)) <= set(numbers):
        there_are = f"{first} to {last}"
    words = f"it has none of the {kind} {missing}; there are {there_are}"
    if not places:
        raise CannotBeDrawn(words)
    if missing:
        print(f"plot: {table.path}: {words}", file=sys.stderr)
    return places


def shown(table, numbers, most, wanted, kind):
    """The places to be shown of loads or depths of these numbers: those that are wanted, otherwise at most so many,
    evenly spread. What is left out is said."""
    if wanted is not None:
        return wanted_places(table, numbers, wanted, kind)
    places = chosen(len(numbers), most)
    if len(places) < len(numbers):
        print(f"plot: {table.path}: {len(places)} of its {len(numbers)} {kind} are shown, --{kind} "
              f"{','.join(str(numbers[place]) for place in places)}; choose others with --{kind}", file=sys.stderr)
    return places


class Picture:
    """A picture of tables of one kind: a grid of panels, as commands of gnuplot that follow those of figure_style.gp.

    tables: those to be drawn together, one unless runs are compared. beside: tables of the same run, by kind. choice:
    what the command line chooses: numbers of `loads` and `depths`, None for as many as there is room for; `variable`,
    the column of a colour map; the number of the `body`, None for the first. folder: of files for gnuplot. Sizes are in
    points.
    """

    def __init__(self, tables, beside, choice, folder):
        self.tables, self.table, self.beside, self.choice, self.folder = tables, tables[0], beside, choice, folder
        self.alone = len(tables) == 1
        self.compared = ""   # the loads at which runs are compared
        self.count, self.commands = 0, []

    def loads(self, most, tables=None):
        """The loads to be shown: of runs that are compared those that all tables have, in panels' number."""
        first, *others = tables or self.tables
        loads = []
        for place, block in enumerate(first.blocks):
            if not has_numbers(block):
                if self.choice.loads is None or block.load in self.choice.loads:
                    print(f"plot: {first.path}: load {block.load} has no numbers and is not shown", file=sys.stderr)
                continue
            found = [next((one for one in table.blocks if math.isclose(
                one.pbar_over_pstar, block.pbar_over_pstar, rel_tol=1e-6)), None) for table in others]
            if None not in found:
                loads.append((place, [block, *found]))
        if not loads:
            raise CannotBeDrawn("the tables have no load in common" if others else "no load has numbers")
        if others and self.choice.loads is None:
            places = chosen(len(loads), MOST_PANELS)
        else:
            places = shown(first, [blocks[0].load for _, blocks in loads], most, self.choice.loads, "loads")
        p_star = first.numbers.get("p*", 1.0)
        pressures = [[p_star*block.pbar_over_pstar for block in first.blocks if math.isfinite(block.pbar_over_pstar)]]
        load = Quantity([first], pressures, "p*")
        found = []
        for n, (place, blocks) in enumerate(loads[one] for one in places):
            pressure = p_star*blocks[0].pbar_over_pstar
            # A map in numpy's format has no loads if there is no summary beside it.
            name = load.scale.value(P_BAR, load.factors[0]*pressure) if math.isfinite(pressure) else \
                f"load {blocks[0].load}"
            colour = 0.6 if len(places) == 1 else n/(len(places) - 1)
            found.append(Load(place, blocks, name, f"lc palette cb {colour}"))
        self.compared = ", ".join(load.name for load in found) if others else ""
        return found

    def curves_of(self, load):
        """What is drawn of a load, a line for each run: the number of the run, its columns, look and title."""
        if self.alone:
            return [(0, load.columns, f"lines {load.colour} lw 1.5", load.name)]
        return [(run, block.columns, f"lines ls {31 + run}", None) for run, block in enumerate(load.blocks)]

    def grid(self, wide, high, across=1, down=1, gaps=(78, 42), room=(70, 16, 67, 42), shared=""):
        """Sets the size: panels in rows from the top, numbered from 0.

        wide: of all panels, or of each column. gaps: between columns (of all, or of each) and rows. room: at the left,
        right, lower and upper edge. shared: the axes, "x", "y" or "xy", that have a label and numbers at the left and
        lower edge alone.
        """
        widths = wide if isinstance(wide, list) else [wide]*across
        beside = gaps[0] if isinstance(gaps[0], list) else [gaps[0]]*(len(widths) - 1)
        left, right, bottom, top = room
        self.across, self.down, self.shared = len(widths), down, shared
        self.width = left + sum(widths) + sum(beside) + right
        self.height = top + down*high + (down - 1)*gaps[1] + bottom
        lefts = [left + sum(widths[:k]) + sum(beside[:k]) for k in range(self.across)]
        tops = [self.height - top - k*(high + gaps[1]) for k in range(down)]
        self.boxes = [(start, start + width, upper - high, upper) for upper in tops
                      for start, width in zip(lefts, widths)]
        # Of a deck with adhesion: contacts without it say so. Surfaces are the same with and without.
        contacts = "contact without adhesion" if self.table.kind not in ("height", "spectrum") and not any(
            table.adhesive for table in self.tables) and any(table.beside_adhesion for table in self.tables) else ""
        words, font = ", ".join(filter(None, (self.compared, contacts))), SMALL
        if self.alone:
            words, points = fitted(names_of(self.tables)[0], self.table.title, self.width,
                                   contacts and f" ({contacts})")
            font = f"noenhanced font ',{points:.3g}'"
        self.commands = [*STYLES, "set border 3 lw 0.7", "set tics nomirror out",
                         "set grid lc rgb '#d9d9d9' lw 0.7 dt solid", "set cbrange [0:1]", "set multiplot",
                         f"set label 1 {quoted(words)} at screen 0.5, screen {1 - 15/self.height} center {font}",
                         *self.commands]

    def single(self, x, y, curves, *commands, key="", left=80, right=14):
        """A picture of one panel. left, right: the room beside it."""
        self.grid(390, 230, room=(left, right, 66, 42))
        self.panel(0, x, y, curves, *commands, key=key)

    def curve(self, look, *columns, title=None, joined=False):
        """A curve as gnuplot's plot wants it, of a look such as 'lines ls 31'; None without numbers.

        It is interrupted where a number is NaN, unless it is joined in the order of the numbers along x.
        """
        rows = [row for row in zip(*columns) if not (joined and any(map(math.isnan, row)))]
        if not any(all(map(math.isfinite, row)) for row in rows):
            return entry(look, title) if title else None
        self.count += 1
        self.commands += [f"$data{self.count} << END", *(" ".join(map(repr, row)) for row in rows), "END"]
        return f"$data{self.count} using {':'.join(map(str, range(1, len(columns) + 1)))} " \
            f"{'smooth unique ' if joined else ''}{with_look(look, title)}"

    def image(self, records, across, down):
        """A file of records of x, y and fields, to which ':3 with image' is added. records: their rows."""
        self.count += 1
        with open(os.path.join(self.folder, f"image{self.count}"), "wb") as file:
            for row in records:
                array.array("d", row).tofile(file)
        form = "%double"*(len(records[0])//across)
        return f"'image{self.count}' binary record=({across}, {down}) format='{form}' using 1:2"

    def panel(self, n, x, y, curves, *commands, key="", title=""):
        """Draws a panel of the grid. commands: others before it. key: where it is; without it there is none."""
        left, right, bottom, top = self.boxes[n]
        for side, place in (("l", left/self.width), ("r", right/self.width), ("b", bottom/self.height),
                            ("t", top/self.height)):
            self.commands.append(f"set {side}margin at screen {place!r}")
        self.commands += x.bare("x" in self.shared and n//self.across < self.down - 1).commands("x")
        self.commands += y.bare("y" in self.shared and n % self.across > 0).commands("y")
        self.commands += ["set key default", f"set key {KEY} {key}"] if key else ["unset key"]
        self.commands += [f"set title {quoted(title)} offset 0, -0.6 {SMALL}" if title else "unset title", *commands]
        drawn = list(filter(None, curves))
        if all(one.startswith("keyentry") for one in drawn):
            drawn = ["NaN", *drawn]   # entries of a key alone are no plot for gnuplot
        self.commands += ["plot " + ", ".join(drawn), "unset label 1"]

    def colours(self, first, last, label):
        """The commands of a bar of colours beside panels of a column, from the first to the last."""
        _, left, _, top = self.boxes[first]
        bottom, inset = self.boxes[last][2], 0.05*(self.boxes[last][3] - self.boxes[last][2])
        high = (top - bottom - 2*inset)/self.height
        return [f"set colorbox user origin screen {(left + 8)/self.width!r}, screen {(bottom + inset)/self.height!r} "
                f"size screen {9/self.width!r}, screen {high!r}",
                f"set cblabel {lines_of(label)} offset -0.5, 0 {SMALL}",
                "set cbtics font ',11' offset -0.6, 0"]

    def key(self, entries, below):
        """A key as wide as the picture, so far below its upper edge."""
        self.boxes.append((0.02*self.width, 0.985*self.width, 0.9*self.height, 0.99*self.height))
        where = f"at screen 0.5, {1 - below/self.height} center center horizontal maxrows 1 samplen 2 width 1"
        self.panel(-1, Axis(0, 1), Axis(0, 1), ["NaN", *entries], "unset border", "unset tics", "unset grid", key=where)

    def runs(self, kind):
        """The entries of a key for runs that are compared."""
        return [entry(f"{kind} ls {31 + run}", name) + " noenhanced"
                for run, name in enumerate(names_of(self.tables)) if not self.alone]


def has_numbers(block):
    """Whether the fields of a load are known: of one that is not solved, or separated, all are NaN."""
    columns = [block.columns[name] for name in ("pressure", "von_mises") if name in block.columns]
    return not columns or any(any(map(math.isfinite, column)) for column in columns)


def with_look(look, title):
    return f"with {look}" + (f" title {quoted(title)}" if title else "")


def entry(look, title):
    """An entry of a key without a curve."""
    return f"keyentry {with_look(look, title)}"
