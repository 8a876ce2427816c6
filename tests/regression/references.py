"""References: excerpts of the tables of each deck, and the tolerances for a new run."""
import math
import os
import pathlib
import re
import subprocess

from tables import Table

HERE = pathlib.Path(__file__).resolve().parent
REFERENCES = HERE / "references"
INPUTS = HERE.parent.parent / "inputs"

# All references together [byte].
LARGEST = 200_000
# A table of more rows than LONG is thinned out to some SAMPLE rows; what stands for all its rows comes below them.
LONG = 24
SAMPLE = 5

# Tolerances. A number agrees if it differs by at most `absolute + of_largest*L`, where L is the largest size that the
# reference has in that column.
#
# The quadratic programme is solved to some 1e-14 of its size, but another BLAS rounds differently, and results that are
# small differences (the smallest pressure, the gap) lose some digits.
SOLVED = (1e-9, 1e-9)
# Areas and lengths of the edge of contact: the same, divided by the slope of the pressure there.
EDGE = (0.0, 1e-8)
# Closed forms: elementary functions and quadratures to 1e-12, some of them differences of numbers of order 1.
CLOSED_FORM = (0.0, 1e-10)
# Products and sums of a few numbers of the deck.
ARITHMETIC = (0.0, 1e-12)
# Stresses; L is the largest of all stresses of the table, as some components vanish but for rounding.
STRESS = (0.0, 1e-9)
# Where a stress is largest: it changes with the square of the distance, so that the place moves by the root of rounding.
PLACE = (1e-8, 1e-5)
# Error estimates: small differences of nearly equal numbers. With -O1 in place of -O3 those of the largest stresses of
# yield_loads differ by 1.7e-5 of the largest, all others by less.
ESTIMATE = (1e-9, 3e-5)
# Integers that do not depend on rounding.
COUNTED = (0.0, 0.0)

# What is not listed is of TABLES, by the kind of table, or else SOLVED.
COLUMNS = (
    # Iterations depend on which of two nearly equal candidates a rounding error puts first; the residual is a rounding
    # error: `status` says that it is small enough.
    (None, "iterations|residual"),
    (COUNTED, "load|status_code|line|body|i|j|waves|active_constraints"),
    (ARITHMETIC, "pbar_over_pstar|x|y|distance|depth|depth_over_cell_x|nu|wave_number|mean_pressure|linear_area_fraction|"
                 "contact_area_(counted|corrected)_fraction"),
    (EDGE, "contact_area(_fraction)?|(area|load)_at_hardness_fraction|[xy]_(min|max)"),
    (PLACE, "(von_mises|shear)_(x|y|depth)"),
    (ESTIMATE, ".*_error"))
TABLES = {"theory": CLOSED_FORM, "theory_lines": CLOSED_FORM, "spectrum": CLOSED_FORM,
          "stress_line": STRESS, "stress_section": STRESS, "stress_planes": STRESS}


class Excerpt:
    """What is compared of a table: remarks, units and column names, which must be equal, and rows, nearly."""

    def __init__(self, kind, head, columns, rows):
        self.kind, self.head, self.columns, self.rows = kind, head, columns, rows

    def text(self):
        lines = [f"# {line}" for line in self.head] + [" ".join(row) for row in [self.columns] + self.rows]
        return "\n".join(lines) + "\n"


def tolerance_of(kind, column):
    """The tolerance of a column; None if it is not compared."""
    for tolerance, names in COLUMNS:
        if re.fullmatch(names, column):
            return tolerance
    return TABLES.get(kind, SOLVED)


def shortened(word):
    """A number to 13 digits, one more than the narrowest tolerance needs; other words as they are."""
    try:
        return f"{float(word):.13g}"
    except ValueError:
        return word


def of_all_rows(rows):
    """Three rows that change with any row of a table: of each column of numbers the mean, the mean weighted from -1 at
    the first row to 1 at the last, and the largest size; of words those that occur. They change by no more than the
    numbers do, so that the tolerances of these hold for them too. What is not finite counts as 0."""
    columns = []
    for words in zip(*rows):
        try:
            numbers = [number if math.isfinite(number) else 0.0 for number in map(float, words)]
        except ValueError:
            columns.append([",".join(sorted(set(words)))]*3)
            continue
        weights = [2*i/(len(numbers) - 1) - 1 for i in range(len(numbers))]
        columns.append([repr(math.fsum(numbers)/len(numbers)),
                        repr(math.fsum(weight*number for weight, number in zip(weights, numbers))/len(numbers)),
                        repr(max(map(abs, numbers)))])
    return [list(row) for row in zip(*columns)]


