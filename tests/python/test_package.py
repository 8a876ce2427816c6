#!/usr/bin/env python3
"""The Python package: the examples of its page, digits, files, pictures, misuse, memory, threads, processes, Ctrl-C.

usage: test_package.py --program WAVYCON --package FOLDER --needs PACKAGES --environment FOLDER

PACKAGES, separated by commas, are numpy, pandas and matplotlib, and perhaps SurfaceTopography and ContactMechanics,
without which the tests of files and of the example are skipped. Where this Python lacks them they are installed into a
virtual environment in FOLDER, once. Exit status: 77 if they cannot be.
"""
import concurrent.futures
import contextlib
import copy
import gc
import importlib.util
import inspect
import io
import os
import pathlib
import pickle
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import types
import unittest
import unittest.mock
import warnings

from program import ProgramTest, main
from tables import Table
from virtual_environment import go_on_with_package

# Half a unit of the last of the 16 digits that tables have.
DIGITS, STRESS_DIGITS = 1e-15, 1e-11
SOLVES = 150
# Seconds within which Ctrl-C ends a solve.
PATIENCE = 1.0

ROUGH = """&surface kind = 'self_affine', rms_slope = 0.1, points = 64, short_wavelength = 0.125, seed = 3 /
&material e_star = 2 /
&load pbar_over_pstar = 0.05, 0.3, 0.1 /
&stress nu = 0.3, line = t /
&output map = t, spots = t /
"""
ALL_TABLES = """&surface kind = 'wave_2d' /
&load pbar_over_pstar = 0.2 /
&method solver = 'fitted', accuracy = 1e-4 /
&stress nu = 0.3, planes = t, section = 'x', depths = 0.1, 0.3 /
&output lines = t, contours = t, histograms = t, theory = t, details = t, spectrum = t, map_points = 24,
   line_points = 24 /
"""
LONG = """
import wavycon as wc
surface = wc.self_affine(points=[512, 512], hurst=0.8, rms_height=1e-6, length_x=1e-3)
print("started", flush=True)
try:
    wc.solve(surface, pbar_over_pstar=[0.1]*50, solver="grid", residual=1e-13)
except KeyboardInterrupt:
    print("stopped")
assert wc.solve(wc.wave_2d(), pbar_over_pstar=0.5)[0].status == "converged"
print("usable")
"""

FORKS = """
import os
from concurrent.futures import ThreadPoolExecutor
import wavycon as wc
def solve():
    return wc.solve(wc.wave_1d(), pbar_over_pstar=0.5)
results = solve()
with ThreadPoolExecutor(4) as pool:
    busy = [pool.submit(lambda: [solve() for _ in range(50)]) for _ in range(4)]
    for _ in range(15):
        child = os.fork()
        if child == 0:
            os._exit(0 if results[0].pressure.max() > 0 and solve()[0].status_code == 1 else 1)
        assert os.waitpid(child, 0)[1] == 0
    assert all(len(solved.result()) == 50 for solved in busy)
"""
# Seconds after which a process counts as hanging.
HANGING = 60
C_PROGRAM = """#include <stdio.h>
#include "wavycon.h"
int main(void)
{
  char version[100] = "";
  wavycon_error error = wavycon_new_error();
  wavycon_get_text(error, NULL, "version", version, sizeof version);
  fputs(version, stdout);
  return wavycon_get_code(error);
}
"""
# A picture of 1 x 1 points: a directory of entries (tag, type, number, value), and the value of a point.
TIFF = b"II*\0" + struct.pack("<IH", 8, 8) + b"".join(
    struct.pack("<HHII", tag, 4, 1, value) for tag, value in
    {256: 1, 257: 1, 258: 8, 259: 1, 262: 1, 273: 110, 278: 1, 279: 1}.items()) + bytes(5)
ROOT = pathlib.Path(__file__).resolve().parents[2]


def read_page(name):
    return (ROOT/"src"/"library"/"python"/name).read_text(encoding="utf-8")


def python_blocks(name):
    return re.findall(r"```python\n(.*?)```", read_page(name), re.DOTALL)


class Named:
    """An array with names of its axes, and perhaps coordinates, as xarray has them."""

    def __init__(self, values, *dims, **coords):
        self.values, self.dims, self.coords = values, dims, coords

    def __array__(self, *arguments, **options):
        return numpy.array(self.values, *arguments, **options)


def solve_small():
    return wc.solve(wc.wave_1d(), pbar_over_pstar=0.5)


class PackageTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(cls.folder)
        os.environ["PATH"] = os.path.dirname(cls.program) + os.pathsep + os.environ["PATH"]
        (cls.folder/"rough.nml").write_text(ROUGH)
        warnings.simplefilter("ignore", wc.Note)   # but in the tests of notes

    def assert_same_rows(self, path, rows):
        """The columns of a table of the program and of a structured array."""
        table = Table(path)
        self.assertEqual(table.columns, list(rows.dtype.names))
        self.assertEqual(len(table.records()), len(rows))
        for column in table.columns:
            # Small components of stresses have the rounding of large ones, by the LAPACK of program and library, and
            # their largest values that of a search.
            numbers = rows[column] if rows[column].dtype.kind == "f" else numpy.zeros(1)
            rounding = (STRESS_DIGITS if "stress" in str(path) else DIGITS)*numpy.nanmax(abs(numbers), initial=0.0)
            for record, value in zip(table.records(), rows[column].tolist()):
                with self.subTest(table=str(path), column=column):
                    if isinstance(value, str):
                        self.assertEqual(record[column], value)
                    elif value == value or float(record[column]) == float(record[column]):
                        self.assertLessEqual(abs(float(record[column]) - value), max(rounding, DIGITS*abs(value)))

    def refuse(self, words, function, *arguments, error=ValueError, **options):
        with self.subTest(words=words), self.assertRaisesRegex(error, words):
            function(*arguments, **options)


class Examples(PackageTest):
    def test_the_page(self):
        examples = python_blocks("README.md")
        self.assertGreater(len(examples), 5)
        names, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed):
            for example in examples:
                exec(example, names)
        for words in "error 1 of 2: wavelength", "status='converged'", r"\(256, 256\)", "load.mean_pressure":
            self.assertRegex(printed.getvalue(), words)

    @unittest.skipUnless(importlib.util.find_spec("ContactMechanics"), "needs ContactMechanics")
    def test_the_example(self):
        (self.folder/"inputs").mkdir()
        shutil.copy(ROOT/"inputs"/"measured_surface.dat", "inputs")
        names, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for example in python_blocks("example.md"):
                exec(example, names)
        shown = "".join(re.findall(r"^```\n\n```\n(.*?)```", read_page("example.md"), re.DOTALL | re.MULTILINE))
        # The last digits of two iterations differ from machine to machine, here and below.
        rounding = r"pressures to \de-\d\d"
        self.assertEqual(*(re.sub(rounding, "", text) for text in (shown, printed.getvalue())))
        self.assertLess(max(map(float, re.findall(r"pressures to (\S+)", printed.getvalue()))), 1e-6)

    @unittest.skipUnless(importlib.util.find_spec("ContactMechanics"), "needs ContactMechanics")
    def test_the_page_of_bounds(self):
        names, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed):
            for example in python_blocks("certify.md"):
                exec(example, names)
        shown = "".join(re.findall(r"^```\n\n```\n(.*?)```", read_page("certify.md"), re.DOTALL | re.MULTILINE))
        number = r"\d\.\S*e-\d\d"
        self.assertEqual(*(re.sub(number, "", text) for text in (shown, printed.getvalue())))
        numpy.testing.assert_allclose(*([float(one) for one in re.findall(number, text)]
                                        for text in (printed.getvalue(), shown)), rtol=0.02)

    def test_help(self):
        for name in wc.__all__ + ["self_affine", "wave_sum"]:
            self.assertTrue(getattr(wc, name).__doc__, name)
        self.assertIn("rms_slope", str(inspect.signature(wc.self_affine)))
        self.assertIn("wave_2d", dir(wc))
        self.assertIn("contact_area_fraction_error", dir(solve_small()[0]))


