#!/usr/bin/env python3
"""The published reference values: recomputed, against grids and other methods, and for consistency."""
import math
import pathlib
import subprocess

from program import ProgramTest, main
from tables import Table

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "outputs" / "reference"
OTHER_METHODS = ROOT / "inputs" / "reference_2d.dat"
DECK = """\
&surface kind = '{}' /
&load pbar_over_pstar = {} /
&method solver = '{}', accuracy = {} /
{}
"""
# The published values. Those of the first three are also at merging, in the summary and in OTHER_METHODS.
VALUES = ("mean_gap_over_amplitude", "contact_area_fraction", "peak_pressure_over_pstar", "trough_gap_over_amplitude",
          "saddle_gap_over_amplitude", "saddle_pressure_over_pstar", "elastic_energy_over_pstar_amplitude", "perimeter")
IN_SUMMARY = VALUES[:3]


def pair(record, name):
    """A value and its error."""
    return float(record[name]), float(record[f"{name}_error"])


def published(surface):
    """{P: {name: (value, error)} of VALUES}."""
    return {float(record["pbar_over_pstar"]): {name: pair(record, name) for name in VALUES}
            for record in Table(REFERENCE / f"{surface}.dat").records()}


def merging_of(surface):
    """From below and from above merging: {name: (value, error)} of the load and of IN_SUMMARY."""
    return [{name: pair(record, name) for name in ("pbar_over_pstar", *IN_SUMMARY)}
            for side in ("below", "above") for record in Table(REFERENCE / "merging.dat").records()
            if (record["surface"], record["side"]) == (surface, side)]


class Published(ProgramTest):
    def check_values(self, value, expected, what):
        """Two values, each with its error, are the same within these."""
        self.assertLessEqual(abs(value[0] - expected[0]), value[1] + expected[1], what)


class ReferenceTable:
    """The tests of a surface's table."""
    surface = ""
    loads = frozenset(i/100 for i in range(1, 100)) | {0.001, 0.002, 0.005, 0.995, 0.998, 0.999}   # at least
    to_recompute = ()              # loads, at another accuracy, hence by other degrees; next to merging in both regimes
    by_grids = ()                  # accuracy and loads
    smooth = ()                    # ranges of P in hundredths in which no spots merge
    merging_loads = 0.0, 0.0, 0.0  # distance of the loads next to merging; relative errors allowed below and above it

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.table = published(cls.surface)
        cls.merging = merging_of(cls.surface)
        cls.merging_load = cls.merging[0]["pbar_over_pstar"][0]

    def solve(self, loads, solver, accuracy, output, kind):
        """The records of a table of the program, loads in the order given."""
        # 2: a load misses the accuracy; its error estimate is larger.
        self.run_deck("case", DECK.format(self.surface, ", ".join(map(repr, loads)), solver, accuracy, output),
                      statuses=(0, 2))
        records = Table(self.folder/f"case.{kind}.dat").records()
        self.assertEqual(len(loads), len(records))
        return records

    def test_loads_and_bounds(self):
        self.assertGreaterEqual(set(self.table), self.loads)
        for load, row in self.table.items():
            for name, (value, error) in row.items():
                exactly_zero = name == ("saddle_gap_over_amplitude" if load > self.merging_load
                                        else "saddle_pressure_over_pstar")
                with self.subTest(load=load, name=name):
                    if exactly_zero:
                        self.assertEqual((0.0, 0.0), (value, error))
                    else:
                        self.assertGreater(value, 0.0)
                        self.assertGreater(error, 0.0)
                        # The largest errors are those of the saddle that is about to close.
                        self.assertLess(error, 0.15*value)

    def test_both_sides_of_merging(self):
        below, above = self.merging
        apart, digits_below, digits_above = self.merging_loads
        for name, (value, error) in below.items():
            other, other_error = above[name]
            self.assertLess(abs(value - other), error + other_error)
            self.assertLess(error, digits_below*value)
            self.assertLess(other_error, digits_above*value)
        # The loads next to merging lie between those of the last spots and the first pool, and so do their values.
        last = max(load for load in self.table if load < self.merging_load)
        first = min(load for load in self.table if load > self.merging_load)
        self.assertLess(first - last, apart)
        for name in IN_SUMMARY:
            value, error = below[name]
            sides = sorted((self.table[last][name][0], self.table[first][name][0]))
            self.assertLess(sides[0] - error, value)
            self.assertLess(value, sides[1] + error)

    def test_recomputed(self):
        for load, record in zip(self.to_recompute, self.solve(self.to_recompute, "fitted", 1e-7,
                                                              "&output details = t /", "details")):
            for name in VALUES:
                self.check_values(pair(record, name), self.table[load][name], (load, name))

    def test_grids(self):
        for accuracy, loads in self.by_grids:
            for load, record in zip(loads, self.solve(loads, "grid", accuracy, "", "summary")):
                self.assertEqual(("grid", "converged"), (record["solver"], record["status"]))
                for name in IN_SUMMARY:
                    self.check_values(pair(record, name), self.table[load][name], (load, name))

    def test_work_of_the_load_is_the_energy(self):
        # The work of the load is the strain energy, dE = -P dG: E + P G grows by the integral of G over P.
        step = 0.01
        for first, last in self.smooth:
            rows = [self.table[i/100] for i in range(first, last + 1)]
            gaps = [row["mean_gap_over_amplitude"][0] for row in rows]
            gained = [row["elastic_energy_over_pstar_amplitude"][0] + load*step*row["mean_gap_over_amplitude"][0]
                      for load, row in ((first, rows[0]), (last, rows[-1]))]
            work = simpson(gaps, step)
            # The error of Simpson's rule at twice the step is some 16 times as large; 4 is cautious.
            allowed = abs(work - simpson(gaps[::2], 2*step))/4
            self.assertLess(allowed, 1e-7)
            self.assertAlmostEqual(work, gained[1] - gained[0], delta=allowed)


