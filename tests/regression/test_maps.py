#!/usr/bin/env python3
"""Maps agree with the summary, and with each other in both formats.

usage: test_maps.py --program WAVYCON
"""
import math

from npy import read_npy
from program import ProgramTest, main
from rough_map import rough_map, text_of
from tables import Table

NAMES = ["x", "y", "pressure", "gap", "displacement", "undeformed_gap"]
LOADS = 0.0, 0.05, 0.2, 0.6, 0.9, 1.0
SIDE = 96
# Sums of some ten thousand numbers, and the 16 digits of tables.
ROUNDING = 1e-12
FILE = "&surface kind = 'file', file = 'heights.dat', length_x = 2, length_y = 3 /\n"
WAVE = "&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3, wavelength_y = 2e-3 /\n"
GRID = "&method solver = 'grid', grid_points = 64, 96 /\n"
# {name: (surface, method, output, whether the map shows the solver's grid)}
DECKS = {
    "own": (WAVE, GRID, "", True),
    "other": (WAVE, GRID, "map_points = 150, 120", False),
    "shifted": (WAVE, GRID, "map_points = 64", False),
    "file": (FILE, "", "", True),
    "file_other": (FILE, "", "map_points = 125, 100", False),
    "file_finer": (FILE, "&method accuracy = 0.03 /\n", "", False),
    "fitted": (WAVE, "&method solver = 'fitted' /\n", "map_points = 48", False),
    "turned": ("&surface kind = 'wave_2d' /\n", "&method solver = 'grid', accuracy = 0.01 /\n", "", False),
    "line": ("&surface kind = 'wave_1d', amplitude = 3, wavelength = 7 /\n", "&method solver = 'auto' /\n",
             "map_points = 200", False),
    "line_own": ("&surface kind = 'wave_1d' /\n", "&method solver = 'grid', grid_points = 64 /\n", "", True),
}


def records_of(path):
    """Shape, and a dictionary for each record."""
    head, values = read_npy(path)
    if head["fortran_order"]:
        raise ValueError(f"{path}: {head}")
    names = [name for name, _ in head["descr"]]
    return head["shape"], [dict(zip(names, row)) for row in zip(*[iter(values)]*len(names), strict=True)]


def mean(values):
    return math.fsum(values)/len(values)