class Digits(PackageTest):
    def test_tables_are_those_of_the_program(self):
        self.run_deck("rough")
        for results in wc.run("rough.nml"), self.solve_rough():
            for name in "summary", "map", "spots", "spot_sizes", "stress_line", "stress_largest":
                self.assert_same_rows(f"rough.{name}.dat", results.table(name))
        self.run_deck("all", ALL_TABLES)
        results = wc.run("all.nml")
        for name in ("lines", "contours", "histograms", "theory", "theory_lines", "details", "spectrum",
                     "stress_section", "stress_planes"):
            # Files have other names than two of the keys.
            file = {"contours": "contour", "histograms": "histogram"}.get(name, name)
            self.assert_same_rows(f"all.{file}.dat", results.table(name))

    def solve_rough(self):
        surface = wc.self_affine(rms_slope=0.1, points=64, short_wavelength=0.125, seed=3)
        return wc.solve(surface, e_star=2, pbar_over_pstar=[0.05, 0.3, 0.1], stress={"nu": 0.3})

    def test_tables_of_the_interface(self):
        self.run_deck("line", "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.1, 0.6 /\n&method solver = 'auto' /\n"
                      "&interface friction = 0.5, tangential_over_normal = 0.1, 0.4, nu = 0.3, work_of_adhesion = 0.2 /\n")
        interface = {"friction": 0.5, "tangential_over_normal": [0.1, 0.4], "nu": 0.3, "work_of_adhesion": 0.2}
        results = wc.solve(wc.wave_1d(), pbar_over_pstar=[0.1, 0.6], interface=interface)
        for name in "interface", "partial_slip":
            self.assert_same_rows(f"line.{name}.dat", results.table(name))
        # The last block is that of the load alone.
        self.assertEqual(["stable", "stable_by_approach"], results[0].table("adhesion")["point"][-2:].tolist())
        self.assertEqual("full_contact", results[1].table("adhesion")["point"][-1])
        # The curve, which is that of all loads, stands once; the loads behind it as in the file.
        self.assert_same_rows("line.adhesion.dat", results.table("adhesion"))
        lines = results[0].table("adhesion_lines")
        self.assertAlmostEqual(0.1, lines["pbar_over_pstar"][0], 9)
        # Next to the edge there is tension.
        self.assertLess(lines["pressure"].min(), -0.1)
        with self.assertRaisesRegex(ValueError, "needs a group &interface in the deck with slip_loop"):
            results.table("slip_loop")

    def test_fields_are_those_of_the_map(self):
        results = self.solve_rough()
        for one in results:
            rows = one.table("map").reshape(one.pressure.shape)
            for field in "pressure", "gap", "displacement":
                self.assertTrue(numpy.array_equal(rows[field], getattr(one, field)))
                # At points they are sums of the same terms in another order.
                at = one.fields_at(*numpy.meshgrid(one.x, one.y))[field]
                self.assertLess(abs(at - rows[field]).max(), 1e-12*abs(rows[field]).max())
            self.assertLess(abs(rows["x"] - one.x).max(), DIGITS)
            self.assertLess(abs(rows["y"] - one.y[:, None]).max(), DIGITS)
        self.assertEqual((), results[1].fields_at(0, 0)["gap"].shape)
        line = results[1].table("stress_planes")[::97]
        stresses = results[1].stresses_at(line["x"], line["y"], line["depth"])   # nu is that of &stress
        one = wc.solve(wc.wave_1d(), e1=2, nu1=0.3, pbar_over_pstar=0.2)[0]
        numpy.testing.assert_array_equal(*(one.stresses_at(0, 0, 0.1, *nu)["stress"] for nu in ([], [0.3])))
        for column, values in zip(("stress_xx", "von_mises", "largest_shear"),
                                  (stresses["stress"][:, 0], stresses["von_mises"], stresses["largest_shear"])):
            self.assertLess(abs(values - line[column]).max(), 1e-10*abs(line[column]).max())

    def test_keys_that_are_set(self):
        self.run_deck("rough", None, "--set=surface.seed=5", "--set=load.mean_gap=1e-3,2e-3", "--set=scene.case=set")
        results = wc.run("rough.nml", {"surface.seed": 5, "load.mean_gap": [1e-3, 2e-3]})
        self.assert_same_rows("set.summary.dat", results.table())
        self.assertEqual([1, 2], results.load.tolist())

    def test_heights_are_those_of_the_file(self):
        rng = numpy.random.default_rng(1)
        for shape in (24, 32), (40,):
            h = rng.normal(size=shape)
            h[..., 3] = numpy.nan
            numpy.save("h.npy", h)
            self.run_deck("h", "&surface kind = 'file', file = 'h.npy', length_x = 2, length_y = 1, fill_missing = "
                          "'harmonic', edges = 'mirror' /\n&load mean_pressure = 0.1 /\n")
            options = {"length_x": 2, "length_y": 1, "fill_missing": "harmonic", "edges": "mirror"}
            for same in h, numpy.asfortranarray(h), numpy.ma.masked_invalid(h), numpy.repeat(h, 2, -1)[..., ::2], \
                    h[..., ::-1][..., ::-1]:
                results = wc.solve(wc.heights(same, **options), mean_pressure=0.1, keep_fields=False)
                self.assert_same_rows("h.summary.dat", results.table())
            self.assertEqual(h.shape if h.ndim == 2 else (1, 40), wc.solve(wc.heights(h, **options),
                                                                           mean_pressure=0.1)[0].gap.shape)
        # Single precision and integers are numbers too.
        whole = rng.integers(-9, 9, size=(16, 16))
        areas = {wc.solve(wc.heights(whole.astype(kind)), pbar_over_pstar=0.2)[0].contact_area
                 for kind in (float, "f4", ">f8", "i2", int)}
        self.assertEqual(1, len(areas))

    def test_a_column_is_a_profile(self):
        h = numpy.random.default_rng(1).normal(size=40)
        h[3] = numpy.nan
        pressures = []
        for shape in (40,), (1, 40), (40, 1):
            one = wc.solve(wc.heights(h.reshape(shape), length_x=2, fill_missing="harmonic"), pbar_over_pstar=0.2)[0]
            self.assertEqual((1, 40), one.pressure.shape)
            pressures.append(one.pressure.tolist())
        self.assertEqual(pressures[:1]*3, pressures)

    def test_a_profile_at_its_places(self):
        """As the program reads it from a file, and at equal steps as without places."""
        x = numpy.cumsum(1 + 0.5*numpy.sin(numpy.arange(60)**2))
        z = numpy.cos(2*numpy.pi*x/x[-1]) + 0.1*x
        numpy.savetxt("xz.txt", numpy.column_stack([x, z]), fmt="%.17g")
        keys = {"detrend": "plane", "edges": "mirror"}
        expected = wc.file(file="xz.txt", **keys).prepared()
        for places, heights in (x, z), (x[::-1], z[::-1, None]):
            found = wc.heights(heights, x=places, length_unit="um", **keys)
            numpy.testing.assert_array_equal(expected.heights, found.heights)
            self.assertEqual({**expected.keys, "unit": "um"}, {**found.keys, "unit": found.length_unit})
        even = wc.heights(z, x=numpy.arange(60)/20)
        self.assertAlmostEqual(3, even.length_x)
        numpy.testing.assert_allclose(even.heights[0] - even.heights[0, 0], z - z[0], atol=1e-14)
        self.refuse("^x:3: x = 2 after 3: from line to line x must rise", wc.heights, [1, 2, 1.0, 3], x=[1, 3, 2, 4])
        self.refuse("x must have the places of all points of a profile, got .3,. for .1, 4.", wc.heights, [1, 2, 1, 3],
                    x=[1, 2, 3])
        self.refuse("x must have the places", wc.heights, numpy.eye(4), x=[1, 2, 3, 4])

    def test_files_that_need_no_other_package(self):
        h = numpy.random.default_rng(1).normal(size=(12, 16))
        numpy.save("map.npy", h)
        surface = wc.read("map.npy", length_x=4, length_unit="um")
        self.assertTrue(numpy.array_equal(h, surface.heights))
        self.assertEqual("um", wc.solve(surface, pbar_over_pstar=0).length_unit)
        with open("map.gsf", "wb") as file:
            files.write_gsf(file, h, {"length_x": 4e-6, "length_y": 3e-6}, "m")
        gap = wc.solve(wc.heights(h, length_x=4, length_y=3), pbar_over_pstar=0)[0].gap
        for surface in wc.read("map.gsf", channel=0), wc.read("map.gsf", length_unit="um"):
            results = wc.solve(surface, pbar_over_pstar=0)
            factor = {"m": 1, "um": 1e6}[results.length_unit]
            self.assertAlmostEqual(4e-6*factor, results.length_x, delta=1e-12*factor)
            numpy.testing.assert_allclose(results[0].gap, gap*factor, atol=4e-7*factor*numpy.abs(h).max())
        # Heights of a file that the program reads are those that it solves; its deck still names the file.
        surface = wc.read("map.gsf", length_unit="um", detrend="plane")
        numpy.testing.assert_allclose(surface.heights, surface.prepared().heights, rtol=0)
        numpy.testing.assert_allclose(wc.file(file="map.gsf").heights, h - h.mean(), atol=2e-7)
        self.assertIn("map.gsf", wc.solve(surface, pbar_over_pstar=0).deck)
        self.refuse("results.surface has the heights of others", lambda: wc.wave_2d().heights)
        self.refuse("no channel 'Height'", wc.read, "map.gsf", "Height")
        for name in "empty.gsf", "empty.npy", "empty.txt":
            pathlib.Path(name).touch()
            self.refuse(f"{name}: the file is empty", wc.solve, wc.file(file=name), pbar_over_pstar=0)
        self.refuse("leave out length_x", wc.read, "map.gsf", length_x=1)
        # What numpy says has the name of the file.
        pathlib.Path("cut.npy").write_bytes(pathlib.Path("map.npy").read_bytes()[:300])
        numpy.save("objects.npy", numpy.array([[1, None]], dtype=object))
        for name in "cut.npy", "objects.npy":
            self.refuse(f"^{name}: ", wc.read, name)
            with self.assertRaisesRegex(SystemExit, f"^wavycon-convert: {name}: "):
                convert([name, "map.gsf"])
        with self.assertRaisesRegex(SystemExit, "map.gsf: decks read this file as it is"):
            convert(["map.gsf", "other.npy"])

    def test_grids_of_esri(self):
        """The program reads them: they have steps, and their first row is that of the largest y."""
        h = numpy.random.default_rng(1).normal(size=(12, 16))
        numpy.savetxt("map.asc", h, header="NCOLS 16\nNROWS 12\nXLLCORNER 0\nYLLCORNER 0\nCELLSIZE 0.5", comments="")
        results = wc.solve(wc.read("map.asc"), pbar_over_pstar=0)
        self.assertEqual((8, 6), (results.length_x, results.length_y))
        expected = wc.solve(wc.heights(h[::-1], length_x=8), pbar_over_pstar=0)[0].gap
        numpy.testing.assert_allclose(results[0].gap, expected, atol=1e-12)
        with self.assertRaisesRegex(SystemExit, "decks read this file as it is"):
            convert(["map.asc", "map.npy"])

    def test_decimal_commas(self):
        """The program reads them; SurfaceTopography takes them for separators, here for x, y and z of a map."""
        heights = numpy.sin(numpy.arange(100.0))
        lines = "".join(f"{x}\t{z:.4f}\n".replace(".", ",") for x, z in enumerate(heights))
        pathlib.Path("stylus.txt").write_text("stylus 2 um\nx [mm]\tz [um]\n" + lines)
        results = wc.solve(wc.read("stylus.txt", height_scale=1e-3, length_unit="mm"), pbar_over_pstar=0)
        self.assertEqual((100, "mm"), (results.length_x, results.length_unit))
        numpy.testing.assert_allclose(results[0].gap.ravel(), 1e-3*(heights.max() - heights), atol=2e-7)

    def test_gsf_keeps_heights_beside_a_large_mean(self):
        h = numpy.random.default_rng(1).uniform(size=(12, 16))
        h[2, 3] = numpy.nan
        with open("map.gsf", "wb") as file:
            files.write_gsf(file, h + 1e5, {"length_x": 4, "length_y": 3}, None)
        found, expected = (wc.solve(surface, pbar_over_pstar=0)[0].gap for surface in
                           (wc.read("map.gsf", fill_missing="harmonic"),
                            wc.heights(h, length_x=4, length_y=3, fill_missing="harmonic")))
        # Of float32, and of 1e5 in double precision.
        numpy.testing.assert_allclose(found, expected, atol=2e-7)

    def test_saved_results(self):
        results = self.solve_rough()
        results.table("spots")
        results.save("rough.npz")
        again = wc.load("rough.npz")
        self.assertEqual(repr(results), repr(again))
        self.assertTrue(numpy.array_equal(results.table("spots"), again.table("spots")))
        self.assertTrue(numpy.array_equal(results[2].gap, again[2].gap))
        self.assertEqual(results.deck, again.deck)
        self.refuse("was not saved", again.table, "contours")
        self.refuse("was not saved", again[0].fields_at, 0, 0)
        # No loads: the columns are there, and the spectrum.
        results[:0].save("none.npz")
        none = wc.load("none.npz")
        self.assertEqual((0, results.table().dtype), (len(none), none.table().dtype))
        self.assertEqual((0,), none.mean_gap.shape)
        self.assertIn("mean_gap", none)
        self.assertEqual(list(results.to_dataframe()), list(none.to_dataframe()))
        none[:0].save("none.npz", fields=False)
        self.assertEqual(0, len(wc.load("none.npz").table()))

    def test_what_the_deck_asks_for_is_saved(self):
        options = {"pbar_over_pstar": [0.1, 0.2], "output": {"spots": True, "height": True}}
        results = wc.solve(wc.self_affine(rms_slope=0.1, points=32, short_wavelength=0.125), **options)
        copied = copy.deepcopy(results)
        results.save("asked.npz")
        for one in copied, wc.load("asked.npz"):
            self.assertEqual(2, len(one.to_dataframe("spots")))
            self.assertEqual((32, 32), one.surface.heights.shape)
        wc.solve(wc.wave_2d(), pbar_over_pstar=0.1, keep_fields=False).save("bare.npz")
        bare = wc.load("bare.npz")
        self.assertEqual("fitted", bare[0].solver)
        self.refuse("'fields' was not saved", lambda: bare[0].pressure)

    def test_decks_have_the_names_of_their_files(self):
        self.assertNotRegex(wc.solve(wc.wave_1d(), pbar_over_pstar=0.1).deck, "case = |directory = ")

    def test_adhesion_is_told(self):
        with self.assertWarnsRegex(wc.Note, "are those without adhesion; the table adhesion has"):
            results = wc.solve(wc.wave_1d(), pbar_over_pstar=0.1, interface={"work_of_adhesion": 0.01})
        self.assertIn("adhesion", results.notes[0])

    def test_chosen_results_are_saved_in_their_order(self):
        results = wc.run("rough.nml")
        for chosen in results[::-1], results[[0, 0, 2]], results[1:]:
            chosen.save("chosen.npz")
            again = wc.load("chosen.npz")
            for name in "load", "mean_pressure", "contact_area":
                numpy.testing.assert_array_equal(chosen[name], again[name])
            self.assertEqual(results.surface.rms_slope, again[::-1].surface.rms_slope)
            for one, other in zip(chosen, again):
                numpy.testing.assert_array_equal(one.pressure, other.pressure)

    def test_saved_results_replace_results_alone(self):
        results = wc.solve(wc.wave_1d(), pbar_over_pstar=0.5)
        results.save("run", fields=False)
        results.save("run.npz", fields=False)
        os.symlink("run.npz", "link.npz")
        results.save("link.npz", fields=False)
        self.assertTrue(os.path.islink("link.npz"))
        before = (self.folder/"run.npz").read_bytes()
        (self.folder/"deck.npz").write_text("&surface kind = 'wave_1d' /")
        self.refuse("is not replaced", results.save, "deck.npz", error=OSError)
        self.assertEqual("&surface kind = 'wave_1d' /", (self.folder/"deck.npz").read_text())
        # A file that cannot be finished leaves what was there.
        with unittest.mock.patch("numpy.savez", side_effect=OSError("full")):
            self.refuse("full", results.save, "run.npz", error=OSError)
        self.assertEqual(before, (self.folder/"run.npz").read_bytes())
        self.assertEqual([], list(self.folder.glob(".*.part")))
        buffer = io.BytesIO()
        results.save(buffer)
        buffer.seek(0)
        self.assertEqual(repr(results), repr(wc.load(buffer)))

    def test_frames_and_pictures(self):
        results = self.solve_rough()
        frame = results.to_dataframe()
        self.assertEqual("pressure", frame.attrs["units"]["mean_pressure"])
        self.assertEqual([1, 2, 3], frame.load.tolist())
        given = matplotlib.pyplot.subplots()[1]
        self.assertIs(given, results.plot(ax=given))
        self.assertEqual("mean pressure [p*]", given.get_xlabel())
        self.assertEqual("y [length]", results[1].plot_map("gap").get_ylabel())
        # A colour bar is as high as its map, and beside it.
        for points in (8, 64), (64, 8):
            h = numpy.random.default_rng(1).normal(size=points)
            ax = wc.solve(wc.heights(h, length_x=points[1]), pbar_over_pstar=0.1)[0].plot_map("gap")
            ax.figure.draw_without_rendering()
            drawn, bar = ax.get_window_extent(), ax.collections[0].colorbar.ax.get_window_extent()
            numpy.testing.assert_allclose((bar.y0, bar.y1), (drawn.y0, drawn.y1))
            self.assertLess(0.1*bar.width, bar.x0 - drawn.x1)
            self.assertLess(bar.x0 - drawn.x1, 0.1*max(drawn.width, drawn.height))
        self.assertEqual("depth [length]", results[1].plot_stress_section().get_ylabel())
        self.assertEqual(1, len(solve_small()[0].plot_map().lines))
        matplotlib.pyplot.close("all")