def excerpt_of(path):
    """The excerpt of a table: all of a short one, a sample of the rows of a long one, the extents of contours."""
    kind = path.name.split(".")[-2]
    table = Table(path)
    head, columns, units = [], table.columns, table.units
    if kind == "contour":
        # The number of points of a curve may depend on the last digit, where the curve meets a node of the grid.
        head = ["the least and the largest coordinates of each load"]
        columns = ["load"] + [f"{axis}_{end}" for axis in "xy" for end in ("min", "max")]
        units = [table.units[table.columns.index(name.split("_")[0])] for name in columns]
        points = {}
        for row in table.records():
            points.setdefault(row["load"], []).append([float(row[axis]) for axis in "xy"])
        rows = [[load] + [repr(end(axis)) for axis in zip(*points[load]) for end in (min, max)] for load in points]
    elif len(table.lines) > LONG:
        # An odd step, which is no multiple of the rows of a map.
        step = (len(table.lines) // SAMPLE) | 1
        head = [f"{len(table.lines)} rows in {table.blocks} blocks, 1 of {step} is here; then what stands for all"]
        rows = table.rows(step) + of_all_rows(table.rows())
    else:
        rows = table.rows()
    kept = [tolerance_of(kind, column) is not None for column in columns]
    return Excerpt(kind, head + [" ".join(f"[{unit}]" for unit in units)], columns,
                   [[shortened(word) if keep else "-" for word, keep in zip(row, kept)] for row in rows])


def read_reference(path):
    """An excerpt as `Excerpt.text` wrote it."""
    lines = path.read_text().splitlines()
    head = [line[2:] for line in lines if line.startswith("# ")]
    columns, *rows = [line.split() for line in lines if not line.startswith("#")]
    return Excerpt(path.name.split(".")[-2], head, columns, rows)


def agrees(word, reference, allowed):
    if word == reference:
        return True
    try:
        value, expected = float(word), float(reference)
    except ValueError:
        return False
    if not (math.isfinite(value) and math.isfinite(expected)):
        return False
    return abs(value - expected) <= allowed


def largest(words):
    """The largest size among those words that are finite numbers; 0 if there is none."""
    sizes = [0.0]
    for word in words:
        try:
            sizes.append(abs(float(word)))
        except ValueError:
            pass
    return max(size for size in sizes if math.isfinite(size))


def differences(new, reference):
    """Differences of two excerpts, as text; at most one for each column."""
    if new.head != reference.head:
        return [f"it begins with {new.head}, in the reference with {reference.head}"]
    if new.columns != reference.columns:
        return [f"its columns are {new.columns}, in the reference {reference.columns}"]
    if len(new.rows) != len(reference.rows):
        return [f"it has {len(new.rows)} rows, the reference {len(reference.rows)}"]
    words = []
    for place, column in enumerate(new.columns):
        tolerance = tolerance_of(new.kind, column)
        if tolerance is None:
            continue
        absolute, of_largest = tolerance
        alike = [place] if tolerance is not STRESS else [k for k, name in enumerate(reference.columns)
                                                         if tolerance_of(new.kind, name) is STRESS]
        allowed = absolute + of_largest*largest(row[k] for row in reference.rows for k in alike)
        bad = [row for row, (ours, theirs) in enumerate(zip(new.rows, reference.rows))
               if not agrees(ours[place], theirs[place], allowed)]
        if bad:
            words.append(f"{column} differs in {len(bad)} of {len(new.rows)} rows, first in row {bad[0] + 1}: "
                         f"{new.rows[bad[0]][place]}, in the reference {reference.rows[bad[0]][place]}")
    return words


def decks():
    """All decks but that of the reference values, which test_reference_table.py compares in full."""
    return sorted(deck for deck in INPUTS.glob("*.nml") if not deck.stem.startswith("reference_"))


def environment():
    """OpenBLAS adds in another order on processors with AVX-512, which changes solutions by some 1e-8, as their residual
    allows. References have the digits of processors with AVX2, which those can do too."""
    processor = pathlib.Path("/proc/cpuinfo")
    has_512 = processor.exists() and " avx512" in processor.read_text()
    return dict(os.environ, **({"OPENBLAS_CORETYPE": "Haswell"} if has_512 else {}))


def run(program, deck, folder):
    """{file name: excerpt} of all tables of a deck. Any exit status but 0 raises an error."""
    output = pathlib.Path(folder) / deck.stem
    subprocess.run([program, deck, "--quiet", "--output", output], check=True, env=environment())
    return {path.name: excerpt_of(path) for path in sorted(output.glob("*.dat"))}
