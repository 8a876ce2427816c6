#!/usr/bin/env python3
"""The parallel program writes the files of the serial program, and its log once.

usage: test_same_tables.py --mpiexec MPIEXEC --ranks N[,N...] --program WAVYCON --parallel WAVYCON_MPI

Files are compared byte by byte, or within a stated rounding.
"""
import argparse
import array
import math
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from ranks import numbers, run  # noqa: E402

TABLES = "map = t, contours = t, spots = t, histograms = t, lines = t, map_points = 64, line_points = 64"
# Differences of numbers that are printed with 16 digits [largest of the column].
NONE = 0.0
# Heights of spread surfaces and their roughness are rounded in another order: some differ in their last digit.
LAST_DIGIT = 1e-15
# Loads that are spread over the ranks are solved in blocks: the first load of each is not started from the one before.
# The expansions end within some 1e-9 of their limit, Beale's method within the rounding of its matrices.
OTHER_START_OF_EXPANSIONS, OTHER_START_OF_BEALE = 1e-8, 1e-11
OF_THE_START = "iterations|residual|.*_error"
# What the log says of the ranks.
GRIDS, LOADS, FIRST = "columns of large grids", "loads", "first"
# Numbers of ranks of decks that are run on all that are asked for, on all but one, and of others.
ALL_RANKS, SEVERAL_RANKS, SOME_RANKS = range(1, 100), range(2, 100), (2, 5)


def write_npy(path, rows, columns, precision="f8"):
    """A smooth rough surface of rows x columns heights: a few waves, of the same heights in each run."""
    stream = random.Random(rows*10000 + columns)
    waves = [(stream.randrange(-9, 10), stream.randrange(-9, 10), stream.uniform(0, 6.28)) for _ in range(40)]
    # Sums of products along the sides are faster than a cosine for each point.
    along_x = [[2*math.pi*k*i/columns + phase for i in range(columns)] for k, _, phase in waves]
    along_y = [[2*math.pi*l*j/rows for j in range(rows)] for _, l, _ in waves]
    cosine_x, sine_x = [[[f(a) for a in wave] for wave in along_x] for f in (math.cos, math.sin)]
    sizes = [1/(1 + k*k + l*l) for k, l, _ in waves]
    heights = array.array("d" if precision == "f8" else "f")
    for j in range(rows):
        factors = [(size*math.cos(angles[j]), size*math.sin(angles[j])) for size, angles in zip(sizes, along_y)]
        heights.extend(sum(c*cx[i] - s*sx[i] for (c, s), cx, sx in zip(factors, cosine_x, sine_x))
                       for i in range(columns))
    if sys.byteorder == "big":
        heights.byteswap()
    words = f"{{'descr': '<{precision}', 'fortran_order': False, 'shape': ({rows}, {columns}), }}"
    words += " "*(-(10 + len(words) + 1) % 64) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(words)) + words.encode() + heights.tobytes())


def numbers_of_npy(content):
    """The numbers of an .npy file, and its head."""
    start = 10 + struct.unpack("<H", content[8:10])[0]
    values = array.array("d" if b"<f8" in content[:start] else "f", content[start:])
    if sys.byteorder == "big":
        values.byteswap()
    return list(values), content[:start]


def log(text):
    """The lines of a log without times and without what only several ranks say."""
    return [re.sub(r"^\[ *[\d.]+ s\]", "[]", line) for line in text.splitlines() if not line.startswith("ranks ")]


def columns(text):
    """The words of a table by columns, and those of its head."""
    lines = [line.split() for line in text.splitlines() if line and not line.startswith("#")]
    head = [word.rstrip(",") for line in text.splitlines() if line.startswith("#") for word in line.split()]
    return list(zip(*lines)), head


def number(word):
    try:
        return float(word)
    except ValueError:
        return None


def farthest(one, other):
    """The largest difference of two columns of words over the largest number in them; infinite if the words differ."""
    pairs = list(zip(map(number, one), map(number, other)))
    if any(a is None and x != y or (a is None) != (b is None) for (a, b), x, y in zip(pairs, one, other)):
        return math.inf
    return farthest_number([(a, b) for a, b in pairs if a is not None])