class Wave2d(ReferenceTable, Published):
    surface = "wave_2d"
    to_recompute = 0.001, 0.05, 0.2, 0.226, 0.236, 0.3, 0.5, 0.8, 0.999
    by_grids = (1e-3, (0.05, 0.2, 0.23, 0.4, 0.7)), (1e-4, (0.01, 0.1, 0.5, 0.95))
    smooth = (8, 20), (40, 60), (60, 96)
    merging_loads = 1e-4, 1.5e-6, 1e-5

    def test_other_methods(self):
        for record in Table(OTHER_METHODS).records():
            for name in IN_SUMMARY:
                word = record[name]
                # Half a unit of the last digit for rounding, and one as the error of the grids of the shorter values.
                load, digits = float(record["pbar_over_pstar"]), len(word.partition(".")[2])
                self.check_values((float(word), 1.5*10.0**-digits), self.table[load][name], (load, name))


class Hexagonal(ReferenceTable, Published):
    surface = "hexagonal"
    to_recompute = 0.001, 0.05, 0.3, 0.5, 0.65, 0.72, 0.75, 0.9, 0.999
    by_grids = (1e-3, (0.1, 0.6, 0.72, 0.8)), (1e-4, (0.01, 0.3, 0.95))
    smooth = (8, 40), (40, 64), (76, 96)
    merging_loads = 5e-4, 1e-4, 1e-4


