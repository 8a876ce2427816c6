"""Variables of gnuplot that several kinds of pictures have: scales and ranges of axes, names of runs and of loads."""
import math
import os
import sys

from axes import Scale, axis, chosen, quoted

REFERENCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "outputs", "reference", "wave_2d.dat")
# At most so many loads are shown as panels, as curves, or as edges of contact.
MOST_PANELS, MOST_CURVES, MOST_EDGES = 4, 8, 20
# Sizes of the letters of titles in points, and the width of a letter over its size, about.
LARGEST, SMALLEST, LETTER = 15.0, 10.0, 0.45


class CannotBeDrawn(ValueError):
    """There is nothing to be shown."""


class Choice:
    """What the command line chooses to be shown: numbers of loads and of depths, None for as many as there is room for;
    the column of a colour map; the number of the body, None for the first.
    """

    def __init__(self, loads=None, depths=None, variable="von_mises", body=None):
        self.loads, self.depths, self.variable, self.body = loads, depths, variable, body


def put_range(name, numbers, **kind):
    """The range of an axis, as `axis` finds it from the numbers on it."""
    low, high, step, wide = axis(numbers, **kind)
    return [f"{name}_low = {low!r}", f"{name}_high = {high!r}", f"{name}_step = {step!r}", f"{name}_wide = {int(wide)}"]


def array_of(name, words):
    """An array of gnuplot's; words: its elements as expressions."""
    return [f"array {name}[{len(words)}] = [{', '.join(words)}]"]


def numbers_in(tables, column, name, over, may_be_wide=False):
    """The scale of a column of several tables, and the factor for each table.

    column: gives the numbers of a table. name: of the number of the head by which they are divided if their unit has no
    label. over: its symbol in gnuplot, '' if they are not to be divided. may_be_wide: whether the axis may be
    logarithmic, then without powers of ten in its label.
    """
    labels = {table.label(name) for table in tables}
    unit = labels.pop() if len(labels) == 1 else ""
    divisors = [1.0 if unit or not name or not over else table.numbers.get(name) or 0.0 for table in tables]
    if not all(divisors):
        over, divisors = "", [1.0]*len(tables)
    numbers = [number/divisor for table, divisor in zip(tables, divisors) for number in column(table)]
    most = max((abs(number) for number in numbers), default=0.0)
    scale = Scale(1.0 if may_be_wide and axis(numbers)[-1] else most, unit, over, tables[0].size_of(name))
    return scale, [scale.factor/divisor for divisor in divisors]


def put_scale(name, found, symbol, words=""):
    """The label of an axis and the factors of the tables, as found by `numbers_in`."""
    scale, factors = found
    return [f"{name}_label = {scale.label(symbol, words)}"] + array_of(f"{name}_factor", [repr(f) for f in factors])


def of_column(name):
    """For `numbers_in`: the numbers of a column."""
    return lambda table: table.column(name)


def of_loads(table):
    """The mean pressures of the blocks."""
    p_star = table.numbers.get("p*", 1.0)
    return [p_star*block.pbar_over_pstar for block in table.blocks if math.isfinite(block.pbar_over_pstar)]


def scaled(tables, factors, name):
    """The numbers of a column on the axis."""
    return [number*factor for table, factor in zip(tables, factors) for number in table.column(name)]


def names_of(tables):
    """The names of the cases; with their folders where the names alone are the same."""
    names = [os.path.basename(table.stem) for table in tables]
    if len(set(names)) < len(names):
        names = [os.path.join(*table.stem.split(os.sep)[-2:]) for table in tables]
    # Bytes that are not UTF-8 cannot be shown.
    return [name.encode("utf-8", "replace").decode("utf-8") for name in names]


def titles(tables, width):
    """The title of a picture so wide, in points, none if runs are compared, and the names of the runs."""
    names = names_of(tables)
    words, size = fitted(names[0], tables[0].title, width) if len(names) == 1 else ("", LARGEST)
    return [f"title_words = {quoted(words)}", f"title_size = {size:.3g}"] + \
        array_of("run_names", [quoted(name) for name in names])


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


def load_facts(table, places):
    """How many loads are shown, and what they are called."""
    scale, factor = numbers_in([table], of_loads, "p*", "p_star")
    p_star = table.numbers.get("p*", 1.0)
    names = [scale.value("p_bar", factor[0]*p_star*table.blocks[i].pbar_over_pstar) for i in places]
    return [f"loads_shown = {len(places)}"] + array_of("load_name", names)


def mean_pressure_axis(tables):
    """The facts of an axis of mean pressures, and whether its numbers are wide."""
    load = numbers_in(tables, of_column("mean_pressure"), "p*", "p_star", may_be_wide=True)
    means = scaled(tables, load[1], "mean_pressure")
    full = load[1][0]*tables[0].numbers.get("p*", 0.0) if len(tables) == 1 else 0.0
    facts = put_scale("load", load, "p_bar", "mean pressure") + put_range("load", means, up_to=full)
    return facts, axis(means)[-1]
