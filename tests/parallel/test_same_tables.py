#!/usr/bin/env python3
"""The parallel program writes the files of the serial program, and its log once.

usage: test_same_tables.py --mpiexec MPIEXEC --ranks N[,N...] --program WAVYCON --parallel WAVYCON_MPI

Each program runs all decks at once. Files are compared byte by byte, or within a stated rounding.
"""
import collections
import math
import re
import subprocess

from npy import read_npy, write_npy
from program import ProgramTest
from ranks import main, run
from rough_map import rough_map

TABLES = "map = t, bounds = t, contours = t, spots = t, histograms = t, lines = t, map_points = 64, line_points = 64"
# Differences of numbers that are printed with 16 digits [largest of the column].
NONE = 0.0
# Heights of spread surfaces and their roughness are rounded in another order: some differ in their last digit.
LAST_DIGIT = 1e-15
# Loads that are distributed over the ranks are solved in blocks: the first load of each is not started from the one before.
# Fitted solutions end within some 1e-9 of their limit, the dual method within the rounding of its matrices.
OTHER_START_OF_FITTED, OTHER_START_OF_SERIES = 1e-8, 1e-11
OF_THE_START = "iterations|residual|.*_error"
# What the log says of the ranks.
GRIDS, LOADS, FIRST = "columns of large grids", "loads", "first"
# Numbers of ranks of decks that are run on all that are asked for, on all but one, and of others.
ALL_RANKS, SEVERAL_RANKS, SOME_RANKS = range(1, 100), range(2, 100), (2, 5)