def farthest_number(pairs):
    if any(math.isnan(a) != math.isnan(b) for a, b in pairs):
        return math.inf
    pairs = [(a, b) for a, b in pairs if not math.isnan(a)]
    largest = max((abs(a) for a, _ in pairs), default=0.0)
    difference = max((abs(a - b) for a, b in pairs), default=0.0)
    return difference/largest if largest > 0 else difference


def complaints(one, other, rounding, left_out=""):
    """Where the files of two folders differ; columns of some names may be left out."""
    names = [sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
             for folder in (one, other)]
    if names[0] != names[1]:
        return [f"files {names[1]}, not {names[0]}"]
    words = [] if names[0] else ["no file"]
    for name in names[0]:
        contents = [(folder/name).read_bytes() for folder in (one, other)]
        if contents[0] == contents[1]:
            continue
        if rounding == NONE:
            words.append(f"{name} differs")
        elif name.endswith(".npy"):
            (values, head), (others, other_head) = map(numbers_of_npy, contents)
            difference = math.inf
            if head == other_head and len(values) == len(others):
                difference = farthest_number(list(zip(values, others)))
            if difference > rounding:
                words.append(f"{name} differs by {difference:.1e}")
        else:
            (table, head), (others, other_head) = (columns(content.decode()) for content in contents)
            head_difference = max((farthest([a], [b]) for a, b in zip(head, other_head)), default=0.0)
            if len(head) != len(other_head) or head_difference > rounding:
                words.append(f"the head of {name} differs by {head_difference:.1e}")
            if len(table) != len(others) or any(len(a) != len(b) for a, b in zip(table, others)):
                words.append(f"{name} has other rows or columns")
                continue
            for column, other_column in zip(table, others):
                difference = farthest(column, other_column)
                if difference > rounding and not re.fullmatch(left_out, column[0]):
                    words.append(f"{name}: {column[0]} differs by {difference:.1e}")
    return words