class Maps(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder/"heights.dat").write_text(text_of(rough_map(SIDE, SIDE, 5)))
        cls.summaries, cls.maps = {}, {}
        for name, (surface, method, output, _) in DECKS.items():
            cls.run_map(name, surface + method, output)
            cls.summaries[name] = [{key: word if key in ("solver", "status") else float(word)
                                    for key, word in record.items()}
                                   for record in Table(cls.folder / f"{name}.summary.dat").records()]
            cls.maps[name] = cls.blocks(name)

    @classmethod
    def run_map(cls, name, groups, output):
        cls.run_deck(name, f"{groups}&load pbar_over_pstar = {', '.join(map(str, LOADS))} /\n"
                     f"&output map = t, {output} /\n")

    @classmethod
    def blocks(cls, name):
        """The records of the text table, a list for each load."""
        table = Table(cls.folder / f"{name}.map.dat")
        assert table.columns == ["load"] + NAMES
        found = [[] for load in LOADS]
        for record in table.records():
            found[int(record["load"]) - 1].append({key: float(record[key]) for key in NAMES})
        return found

    def each_load(self):
        return [(name, row, points) for name in DECKS
                for row, points in zip(self.summaries[name], self.maps[name], strict=True)]

    def test_contact_and_gap_exclude_each_other(self):
        for name, row, points in self.each_load():
            with self.subTest(deck=name, load=row["pbar_over_pstar"]):
                self.assertEqual(0.0, min(min(point["pressure"] for point in points), 0.0))
                self.assertEqual(0.0, min(min(point["gap"] for point in points), 0.0))
                self.assertEqual(0.0, max(point["pressure"]*point["gap"] for point in points))

    def test_gaps_and_displacements_agree(self):
        for name, row, points in self.each_load():
            with self.subTest(deck=name, load=row["pbar_over_pstar"]):
                delta = row["mean_gap"]/row["mean_gap_over_amplitude"] if row["mean_gap"] else row["approach"]
                for point in points:
                    gap = point["undeformed_gap"] + point["displacement"] - row["approach"]
                    # Between the points of a height map its series is a little above the highest of them.
                    if row["status"] == "no_load" and name == "file_other":
                        gap = max(gap, 0.0)
                    self.assertAlmostEqual(gap, point["gap"], delta=ROUNDING*delta)

    def test_integrals_are_those_of_the_summary(self):
        # Of a map with n points to a side errors are at most of the order 1/n, a part of a step all along the edge; of
        # a peak between the points, 1/n^2. Seen are half of these.
        for name, row, points in self.each_load():
            with self.subTest(deck=name, load=row["pbar_over_pstar"]):
                side = math.sqrt(len(points)) if len({point["y"] for point in points}) > 1 else len(points)
                area = mean([point["pressure"] > 0.0 for point in points])
                self.assertAlmostEqual(row["contact_area_fraction"], area, delta=2/side)
                self.assertAlmostEqual(row["mean_pressure"], mean([point["pressure"] for point in points]),
                                       delta=0.15/side*row["peak_pressure"])
                self.assertAlmostEqual(row["mean_gap"], mean([point["gap"] for point in points]),
                                       delta=0.004/side*(row["mean_gap"] + row["approach"]))
                self.assertAlmostEqual(row["peak_pressure"], max(point["pressure"] for point in points),
                                       delta=0.012*row["peak_pressure"])

    def test_own_points_are_the_solvers(self):
        for name, row, points in self.each_load():
            with self.subTest(deck=name, load=row["pbar_over_pstar"]):
                if not DECKS[name][3] or row["solver"] != "grid":
                    continue
                # Of an even surface a quarter, or in 1-D half, is solved.
                parts = {"own": 4, "file": 1, "line_own": 2}[name]
                self.assertEqual(parts*row["active_constraints"], sum(point["pressure"] <= 0.0 for point in points))
                self.assertTrue(math.isclose(row["mean_pressure"], mean([point["pressure"] for point in points]),
                                             rel_tol=ROUNDING))
                self.assertTrue(math.isclose(row["mean_gap"], mean([point["gap"] for point in points]), rel_tol=1e-9))

    def test_points_are_those_requested(self):
        for name, sides, first in (("own", (64, 96), 0.5), ("other", (150, 120), 0.0), ("shifted", (64, 64), 0.0),
                                   ("file", (96, 96), 0.0), ("turned", (128, 128), 0.0), ("line_own", (64, 1), 0.5)):
            points = self.maps[name][1]
            step = [2*sorted({point[key] for point in points})[1] for key in "xy"[:2 if sides[1] > 1 else 1]]
            self.assertEqual(math.prod(sides), len(points))
            self.assertEqual(sides, tuple(len({point[key] for point in points}) for key in "xy"))
            self.assertTrue(math.isclose(first*step[0]/(2*(1 + first)), points[0]["x"]))

    def test_numpys_format_has_the_same_numbers(self):
        for name in ("own", "file", "line"):
            surface, method, output, own = DECKS[name]
            self.run_map("binary", surface + method, output + " map_format = 'npy'")
            shape, records = records_of(self.folder / "binary.map.npy")
            rows = len({point["y"] for point in self.maps[name][0]})
            self.assertEqual((len(LOADS), rows, len(self.maps[name][0])//rows), shape)
            for expected, record in zip([point for load in self.maps[name] for point in load], records, strict=True):
                self.assertEqual(NAMES, list(record))
                for key in NAMES:
                    self.assertTrue(math.isclose(expected[key], record[key], rel_tol=1e-15), (key, expected, record))

    def test_large_maps_are_in_numpys_format(self):
        self.run_map("at_limit", WAVE + GRID, "map_points = 257")
        self.run_map("beyond", WAVE + GRID, "map_points = 257, 258")
        self.assertTrue((self.folder / "at_limit.map.dat").exists())
        self.assertFalse((self.folder / "at_limit.map.npy").exists())
        self.assertFalse((self.folder / "beyond.map.dat").exists())
        self.assertEqual((len(LOADS), 258, 257), records_of(self.folder / "beyond.map.npy")[0])


if __name__ == "__main__":
    main()