# A deck, what the log must say of the ranks, the numbers of ranks, the rounding, and columns that are not compared.
Case = collections.namedtuple("Case", "deck spread ranks rounding left_out", defaults=(SOME_RANKS, NONE, ""))
SURFACE = "&surface kind = "
CASES = {
    # Waves on grids: an even one on a quarter of the cell, one on the rotated cell, one with periods.
    "quarter": Case(f"{SURFACE}'wave_2d', wavelength_y = 2 /\n&load pbar_over_pstar = 0.02, 0.3, 0.8 /\n"
                    f"&method solver = 'grid', grid_points = 640 /\n&output {TABLES} /\n", GRIDS, ALL_RANKS),
    "turned": Case(f"{SURFACE}'wave_2d' /\n&load pbar_over_pstar = 0.1, 0.6 /\n"
                   f"&method solver = 'grid', grid_points = 1024 /\n&output {TABLES} /\n", GRIDS),
    "accuracy": Case(f"{SURFACE}'wave_2d', wavelength_y = 1.5 /\n&load pbar_over_pstar = 0.2 /\n"
                     "&method solver = 'grid', accuracy = 2e-5 /\n", GRIDS),
    "hexagonal": Case(f"{SURFACE}'hexagonal' /\n&load pbar_over_pstar = 0.05, 0.7 /\n"
                      f"&method solver = 'grid', grid_points = 720, 1024 /\n&output {TABLES} /\n", GRIDS),
    "phases": Case(f"{SURFACE}'sum', length_x = 2, length_y = 1, amplitudes = 1, 0.4, 0.15, waves_x = 1, 0, 3, "
                   "waves_y = 0, 1, 2, phases = 0, 0, 60 /\n&load pbar_over_pstar = 0.1, 0.5 /\n"
                   f"&method solver = 'grid', grid_points = 600, 256 /\n&output {TABLES} /\n", GRIDS, SEVERAL_RANKS),
    # One load each, so that its grids are distributed, not the loads.
    **{name: Case(f"{SURFACE}'wave_2d', wavelength_y = 2 /\n&load {load} /\n"
                  f"&method solver = 'grid', grid_points = 768 /\n{material}", GRIDS)
       for name, load, material in (("gap", "mean_gap_over_amplitude = 0.1", ""),
                                    ("area", "contact_area_fraction = 0.1", ""),
                                    ("hardness", "pbar_over_pstar = 0.4", "&material hardness = 5 /\n"),
                                    ("film", "pbar_over_pstar = 0.3",
                                     "&material e1 = 1, nu1 = 0.5, layer_thickness = 5e-4 /\n"))},
    # Height maps: of odd size, mirrored, on other points, with more ranks than columns, made.
    "odd": Case(f"{SURFACE}'file', file = 'odd.npy', length_x = 3, length_y = 2.6 /\n"
                f"&load pbar_over_pstar = 0.05, 0.4 /\n&output {TABLES}, height = t /\n", GRIDS, ALL_RANKS, LAST_DIGIT),
    "windowed": Case(f"{SURFACE}'file', file = 'odd.npy', length_x = 3, length_y = 2.6, edges = 'window', "
                     "detrend = 'quadratic' /\n&load pbar_over_pstar = 0.05 /\n&output height = t, spectrum = t /\n",
                     GRIDS, SEVERAL_RANKS, LAST_DIGIT),
    "mirrored": Case(f"{SURFACE}'file', file = 'mirrored.npy', edges = 'mirror', detrend = 'plane' /\n"
                     f"&load pbar_over_pstar = 0.05, 0.4 /\n&output {TABLES}, height = t /\n", GRIDS, SOME_RANKS,
                     LAST_DIGIT),
    "other_points": Case(f"{SURFACE}'file', file = 'coarse.npy' /\n&load pbar_over_pstar = 0.1 /\n"
                         "&method solver = 'grid', grid_points = 384, 256 /\n", GRIDS, SOME_RANKS, LAST_DIGIT),
    "few_columns": Case(f"{SURFACE}'file', file = 'narrow.npy', length_x = 1, length_y = 50 /\n"
                        "&load pbar_over_pstar = 0.1 /\n", GRIDS, SEVERAL_RANKS, LAST_DIGIT),
    **{name: Case(f"{SURFACE}'self_affine', rms_slope = 0.1, points = 384, short_wavelength = 0.03 /\n"
                  f"&load pbar_over_pstar = {loads} /\n&output map = t, {output} /\n", GRIDS, ranks, LAST_DIGIT)
       for name, loads, output, ranks in (("made", "0.01, 0.1", "contours = t, spots = t, spectrum = t", SEVERAL_RANKS),
                                          ("npy", "0.05", "map_format = 'npy'", SOME_RANKS))},
    # What is not distributed over the ranks.
    "fitted": Case(f"{SURFACE}'wave_2d' /\n&load sweep_from = 0.1, sweep_to = 0.9, sweep_steps = 3 /\n"
                       f"&method solver = 'fitted' /\n&output {TABLES}, details = t /\n", FIRST),
    "paper": Case(f"{SURFACE}'wave_2d' /\n&load sweep_from = 0.1, sweep_to = 0.9, sweep_steps = 5 /\n"
                  f"&method solver = 'beale' /\n&output {TABLES}, coefficients = t, theory = t /\n", FIRST),
    "line": Case(f"{SURFACE}'wave_1d' /\n&load pbar_over_pstar = 0.1, 0.6 /\n&method solver = 'auto' /\n"
                 "&output lines = t, map = t /\n&stress nu = 0.3, line = t /\n", FIRST),
    # Loads that are.
    **{f"loads_of_{solver}": Case(f"{SURFACE}'wave_2d' /\n&method solver = '{solver}'{keys} /\n"
                                  "&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 37 /\n", LOADS,
                                  SEVERAL_RANKS, rounding, "" if rounding == NONE else OF_THE_START)
       for solver, keys, rounding in (("beale", "", NONE), ("fitted", "", OTHER_START_OF_FITTED),
                                      ("series", ", harmonics = 9, constraint_points = 11", OTHER_START_OF_SERIES))},
    "loads_of_grids": Case(f"{SURFACE}'hexagonal' /\n&load sweep_from = 0.05, sweep_to = 0.9, sweep_steps = 20 /\n"
                           "&method solver = 'grid', grid_points = 64 /\n", LOADS, SEVERAL_RANKS),
}
# Points along y and x, precision, column by column.
MAPS = {"odd": (263, 301, "f8", False), "mirrored": (256, 384, "f4", True), "coarse": (128, 192, "f8", True),
        "narrow": (2048, 40, "f4", False)}


def logs(text):
    """The lines of each deck's log, by its name, without times and what only several ranks say; and with the latter."""
    parts = re.findall(r"^(wavycon .*\ndeck: (\w+)\.nml\n(?:(?!wavycon |\d+ decks: ).*\n)*)", text, re.MULTILINE)
    lines = {name: [re.sub(r"^\[ *[\d.]+ s\]", "[]", line) for line in part.rstrip().splitlines()]
             for part, name in parts}
    return {name: [line for line in own if not line.startswith("ranks: ")] for name, own in lines.items()}, lines


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