class SameTables(unittest.TestCase):
    mpiexec = program = parallel = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def serial(self, words):
        return subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def compare(self, text, rounding=NONE, ranks=SEVERAL_RANKS, spread=None, left_out=""):
        """Runs a deck by both programs. spread: what the log must say of the ranks; the rest as in complaints."""
        (self.folder/"deck.nml").write_text(text)
        words = ["deck.nml", "--output", "results"]
        expected = self.serial(words)
        self.assertEqual("", expected.stderr)
        reference = (self.folder/"results").rename(self.folder/"serial")
        first = None
        for number_of_ranks in set(ranks).intersection(self.ranks):
            with self.subTest(ranks=number_of_ranks):
                outcome = run(self.mpiexec, number_of_ranks, [self.parallel, *words], self.folder)
                self.assertEqual((expected.returncode, ""), (outcome.status, outcome.stderr))
                if rounding == NONE:
                    self.assertEqual(log(expected.stdout), log(outcome.stdout))
                else:
                    self.assertEqual(len(log(expected.stdout)), len(log(outcome.stdout)))
                if spread and number_of_ranks > 1:
                    self.assertRegex(outcome.stdout, spread)
                results = (self.folder/"results").rename(self.folder/f"ranks-{number_of_ranks}")
                self.assertEqual([], complaints(reference, results, rounding if number_of_ranks > 1 else NONE,
                                                left_out))
                if number_of_ranks > 1:
                    first = first or results
                    self.assertEqual([], complaints(first, results, min(rounding, LAST_DIGIT)), "unlike fewer ranks")

    # Waves on grids: an even one on a quarter of the cell, one on the turned cell, one with periods.

    def test_wave_on_a_quarter(self):
        self.compare("&surface kind = 'wave_2d', wavelength_y = 2 /\n&load pbar_over_pstar = 0.02, 0.3, 0.8 /\n"
                     f"&method solver = 'grid', grid_points = 640 /\n&output {TABLES} /\n", spread=GRIDS, ranks=ALL_RANKS)

    def test_wave_on_the_turned_cell(self):
        self.compare("&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.1, 0.6 /\n"
                     f"&method solver = 'grid', grid_points = 1024 /\n&output {TABLES} /\n",
                     spread=GRIDS, ranks=SOME_RANKS)

    def test_wave_to_an_accuracy(self):
        self.compare("&surface kind = 'wave_2d', wavelength_y = 1.5 /\n&load pbar_over_pstar = 0.2 /\n"
                     "&method solver = 'grid', accuracy = 2e-5 /\n", spread=GRIDS, ranks=SOME_RANKS)

    def test_hexagonal(self):
        self.compare("&surface kind = 'hexagonal' /\n&load pbar_over_pstar = 0.05, 0.7 /\n"
                     f"&method solver = 'grid', grid_points = 720, 1024 /\n&output {TABLES} /\n",
                     spread=GRIDS, ranks=SOME_RANKS)

    def test_sum_with_phases(self):
        self.compare("&surface kind = 'sum', length_x = 2, length_y = 1, amplitudes = 1, 0.4, 0.15, waves_x = 1, 0, 3, "
                     "waves_y = 0, 1, 2, phases = 0, 0, 60 /\n&load pbar_over_pstar = 0.1, 0.5 /\n"
                     f"&method solver = 'grid', grid_points = 600, 256 /\n&output {TABLES} /\n", spread=GRIDS)

    def test_loads_by_gap_and_area(self):
        # One load, so that its grids are spread, not the loads.
        for load in "mean_gap_over_amplitude = 0.1", "contact_area_fraction = 0.1":
            self.compare("&surface kind = 'wave_2d', wavelength_y = 2 /\n"
                         f"&load {load} /\n&method solver = 'grid', grid_points = 768 /\n", spread=GRIDS,
                         ranks=SOME_RANKS)
            for path in self.folder.iterdir():
                path.rename(path.with_name(f"{path.name}-{load[:4]}"))

    def test_hardness(self):
        self.compare("&surface kind = 'wave_2d', wavelength_y = 2 /\n&material hardness = 5 /\n"
                     "&load pbar_over_pstar = 0.4 /\n&method solver = 'grid', grid_points = 768 /\n",
                     spread=GRIDS, ranks=SOME_RANKS)

    # Height maps.

    def test_map_of_odd_size(self):
        write_npy(self.folder/"map.npy", 263, 301)
        self.compare("&surface kind = 'file', file = 'map.npy', length_x = 3, length_y = 2.6 /\n"
                     f"&load pbar_over_pstar = 0.05, 0.4 /\n&output {TABLES} /\n", rounding=LAST_DIGIT, spread=GRIDS,
                     ranks=ALL_RANKS)

    def test_mirrored_map(self):
        write_npy(self.folder/"map.npy", 256, 384, "f4")
        self.compare("&surface kind = 'file', file = 'map.npy', edges = 'mirror', detrend = 'plane' /\n"
                     f"&load pbar_over_pstar = 0.05, 0.4 /\n&output {TABLES} /\n",
                     rounding=LAST_DIGIT, spread=GRIDS, ranks=SOME_RANKS)

    def test_map_on_other_points(self):
        write_npy(self.folder/"map.npy", 128, 192)
        self.compare("&surface kind = 'file', file = 'map.npy' /\n&load pbar_over_pstar = 0.1 /\n"
                     "&method solver = 'grid', grid_points = 384, 256 /\n",
                     rounding=LAST_DIGIT, spread=GRIDS, ranks=SOME_RANKS)

    def test_more_ranks_than_columns(self):
        write_npy(self.folder/"map.npy", 2048, 40)
        self.compare("&surface kind = 'file', file = 'map.npy', length_x = 1, length_y = 50 /\n"
                     "&load pbar_over_pstar = 0.1 /\n", rounding=LAST_DIGIT, spread=GRIDS)

    def test_self_affine(self):
        self.compare("&surface kind = 'self_affine', rms_slope = 0.1, points = 384, short_wavelength = 0.03 /\n"
                     "&load pbar_over_pstar = 0.01, 0.1 /\n&output map = t, contours = t, spots = t, spectrum = t /\n",
                     rounding=LAST_DIGIT, spread=GRIDS)

    def test_maps_as_npy(self):
        self.compare("&surface kind = 'self_affine', rms_slope = 0.1, points = 384, short_wavelength = 0.03 /\n"
                     "&load pbar_over_pstar = 0.05 /\n&output map = t, map_format = 'npy' /\n",
                     rounding=LAST_DIGIT, spread=GRIDS, ranks=SOME_RANKS)

    # What is not spread over the ranks.

    def test_expansions(self):
        self.compare("&surface kind = 'wave_2d' /\n&load sweep_from = 0.1, sweep_to = 0.9, sweep_steps = 3 /\n"
                     f"&method solver = 'fitted' /\n&output {TABLES}, details = t /\n", spread=FIRST, ranks=SOME_RANKS)

    def test_paper(self):
        self.compare("&surface kind = 'wave_2d' /\n&load sweep_from = 0.1, sweep_to = 0.9, sweep_steps = 5 /\n"
                     f"&output {TABLES}, coefficients = t, theory = t /\n", spread=FIRST, ranks=SOME_RANKS)

    def test_one_dimensional_wave(self):
        self.compare("&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.1, 0.6 /\n&method solver = 'auto' /\n"
                     "&output lines = t, map = t /\n&stress nu = 0.3, line = t /\n", spread=FIRST, ranks=SOME_RANKS)

    def test_loads_that_are_spread(self):
        for solver, rounding in ("fitted", OTHER_START_OF_EXPANSIONS), ("beale", OTHER_START_OF_BEALE):
            self.compare("&surface kind = 'wave_2d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 37 /\n"
                         f"&method solver = '{solver}' /\n", rounding=rounding, spread=LOADS,
                         left_out=OF_THE_START)
            for path in self.folder.iterdir():
                path.rename(path.with_name(f"{path.name}-{solver}"))

    def test_loads_on_small_grids_that_are_spread(self):
        self.compare("&surface kind = 'hexagonal' /\n&load sweep_from = 0.05, sweep_to = 0.9, sweep_steps = 20 /\n"
                     "&method solver = 'grid', grid_points = 64 /\n", spread=LOADS)

    # The command line.

    def test_check(self):
        (self.folder/"deck.nml").write_text("&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.1 /\n")
        outcome = run(self.mpiexec, max(self.ranks), [self.parallel, "--check", "deck.nml"], self.folder)
        self.assertEqual((0, ""), (outcome.status, outcome.stderr))
        self.assertEqual(1, outcome.stdout.count("wave_2d"), outcome.stdout)
        self.assertFalse((self.folder/"outputs").exists())

    def test_version_and_help(self):
        for option, words in ("--version", "wavycon "), ("--help", "usage: mpirun -n RANKS wavycon-mpi"):
            outcome = run(self.mpiexec, max(self.ranks), [self.parallel, option], self.folder)
            self.assertEqual((0, "", 1), (outcome.status, outcome.stderr, outcome.stdout.count(words)), option)

    def test_bad_decks(self):
        (self.folder/"deck.nml").write_text("&surface kind = 'wave' /\n&load pbar = 0.1 /\n")
        (self.folder/"map.nml").write_text("&surface kind = 'file', file = 'nowhere.npy' /\n"
                                           "&load pbar_over_pstar = 0.1 /\n")
        for words in (["deck.nml"], ["nowhere.nml"], ["map.nml"], ["--bad", "deck.nml"], []):
            expected = self.serial(words)
            outcome = run(self.mpiexec, max(self.ranks), [self.parallel, *words], self.folder)
            self.assertIn(expected.returncode, (1, 3))
            self.assertEqual(expected.returncode, outcome.status, words)
            ours = re.sub("^usage: wavycon", "usage: mpirun -n RANKS wavycon-mpi", expected.stderr, flags=re.MULTILINE)
            self.assertEqual(1, outcome.stderr.count(ours), (words, outcome.stderr))
            self.assertEqual(expected.stdout, outcome.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in "mpiexec", "ranks", "program", "parallel":
        parser.add_argument(f"--{name}", required=True)
    options, rest = parser.parse_known_args()
    for name, value in vars(options).items():
        setattr(SameTables, name, value)
    SameTables.ranks = numbers(options.ranks)
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)


if __name__ == "__main__":
    main()
