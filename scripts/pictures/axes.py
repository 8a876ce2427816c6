"""Scales, labels and ranges of axes, and the loads to be shown."""
import dataclasses
import math
import re

# Prefixes of the units that are converted to one whose numbers are easy to read: powers of ten.
PREFIXES = {"n": -9, "µ": -6, "u": -6, "m": -3, "": 0, "k": 3, "M": 6, "G": 9}
SHOWN = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
CONVERTED = re.compile(r"([nµumkMG]?)(Pa|m)")
# Numbers between these need no power of ten beside them. Units with prefixes always get the one that suits them.
SMALL, LARGE = 1e-2, 1e4
# An axis is logarithmic if its numbers span more than this and half of them would lie in its first tenth.
WIDE, CROWDED = 100, 0.1
LONGEST = 6    # Letters of a number beside a tic. Margins have no room for more: nearly equal numbers count as one.


def quoted(text):
    """A string of gnuplot's: within single quotes nothing is expanded."""
    return "'" + re.sub(r"[\x00-\x1f\x7f]", "?", text).replace("'", "''") + "'"


def lines_of(label):
    """The same for a label, which may be a tuple of lines."""
    return '."\\n".'.join(map(quoted, label)) if isinstance(label, tuple) else quoted(label)


def marked_up(text):
    """A text for gnuplot's enhanced mode, in which exponents are raised and nothing else has a meaning."""
    text = re.sub(r"([\\{}_@&~])", r"\\\1", text)
    return re.sub(r"\^([+-]?\d+)?", lambda found: "^{" + found[1].replace("-", "−") + "}" if found[1] else r"\^", text)


def label_of_unit(unit):
    """A unit with its prefix for gnuplot's enhanced mode: um is shown as µm."""
    known = CONVERTED.fullmatch(unit)
    return marked_up(SHOWN[PREFIXES[known[1]]] + known[2] if known else unit)


def ten_to(power):
    """A power of ten in gnuplot's enhanced mode."""
    return "10^{" + str(power).replace("-", "−") + "}"


class Scale:
    """How the numbers of an axis are shown: times `factor`, beside a label.

    most: the largest number. unit: its label, '' if it has none. over: the symbol of that by which numbers without a
    label are divided, '' if they are not. size: the number that is to be 1 to 1000 in the unit shown, None for the
    largest: all pictures of a run then have the same unit.
    """

    def __init__(self, most, unit="", over="", size=None):
        self.unit, self.over = unit, "" if unit else over
        self.factor, self.power = 1.0, 0
        known = CONVERTED.fullmatch(unit)
        if known and size:
            most = size
        if not most > 0:
            return
        # The largest number is then 1 to 1000, as far as there are prefixes; 0.9999 counts as 1.
        power = 3*math.floor(math.log10(1.001*most)/3)
        if known and PREFIXES[known[1]] + power in SHOWN:
            self.unit = SHOWN[PREFIXES[known[1]] + power] + known[2]
        elif SMALL <= most < LARGE:
            return
        else:
            power = self.power = 3*math.floor((math.log10(most) + 1)/3)
        self.factor = 10.0**-power

    def label(self, symbol, words=""):
        """The label of the axis in gnuplot's enhanced mode."""
        power = ten_to(-self.power) + " " if self.power and not self.unit else ""
        over = "/" + self.over if self.over else ""
        unit = f" [{ten_to(self.power) + ' ' if self.power else ''}{marked_up(self.unit)}]" if self.unit else ""
        return (words + " " if words else "") + power + symbol + over + unit

    def value(self, symbol, number):
        """What a quantity is, such as p/p* = 0.2 or p = 3 MPa; number: on the axis."""
        shown = f"{number*10.0**self.power:.4g}"
        if "e" in shown:
            mantissa, exponent = shown.split("e")
            shown = ("" if mantissa == "1" else f"{mantissa}·") + ten_to(int(exponent))
        over, unit = "/" + self.over if self.over else "", " " + marked_up(self.unit) if self.unit else ""
        return f"{symbol}{over} = {shown.replace('-', '−')}{unit}"


