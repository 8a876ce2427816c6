"""What the pictures show, for each kind of table: the variables that scripts/pictures/KIND.gp wants.

Each function of FACTS takes the tables to be drawn together (one, unless runs are compared), the tables of the same run
by kind as far as COMPANIONS lists them, the numbers of the loads to be shown or None, and the folder from which gnuplot
reads. It returns the size of the picture in points of 1/72 inch and the gnuplot commands that set the variables.
"""
import math
import os
import sys

from axes import Scale, axis, chosen, quoted

REFERENCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "outputs", "reference", "wave_2d.dat")
# At most so many loads are shown as panels, or as curves.
MOST_PANELS, MOST_CURVES = 4, 8


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


def titles(stems):
    """The names of the cases; with their folders where the names alone are the same."""
    names = [os.path.basename(stem) for stem in stems]
    if len(set(names)) < len(names):
        names = [os.path.join(*stem.split(os.sep)[-2:]) for stem in stems]
    words = names[0] if len(names) == 1 else ""
    return [f"title_words = {quoted(words)}"] + array_of("run_names", [quoted(name) for name in names])


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
    facts += [f"inaccurate = {codes.count(10)}", f"unsolved = {sum(code > 10 for code in codes)}"]
    # The paper's series is shown beside converged values: its waves have one shape, whatever their size.
    reference = ""
    if len(tables) == 1 and first.method == "beale":
        reference = "table" if "cell_y" in first.numbers else "closed form"
    # gnuplot wants the file even if it plots nothing of it.
    os.symlink(os.path.realpath(REFERENCE), os.path.join(folder, "reference"))
    return (760, 280), facts + [f"reference = '{reference}'"]


def of_blocks(name):
    return lambda table: table.column(name)


def load_facts(tables, places, of_table=0):
    """The names of the loads shown, in the pressure's unit or over p*, and the indices of their blocks."""
    scale, _ = numbers_in(tables, of_loads, "p*", "p_star")
    table = tables[of_table]
    divisor = table.numbers.get("p*") if scale.over else 1.0
    names = [scale.value("p_bar", p_star_of(table)*table.blocks[i].pbar_over_pstar/divisor) for i in places]
    return [f"panels = {len(places)}"] + array_of("load_name", names) + array_of("block_of", [str(i) for i in places])


def p_star_of(table):
    return table.numbers.get("p*", 1.0)


def lines(tables, beside, loads, folder):
    first = tables[0]
    places = shown(first, loads, MOST_PANELS if len(tables) > 1 else MOST_CURVES)
    if any(len(table.blocks) != len(first.blocks) for table in tables):
        places = [i for i in places if all(i < len(table.blocks) for table in tables)]
    pressure = numbers_in(tables, of_column("pressure"), "p*", "p_star")
    gap = numbers_in(tables, of_column("gap"), "Delta", "Delta")
    length = numbers_in(tables, of_column("distance"), "", "")
    facts = put_scale("pressure", pressure, "p", "pressure") + put_scale("gap", gap, "gap_symbol", "gap")
    facts += put_scale("length", length, "'{/:Italic x}'")
    facts += [f"diagonal_label = {length[0].label(quoted('distance along the diagonal'))}"]
    return None
COMPANIONS = {"lines": ("theory_lines",), "map": ("contour",), "theory": ("summary",)}
FACTS = {"summary": summary}