class Certify(PackageTest):
    @staticmethod
    def smooth_map(shape, **options):
        """Heights of a few slow waves that are not even."""
        y, x = numpy.mgrid[:shape[0], :shape[1]]/numpy.reshape(shape, (2, 1, 1))
        h = numpy.cos(2*numpy.pi*(x - 0.1)) + 0.7*numpy.sin(2*numpy.pi*(2*x + (y if shape[0] > 1 else 0)) + 0.4)
        return wc.heights(h, length_x=2, length_y=3, **options)

    def solve_one(self, surface, **options):
        one = wc.solve(surface, output={"bounds": True}, **options)[0]
        return one, wc.certify(surface, one.pressure, one.gap, **options)

    def test_a_solution_has_the_bounds_of_its_table(self):
        rough = wc.self_affine(rms_slope=0.1, points=64, short_wavelength=0.25, seed=3)
        for surface, area, mean_pressure in ((rough, 1, 0.01), (self.smooth_map((32, 48)), 6, 0.5),
                                             (self.smooth_map((27, 33)), 6, 0.5), (self.smooth_map((1, 65)), 2, 0.5),
                                             (self.smooth_map((32, 48), edges="mirror"), 6, 0.5),
                                             (self.smooth_map((1, 65), edges="mirror"), 2, 0.5)):
            with self.subTest(surface=surface):
                one, bounds = self.solve_one(surface, e_star=2, mean_pressure=mean_pressure, residual=1e-11)
                table = one.table("bounds")[0]
                own = mean_pressure*one.approach*area - one.elastic_energy, one.approach, one.mean_gap
                for name, (lower, upper), number in zip(bounds._fields, bounds, own):
                    self.assertTrue(lower < number < upper)
                    # Fields are converted to the deck's units and back.
                    self.assertLess(abs(lower - table[f"{name}_lower"]), 1e-12*upper)
                    self.assertLess(abs(upper - table[f"{name}_upper"]), 1e-12*upper)

    def test_bounds_of_a_ball(self):
        ball = wc.ball(radius=0.1)
        one = wc.solve(ball, force=1e-3)[0]
        self.refuse("periodic and mirrored surfaces only", wc.certify, ball, one)
        self.refuse("periodic and mirrored surfaces only", wc.certify, ball, one.pressure, one.gap, mean_pressure=1)

    def test_bounds_on_other_points(self):
        """A wave that is solved to 1e-8 by no grid. The width falls with nearly the cube of the points, in 1-D on
        average: there it depends on where the edge lies between two points."""
        for surface, shapes, area in ((wc.wave_2d(amplitude=0.3, wavelength=2), ((32, 32), (64, 64), (63, 90)), 4),
                                      (wc.wave_1d(amplitude=0.3, wavelength=2), ((1, 64), (1, 512)), 2)):
            load = {"e_star": 2, "mean_pressure": 0.1}
            widths = []
            for shape in shapes:
                one = wc.solve(surface, **load, accuracy=1e-8, output={"map_points": max(shape)})[0]
                step, pressure, gap = max(shape)//shape[1], one.pressure, one.gap
                if shape == (63, 90):
                    places = numpy.meshgrid(numpy.arange(90)/45, numpy.arange(63)/31.5)
                    pressure, gap = (one.fields_at(*places)[name] for name in ("pressure", "gap"))
                bounds = wc.certify(surface, pressure[:, ::step], gap[:, ::step], **load)
                own = 0.1*one.approach*area - one.elastic_energy, one.approach, one.mean_gap
                for (lower, upper), number in zip(bounds, own):
                    self.assertTrue(lower < number < upper)
                widths.append(bounds.energy[1] - bounds.energy[0])
            self.assertLess(widths[1], widths[0]*(shapes[0][1]/shapes[1][1])**2.5)

    def test_the_place_of_the_points(self):
        """Fields of grids begin half a step in. The bounds are those of the surface that is moved."""
        wave, load = wc.wave_2d(amplitude=1e-3), {"e_star": 1, "mean_pressure": 1e-3}
        one = wc.solve(wave, solver="grid", grid_points=64, **load)[0]
        self.assertAlmostEqual(0.5, one.x[0]*64)
        by_result = wc.certify(wave, one, **load)
        by_places = wc.certify(wave, one.pressure, one.gap, x=one.x.astype("f4"), y=one.y, **load)
        wide = wc.certify(wave, one.pressure, one.gap, **load)
        widths = [each.energy[1]/each.energy[0] - 1 for each in (by_result, by_places, wide)]
        self.assertLess(max(widths[:2]), 1e-4)
        self.assertGreater(widths[2], 1e-3)
        # A map of other points and its own, moved by a step.
        surface = self.smooth_map((24, 40))
        one = wc.solve(surface, **load)[0]
        expected = wc.certify(surface, one, **load)
        for steps in (1, 0), (0, 1), (-1, 1):
            p, g = (numpy.roll(field, -numpy.array(steps), (1, 0)) for field in (one.pressure, one.gap))
            found = wc.certify(surface, p, g, x=one.x + steps[0]/20, y=one.y + steps[1]/8, **load)
            numpy.testing.assert_allclose(found, expected, rtol=1e-10)
        for shape, name in ((24, 40), "y"), ((1, 65), "x"):
            mirrored = self.smooth_map(shape, edges="mirror")
            one = wc.solve(mirrored, **load)[0]
            places = {"x": one.x, "y": one.y}
            self.assertEqual(wc.certify(mirrored, one.pressure, one.gap, **load), wc.certify(mirrored, one, **load))
            self.refuse("half a step from its borders", wc.certify, mirrored, one.pressure, one.gap, **load,
                        **{**places, name: places[name] - places[name][0]})
        for words, x in {"x must be 40 places": one.x, "equal steps over the whole side 2":
                         numpy.linspace(0, 2, 40), "at most a step": numpy.arange(40)/20 - 1}.items():
            self.refuse(words, wc.certify, surface, p, g, x=x, **load)

    def test_a_load_without_conversion(self):
        """By its load over p*, and by a result alone, also a saved one, whose title names the group."""
        wave = wc.wave_2d(amplitude=1e-6, wavelength=1e-3)
        for material in ({"e_star": 2e11}, {"e1": 2e11, "nu1": 0.3, "hardness": 1e10},
                         {"e1": 2e11, "nu1": 0.3, "layer_thickness": 1e-3, "layer_base": "bonded"}):
            results = wc.solve(wave, title="&material e_star = 1", mean_pressure=[1e7, 1e8], **material)
            results.save("run.npz")
            for one in results[0], wc.load("run.npz")[0]:
                expected = wc.certify(wave, one, mean_pressure=1e7, **material)
                ratio = wc.certify(wave, one.pressure, one.gap, x=one.x, y=one.y, pbar_over_pstar=one.pbar_over_pstar,
                                   **material)
                for found in wc.certify(wave, one), wc.certify(wave, one, **material), ratio:
                    numpy.testing.assert_allclose(found, expected, rtol=1e-12)

    def test_what_is_wrong_is_wide(self):
        load = {"e_star": 2, "mean_pressure": 0.5, "residual": 1e-11}
        for edges in "periodic", "mirror":
            surface = self.smooth_map((64, 64), edges=edges)
            one, right = self.solve_one(surface, **load)

            def widening(pressure, gap):
                bounds = wc.certify(surface, pressure, gap, **load)
                own = 0.5*one.approach*6 - one.elastic_energy
                self.assertTrue(bounds.energy[0] < own < bounds.energy[1])
                return (bounds.energy[1] - bounds.energy[0])/(right.energy[1] - right.energy[0])

            # The mean is given: a factor of all pressures changes nothing.
            self.assertAlmostEqual(1, widening(1.01*one.pressure, one.gap), delta=1e-9)
            left, hole, double, moved = one.pressure.copy(), one.gap.copy(), one.gap.copy(), one.pressure.copy()
            left[:, :32] *= 1.1
            row, column = numpy.unravel_index(one.gap.argmax(), one.gap.shape)
            hole[row, column] = 0
            double[row, column] *= 2
            moved[row, column], moved[numpy.unravel_index(one.pressure.argmax(), moved.shape)] = one.pressure.max(), 0
            for wrong in (left, one.gap), (one.pressure, hole), (one.pressure, double), (moved, one.gap), \
                    (one.pressure*0 + 1, one.gap), (one.pressure, one.gap*0), (one.pressure[::-1], one.gap):
                self.assertGreater(widening(*wrong), 1.2)
            self.assertGreater(widening(one.pressure, hole), 2)
            # No number is too large or too small.
            for factor in 1e300, 1e-300:
                self.assertAlmostEqual(1, widening(factor*one.pressure, one.gap), delta=1e-9)
                self.assertGreater(widening(one.pressure, factor*one.gap), 2)

    def test_a_hardness(self):
        load = {"e_star": 2, "mean_pressure": 0.5, "hardness": 1.5}
        one, bounds = self.solve_one(self.smooth_map((64, 64)), **load)
        self.assertAlmostEqual(1.5, one.peak_pressure, delta=1e-9)
        table = one.table("bounds")[0]
        self.assertAlmostEqual(table["energy_upper"], bounds.energy[1], delta=1e-12)
        # Without the overlap the lower bound is lower.
        self.assertLess(bounds.energy[0], table["energy_lower"])
        self.assertEqual([False, True, True, True], numpy.isnan([*bounds.approach, *bounds.mean_gap]).tolist())
        self.refuse("below the hardness", wc.certify, self.smooth_map((64, 64)), one.pressure, one.gap,
                    **{**load, "mean_pressure": 1.5})

    def test_misuse(self):
        surface, p = self.smooth_map((8, 12)), numpy.ones((8, 12))
        nan = numpy.where(numpy.arange(12) == 5, numpy.nan, p)

        def refuse(words, pressure=p, gap=p, surface=surface, mean_pressure=1, **options):
            self.refuse(words, wc.certify, surface, pressure, gap, mean_pressure=mean_pressure, **options)

        refuse("must have one shape.*8, 12.*12, 8", gap=p.T)
        refuse("must have one shape", p[None], p[None])
        refuse("array of real numbers", p*1j)
        refuse("must be finite", nan)
        refuse("must be finite", gap=-numpy.inf*p)
        refuse("must be finite", gap=numpy.ma.masked_array(p, p > 0))
        refuse("no pressure is above 0", -p)
        refuse("at least 12 points along x and 8 along y", p[:, :11], p[:, :11])
        refuse("at least 12 points along x and 8 along y", p[:7], p[:7], self.smooth_map((8, 12), edges="mirror"))
        refuse("above 0 and below the hardness", mean_pressure=0)
        refuse("nan", mean_pressure=numpy.nan)
        refuse("must be one number", mean_pressure=[1, 2])
        refuse("must be one number", mean_pressure=None)
        refuse("must be one number", mean_pressure="1")
        refuse("give pressure and gap, or one load", gap=None)
        refuse("hardness", mean_pressure=1, hardness=1)
        refuse("free edges", surface=self.smooth_map((8, 12), edges="free"))
        refuse("flat", surface=wc.heights(p))
        refuse("1 point along y", surface=wc.wave_1d())
        refuse("must be a surface", surface=p)
        refuse("did you mean 'e_star'", e_sta=1)
        refuse("contradict each other", pbar_over_pstar=1)
        refuse("must be one number", mean_pressure=None, pbar_over_pstar=[1])