def complaints(case, one, other, rounding, left_out=""):
    """Where the files of a case in two folders differ; columns of some names may be left out."""
    names = [sorted(path.name for path in folder.glob(f"{case}.*")) for folder in (one, other)]
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
            (head, values), (other_head, others) = (read_npy(folder/name) for folder in (one, other))
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


class SameTables(ProgramTest):
    mpiexec = parallel = ""

    def serial(self, words):
        return subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def test_all_decks(self):
        for name, (rows, along, *kind) in MAPS.items():
            write_npy(self.folder/f"{name}.npy", rough_map(rows, along, rows), *kind)
        for name, case in CASES.items():
            (self.folder/f"{name}.nml").write_text(case.deck)
        every = self.serial([*(f"{name}.nml" for name in CASES), "--output", "results"])
        self.assertEqual((0, ""), (every.returncode, every.stderr))
        (self.folder/"results").rename(self.folder/"serial")
        expected, _ = logs(every.stdout)
        first = {}
        for ranks in self.ranks:
            chosen = {name: case for name, case in CASES.items() if ranks in case.ranks}
            decks = [f"{name}.nml" for name in chosen]
            outcome = run(self.mpiexec, ranks, [self.parallel, *decks, "--output", "results"], self.folder)
            self.assertEqual((0, ""), (outcome.status, outcome.stderr))
            results = (self.folder/"results").rename(self.folder/f"ranks-{ranks}")
            found, lines = logs(outcome.stdout)
            for name, case in chosen.items():
                with self.subTest(ranks=ranks, deck=name):
                    if case.rounding == NONE:
                        self.assertEqual(expected[name], found[name])
                    self.assertEqual(len(expected[name]), len(found[name]))
                    rounding = case.rounding if ranks > 1 else NONE
                    self.assertEqual([], complaints(name, self.folder/"serial", results, rounding, case.left_out))
                    if ranks > 1:
                        self.assertRegex("\n".join(lines[name]), case.spread)
                        fewer = first.setdefault(name, results)
                        self.assertEqual([], complaints(name, fewer, results, min(case.rounding, LAST_DIGIT)),
                                         "unlike fewer ranks")

    # The command line.

    def test_check(self):
        (self.folder/"checked.nml").write_text("&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.1 /\n")
        outcome = run(self.mpiexec, max(self.ranks), [self.parallel, "--check", "checked.nml"], self.folder)
        self.assertEqual((0, ""), (outcome.status, outcome.stderr))
        self.assertEqual(1, outcome.stdout.count("wave_2d"), outcome.stdout)
        self.assertFalse((self.folder/"outputs").exists())

    def test_version_and_help(self):
        for option, words in ("--version", "wavycon "), ("--help", "usage: mpirun -n RANKS wavycon-mpi"):
            outcome = run(self.mpiexec, max(self.ranks), [self.parallel, option], self.folder)
            self.assertEqual((0, "", 1), (outcome.status, outcome.stderr, outcome.stdout.count(words)), option)

    def test_bad_decks(self):
        (self.folder/"bad.nml").write_text("&surface kind = 'wave' /\n&load pbar = 0.1 /\n")
        (self.folder/"map.nml").write_text("&surface kind = 'file', file = 'nowhere.npy' /\n"
                                           "&load pbar_over_pstar = 0.1 /\n")
        # Each rank reads its own lines: of the last ones of a large map.
        heights = rough_map(*MAPS["odd"][:2], 1)
        heights[200][299], heights[200][300] = math.inf, math.nan
        for order in False, True:
            write_npy(self.folder/f"infinite{order}.npy", heights, "f8", order)
            (self.folder/f"infinite{order}.nml").write_text(
                f"&surface kind = 'file', file = 'infinite{order}.npy' /\n&load pbar_over_pstar = 0.1 /\n")
        for words in (["bad.nml", "nowhere.nml", "map.nml"], ["--bad", "bad.nml"], [], ["infiniteFalse.nml"],
                      ["infiniteTrue.nml"]):
            expected = self.serial(words)
            outcome = run(self.mpiexec, max(self.ranks), [self.parallel, *words], self.folder)
            self.assertIn(expected.returncode, (1, 3))
            self.assertEqual(expected.returncode, outcome.status, words)
            self.assertEqual(1, outcome.stderr.count(expected.stderr), (words, outcome.stderr))
            self.assertEqual(expected.stdout, outcome.stdout)


if __name__ == "__main__":
    main(SameTables)
