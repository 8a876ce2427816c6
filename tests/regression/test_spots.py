#!/usr/bin/env python3
"""Spots, pools, percolation and histograms agree with the map of the points that were solved.

usage: test_spots.py --program WAVYCON
"""
import math

from program import ProgramTest, main
from rough_map import rough_map, text_of
from tables import Table

SIDE = 72
LOADS = 0.02, 0.1, 0.25, 0.4, 0.6, 0.8, 0.95
# Sums of some thousand numbers, and the 16 digits of tables.
ROUNDING = 1e-11
EIGHT = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
FOUR = [(i, j) for i, j in EIGHT if i*j == 0]
MAP = "&surface kind = 'file', file = '{}.dat', length_x = 2, length_y = 3 /\n"


def heights(seed):
    """A rough surface: waves down to six points."""
    return rough_map(SIDE, SIDE, seed, longest=2, shortest=12, power=1.8)


def regions(inside, steps):
    """The connected parts of a periodic map: sets of points with whether they go on from cell to cell along x and y.

    inside: rows of truth values. steps: to the neighbours that connect.
    """
    rows, columns = len(inside), len(inside[0])
    place_of, found = {}, []   # of each point: the region, and the place in the plane that it was reached at
    for start in ((k, l) for l in range(rows) for k in range(columns)):
        if not inside[start[1]][start[0]] or start in place_of:
            continue
        place_of[start] = start
        points, ends, goes_on = {start}, [start], [0, 0]
        while ends:
            x, y = ends.pop()
            for i, j in steps:
                point = (x + i) % columns, (y + j) % rows
                if not inside[point[1]][point[0]]:
                    continue
                if point not in place_of:
                    place_of[point] = x + i, y + j
                    points.add(point)
                    ends.append((x + i, y + j))
                else:
                    goes_on[0] |= place_of[point][0] != x + i
                    goes_on[1] |= place_of[point][1] != y + j
        found.append((points, goes_on))
    return found


def regions_of_map(inside, steps):
    """The same of a map that mirror images continue: those of all four, which are one if they are images."""
    tiles = [line + line[::-1] for line in inside + inside[::-1]]
    found = {}
    for points, goes_on in regions(tiles, steps):
        own = frozenset((min(k, len(tiles[0]) - 1 - k), min(l, len(tiles) - 1 - l)) for k, l in points)
        before = found.get(own, [0, 0])
        found[own] = [before[0] | goes_on[0], before[1] | goes_on[1]]
    return list(found.items())


def total(rows, column):
    """The sum of a column."""
    return math.fsum(float(row[column]) for row in rows)