class Yield(Published):
    """The largest von Mises stresses and their places."""
    surfaces = {"wave_2d": "kind = 'wave_2d'", "rectangular": "kind = 'wave_2d', wavelength_y = 2",
                "hexagonal": "kind = 'hexagonal'"}
    laterals = "constrained", "hydrostatic"
    ratios = tuple(i/20 for i in range(11))
    loads = (0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, *(i/20 for i in range(3, 21)))
    name = "largest_von_mises_over_pstar"
    # Relative errors of less than ten digits: next to merging, and where the search for a place on the surface ends early.
    error_of = {("hexagonal", 0.7): 3e-9, ("wave_2d", 0.65): 4e-8}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.table = {(row["surface"], row["lateral"], float(row["nu"]), float(row["pbar_over_pstar"])): row
                     for row in Table(REFERENCE / "yield.dat").records()}

    def place(self, key):
        return [float(self.table[key][name]) for name in ("x_over_cell_x", "y_over_cell_y", "depth_over_cell_x")]

    def test_rows_and_bounds(self):
        self.assertEqual({(surface, lateral, nu, load) for surface in self.surfaces for lateral in self.laterals
                          for nu in self.ratios for load in self.loads}, set(self.table))
        for key, row in self.table.items():
            value, error = pair(row, self.name)
            self.assertGreater(error, 0.0)
            self.assertLess(error, self.error_of.get((key[0], key[3]), 2e-10)*value, key)
            for number in self.place(key):
                self.assertTrue(0.0 <= number < 1.0, key)

    def test_full_contact(self):
        """Below the crest of the square wave, or on its surface between crests and troughs."""
        for lateral in self.laterals:
            for nu in self.ratios:
                key = "wave_2d", lateral, nu, 1.0
                value, error = pair(self.table[key], self.name)
                mean = (1 - 2*nu)/(1 - nu) if lateral == "constrained" else 0.0
                below = 1.5*math.exp(-2*(1 + nu)/3) + mean
                between = math.sqrt(mean**2 + 0.75*(1 - 2*nu)**2)
                self.assertLessEqual(abs(value - max(below, between)), error + 1e-15)
                x, y, depth = self.place(key)
                if below > between:
                    expected = 2*(1 + nu)/3/(2*math.pi*math.sqrt(2))
                    self.assertAlmostEqual(expected, depth, delta=2e-6)
                    self.assertIn((x % 0.5, y % 0.5), ((0.0, 0.0),))
                else:
                    self.assertEqual((0.25, 0.25, 0.0), (x % 0.5, y % 0.5, depth))

    def test_recomputed(self):
        """By fitted solutions of other degrees, and by grids."""
        for solver, accuracy, loads, place_error in (("fitted", 1e-7, (0.002, 0.1, 0.5, 0.95), 1e-3),
                                                     ("grid", 1e-3, (0.05, 0.6), 0.02)):
            for surface, keys in self.surfaces.items():
                for lateral in self.laterals:
                    self.recompute(surface, keys, lateral, solver, accuracy, loads, place_error)

    def recompute(self, surface, keys, lateral, solver, accuracy, loads, place_error):
        deck = (f"&surface {keys} /\n&load pbar_over_pstar = {', '.join(map(str, loads))} /\n"
                f"&stress nu = 0.05, 0.4, lateral = '{lateral}' /\n&method solver = '{solver}', accuracy = {accuracy} /\n")
        self.run_deck("case", deck)
        records = Table(self.folder/"case.stress_largest.dat").records()
        self.assertEqual(2*len(loads), len(records))
        for record in records:
            key = surface, lateral, float(record["nu"]), float(record["pbar_over_pstar"])
            self.check_values(pair(record, self.name), pair(self.table[key], self.name), (solver, key))
            cell_x = 2/math.sqrt(3) if surface == "hexagonal" else 1.0
            self.assertAlmostEqual(self.place(key)[2], float(record["von_mises_depth"])/cell_x, delta=place_error)


class Challenge(Published):
    """Contact area, mean gap and stiffness of rough surfaces."""
    loads = 4e-5, 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.08
    e_star = 25.0
    # A value of the table is the mean of those at two loads 2 % apart: its relative difference from that between them.
    of_pairs = 1e-4

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.table = {(int(row["seed"]), float(row["pressure_over_e_star_slope"])): row
                     for row in Table(REFERENCE / "challenge.dat").records()}

    def test_rows_and_bounds(self):
        self.assertEqual({(seed, load) for seed in (1, 2) for load in self.loads}, set(self.table))
        for seed in (1, 2):
            rows = [self.table[seed, load] for load in self.loads]
            for name, way in (("contact_area_fraction", 1), ("mean_gap", -1), ("stiffness", 1)):
                values = [way*pair(row, name)[0] for row in rows]
                self.assertEqual(sorted(values), values, name)
            for row in rows:
                coarse, fine = (float(row[f"contact_area_fraction_{points}"]) for points in (2048, 4096))
                area, error = pair(row, "contact_area_fraction")
                self.assertAlmostEqual((4*fine - coarse)/3, area, delta=1e-3*area)
                self.assertTrue(abs(fine - area) <= error <= 0.015*area)
                self.assertLess(pair(row, "mean_gap")[1], 4e-4)
                self.assertLess(pair(row, "stiffness")[1], 0.007*float(row["stiffness"]))

    def test_stiffness_is_the_slope_of_the_gap(self):
        """Its integral over the logarithm of the pressure, by trapezoids, whose error is the tolerance."""
        for seed in (1, 2):
            rows = [self.table[seed, load] for load in self.loads]
            steepness = [self.e_star*load/float(row["stiffness"]) for load, row in zip(self.loads, rows)]
            for i in range(len(rows) - 1):
                fall = 0.5*(steepness[i] + steepness[i + 1])*math.log(self.loads[i + 1]/self.loads[i])
                self.assertAlmostEqual(fall, float(rows[i]["mean_gap"]) - float(rows[i + 1]["mean_gap"]), delta=0.1*fall)

    def test_recomputed(self):
        load = 0.01
        subprocess.run([self.program, ROOT / "inputs" / "challenge.nml", "--quiet", "--output", self.folder,
                        "--set", "scene.case=case", "--set", f"load.mean_pressure={load*self.e_star}",
                        "--set", "surface.seed=2"], check=True)
        record = Table(self.folder/"case.summary.dat").records()[0]
        row = self.table[2, load]
        area = float(record["contact_area_fraction"])
        self.assertAlmostEqual(float(row["contact_area_fraction_2048"]), area, delta=self.of_pairs*area)
        gap = float(row["mean_gap"])
        self.check_values((float(record["mean_gap"]), self.of_pairs*gap), pair(row, "mean_gap"), "mean gap")


