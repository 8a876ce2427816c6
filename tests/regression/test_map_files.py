#!/usr/bin/env python3
"""Height maps that numpy, gsffile and SurfaceTopography write or read are the same surface to the program.

usage: test_map_files.py --program WAVYCON --environment FOLDER

The packages are installed into a virtual environment in FOLDER, once. Exit status: 77 if they cannot be.
"""
import csv
import os
import pathlib
import subprocess

from program import ProgramTest, main, new_folder
from virtual_environment import go_on_with

M, N = 14, 9  # points along x and y
STEP = 2.0**-20  # between points, so that sides and coordinates are exact in single precision


class MapFiles(ProgramTest):
    def setUp(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(new_folder(self.addCleanup))
        self.heights = numpy.random.default_rng(5).standard_normal((N, M))*STEP
        self.single = self.heights.astype(numpy.float32)

    def summary(self, name, keys="", scene=""):
        """The rows of the summary for a map."""
        pathlib.Path("deck.nml").write_text(
            f"&surface kind = 'file', file = '{name}'{keys} /\n&load pbar_over_pstar = 0.02, 0.3 /\n{scene}\n",
            encoding="utf-8")
        subprocess.run([self.program, "deck.nml", "--quiet", "--output", "made"], check=True)
        summary = rows_of("made/deck.summary.dat")
        subprocess.run([self.program, "made/deck.resolved.nml", "--quiet", "--output", "again"], check=True)
        self.assertEqual(summary, rows_of("again/deck.summary.dat"), f"the resolved deck of {name}")
        return summary

    def refusal(self, name, keys=""):
        pathlib.Path("deck.nml").write_text(
            f"&surface kind = 'file', file = '{name}'{keys} /\n&load pbar_over_pstar = 0.02 /\n", encoding="utf-8")
        outcome = subprocess.run([self.program, "deck.nml"], capture_output=True, check=False)
        self.assertEqual(1, outcome.returncode)
        return outcome.stderr.decode()

    def sides(self):
        return f", length_x = {M*STEP!r}, length_y = {N*STEP!r}"

    def test_arrays_of_numpy(self):
        numpy.savetxt("map.dat", self.heights, "%.17g")
        expected = self.summary("map.dat")
        numpy.savetxt("full.dat", self.heights)
        self.assertEqual(expected, self.summary("full.dat"))
        for name, array in (("c", self.heights), ("fortran", numpy.asfortranarray(self.heights)),
                            ("big", self.heights.astype(">f8"))):
            numpy.save(name, array)
            self.assertEqual(expected, self.summary(f"{name}.npy"), name)
        for version in (2, 0), (3, 0):
            with open("version.npy", "wb") as file:
                numpy.lib.format.write_array(file, self.heights, version)
            self.assertEqual(expected, self.summary("version.npy"), version)
        os.rename("c.npy", "heights.data")
        self.assertEqual(expected, self.summary("heights.data"))

    def test_tables_of_spreadsheets(self):
        numpy.savetxt("map.dat", self.heights, "%.17g")
        expected = self.summary("map.dat")
        for name, encoding, ending, options in (
                ("quoted", "utf-8-sig", "\r\n", {"quoting": csv.QUOTE_ALL}), ("cr", "ascii", "\r", {}),
                ("tabs", "utf-8", "\n", {"delimiter": "\t"}), ("semicolons", "utf-8-sig", "\r", {"delimiter": ";"})):
            rows = [[repr(height) for height in row] for row in self.heights.tolist()]
            if name == "semicolons":
                rows = [[height.replace(".", ",") for height in row] for row in rows]
            with open(f"{name}.csv", "w", encoding=encoding, newline="") as file:
                csv.writer(file, lineterminator=ending, **options).writerows(rows)
            self.assertEqual(expected, self.summary(f"{name}.csv"), name)
            rows[4][3], rows[8][0] = "#N/A", "1.#QNAN"
            with open(f"{name}.csv", "w", encoding=encoding, newline="") as file:
                csv.writer(file, lineterminator=ending, **options).writerows([["a head", "in words"], *rows])
            self.assertIn(f"{name}.csv: 2 of {M*N} heights are missing (", self.refusal(f"{name}.csv"))

    def test_a_grid_of_esri(self):
        numpy.savetxt("map.dat", self.heights, "%.17g")
        expected = self.summary("map.dat", self.sides())
        head = f"ncols {M}\nnrows {N}\nxllcorner 0.0\nyllcorner 0.0\ncellsize {STEP!r}\nNODATA_value -9999"
        numpy.savetxt("map.asc", self.heights[::-1], "%.17g", header=head, comments="")
        self.assertEqual(expected, self.summary("map.asc"))

    def test_single_precision(self):
        numpy.savetxt("map.dat", self.single.astype(float), "%.17g")
        expected = self.summary("map.dat", self.sides())
        for name, order in ("little", "<f4"), ("big", ">f4"):
            numpy.save(name, numpy.asfortranarray(self.single.astype(order)))
            self.assertEqual(expected, self.summary(f"{name}.npy", self.sides()), name)
        gsffile.write_gsf("map.gsf", self.single, {"XReal": M*STEP, "YReal": N*STEP, "XYUnits": "m", "ZUnits": "m"})
        self.assertEqual(expected, self.summary("map.gsf"))
        self.assertIn("cell_x[m] = 1.33514404296875e-5", pathlib.Path("made/deck.summary.dat").read_text(encoding="utf-8"))
        read, _ = gsffile.read_gsf("map.gsf")
        self.assertTrue((read == self.single).all())

    def test_a_unit_of_the_deck(self):
        numpy.savetxt("map.dat", 1000*self.single.astype(float), "%.17g")
        expected = self.summary("map.dat", f", length_x = {1000*M*STEP!r}, length_y = {1000*N*STEP!r}",
                                "&scene length_unit = 'mm' /")
        for name, height_unit, factor in ("m", "m", ""), ("nm", "nm", ", height_scale = 1e9"):
            gsffile.write_gsf(f"{name}.gsf", self.single, {"XReal": M*STEP, "YReal": N*STEP, "XYUnits": "m",
                                                           "ZUnits": height_unit})
            found = self.summary(f"{name}.gsf", factor, "&scene length_unit = 'mm' /")
            for one, other in zip(sum(expected, []), sum(found, []), strict=True):
                # Powers of ten are rounded.
                self.assertTrue(one == other or abs(float(one) - float(other)) <= 1e-9*abs(float(one)), (one, other))

    def test_a_profile(self):
        numpy.savetxt("map.dat", self.heights[:1], "%.17g")
        numpy.save("map.npy", self.heights[0])
        self.assertEqual(self.summary("map.dat"), self.summary("map.npy"))

    def test_missing_heights(self):
        self.heights[4, 3] = self.heights[8, 13] = self.heights[8, 12] = numpy.nan
        numpy.save("map.npy", self.heights)
        gsffile.write_gsf("map.gsf", self.heights.astype(numpy.float32))
        numpy.savetxt("map.dat", self.heights)
        names = "map.npy", "map.gsf", "map.dat"
        for name in names:
            self.assertIn(f"{name}: 3 of {M*N} heights are missing (", self.refusal(name))
        self.single[4, 3] = self.single[8, 13] = -1e30
        # In the file's unit, whatever the deck's.
        gsffile.write_gsf("value.gsf", self.single, {"XReal": 1, "YReal": 1, "XYUnits": "m", "ZUnits": "nm"})
        self.assertIn("value.gsf: 2 of 126 heights are missing (", self.refusal("value.gsf", ", missing_value = -1e30"))
        numpy.save("value.npy", self.single)
        self.assertIn("value.npy: 2 of 126 heights are missing (",
                      self.refusal("value.npy", ", missing_value = -1e30"))

    def test_surface_topography(self):
        numpy.savetxt("map.dat", self.heights, "%.17g")
        topography = Topography(self.heights.T, (M*STEP, N*STEP), unit="m")
        topography.to_matrix("topography.dat")
        numpy.save("topography.npy", topography.heights().T)
        expected = self.summary("map.dat", self.sides())
        # The text has a head with the sides, as those of Gwyddion.
        self.assertEqual(expected, self.summary("topography.dat"))
        self.assertEqual(expected, self.summary("topography.npy", self.sides()))
        masked = numpy.ma.masked_where(numpy.arange(N*M).reshape(N, M) == 17, self.heights)
        topography = Topography(masked.T, (M*STEP, N*STEP), unit="m")
        topography.to_matrix("topography.dat")
        numpy.save("topography.npy", numpy.ma.filled(topography.heights(), numpy.nan).T)
        for name in "topography.dat", "topography.npy":
            self.assertIn(f"{name}: 1 of {M*N} heights are missing (", self.refusal(name))

    def test_a_line_scan_of_unequal_steps(self):
        # Two waves, the shorter one of 16 mean steps, as inputs/surfaces.md writes line scans; slope (rms) 0.2.
        x = numpy.arange(256) + numpy.random.default_rng(7).uniform(-0.4, 0.4, 256)
        scan = NonuniformLineScan(x, sum(256/k*numpy.cos(2*numpy.pi*k*x/256)/10/numpy.pi for k in (1, 16)), unit="um")
        numpy.savetxt("scan.txt", numpy.c_[scan.positions(), scan.heights()])
        self.summary("scan.txt", ", edges = 'mirror'")
        head = pathlib.Path("made/deck.summary.dat").read_text(encoding="utf-8")
        self.assertIn("# prepared: resampled to 256 points", head)
        slope = float(head.split("rms_slope[-] = ")[1].split(",")[0])
        self.assertLess(abs(slope/0.2 - 1), 0.005)


def rows_of(path):
    """Fields of the rows: the columns are as wide as their units."""
    return [line.split() for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines()
            if not line.startswith("#")][1:]


if __name__ == "__main__":
    go_on_with("numpy", "gsffile", "SurfaceTopography")
    import gsffile
    import numpy
    from SurfaceTopography import NonuniformLineScan, Topography
    main()