class Sweeps(PackageTest):
    def test_a_sweep(self):
        frame = wc.sweep("rough.nml", {"surface.seed": range(1, 4), "load.pbar_over_pstar": [0.1, [0.2, 0.3], -1]}, 2,
                         "tables")
        self.assertEqual(3*(1 + 2 + 1), len(frame))
        failed = frame[frame.status == "failed"]
        self.assertEqual([1, 2, 3], failed["surface.seed"].tolist())
        self.assertTrue(failed.message.str.contains("is a tension").all())
        maps = [wc.heights(numpy.where(numpy.arange(64).reshape(8, 8) == 9, numpy.nan, 0.0))]
        self.refuse("^all runs failed; the first one: heights0.npy: 1 of 64 heights are missing", wc.sweep, maps,
                    pbar_over_pstar=0.1)
        self.refuse("all runs failed; .*&load", wc.sweep, wc.wave_1d(), {"material.e_star": [1, 2]})
        one = wc.run("rough.nml", {"surface.seed": 2, "load.pbar_over_pstar": [0.2, 0.3]})
        rows = frame[(frame["surface.seed"] == 2) & (frame["load.pbar_over_pstar"].map(str) == "[0.2, 0.3]")]
        for column in "mean_gap", "contact_area", "peak_pressure":
            self.assertLess(abs(rows[column].to_numpy()/getattr(one, column) - 1).max(), DIGITS)
        self.assertEqual(6, len(list(pathlib.Path("tables").glob("*.summary.dat"))))
        self.refuse("no run", wc.sweep, "rough.nml", {"surface.seed": []})
        self.refuse("there is no such file", wc.sweep, "none.nml")