class Adhesion(Published):
    """Contacts with adhesion: errors, and recomputed. exact.adhesion has the balance of energy."""
    p_star = {"wave_2d": math.sqrt(2)*math.pi, "hexagonal": math.pi/2}
    works = 0.01, 0.02, 0.05, 0.1, 0.2, 0.5
    names = "pbar_over_pstar", "mean_gap_over_amplitude", "elastic_energy_over_pstar_amplitude"
    extremes = "pull_off", "jump"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.table = Table(REFERENCE / "adhesion.dat").records()

    def solve(self, surface, work, areas, accuracy):
        """{(branch, area): ((value, error) of each of names)} of the areas, and the critical points' records."""
        self.run_deck("case", DECK.replace("pbar_over_pstar", "contact_area_fraction").format(
            surface, ", ".join(map(repr, areas)), "auto", accuracy,
            f"&interface work_of_adhesion = {work*self.p_star[surface]!r} /"), statuses=(0, 2))
        records = Table(self.folder/"case.adhesion.dat").records()
        found = {}
        for record in records:
            energy = [number/self.p_star[surface] for number in pair(record, "elastic_energy_per_area")]
            if float(record["load"]) > 0:
                found[record["branch"], float(record["contact_area_fraction"])] = (
                    pair(record, self.names[0]), pair(record, self.names[1]), energy)
        return found, [record for record in records if record["point"].startswith(self.extremes)]

    def rows_of(self, surface, work):
        return [row for row in self.table
                if row["surface"] == surface and float(row["w_over_pstar_amplitude"]) == work]

    def test_rows_and_bounds(self):
        for surface in self.p_star:
            for work in self.works:
                rows = self.rows_of(surface, work)
                self.assertEqual({"spots", "pools"}, {row["branch"] for row in rows})
                points = [row["point"] for row in rows]
                self.assertEqual(2, points.count("end_of_branch"))
                # The approach has its least value on both branches, and its largest on that of spots.
                self.assertEqual(2, points.count("pull_off_by_approach"), (surface, work))
                self.assertEqual(1, points.count("jump_by_approach"), (surface, work))
                for row in rows:
                    given = row["point"] in ("stable", "stable_by_approach", "unstable")
                    if given:
                        self.assertEqual("0", row["contact_area_fraction_error"])
                    # What an extreme is of is known better than what changes with the area there. The last point of a
                    # branch may miss the accuracy.
                    of_extreme = self.names[row["point"].endswith("by_approach")]
                    if row["point"] == "end_of_branch":
                        of_extreme = ""
                    for name in self.names:
                        largest = 1.4e-8 if given else 6e-8 if name == of_extreme else 4e-6
                        self.assertTrue(0.0 < pair(row, name)[1] < largest, row)

    def test_recomputed(self):
        for surface, work, areas in (("wave_2d", 0.05, (0.1, 0.3, 0.5, 0.9)), ("hexagonal", 0.2, (0.05, 0.4, 0.65, 0.9))):
            rows = self.rows_of(surface, work)
            found, critical = self.solve(surface, work, areas, 1e-5)
            self.assertEqual(len(areas), len(found))
            for (branch, area), values in found.items():
                row = next(row for row in rows
                           if row["branch"] == branch and float(row["contact_area_fraction"]) == area)
                for name, value in zip(self.names, values):
                    self.check_values(value, pair(row, name), (surface, branch, area, name))
            published_points = [row for row in rows if row["point"].startswith(self.extremes)]
            self.assertEqual([row["point"] for row in published_points], [record["point"] for record in critical])
            for row, record in zip(published_points, critical):
                name = self.names[row["point"].endswith("by_approach")]
                self.check_values(pair(record, name), pair(row, name), row)


def simpson(values, step):
    return step/3*(values[0] + values[-1] + 4*sum(values[1:-1:2]) + 2*sum(values[2:-1:2]))


if __name__ == "__main__":
    main()