class Spots(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rough = heights(7)
        rolled = [row[30:] + row[:30] for row in rough[50:] + rough[:50]]
        for name, rows in (("rough", rough), ("rolled", rolled), ("other", heights(8))):
            (cls.folder/f"{name}.dat").write_text(text_of(rows))
            cls.run_spots(name, MAP.format(name) + "&method residual = 1e-12 /\n")
        cls.run_spots("mirrored", MAP.format("other").replace("/", "edges = 'mirror' /"))

    @classmethod
    def run_spots(cls, name, groups, loads=LOADS, tables="map = t, spots = t, histograms = t, histogram_bins = 17"):
        cls.run_deck(name, f"{groups}&load pbar_over_pstar = {', '.join(map(str, loads))} /\n&output {tables} /\n")

    def table(self, name, kind):
        return Table(self.folder/f"{name}.{kind}.dat").records()

    def sizes(self, name, load, region):
        return [row for row in self.table(name, "spot_sizes") if int(row["load"]) == load and row["region"] == region]

    def fields(self, name, load):
        """The pressures and the gaps of a load, rows along x."""
        rows = [row for row in self.table(name, "map") if int(row["load"]) == load]
        values = [(float(row["pressure"]), float(row["gap"])) for row in rows]
        grid = [values[l*SIDE:(l + 1)*SIDE] for l in range(SIDE)]
        return [[p for p, _ in row] for row in grid], [[g for _, g in row] for row in grid]

    def test_regions_are_those_of_a_search_through_the_points(self):
        seen = set()
        for name, search in ("rough", regions), ("other", regions), ("mirrored", regions_of_map):
            for load, row in enumerate(self.table(name, "spots"), 1):
                pressure, _ = self.fields(name, load)
                whole = math.fsum(map(math.fsum, pressure))
                contact = [[p > 0 for p in line] for line in pressure]
                spots = search(contact, EIGHT)
                pools = search([[not value for value in line] for line in contact], FOUR)
                closed = [points for points, goes_on in pools if not any(goes_on)]
                with self.subTest(deck=name, load=load):
                    self.assertEqual([len(spots), len(closed)], [int(row["spots"]), int(row["closed_pools"])])
                    for i, way in enumerate("xy"):
                        for kind, found in ("contact", spots), ("gap", pools):
                            self.assertEqual(any(goes_on[i] for _, goes_on in found),
                                             row[f"{kind}_percolates_{way}"] == "1")
                    # Each spot by its load, which no two share.
                    carried = sorted(math.fsum(pressure[l][k] for k, l in points)/whole for points, _ in spots)
                    table = self.sizes(name, load, "spot")
                    for one, other in zip(carried, sorted(float(spot["load_fraction"]) for spot in table), strict=True):
                        self.assertAlmostEqual(one, other, delta=ROUNDING)
                    # A pool that is closed is a hole of the spot about it, and a closed spot one of its pool.
                    self.assertEqual(len(closed), sum(int(spot["holes"]) for spot in table))
                    seen.add((len(spots) > 5, len(closed) > 5, row["contact_percolates_x"], row["gap_percolates_x"]))
        # Light loads with many spots, heavy ones with many pools.
        self.assertIn((True, False, "0", "1"), seen)
        self.assertIn((False, True, "1", "0"), seen)

    def test_areas_add_up(self):
        for name in "rough", "other", "mirrored":
            for load, row in enumerate(self.table(name, "spots"), 1):
                with self.subTest(deck=name, load=load):
                    spots, pools = self.sizes(name, load, "spot"), self.sizes(name, load, "pool")
                    area = float(row["contact_area_fraction"])
                    self.assertAlmostEqual(area, float(row["spots_area_fraction"]), delta=ROUNDING)
                    self.assertAlmostEqual(area, total(spots, "area_fraction"), delta=ROUNDING)
                    self.assertAlmostEqual(6*area, total(spots, "area"), delta=6*ROUNDING)
                    self.assertAlmostEqual(1 - area, total(pools, "area_fraction"), delta=ROUNDING)
                    self.assertAlmostEqual(1.0, total(spots, "load_fraction"), delta=ROUNDING)
                    perimeter = float(row["perimeter"])
                    self.assertAlmostEqual(perimeter, total(spots, "perimeter"), delta=ROUNDING*perimeter)
                    self.assertAlmostEqual(perimeter, total(pools, "perimeter"), delta=ROUNDING*perimeter)

    def test_a_surface_moved_over_the_cell_has_the_same_regions(self):
        # To what the iteration leaves of the pressures next to the edge at this residual.
        for row, moved in zip(self.table("rough", "spots"), self.table("rolled", "spots"), strict=True):
            for name, word in row.items():
                with self.subTest(load=row["load"], column=name):
                    if name.endswith("fraction") or name == "perimeter":
                        self.assertAlmostEqual(float(word), float(moved[name]), delta=1e-8*(1 + float(word)))
                    else:
                        self.assertEqual(word, moved[name])

    def test_spots_of_the_wave_merge_at_the_known_load(self):
        # P = 0.22861 (outputs/reference/merging.dat). Fitted solutions place it to their accuracy, grids to their step.
        wave = "&surface kind = 'wave_2d', amplitude = 0.1, wavelength = 2 /\n"
        for name, method, loads in (("fitted", "solver = 'auto', accuracy = 1e-5", (0.2, 0.2285, 0.2287, 0.3)),
                                    ("grids", "solver = 'grid', accuracy = 1e-3", (0.2, 0.224, 0.234, 0.3)),
                                    ("points", "solver = 'grid', grid_points = 256", (0.2, 0.225, 0.232, 0.3)),
                                    ("series", "solver = 'beale'", (0.1, 0.15, 0.4, 0.6))):
            self.run_spots(name, wave + f"&method {method} /\n", loads, "spots = t")
            for row in self.table(name, "spots"):
                with self.subTest(deck=name, load=row["pbar_over_pstar"]):
                    apart = int(row["load"]) <= 2
                    self.assertEqual(["2", "0"] if apart else ["1", "2"], [row["spots"], row["closed_pools"]])
                    percolates = [row[f"{kind}_percolates_{way}"] for kind in ("contact", "gap") for way in "xy"]
                    self.assertEqual(["0", "0", "1", "1"] if apart else ["1", "1", "0", "0"], percolates)
                    self.assertAlmostEqual(float(row["contact_area_fraction"]), float(row["spots_area_fraction"]),
                                           delta=ROUNDING)
                    places = {(float(spot["x"]), float(spot["y"]))
                              for spot in self.sizes(name, int(row["load"]), "spot" if apart else "pool")}
                    for x, y in ((0.0, 0.0), (1.0, 1.0)) if apart else ((1.0, 0.0), (0.0, 1.0)):
                        # 2 is 0 but for rounding.
                        self.assertTrue(any(max(abs(math.remainder(x - u, 2)), abs(math.remainder(y - v, 2))) < 1e-3
                                            for u, v in places), places)

    def test_strips_of_a_profile(self):
        profile = "&surface kind = 'sum', amplitudes = 1, 0.6, waves_x = 2, 3, length_x = 1 /\n"
        # Phases make it uneven, so that the whole cell is solved. Each strip carries the pressures at its points.
        self.run_spots("uneven", profile.replace("length_x", "phases = 50, 20, length_x")
                      + "&method solver = 'grid', grid_points = 200 /\n", (0.1, 0.4, 0.8))
        strips = 0
        for load in 1, 2, 3:
            points = [(float(row["x"]), float(row["pressure"]))
                      for row in self.table("uneven", "map") if int(row["load"]) == load]
            for strip in self.sizes("uneven", load, "spot"):
                strips += 1
                x, half_width = float(strip["x"]), float(strip["equivalent_radius"])
                carried = math.fsum(p for place, p in points if abs(math.remainder(place - x, 1)) < half_width + 1/400)
                self.assertAlmostEqual(carried/math.fsum(p for _, p in points), float(strip["load_fraction"]),
                                       delta=ROUNDING)
        self.assertGreater(strips, 4)

    def test_histograms_are_those_of_the_points(self):
        for name in "rough", "other":
            summary = self.table(name, "summary")
            table = self.table(name, "histogram")
            for load in range(1, len(LOADS) + 1):
                rows = [{key: float(word) for key, word in row.items()} for row in table if int(row["load"]) == load]
                pressure, gap = ([value for line in field for value in line] for field in self.fields(name, load))
                with self.subTest(deck=name, load=load):
                    self.assertEqual(17, len(rows))
                    for kind, values, mean in (("pressure", [p for p in pressure if p > 0], "mean_pressure"),
                                               ("gap", [g for p, g in zip(pressure, gap) if not p > 0], "mean_gap")):
                        width = rows[1][kind] - rows[0][kind]
                        self.assertAlmostEqual(max(values), 17*width, delta=ROUNDING*max(values))
                        area = width*total(rows, kind + "_density")
                        self.assertAlmostEqual(len(values)/SIDE**2, area, delta=ROUNDING)
                        found = math.fsum(row[kind + "_fraction"]*row[kind + "_mean"] for row in rows)
                        self.assertTrue(math.isclose(math.fsum(values)/SIDE**2, found, rel_tol=ROUNDING))
                        # What the iteration leaves: overlaps at points without pressure count as no gap.
                        self.assertTrue(math.isclose(float(summary[load - 1][mean]), found, rel_tol=1e-5))
                        for i, row in enumerate(rows):
                            low, high = i*width, (i + 1)*width if i < 16 else math.inf
                            # Values at the end of a bin may be in the next.
                            number = sum(low <= value < high for value in values)
                            self.assertAlmostEqual(number/SIDE**2, row[kind + "_fraction"], delta=1.5/SIDE**2)
                            self.assertTrue(low - 1e-9*width <= row[kind + "_mean"] <= (i + 1 + 1e-9)*width)

    def test_histograms_of_solutions_without_a_grid(self):
        # Areas and means of the summary, to the sampling: src/core/measure/README.md, (A6).
        for name, surface, method, area_error in (("wave", "wave_2d", "solver = 'auto', accuracy = 1e-5", 3e-4),
                                                  ("line", "wave_1d", "solver = 'auto'", 1e-5)):
            self.run_spots(name, f"&surface kind = '{surface}' /\n&method {method} /\n", (0.05, 0.5, 0.9))
            for load, summary in enumerate(self.table(name, "summary"), 1):
                rows = [{key: float(word) for key, word in row.items()}
                        for row in self.table(name, "histogram") if int(row["load"]) == load]
                area = math.fsum(row["pressure_fraction"] for row in rows)
                self.assertAlmostEqual(float(summary["contact_area_fraction"]), area, delta=area_error)
                self.assertAlmostEqual(1.0, area + math.fsum(row["gap_fraction"] for row in rows), delta=ROUNDING)
                for kind in "pressure", "gap":
                    mean = math.fsum(row[kind + "_fraction"]*row[kind + "_mean"] for row in rows)
                    self.assertTrue(math.isclose(float(summary["mean_" + kind]), mean, rel_tol=1e-4))


if __name__ == "__main__":
    main()