class Notes(PackageTest):
    def warned(self, function, *arguments, **options):
        """The result, and the texts of the notes, all of which point at the line of this call."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = function(*arguments, **options)
        for one in caught:
            self.assertIs(wc.Note, one.category)
            self.assertEqual(__file__, one.filename)
        return result, [str(one.message) for one in caught]

    def notes_of_the_program(self, *options):
        log = subprocess.run([self.program, "noted.nml", "--output", "noted", *options], cwd=self.folder, check=False,
                             capture_output=True, text=True).stdout
        return re.findall("^note: (.*)", log, re.MULTILINE)

    def test_notes_are_those_of_the_program(self):
        heights = numpy.random.default_rng(1).normal(size=(16, 16)) + numpy.arange(16)*3
        numpy.savetxt("map.dat", heights*1e-9, fmt="%.17g")
        deck = """&scene length_unit = 'um' / &surface kind = 'file', file = 'map.dat' /
                  &load contact_area_fraction = 1e-6, 0.2, 2e-6 / """
        (self.folder/"noted.nml").write_text(deck)
        results, notes = self.warned(wc.run, "noted.nml")
        self.assertEqual(self.notes_of_the_program(), notes)
        self.assertEqual(notes, results.notes)
        for words in "slopes of the surface are", "along x the last heights differ", "2 of 3 contact areas are below":
            self.assertTrue(any(words in note for note in notes), words)
        solved, notes = self.warned(wc.solve, wc.heights(heights*1e-9), contact_area_fraction=[1e-6, 0.2, 2e-6],
                                    length_unit="um")
        self.assertEqual(results.notes, notes)
        solved.save("noted.npz")
        self.assertEqual((notes, []), (solved.notes, self.warned(wc.load, "noted.npz")[1]))
        self.assertEqual(notes, wc.load("noted.npz").notes)

    def test_a_map_that_is_filled(self):
        h = numpy.random.default_rng(1).normal(size=(32, 32))
        notes = []
        for missing in 2, 16:
            h[:, :missing] = numpy.nan
            results, found = self.warned(wc.solve, wc.heights(h, fill_missing="harmonic", edges="mirror"), pbar_over_pstar=0.1)
            self.assertEqual(results.notes, found)
            notes.append([note for note in found if "are missing and filled" in note])
        self.assertEqual([0, 1], [len(found) for found in notes])
        self.assertIn("50 % of the heights are missing and filled", notes[1][0])

    def test_other_words_for_units(self):
        for unit, words in {"megapascal": "'MPa'", "N/mm2": "'N/mm^2'", "MPa": "", "N/mm^2": "", "psi": ""}.items():
            results, notes = self.warned(wc.solve, wc.wave_2d(amplitude=1e-3), e_star=1, mean_pressure=1e-4,
                                         pressure_unit=unit, length_unit="mm")
            self.assertEqual([f"pressure_unit = '{unit}' is no unit that is known: it is shown as it is, and nothing is "
                              f"converted to it. Did you mean {words}?"]*bool(words), notes)
            self.assertEqual("N" if unit in ("MPa", "N/mm^2") else f"{unit}*mm^2", results.units["force"])
        self.assertIn("length_unit = 'micrometer' is no unit", self.warned(
            wc.solve, wc.wave_2d(amplitude=1e-3), pbar_over_pstar=0.1, length_unit="micrometer")[1][0])

    def test_what_has_nothing_to_note(self):
        results, notes = self.warned(wc.solve, wc.wave_2d(), pbar_over_pstar=[0.1, 0.5])
        self.assertEqual(([], []), (results.notes, notes))

    def test_the_series_and_the_tables(self):
        results, notes = self.warned(wc.solve, wc.wave_2d(), pbar_over_pstar=[0.9, 0.5], solver="beale")
        self.assertEqual(2, len(notes))
        self.assertIn("at 1 of 2 loads the mean gap is below 0", notes[1])
        slip = {"friction": 0.1, "tangential_over_normal": [0.05, 0.1]}
        unlike = {"e1": 1, "nu1": 0.3, "e2": 20, "nu2": 0.2}
        results, notes = self.warned(wc.solve, wc.wave_2d(amplitude=0.01), pbar_over_pstar=[0.3, 0.5], interface=slip,
                                     **unlike)
        self.assertEqual([], notes)
        frame, notes = self.warned(results.to_dataframe, "partial_slip")
        self.assertEqual(1, len(notes))
        self.assertIn("partial slip neglects the coupling", notes[0])
        self.assertEqual(notes, results.notes)

    def test_tables_of_one_load_count_no_loads(self):
        """The package asks for the table load by load."""
        results = wc.solve(wc.wave_2d(), pbar_over_pstar=[3e-3, 2e-3, 1e-3], solver="grid", grid_points=64, stress={"nu": 0})
        results.table("stress_largest")
        self.assertEqual(["the error of the largest stress is more than half of it: give a better accuracy, or more "
                          "grid_points"], [note for note in results.notes if "largest stress" in note])

    def test_a_sweep(self):
        (self.folder/"noted.nml").write_text("&surface kind = 'wave_2d' / &load pbar_over_pstar = 0.5 /")
        frame = wc.sweep("noted.nml", {"method.solver": ["auto", "beale"]})
        self.assertEqual(["", *self.notes_of_the_program("--set", "method.solver=beale")], frame.message.tolist())


class Misuse(PackageTest):
    def test_units(self):
        h = numpy.random.default_rng(1).normal(size=(16, 16))
        surface = wc.heights(h, length_x=4, length_unit="um")
        self.refuse("lengths of this surface are in um", wc.solve, surface, pbar_over_pstar=0.1, length_unit="m")
        self.refuse("are in um", wc.solve, surface, pbar_over_pstar=0.1, scene={"length_unit": "mm"})
        for unit in None, "um":
            self.assertEqual("um", wc.solve(surface, pbar_over_pstar=0, length_unit=unit).length_unit)
        self.assertEqual("m", wc.solve(wc.heights(h), pbar_over_pstar=0, length_unit="m").length_unit)

    def test_a_broken_reader(self):
        reader = self.folder/"broken"/"SurfaceTopography.py"
        reader.parent.mkdir()
        (reader.parent/"map.opd").write_bytes(bytes(8))
        code = f"""import sys; sys.path[:0] = [{os.path.dirname(wc.__path__[0])!r}, {str(reader.parent)!r}]