@dataclasses.dataclass(frozen=True)
class Axis:
    """Range, step of the tics (None: gnuplot's), whether it is logarithmic, label, and whether tics have numbers.

    font: of the tics. options: of the label.
    """

    low: float
    high: float
    step: float = None
    wide: bool = False
    label: object = ""
    numbers: bool = True
    font: str = ",14"
    options: str = "offset 0, 0"

    def commands(self, name):
        tics = repr(self.step) if self.step else "autofreq"
        is_short = self.wide and math.floor(math.log10(self.high)) - math.ceil(math.log10(self.low)) < 1
        if is_short:
            # A single power of ten, or none, is no scale.
            powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)))
            tics = "(" + ", ".join(f"{one}e{power}" for power in powers for one in (1, 2, 5)) + ")"
        form = ("10^{%T}" if self.wide and not is_short else "%h") if self.numbers else ""
        minor = "default" if not (self.wide and self.step) else 1 if self.step > 10 else 10
        # The range is set while the axis is linear: one from 0 is no range of a logarithmic axis.
        return [f"unset logscale {name}", f"set {name}range [{self.low!r}:{self.high!r}]",
                *[f"set logscale {name}"]*self.wide,
                f"set {name}tics {tics} font '{self.font}'",
                f"set m{name}tics {minor}", f"set format {name} '{form}'",
                f"set {name}label {lines_of(self.label)} {self.options}"]

    @classmethod
    def of(cls, numbers, label, **kind):
        """The axis of numbers; kind: for `axis`."""
        return cls(*axis(numbers, **kind), label)

    def bare(self, is_bare=True):
        """The axis without label and numbers, beside one that has them."""
        return dataclasses.replace(self, label="", numbers=False) if is_bare else self


def axis(numbers, may_be_wide=True, up_to=None):
    """The range of an axis: (lowest, highest, step of its tics, whether it is logarithmic).

    numbers: those to be shown. up_to: the axis ends there if they come near it.
    """
    numbers = [number for number in numbers if math.isfinite(number)] or [0.0, 1.0]
    low, high = min(numbers), max(numbers)
    positive = sorted(number for number in numbers if number > 0)
    if may_be_wide and low >= 0 and positive and high > WIDE*positive[0] and \
            positive[(len(positive) - 1)//2] < CROWDED*high:
        low, high = positive[0]/1.6, high*1.6
        return low, high, 10.0**math.ceil(math.log10(high/low)/5), True
    margin = 0.1*(high - low)
    if low > 0.6*high and low < high and longest_tic(low - margin, high + margin) <= LONGEST:
        low, high = low - margin, high + margin
    elif low < high or high > 0:
        margin = 0.06*(max(high, 0) - min(low, 0)) if low < 0.6*high else 0.3*high
        low, high = min(0.0, low - margin if low < 0 else 0.0), max(high + margin, 0.0)
    else:
        low, high = min(low, 0.0), 1.0
    if up_to and 0.7*up_to < high < 1.15*up_to:
        high = up_to
    return low, high, step_of(high - low), False


def a_decade(numbers):
    """The ends of a logarithmic axis of numbers > 0, which is a decade long at least."""
    margin = max(1.6, math.sqrt(10*min(numbers)/max(numbers)))
    return min(numbers)/margin, margin*max(numbers)


def decades(numbers, label, widen=1.0):
    """A logarithmic axis from power of ten to power of ten."""
    return Axis(10.0**math.floor(math.log10(min(numbers))), 10.0**math.ceil(math.log10(widen*max(numbers))), wide=True,
                label=label)


def step_of(span):
    """A round step that divides a range into four to eight, at most."""
    rough = span/6
    power = 10.0**math.floor(math.log10(rough))
    return next(step for step in (power, 2*power, 5*power, 10*power) if step >= 0.999*rough)


def longest_tic(low, high):
    """Letters of the longest number beside the tics of a range, as gnuplot's %g writes it."""
    step = step_of(high - low)
    return max(len(f"{number*step:g}") for number in range(math.ceil(low/step), math.floor(high/step) + 1))


def chosen(count, most):
    """Places of at most so many loads, evenly spread with the first and the last."""
    if count <= most:
        return list(range(count))
    return sorted({round(i*(count - 1)/(most - 1)) for i in range(most)})