import wavycon
try: wavycon.read({str(reader.parent/"map.opd")!r})
except ImportError as error: print(error)"""
        for text, words in ("import a_package_that_is_not_there", "is installed, but cannot be imported: No module named"
                            " 'a_package"), ("from os import none", "is installed, but cannot be imported: cannot import"):
            reader.write_text(text)
            printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
            self.assertIn(words, printed)

    def test_surfaces(self):
        for bad in [["a", "b"]], [[1j]], object(), [None], numpy.array(["2020"], dtype="M8"):
            self.refuse("real numbers", wc.heights, bad)
        for bad in 1.0, [], numpy.zeros((2, 3, 4)), numpy.zeros((0, 3)):
            self.refuse("shape", wc.heights, bad)
        ragged = [[1, 2], [3]]
        self.refuse("", wc.heights, ragged)
        for words, surface in {"3 to 1048576": wc.heights(numpy.zeros((2, 2))),
                               "missing": wc.heights([[1.0, numpy.nan]*4]*4),
                               "heights are up to Infinity in size": wc.heights([[1.0, numpy.inf]*4]*4),
                               "must be": wc.wave_2d(amplitude="x"), "length_x": wc.heights(numpy.eye(8), length_x=-1),
                               "there is no such file": wc.file(file="none.txt"), "kind": wc.Surface({})}.items():
            self.refuse(words, wc.solve, surface, pbar_over_pstar=0.1, error=(ValueError, OSError))
        numpy.save("h.npy", numpy.eye(8))
        for make, first in (wc.wave_2d, []), (wc.heights, [numpy.eye(8)]), (wc.read, ["h.npy"]):
            self.refuse("there is no key 'lengt_x'", make, *first, lengt_x=1)
        self.refuse("heights takes an array, got 'scan.csv': wavycon.read takes a file", wc.heights, "scan.csv")
        self.refuse("a file is needed, got ndarray: wavycon.heights takes an array", wc.read, numpy.eye(8))
        self.refuse("array.astype.float. may", wc.heights, pandas.DataFrame({"h": [1, 2]}, dtype=object))
        with self.assertRaises(AttributeError):
            wc.wave_3d
        locked = numpy.eye(8)
        locked.flags.writeable = False
        self.assertEqual("no_load", wc.solve(wc.heights(locked), pbar_over_pstar=0)[0].status)
        h = numpy.random.default_rng(1).normal(size=(16, 16))
        surface = wc.heights(h)
        first = wc.solve(surface, pbar_over_pstar=0.2)[0].contact_area
        h[:] = 0   # the surface has a copy
        self.assertEqual(first, wc.solve(surface, pbar_over_pstar=0.2)[0].contact_area)

    def test_arrays_of_other_packages(self):
        """Order in memory, type and owner of heights do not matter; of xarray's axes the names count."""
        h = numpy.round(numpy.random.default_rng(1).normal(size=(16, 12))*100)

        def area(heights):
            return wc.solve(wc.heights(heights, length_x=2, length_y=3), pbar_over_pstar=0.2)[0].contact_area

        expected = area(h)
        for same in (numpy.asfortranarray(h), numpy.repeat(h, 2, 1)[:, ::2], h.astype("i2"), h.astype(">f4"), h.tolist(),
                     numpy.ma.masked_array(h.astype("i2")), pandas.DataFrame(h), Named(h, "y", "x"), Named(h.T, "x", "y")):
            self.assertEqual(expected, area(same))
        # Coordinates have the sides, rising or falling, also of a profile; others are given.
        x, y = numpy.float32(0.1) + 0.25*numpy.arange(12, dtype="f4"), numpy.arange(16)[::-1]*2
        for same in Named(h, "y", "x", x=x, y=y), Named(h.T, "x", "y", x=x, y=y, z=1):
            surface = wc.heights(same)
            numpy.testing.assert_allclose((surface.length_x, surface.length_y), (3, 32), rtol=1e-6)
            self.assertEqual(7, wc.heights(same, length_x=7).length_x)
        for profile in Named(h[:, 0], "y", x=x[0], y=y), Named(h[:, :1], "y", "x", x=x[:1], y=y):
            self.assertEqual(32, wc.heights(profile).length_x)
        self.assertEqual({"kind", "file"}, set(wc.heights(Named(h, "y", "x", lat=y)).keys))
        uneven = Named(h, "y", "x", x=x**2)
        self.refuse("coordinates x do not have equal steps: .* or give length_x", wc.heights, uneven)
        self.assertEqual(3, wc.heights(uneven, length_x=3).length_x)

    def test_loads_of_any_kind(self):
        """`solve` of a surface and of a problem take the same kinds of lists."""
        loads = [0.1, 0.2]
        with wc.problem(wc.wave_1d()) as problem:
            for make in iter, set, tuple, numpy.array, pandas.Series, lambda values: Named(numpy.array(values), "load"):
                for solve in problem.solve, lambda **load: wc.solve(wc.wave_1d(), **load):
                    self.assertEqual(loads, sorted(solve(pbar_over_pstar=make(loads)).pbar_over_pstar))
            for bad in True, None, [], iter([]), "0.1", {}, [[0.1]], numpy.ma.masked_array(loads, [False, True]):
                self.refuse("pbar_over_pstar", problem.solve, pbar_over_pstar=bad)
            for bad in loads, iter(loads), set(loads):
                self.refuse("find needs one value", problem.find, mean_gap=bad)
            found = problem.find(pbar_over_pstar=numpy.array([0.1]))   # as root of scipy gives its variable
            self.assertAlmostEqual(0.1, found.pbar_over_pstar)
            self.refuse("give the loads by one of pbar", problem.solve, sweep_from=0.1)
            self.refuse(", and accuracy to wavycon.problem", problem.find, mean_gap=0.5, accuracy=1e-3)
            for copied in pickle.dumps, copy.deepcopy:
                self.refuse("cannot be copied or pickled: make a problem in each", copied, problem, error=TypeError)

    def test_solve(self):
        wave = wc.wave_2d()
        self.assertEqual("converged", wc.solve(wave, pbar_over_pstar=0.1, keep_fields=numpy.bool_(False))[0].status)
        self.refuse("got str; run takes the file of a deck", wc.solve, "wave_2d", pbar_over_pstar=0.1)
        self.refuse("'amplitude' is a key of surfaces", wc.solve, wave, pbar_over_pstar=0.1, amplitude=2)
        self.refuse("e_star must be a number, .* got None", wc.solve, wave, pbar_over_pstar=0.1,
                    e_star=numpy.ma.masked_array(1, True))
        self.refuse("must be a surface", wc.solve, numpy.eye(8), pbar_over_pstar=0.1)
        self.refuse("there is no load", wc.solve, wave)
        self.refuse("did you mean 'mean_pressure'", wc.solve, wave, mean_presure=1)
        self.refuse("did you mean", wc.solve, wave, pbar_over_pstar=0.1, method={"solvr": "grid"})
        self.refuse("one of|only one|several|and", wc.solve, wave, pbar_over_pstar=0.1, mean_gap=0.1)
        for bad in -1, numpy.nan, numpy.inf, "a", [], [[1]], {}, 1j, b"1", [0.1, None], True:
            self.refuse("", wc.solve, wave, pbar_over_pstar=bad)
        self.refuse("control characters", wc.solve, wave, pbar_over_pstar=0.1, title="a\n/ &load mean_gap = 1 /")
        self.refuse("control characters", wc.solve, wave, pbar_over_pstar=0.1, title="a\0b")
        (self.folder/"cut.nml").write_text("&surface kind = 'wave_1d' / &load pbar_over_pstar = 0.1 /")
        self.refuse("null character", wc.run, "cut.nml\0b")
        self.refuse("null character", wc.solve(wave, pbar_over_pstar=0.1)[0].table, "spots\0b")
        self.assertIn("it''s 'µ'".replace("''", "'"), wc.solve(wave, pbar_over_pstar=0.1, title="it's 'µ'").deck
                      .replace("''", "'"))
        for number in numpy.float32(0.25), numpy.int64(0), 1, range(2), (0.1, numpy.float64(0.2)), numpy.array(0.25), \
                numpy.array([0.5, 0.25])[::-1]:
            self.assertLess(max(wc.solve(wave, pbar_over_pstar=number).status_code), 10)
        self.assertEqual("above_hardness", wc.solve(wave, mean_pressure=2, hardness=1)[0].status)

    def test_results(self):
        results = solve_small()
        one = results[0]
        for thing in one, results:
            with self.assertRaises(AttributeError):
                thing.contact_aera
        with self.assertRaises(IndexError):
            results[1]
        self.refuse("to_dataframe.. takes lists of names", lambda: results[["mean_gap", "status"]], error=IndexError)
        self.refuse("'rms_slop'; did you mean 'rms_slope'", lambda: results.surface.rms_slop, error=AttributeError)
        self.refuse(": this is a directory", results.save, str(self.folder), error=IsADirectoryError)
        self.refuse("there is no table 'maps'", one.table, "maps")
        self.refuse("there is no table 'None'", one.table, None)
        self.refuse("got the text 'None'", one.stresses_at, 0, 0, 0, 0.3, None)
        self.refuse("nu must be one number", one.stresses_at, 0, 0, 0, [0.3, 0.2])
        self.refuse("needs a group &stress", one.table, "stress_line")
        self.refuse("needs a group &stress", one.plot_stress_section)
        self.refuse("finite", one.fields_at, numpy.nan, 0)
        self.refuse("real numbers", one.fields_at, "a", 0)
        self.refuse("shape", one.fields_at, [1, 2], [1, 2, 3])
        self.refuse("0 or more", one.stresses_at, 0, 0, -1, 0.3)
        self.refuse("nu", one.stresses_at, 0, 0, 0, 0.7)
        self.refuse("lateral", one.stresses_at, 0, 0, 0, 0.3, "tight")
        self.refuse("give nu", one.stresses_at, 0, 0, 0)
        self.assertEqual((2, 3, 6), one.stresses_at(numpy.zeros((2, 1)), 0, [0, 1, 2], 0.3)["stress"].shape)
        self.refuse("points must be", one.fields_at, [], [])
        without = wc.solve(wc.wave_1d(), pbar_over_pstar=0.5, keep_fields=False)[0]
        self.refuse("keep_fields is not set", lambda: without.pressure)
        self.refuse("keep_fields is not set", without.table, "contours")

    def test_decks(self):
        self.refuse("there is no such file", wc.run, "none.nml", error=OSError)
        self.refuse("there is no key 'sed'", wc.run, "rough.nml", {"surface.sed": 1})
        self.refuse("group.key=value", wc.run, "rough.nml", {"seed": 1})
        self.refuse("set must be a dictionary", wc.run, "rough.nml", ["surface.seed=1"])
        self.refuse("must be a surface, .* got NoneType", wc.sweep, None)
        self.refuse("number", wc.set_threads, 0)
        for bad in 2.5, "2", None:
            self.refuse("", wc.set_threads, bad, error=TypeError)
        numpy.save("h.npy", numpy.eye(8))
        numpy.savez("h.npz", h=numpy.eye(8))
        solve_small().save("cut.npz")
        with open("cut.npz", "r+b") as file:
            file.truncate(5000)
        open("empty.npz", "wb").close()
        for name in "rough.nml", "h.npy", "h.npz", "cut.npz", "empty.npz":
            self.refuse(f"{name}: this is no file that Results.save", wc.load, name)
        self.refuse("", wc.load, "none.npz", error=OSError)

    def test_memory(self):
        """The process does not grow with the number of solves."""
        def solve_some(number):
            for _ in range(number):
                one = wc.solve(wc.wave_2d(), pbar_over_pstar=0.5, keep_fields=False)[0]
                one.contact_area_fraction
        solve_some(20)
        resident = pages()
        solve_some(SOLVES)
        gc.collect()
        # A scene takes some 100 kB: none may stay.
        self.assertLess(pages() - resident, 2e6)


def pages():
    """Bytes of the process that are in memory; 0 where the system does not tell."""
    try:
        return int(pathlib.Path("/proc/self/statm").read_text().split()[1])*os.sysconf("SC_PAGESIZE")
    except OSError:
        return 0


class Processes(PackageTest):
    def test_a_program_in_c(self):
        """The package has what it needs."""
        folder = wc.get_include()
        self.assertTrue(os.path.isfile(os.path.join(folder, "wavycon.h")))
        compiler = shutil.which("cc")
        if not compiler or sys.platform == "win32":
            self.skipTest("no compiler")
        pathlib.Path("keys.c").write_text(C_PROGRAM)
        # In a build tree the library of the package is a link to one with a version in its name.
        of_library = next(pathlib.Path(folder).glob("libwavycon.*")).resolve().parent
        subprocess.run([compiler, "keys.c", f"-I{folder}", f"-L{folder}", "-lwavycon", f"-Wl,-rpath,{of_library}", "-o",
                        "keys"], check=True)
        printed = subprocess.run([self.folder/"keys"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(wc.__version__, printed)

    def test_threads(self):
        """Threads solve at the same time, to the digits of one, and share results."""
        surface = wc.self_affine(rms_height=1, points=128, short_wavelength=0.05)
        loads = [0.02*k for k in range(1, 9)]
        serial = [wc.solve(surface, pbar_over_pstar=load)[0] for load in loads]
        shared = wc.solve(surface, pbar_over_pstar=loads)
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            solved = list(pool.map(lambda load: wc.solve(surface, pbar_over_pstar=load)[0].contact_area, loads))
            peaks = list(pool.map(lambda one: one.pressure.max(), shared))
        self.assertEqual([one.contact_area for one in serial], solved)
        self.assertEqual([one.pressure.max() for one in shared], peaks)

    def test_threads_that_ask_for_tables(self):
        """A table that takes solutions of its own is not mixed with the loads of which other threads ask for tables."""
        shared = wc.solve(wc.wave_2d(), e_star=1, solver="grid", grid_points=128, mean_pressure=[0.5, 1], interface={
            "friction": 0.3, "nu": 0.3, "tangential_over_normal": [0.05, 0.1, 0.15, 0.2]})

        def table(load, name):
            shared[load]._tables.pop(name, None)   # so that it is made again
            return shared[load].table(name).tobytes()

        serial = table(0, "partial_slip"), table(1, "spots")
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            slip = pool.submit(lambda: {table(0, "partial_slip") for _ in range(3)})
            spots = {table(1, "spots")}
            while not slip.done():
                spots.add(table(1, "spots"))
        self.assertEqual(({serial[0]}, {serial[1]}), (slip.result(), spots))

    @unittest.skipUnless(hasattr(os, "fork"), "needs fork")
    def test_fork(self):
        """Objects made before a fork work in the child, also if other threads are in the library."""
        # No pipes: a child that hangs would keep them open.
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", FORKS], timeout=HANGING, check=False,
                              env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
        self.assertEqual(0, done.returncode)

    def test_ctrl_c(self):
        """Ctrl-C ends a solve within a second, and the interpreter goes on."""
        child = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True,
                                 env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
        self.assertEqual("started\n", child.stdout.readline())
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        sent = time.monotonic()
        self.assertEqual("stopped\n", child.stdout.readline())
        self.assertLess(time.monotonic() - sent, PATIENCE)
        self.assertEqual("usable\n", child.communicate()[0])
        self.assertEqual(0, child.returncode)


@unittest.skipUnless(importlib.util.find_spec("SurfaceTopography"), "needs SurfaceTopography")
class Files(PackageTest):
    def test_reading_and_converting(self):
        h = numpy.random.default_rng(1).normal(size=(12, 16))
        numpy.savetxt("scan.txt", h)
        surface = wc.read("scan.txt", length_x=4, length_unit="um")
        self.assertTrue(numpy.array_equal(h, surface.heights))
        self.assertEqual("um", wc.solve(surface, pbar_over_pstar=0.2).length_unit)
        self.refuse("are in um", wc.solve, surface, pbar_over_pstar=0.2, length_unit="m")
        numpy.savetxt("scan.txt", h, header="Width: 4 m\nHeight: 3 m\nValue units: m")
        for name in "scan.npy", "scan.gsf":
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                convert(["scan.txt", name])
            (self.folder/"converted.nml").write_text(printed.getvalue() + "&load pbar_over_pstar = 0.2 /")
            found = wc.run("converted.nml")[0].contact_area_fraction
            self.assertEqual(found, wc.solve(wc.read(name), pbar_over_pstar=0.2)[0].contact_area_fraction)
            # gsf has single precision.
            self.assertAlmostEqual(wc.solve(wc.heights(h), pbar_over_pstar=0.2)[0].contact_area_fraction, found,
                                   delta=0 if name == "scan.npy" else 1e-6)

    def test_heads_in_the_language_of_gwyddions_user(self):
        """SurfaceTopography finds in some languages the sides but no unit, or the unit but no sides."""
        h = numpy.random.default_rng(1).normal(size=(6, 8))
        for words in (("Kanal", "Breite", "Höhe", "Werteinheiten"), ("\ufeff# Kanal", "Breite", "Höhe", "Werteinheiten"),
                      ("Canal", "Ancho", "Alto", "Unidades de valor"), ("Channel", "Width", "Height", "Value units")):
            head = "\n".join(f"{word}: {value}" for word, value in zip(words, ("Topo", "20.0 µm", "15.0 µm", "nm")))
            numpy.savetxt("scan.txt", h, header=head, encoding="utf-8")
            text = pathlib.Path("scan.txt").read_text(encoding="utf-8").replace("# \ufeff", "\ufeff")   # a mark is first
            pathlib.Path("scan.txt").write_text(text, encoding="utf-8")
            one = wc.solve(wc.read("scan.txt", length_unit="um"), pbar_over_pstar=0)
            self.assertEqual("um", one.length_unit)
            self.assertAlmostEqual(1e-3*h.std(), one.surface.rms_height, delta=1e-9)
            numpy.testing.assert_allclose((one[0].x[1], one[0].y[1]), 2.5, rtol=DIGITS)

    def test_the_axes_of_netcdf(self):
        from scipy.io import netcdf_file   # which SurfaceTopography needs
        h = numpy.random.default_rng(1).normal(size=(6, 8))
        for axes, z in {("y", "x"): h, ("x", "y"): h.T}.items():
            with netcdf_file("map.nc", "w") as file:
                for name, points in ("x", 8), ("y", 6):
                    file.createDimension(name, points)
                file.createVariable("heights", "f8", axes)[:] = z
            numpy.testing.assert_array_equal(h, wc.read("map.nc").heights)

    def test_empty_files(self):
        for name in "empty.opd", "empty.txt", "empty.npy", "empty.gsf":
            pathlib.Path(name).touch()
            self.refuse(f"{name}: the file is empty", wc.read, name)

    def test_points_are_no_map(self):
        """SurfaceTopography takes lines of x, y, z for a map of three columns where a point is missing."""
        points = [(x, y, x*y % 3) for y in range(5) for x in range(5)]
        numpy.savetxt("points.txt", points[:7] + points[8:])
        self.refuse("points.txt: 1 of 25 heights are missing", wc.read, "points.txt")
        one = wc.solve(wc.read("points.txt", fill_missing="harmonic"), pbar_over_pstar=0)[0]
        self.assertEqual((5, 5), one.gap.shape)
        with self.assertRaisesRegex(SystemExit, "points.txt: decks read this file as it is"):
            convert(["points.txt", "map.npy"])

    def test_lines_with_words_are_not_left_out(self):
        h = numpy.random.default_rng(1).normal(size=(9, 12))
        for place in (0, 0), (4, 3), (8, 11):
            for word, number in ("NA", numpy.nan), ("--", numpy.nan), ("0.1x", None):
                words = [[str(one) for one in row] for row in h]
                words[place[0]][place[1]] = word
                pathlib.Path("marks.txt").write_text("\n".join(map(" ".join, words)))
                if number is None:
                    self.refuse(f"marks.txt:{place[0] + 1}: '0.1x'", wc.read, "marks.txt")
                else:
                    self.assertEqual(h.shape, wc.read("marks.txt", fill_missing="harmonic").prepared().heights.shape)
        lines = [f"{i} {'NA' if i == 5 else i % 3}" for i in range(12)]
        pathlib.Path("marks.txt").write_text("x z\n" + "\n".join(lines))
        self.assertEqual((1, 12), wc.read("marks.txt", fill_missing="harmonic").prepared().heights.shape)
        # An infinite height is wrong, as the program has it; SurfaceTopography takes it for missing.
        for text, line in (("1 2 3\n4 inf 6\n7 8 9", 2), ("0 1\n1 2\n2 -Infinity", 3), ("inf\n1\n2\n3", 1),
                           ("0 0 1\n1 0 inf\n0 1 1\n1 1 2", 2)):
            pathlib.Path("marks.txt").write_text(text + "\n")
            self.refuse(f"marks.txt:{line}: '.*' is not a height: write nan if it is missing", wc.read, "marks.txt")
        pathlib.Path("marks.txt").write_text("z\n1\nNA\n2\n3\n")   # one column
        self.assertEqual((1, 4), wc.read("marks.txt", fill_missing="harmonic").prepared().heights.shape)

    def test_no_row_is_lost(self):
        """SurfaceTopography takes the lines of a profile as far as the last one that is no row for a head, and leaves out
        such lines of a matrix."""
        for between in ",", ";", "\t", " ":
            for place in 0, 8, 39:
                for line in f"{place}{between}", "5.0", "pause", "***":
                    rows = [f"{i}{between}{i % 3}" for i in range(40)]
                    rows[place] = line
                    pathlib.Path("gap.csv").write_text(f"x{between}z\n" + "\n".join(rows) + "\n")
                    if line[-1] in ",;\t":
                        self.assertEqual((1, 40), wc.read("gap.csv", fill_missing="harmonic").prepared().heights.shape)
                    elif line[0].isdigit() or place > 0:   # above the first row they are a head
                        number = 3 if place == 0 else place + 2
                        self.refuse(f"gap.csv:{number}: ", wc.read, "gap.csv", fill_missing="harmonic")
        h = numpy.random.default_rng(1).normal(size=(64, 64))
        for head in "", "# Channel: Height\n# Width: 4 um\n# Height: 4 um\n# Value units: um\n":
            for place in 20, 63:
                for line in "***", "line 20 lost", "1,2,3,4":
                    rows = [" ".join(map(str, row)) for row in h]
                    rows[place] = line
                    pathlib.Path("lost.txt").write_text(head + "\n".join(rows) + "\n")
                    self.refuse(f"lost.txt:{place + 1 + head.count('#')}: ", wc.read, "lost.txt")
        # What is read as before: maps one below the other, two bytes a character.
        maps = [f"Channel: {name}\nWidth: 4 um\nHeight: 4 um\nValue units: um\n" + "\n".join(
            " ".join(map(str, row)) for row in rows) for name, rows in (("First", h), ("Second", -h))]
        pathlib.Path("maps.txt").write_text("\n".join(maps))
        numpy.testing.assert_array_equal(-h, wc.read("maps.txt", "Second").heights)
        rows = "\n".join(f"{i},{i % 3}" for i in range(40))
        pathlib.Path("two.csv").write_text(f"x,z\n{rows}\n", encoding="utf-16")
        for kind in "utf-16-le", "utf-16-be":
            pathlib.Path("two.csv").write_text(f"\ufeffx,z\n{rows}\n", encoding=kind)
            numpy.testing.assert_allclose(numpy.arange(40) % 3, wc.read("two.csv").heights[0])
            self.assertEqual(40, wc.file(file="two.csv").prepared().heights.size)

    def test_coordinates_are_no_heights(self):
        """SurfaceTopography takes all numbers of a text for heights."""
        h = numpy.random.default_rng(1).normal(size=(6, 8))
        framed = numpy.block([[numpy.zeros((1, 1)), numpy.arange(8)[None]/2], [numpy.arange(6)[:, None]/2, h]])
        for name, rows in ("x and y", framed), ("x", framed[:, 1:]), ("y", framed[1:]):
            numpy.savetxt(f"{name}.txt", rows)
            self.refuse(f"{name}.txt:1: .* equal steps", wc.read, f"{name}.txt")

    def test_decimal_commas_and_grids_of_esri(self):
        """SurfaceTopography takes the one for separators, and not the sides of the other."""
        h = numpy.round(numpy.random.default_rng(1).normal(size=(6, 8)), 3)
        for name, between, head in ("tabs.txt", "\t", ""), ("semicolons.csv", ";", ""), ("esri.asc", " ", "ncols 8\nnrows 6\n"
                                    "xllcorner 0\nyllcorner 0\ncellsize 0.5\n"):
            rows = "\n".join(between.join(map(str, row)) for row in h)
            pathlib.Path(name).write_text(head + (rows if head else rows.replace(".", ",")) + "\n")
            found, expected = (function(name).prepared() for function in (wc.read, lambda file: wc.file(file=file)))
            numpy.testing.assert_allclose(expected.heights, found.heights)
            self.assertEqual((6, 8), found.heights.shape)
            self.assertEqual(4 if head else 1, wc.solve(wc.read(name), pbar_over_pstar=0).length_x)

    def test_the_line_at_which_x_does_not_rise(self):
        pathlib.Path("back.csv").write_text("x,z\n100.0,0\n101.1,.1\n102.0,.3\n102.0,.4\n103.3,.2\n")
        self.refuse("back.csv:5: x = 102 after 102", wc.read, "back.csv")

    def test_the_unit_is_that_of_the_sides(self):
        """As the program has it; SurfaceTopography takes that of the heights."""
        h = numpy.random.default_rng(1).normal(size=(6, 8))
        head = "# Channel: Height\n# Width: 20{0}0 µm\n# Height: 15{0}0 µm\n# Value units: nm\n"
        for point in ".", ",":
            rows = "\n".join("\t".join(map("{:.6f}".format, row)) for row in h)
            pathlib.Path("scan.txt").write_text(head.format(point) + rows.replace(".", point), encoding="utf-8")
            for unit, factor in (None, 1), ("nm", 1000):
                if unit and point == ",":
                    continue   # the program converts nothing
                one = wc.solve(wc.read("scan.txt", length_unit=unit), pbar_over_pstar=0)
                self.assertEqual(unit or "um", surfaces.unit_name(one.length_unit))
                numpy.testing.assert_allclose((one.length_x, one.length_y, one.surface.rms_height), factor*numpy.array(
                    [20, 15, 1e-3*h.std()]), rtol=1e-5)

    def test_what_is_no_file_of_an_instrument(self):
        """The program reads tables of numbers, or tells what is wrong."""
        h = numpy.random.default_rng(1).normal(size=(8, 12))
        numpy.savetxt("comma.csv", h, delimiter=",")
        numpy.testing.assert_allclose(h - h.mean(), wc.read("comma.csv").prepared().heights, atol=1e-14)
        pathlib.Path("ragged.txt").write_text("1 2 3\n1 2\n4 5 6\n")
        pathlib.Path("number.json").write_text('{"a": 1}')   # of 8 bytes, as a tile of 2 x 2 heights, .hgt
        pathlib.Path("grey.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(60))
        pathlib.Path("cut.opd").write_bytes(b"\1\0Directory" + bytes(9))
        pathlib.Path("cut.al3d").write_bytes(b"AliconaImaging\0\r\nVersion".ljust(50, b"\0"))   # of a tile's size too
        pathlib.Path("link.al3d").write_text("version https://git-lfs\n")   # in place of the file
        pathlib.Path("grey.tif").write_bytes(TIFF)
        (self.folder/"folder.opd").mkdir()
        for name, words in {"ragged.txt": "2: this row has 2 numbers, the first has 3", "number.json": " there are no",
                            "grey.png": " by its name this is a picture", "folder.opd": " this is no file",
                            "grey.tif": " by its name this is a picture, which has no scale .* to wavycon.heights",
                            "cut.al3d": " SurfaceTopography cannot read it: AL3DReader: .*truncated",
                            "link.al3d": " SurfaceTopography cannot read it: AL3DReader: .*magic",
                            "cut.opd": " SurfaceTopography cannot read it: OPDReader: .*truncated"}.items():
            self.refuse(f"{name}:{words}", wc.read, name, error=(ValueError, OSError))
            with self.assertRaisesRegex(SystemExit, f"{name}:{words}"):
                convert([name, "map.npy"])

    def test_channels_that_have_no_heights(self):
        def channel(name, unit, data_unit=None, **more):
            return types.SimpleNamespace(name=name, unit=unit, data_unit=data_unit, **more)

        height, phase = channel("Height", "m", "m"), channel("Phase", "m", "deg")
        mixed = [phase, height, channel("Error", ("nm", "V")), channel("Raw", "m", None, is_height_channel=False),
                 channel("Zsensor", "µm"), channel("Lateral", "px"), channel("Phase", None)]
        self.assertIs(height, files.choose(mixed, None))
        # Numbers are those of the file, and of one name that which has heights is taken.
        self.assertEqual(["Height", "Zsensor", "Zsensor"], [files.choose(mixed, one).name for one in (1, 4, "Zsensor")])
        self.assertIs(mixed[6], files.choose(mixed, "Phase"))
        heights = "which is no length .Gm, .*, fm.; channels of heights: 1 'Height', 4 'Zsensor', 6 'Phase'"
        for wanted, unit in {0: "0 'Phase' is in 'deg'", "Error": "2 'Error' is in 'V'", 5: "5 'Lateral' is in 'px'"}.items():
            self.refuse(f"the channel {unit}, {heights}", files.choose, mixed, wanted, error=files.NoHeights)
        for wanted in 7, "Friction":
            self.refuse(f"no channel {wanted!r}; channels of heights: 1 'Height'", files.choose, mixed, wanted,
                        error=files.NoHeights)
        self.refuse("the channel 0 'Phase' is in 'deg', which is no length .*; channels of heights: none", files.choose,
                    [phase], None, error=files.NoHeights)
        self.refuse("no channel of heights; channels of heights: none", files.choose, [], None, error=files.NoHeights)
        pathlib.Path("scan.ibw").write_text("of an instrument")
        with unittest.mock.patch("SurfaceTopography.open_topography") as opened:
            opened.return_value.__enter__.return_value.channels = mixed
            self.refuse("^scan.ibw: the channel 0 'Phase' is in 'deg', which is no length", wc.read, "scan.ibw", 0)

    def test_micrometres_have_one_name(self):
        (self.folder/"um.txt").write_text("# Width: 4 \u00b5m\n# Height: 3 \u00b5m\n# Value units: \u00b5m\n"
                                          "1 2 3 2\n2 3 4 1\n3 1 2 2\n", encoding="utf-8")
        surface = wc.read("um.txt")
        self.assertEqual(("um", 4), (surface.length_unit, surface.keys["length_x"]))
        self.assertEqual("um", wc.solve(surface, pbar_over_pstar=0, length_unit="um").length_unit)
        both = wc.file(file="um.txt") + wc.heights(surface.heights, length_unit="um", length_x=4, length_y=3)
        numpy.testing.assert_allclose(both.heights, 2*surface.heights - surface.heights.mean(), atol=1e-14)
        self.refuse("'um' and 'nm'; read.file, length_unit", lambda: wc.read("um.txt") + wc.heights(
            surface.heights, length_unit="nm"))
        self.refuse("um.txt: 'furlong' is no unit to which 'um' is converted: units are .*, m, cm, mm, um", wc.read,
                    "um.txt", length_unit="furlong")
        for unit in "\u00b5m", "\u03bcm":   # the micro sign, the Greek letter
            self.assertEqual("um", wc.read("um.txt", length_unit=unit).length_unit)
            self.assertEqual(4, wc.solve(surface, pbar_over_pstar=0, length_unit=unit).length_x)

    def test_units_are_those_of_the_program(self):
        """Those of the file, by SurfaceTopography or the program, and those that a user gives."""
        with self.assertRaises(ValueError) as raised:
            (self.folder/"inch.txt").write_text("# Width: 4 inch\n# Height: 3 inch\n# Value units: inch\n1 2 3\n4 5 7\n1 2 3\n")
            wc.read("inch.txt")
        known = re.search("one of (.*) and (pm)", str(raised.exception))
        for unit in [*known[1].split(", "), known[2]]:
            self.assertIn(surfaces.unit_name(unit), files.LENGTHS)
            for of_file in unit, "mm":
                (self.folder/"unit.txt").write_text(f"# Width: 4 {of_file}\n# Height: 3 {of_file}\n# Value units: {of_file}\n"
                                                    "1 2 3\n4 5 7\n1 2 3\n", encoding="utf-8")
                one = wc.solve(wc.read("unit.txt", length_unit=unit), pbar_over_pstar=0)
                factor = 1 if of_file == unit else 10.0**(-3 - files.LENGTHS[surfaces.unit_name(unit)])
                numpy.testing.assert_allclose((one.length_x, numpy.ptp(one[0].gap)), numpy.array([4, 6])*factor, rtol=1e-12)

    def test_texts_have_the_notes_of_the_program(self):
        """Also those of other readers: steps that are rounded are equal, a value for missing heights, units of heights."""
        x = numpy.round(0.03861*numpy.arange(1, 41), 4)
        numpy.savetxt("rounded.csv", numpy.c_[x, numpy.sin(9*x)], delimiter=",", header="x,y", comments="")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            surface = wc.read("rounded.csv", edges="mirror")
        numpy.testing.assert_allclose(numpy.ptp(numpy.sin(9*x)), numpy.ptp(surface.heights))
        h = numpy.random.default_rng(1).normal(size=(8, 12))
        numpy.savetxt("placeholder.txt", numpy.where(numpy.arange(12) == 5, -9999, h))
        surface = wc.read("placeholder.txt", length_x=3, missing_value=-9999, fill_missing="harmonic")
        self.assertLess(numpy.ptp(surface.prepared().heights), 10)
        numpy.save("map.npy", h)
        numpy.save("map.npy", numpy.where(h < -1, -32768.1, h))
        filled = wc.read("map.npy", missing_value=-32768.1, fill_missing="harmonic").prepared().heights
        self.assertLess(numpy.ptp(filled), 10)
        numpy.save("map.npy", numpy.where(h < -1, numpy.finfo(float).max, h))
        self.assertEqual((h < -1).sum(), numpy.isnan(wc.read("map.npy").heights).sum())

    def test_unequal_steps(self):
        x = numpy.sort(numpy.random.default_rng(1).uniform(0, 1, 60))
        numpy.savetxt("profile.txt", numpy.c_[x, numpy.cos(9*x)])
        surface = wc.read("profile.txt", edges="mirror")
        with self.assertWarnsRegex(wc.Note, "unequal steps"):
            self.assertEqual(1, wc.solve(surface, pbar_over_pstar=0.2).dimension)
        numpy.savetxt("holes.txt", numpy.c_[x, numpy.where(numpy.arange(60) == 7, numpy.nan, x)])
        self.refuse("holes.txt: . of 60 heights, resampled to equal steps, are missing", wc.read, "holes.txt")

    def test_misuse(self):
        (self.folder/"words.txt").write_text("no heights")
        self.refuse("words.txt: there are no numbers in this file", wc.read, "words.txt")
        self.refuse("there is no such file", wc.read, "none.opd", error=OSError)
        numpy.savetxt("scan.txt", numpy.eye(8))
        self.refuse("no channel", wc.read, "scan.txt", channel="Phase")
        (self.folder/"deck.npy").write_text("&surface kind = 'wave_1d' /")
        numpy.save("map.npy", numpy.eye(8))
        for words in (["none.opd", "map.gsf"], ["words.txt", "map.gsf"], ["scan.txt", "map.tif"],
                      ["scan.txt", "no/map.gsf"], ["scan.txt", "deck.npy"], ["map.npy", "map.npy"]):
            with self.assertRaisesRegex(SystemExit, "wavycon-convert: "):
                convert(words)


if __name__ == "__main__":
    given = go_on_with_package()
    import matplotlib
    matplotlib.use("agg")
    import matplotlib.pyplot
    import numpy
    import pandas
    import wavycon as wc
    from wavycon import files, surfaces
    from wavycon.files import convert
    main()
