#!/usr/bin/env python3
"""The Python package as a part of programs: names that editors know, types, results as values, problems, progress.

usage: test_values.py --program WAVYCON --package FOLDER --needs PACKAGES --environment FOLDER, as test_package.py

The tests of types need mypy, those of some files h5py and xarray: they are skipped where these are not installed.
"""
import copy
import gc
import importlib.util
import inspect
import os
import pathlib
import pickle
import re
import subprocess
import sys
import unittest
import unittest.mock
import warnings

from program import ProgramTest, main
from virtual_environment import go_on_with_package

# Half a unit of the last of the 16 digits that tables have.
DIGITS = 1e-15
ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT/"src"/"library"/"python"
PROGRAM = """
import wavycon as wc
results = wc.solve(wc.wave_2d(amplitude=1e-6), e_star=2e11, mean_pressure=[1e7, 1e8], stress={"nu": 0.3})
reveal_type(results[0])
reveal_type(results[:1])
reveal_type(results.mean_gap)
reveal_type(results[0].mean_gap)
reveal_type(results[0].status)
reveal_type(wc.self_affine)
"""
REVEALED = ("Result", "Results", "float64", "float", "str", "hurst: ")
MISTAKES = {"wc.wave_2d(amplitud=1)": "amplitud", "wc.wave_2d(amplitude='1')": "str",
            "wc.solve(wc.wave_2d(), mean_presure=1)": "mean_presure", "wc.solve(wc.wave_2d(), solver='gird')": "gird",
            "wc.solve(wc.wave_2d(), mean_gap=1)[0].mean_gab": "mean_gab",
            "wc.solve(wc.wave_2d(), mean_gap=1)[0].plot_map('presure')": "presure",
            "wc.solve(wc.wave_2d(), mean_gap=1).plot(y='mean_gab')": "mean_gab",
            "wc.solve(wc.wave_2d(), mean_gap=1).plot('mean_gap', 'pressur')": "pressur",
            "wc.problem(wc.wave_2d()).find(mean_gap=[0.1, 0.2])": "list"}


class ValuesTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(cls.folder)
        os.environ["PATH"] = os.path.dirname(cls.program) + os.pathsep + os.environ["PATH"]
        warnings.simplefilter("ignore", wc.Note)
        cls.rough = wc.self_affine(rms_slope=0.1, points=64, short_wavelength=0.125, seed=3)

    def solve_rough(self, **options):
        return wc.solve(self.rough, pbar_over_pstar=[0.05, 0.3, 0.1], **options)

    def refuse(self, words, function, *arguments, error=ValueError, **options):
        with self.subTest(words=words), self.assertRaisesRegex(error, words):
            function(*arguments, **options)


class Names(ValuesTest):
    def test_functions_are_the_kinds_and_keys_of_the_library(self):
        keys = wc.keys()["surface"]
        for kind in keys["kind"]["choices"]:
            function = getattr(wc, {"sum": "wave_sum"}.get(kind, kind))
            self.assertEqual(kind, function().keys["kind"])
            own = [key for key in keys.values() if kind in key.get("read_by", ())]
            self.assertEqual([key["name"] for key in own], list(inspect.signature(function).parameters))
            for key in own:
                unit = rf" \[{re.escape(key['unit'])}\]" if key["unit"] else ""
                self.assertRegex(inspect.getdoc(function), rf"(?m)^{key['name']}{unit}: ")
                if key["default"] and (kind, key["name"]) not in (("ball", "length_x"), ("ball", "length_y")):
                    default = {".true.": "True", ".false.": "False"}.get(key["default"], key["default"])
                    self.assertIn(f"Default: {default}.", " ".join(function.__doc__.split()))

    def test_only_keys_that_are_given_are_in_the_deck(self):
        self.assertEqual({"kind": "hexagonal", "amplitude": 2}, wc.hexagonal(amplitude=2).keys)

    def test_columns_are_those_of_the_summary(self):
        results = self.solve_rough()
        names = results.table().dtype.names
        for thing in results, results[0]:
            self.assertEqual(set(names), {name for name, _ in inspect.getmembers(type(thing), lambda one: isinstance(
                one, property)) if name in names})
        for name in names:
            self.assertTrue(getattr(type(results), name).__doc__, name)
            numpy.testing.assert_array_equal(results[name], getattr(results, name))
            numpy.testing.assert_array_equal(results[1][name], getattr(results[1], name))
        self.assertIn("[length] Mean gap", type(results).mean_gap.__doc__)

    def test_options_are_the_keys_of_the_library(self):
        for group, own in wc.keys().items():
            for key in own if group not in ("surface", "scene", "output") else ():
                owners = [one for one, known in wc.keys().items() if key in known and one != "surface"]
                self.assertEqual(len(owners) == 1, key + "_"*(key == "yield") in wc.Options.__annotations__, key)
        self.assertIn("e_star [pressure]: ", wc.Settings.__doc__)

    def test_all_names_are_imported_by_a_star(self):
        names = {}
        exec("from wavycon import *", names)
        for name in "wave_2d", "wave_sum", "solve", "problem", "Options":
            self.assertIn(name, names)
        self.assertLessEqual(set(wc.__all__), set(dir(wc)))

    def test_a_wrong_name_is_an_error_at_once(self):
        self.refuse("wave_2d: there is no key 'amplitud'; did you mean 'amplitude'", wc.wave_2d, amplitud=1)
        self.refuse("'hight_scale'; did you mean 'height_scale'", wc.heights, numpy.eye(8), hight_scale=1)
        self.refuse("positional", wc.wave_2d, 1, error=TypeError)
        results = self.solve_rough()
        self.refuse("'mean_gab'; did you mean 'mean_gap'", lambda: results["mean_gab"], error=KeyError)
        for thing in results, results[0]:
            self.refuse("'contact_area_fracton'; did you mean 'contact_area_fraction'",
                        lambda thing=thing: thing.contact_area_fracton, error=AttributeError)
            self.assertFalse(hasattr(thing, "_none"))
        self.refuse("'pressure' here: one load has it", lambda: results.pressure, error=AttributeError)
        for name in "save", "method":
            self.refuse(f"'{name}' here: results of solve have it", getattr, results[0], name, error=AttributeError)
        self.refuse("load is a group: it must be a dictionary of keys and their values, got 3", wc.solve, self.rough, load=3)
        results.save("units.npz")
        for one in results, results[:2], wc.load("units.npz"), pickle.loads(pickle.dumps(results)):
            self.refuse("'mean_gapp'; did you mean 'mean_gap'", one.units.__getitem__, "mean_gapp", error=KeyError)
        with self.assertRaises(FileNotFoundError) as caught:
            results.save("nowhere/x.npz")
        self.assertEqual("nowhere/x.npz", caught.exception.filename)
        self.refuse("'presure'; did you mean 'pressure'", results[0].plot_map, "presure")
        self.refuse("'mises'|did you mean", wc.solve(wc.wave_2d(), pbar_over_pstar=0.2, stress={"nu": 0.3})[0]
                    .plot_stress_section, "von_mise", error=KeyError)
        self.refuse("'area'; did you mean 'contact_area'", results.plot, y="area", error=KeyError)
        self.refuse("'contour'; did you mean 'contours'[?] The tables are ", results.table, "contour")
        self.refuse("must end in .npz or .h5, not in .csv; to_dataframe", results.save, "run.csv")
        self.refuse("'mean_pres'; did you mean 'mean_pressure'", results.plot, x="mean_pres", error=KeyError)

    def test_what_is_meant_comes_first(self):
        wave = wc.wave_2d()
        for name, words in {"pressure": "'mean_pressure'", "gap": "'mean_gap'", "area": "'contact_area'", "E1": "'e1'",
                            "lenght_unit": "'length_unit'", "units": "'length_unit'", "young": "'e1', 'e2' or 'base_e'",
                            "youngs_modulus": "'e1', 'e2' or 'base_e'", "poisson_ratio": "'nu1', 'nu2', 'layer_nu' or 'base_nu'",
                            "yiield": "'yield'", "depth": "'depths'", "histogram": "'histograms'",
                            "resistivity": "'resistivity1'"}.items():
            self.refuse(rf"no key '{name}'; did you mean {words}\?", wc.solve, wave, **{name: 1})
        self.refuse("got \\[1, 2\\] in a list", wc.solve, wave, mean_pressure=[[1, 2]])
        ball = {"e1": 2e5, "nu1": 0.3, "yield_stress": 500}
        with wc.problem(wc.ball(radius=2, length_x=0.1), **ball) as p:
            self.assertAlmostEqual(p.find(yield_=1).force, wc.solve(wc.ball(radius=2), yield_=1, **ball)[0].force)
        self.refuse("as many lines", library.copied, "get_near_names", b"x", b"a\nb", b"one")
        self.assertEqual(["Mean_Gap"], library.copied("get_near_names", b"gap", b"map\nMean_Gap", None).splitlines())
        self.assertEqual("", library.copied("get_near_names", b"gap", b"", None))
        self.refuse("no key 'tolerance'$", wc.solve, wave, tolerance=1)
        self.refuse("no key 'E'; did you mean 'e1'", wc.solve, wave, E=1)
        self.refuse("several groups have a key 'nu': .*, or nu1, or nu2", wc.solve, wave, nu=0.3)
        self.refuse("did you mean 'length_unit', an option of solve", wc.file, lenght_unit="m")
        self.refuse("no key 'length_unit': it is an option of solve", wc.wave_2d, length_unit="m")
        self.refuse("wave_2d: there is no key 'wave_length'; did you mean 'wavelength'", wc.wave_2d, wave_length=1)
        numpy.save("h.npy", numpy.eye(8))
        for make, first in (wc.heights, [numpy.eye(8)]), (wc.read, ["h.npy"]), (wc.file, []), (wc.self_affine, []):
            for name in "spacing", "dx", "pixel_size", "Lx", "width":
                self.refuse(f"^{make.__name__}: there is no key '{name}'; did you mean 'length_x' and 'length_y', the sides "
                            r"of the whole cell\?$", make, *first, **{name: 1})
        for make, first in (wc.heights, [numpy.eye(8)]), (wc.read, ["h.npy"]):
            self.refuse(f"^{make.__name__}: .*'unit'; did you mean 'length_unit'", make, *first, unit="m")
        self.refuse("'length'; did you mean 'length_x'", wc.heights, numpy.eye(8), length=1)
        self.refuse("'sizes'; did you mean 'length_x' and", wc.heights, numpy.eye(8), sizes=1)
        self.refuse("no key '___'$", wc.solve, wave, ___=1)
        self.refuse("only maps are prepared", wc.wave_2d().prepared)
        self.refuse("^heights: there is no key 'file'", wc.heights, numpy.eye(8), file="h.npy")
        self.refuse("^wave_2d: there is no key 'dx'; there are amplitude, ", wc.wave_2d, dx=1)
        results = self.solve_rough()
        for name, meant in {"peak_error": "peak_pressure_error", "aera": "contact_area",
                            "peak": "peak_pressure", "meangap": "mean_gap"}.items():
            for thing in results, results[0]:
                self.refuse(rf"'{name}'; did you mean '{meant}'\?", getattr, thing, name, error=AttributeError)
        self.refuse("no attribute 'temperature'$", getattr, results, "temperature", error=AttributeError)

    def test_docstrings_stand_alone(self):
        self.assertIn("gap amplitude (1 - cos(2 pi x/wavelength) cos(2 pi y/wavelength_y))", wc.wave_2d.__doc__)
        for kind in wc.keys()["surface"]["kind"]["choices"]:
            self.assertNotRegex(getattr(wc, {"sum": "wave_sum"}.get(kind, kind)).__doc__, r"\b(phi|theta)\b")

    def test_a_package_that_is_not_there(self):
        with unittest.mock.patch.dict(sys.modules, {"pandas": None, "matplotlib.pyplot": None, "xarray": None,
                                                    "h5py": None}):
            results = self.solve_rough(keep_fields=False)
            for name, function in {"pandas": results.to_dataframe, "matplotlib": results.plot,
                                   "xarray": results.to_xarray, "h5py": lambda: results.save("a.h5", fields=False)}.items():
                self.refuse(rf"this needs {name}: pip install 'wavycon\[\w+\]'", function, error=ImportError)
        self.assertEqual([], list(self.folder.glob("*.h5")))

    def test_keys_are_the_callers(self):
        wc.keys()["load"].clear()
        self.assertIn("mean_pressure", wc.keys()["load"])


@unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed: types are not checked")
class Types(ValuesTest):
    def mypy(self, *words, status):
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--config-file", ROOT/"pyproject.toml", *words],
                              env=dict(os.environ, MYPYPATH=os.path.dirname(wc.__path__[0])), cwd=self.folder,
                              capture_output=True, text=True, check=False)
        self.assertEqual(status, done.returncode, done.stdout + done.stderr)
        return done.stdout

    def test_the_package(self):
        self.mypy("-p", "wavycon", status=0)

    def test_the_pages(self):
        for page in "README.md", "example.md", "certify.md":
            text = "\n".join(re.findall(r"```python\n(.*?)```", (PAGES/page).read_text(encoding="utf-8"), re.DOTALL))
            (self.folder/"page.py").write_text(text, encoding="utf-8")
            with self.subTest(page=page):
                self.mypy("page.py", status=0)

    def test_what_a_checker_knows(self):
        (self.folder/"known.py").write_text(PROGRAM)
        revealed = re.findall("Revealed type is (.*)", self.mypy("known.py", status=0))
        self.assertEqual(len(REVEALED), len(revealed))
        for words, line in zip(REVEALED, revealed):
            self.assertIn(words, line)
            self.assertNotRegex(line, "^['\"]Any")

    def test_what_a_checker_finds(self):
        (self.folder/"wrong.py").write_text("import wavycon as wc\n" + "\n".join(MISTAKES))
        found = self.mypy("wrong.py", status=1)
        for number, words in enumerate(MISTAKES.values(), 2):
            self.assertRegex(found, rf"wrong.py:{number}: error: .*{words}")


class Values(ValuesTest):
    def assert_same(self, results, again):
        self.assertEqual(repr(results), repr(again))
        for one, other in zip(results, again):
            for name in "x", "y", "pressure", "gap", "displacement":
                numpy.testing.assert_array_equal(getattr(one, name), getattr(other, name))
        self.assertEqual((results.deck, results.notes, results.units), (again.deck, again.notes, again.units))

    def test_copies(self):
        results = self.solve_rough()
        results.table("spots")
        for again in pickle.loads(pickle.dumps(results)), copy.deepcopy(results):
            self.assert_same(results, again)
            numpy.testing.assert_array_equal(results.table("spots"), again.table("spots"))
            self.refuse("was not saved", again.table, "contours")
        self.assertEqual(results[1].mean_gap, pickle.loads(pickle.dumps(results[1])).mean_gap)
        without = self.solve_rough(keep_fields=False)
        self.assertEqual(repr(without), repr(copy.deepcopy(without)))
        self.refuse("was not saved", lambda: copy.deepcopy(without)[0].pressure)

    def test_slices_are_results(self):
        results = self.solve_rough()
        self.assertIsInstance(results[1:], wc.Results)
        self.assertEqual(results.mean_gap[::-1].tolist(), results[::-1].mean_gap.tolist())
        self.assertEqual(results.p_star, results[:1].p_star)
        self.assertEqual([1, 2, 3], [one.load for one in results])
        results[1:].save("part.npz")
        self.assertEqual([2, 3], wc.load("part.npz").load.tolist())

    def test_lists_and_masks_are_results(self):
        results = self.solve_rough()
        heavy = results[results.pbar_over_pstar > 0.07]
        self.assertIsInstance(heavy, wc.Results)
        for chosen, loads in ((heavy, [2, 3]), (results[[2, 0]], [3, 1]), (results[numpy.array([-1])], [3]),
                              (results[[True, False, False]], [1]), (results[[]], []),
                              (results[results.mean_gap < 0], [])):
            self.assertEqual(loads, chosen.load.tolist())
        self.assertEqual(2, results[numpy.int64(1)].load)
        for bad in [True, False], [3], ["mean_gap"], [0.5]:
            self.refuse("", results.__getitem__, bad, error=IndexError)
        heavy.save("heavy.npz")
        self.assertEqual([2, 3], wc.load("heavy.npz").load.tolist())

    def test_a_slice_of_no_loads(self):
        results = self.solve_rough()
        results[3:].surface
        self.assertEqual((0, 0), (len(results[3:].mean_gap), len(results[3:][:1].table("spots"))))
        frame, whole = results[3:].to_dataframe(), results.to_dataframe()
        self.assertEqual((0, list(whole), whole.attrs), (len(frame), list(frame), frame.attrs))
        self.refuse("there are no loads to draw", results[3:].plot)
        if importlib.util.find_spec("xarray"):
            data = results[3:].to_xarray()
            self.assertEqual((0, *results[0].pressure.shape), data.pressure.shape)
            self.assertEqual(0, data.mean_gap.size)

    def test_what_is_in_a_result(self):
        results = self.solve_rough()
        for thing in results, results[0], results[3:]:
            self.assertEqual([True, False], ["mean_gap" in thing, "mean_gab" in thing])
        self.assertEqual([True, False], [results[0] in results, results[0] in results[1:]])

    def test_what_a_result_has_cannot_be_changed(self):
        results = self.solve_rough()
        for values in results.mean_gap, results["mean_gap"], results[0].pressure, results[0].table("spots")["perimeter"]:
            self.refuse("read-only", values.__setitem__, 0, 1)
        for thing in results, results[0]:
            with self.assertRaises(AttributeError):
                thing.mean_gap = 1

    def test_the_surface(self):
        """The statistics are those of the head of the program's tables."""
        rng = numpy.random.default_rng(1)
        h = numpy.cos(2*numpy.pi*numpy.arange(24)/24) + 0.1*rng.normal(size=(16, 24))
        for options in {}, {"edges": "mirror"}:
            numpy.save("h.npy", h)
            words = "".join(f", {key} = '{value}'" for key, value in options.items())
            self.run_deck("h", f"&surface kind = 'file', file = 'h.npy'{words} / &load pbar_over_pstar = 0.1 /")
            head = (self.folder/"h.summary.dat").read_text()
            surface = wc.solve(wc.heights(h, **options), pbar_over_pstar=0.1).surface
            for name in "rms_height", "rms_slope", "rms_curvature":
                told = float(re.search(rf"{name}\[[^]]*\] = ([^,\s]*)", head)[1])
                self.assertAlmostEqual(1, getattr(surface, name)/told, delta=1e-12)
        profile = wc.solve(wc.wave_1d(amplitude=2, wavelength=3), pbar_over_pstar=0.1).surface
        self.assertAlmostEqual(4*numpy.pi/3/2**0.5, profile.rms_slope, delta=1e-12)
        self.assertIn("spectrum_1d", profile.spectrum.dtype.names)
        ball = wc.solve(wc.ball(radius=1.0, length_x=0.2, points=16), force=1e-6).surface
        with self.assertRaisesRegex(ValueError, "free edges"):
            ball.rms_slope
        self.assertEqual(("Roughness(no spectrum)", (16, 16)), (repr(ball), ball.heights.shape))

    def test_heights_that_were_solved(self):
        h = numpy.random.default_rng(1).normal(size=(16, 24))
        results = wc.solve(wc.heights(h, length_x=3), pbar_over_pstar=[0, 0.1])
        numpy.testing.assert_allclose(results.surface.heights, h - h.mean(), atol=1e-14)
        # At first touch the gap is what is between the highest point and the heights.
        numpy.testing.assert_allclose(results[0].gap, h.max() - h, atol=1e-12)
        self.refuse("read-only", results.surface.heights.__setitem__, 0, 1)
        wave = wc.solve(wc.wave_2d(amplitude=2), pbar_over_pstar=0.1)
        self.assertEqual(wave[0].gap.shape, wave.surface.heights.shape)
        self.assertAlmostEqual(2, wave.surface.heights.max(), delta=1e-12)
        self.assertEqual((1, 24), wc.solve(wc.heights(h[0]), pbar_over_pstar=0.1).surface.heights.shape)

    def test_copies_have_the_surface(self):
        results = self.solve_rough()
        for has_heights in False, True:
            if has_heights:
                results.surface.heights
            results.save("surface.npz", fields=has_heights)
            for again in wc.load("surface.npz"), pickle.loads(pickle.dumps(results)), copy.deepcopy(results):
                self.assertEqual(repr(results.surface), repr(again.surface))
                if has_heights:
                    numpy.testing.assert_array_equal(results.surface.heights, again.surface.heights)
                else:
                    self.refuse("'height' was not saved.*solve it by wavycon.run", getattr, again.surface, "heights")
                self.refuse("'fields_at' was not saved: .* has no solver", again[0].fields_at, 0, 0)

    def test_the_deck_of_heights_in_memory(self):
        h = numpy.random.default_rng(1).normal(size=(16, 24))
        results = wc.solve(wc.heights(h), pbar_over_pstar=0.1)
        self.assertIn("\n! The heights were in memory: to run this deck write them to a file", results.deck)
        numpy.save("heights.npy", h)
        deck = self.folder/"again.nml"
        deck.write_text(results.deck.replace("file = 'heights'", "file = 'heights.npy'"))
        again = wc.run(deck)
        self.assertEqual(results.mean_gap.tolist(), again.mean_gap.tolist())
        for other in again, self.solve_rough():
            self.assertNotIn("in memory", other.deck)
        for other, words in (results, "to a file, the heights to that which it names, and solve"), (
                self.solve_rough(), "to a file, and solve"):
            self.refuse(words, pickle.loads(pickle.dumps(other))[0].fields_at, 0, 0)

    def test_two_bodies(self):
        """The sum of two maps is what the program makes of two files, each with its own treatment."""
        first, second = numpy.random.default_rng(1).normal(size=(2, 16, 24)) + 0.3*numpy.arange(24)
        second[3, 5] = numpy.nan
        numpy.save("first.npy", first)
        numpy.save("second.npy", second)
        both = {"length_x": 3, "fill_missing": "harmonic", "edges": "mirror"}
        files = wc.file(file="first.npy", file2="second.npy", detrend="plane", file2_detrend="mean", height_scale=2,
                        file2_scale=1, **both)
        surface = (wc.heights(first, detrend="plane", height_scale=2, **both)
                   + wc.heights(second, detrend="mean", **both).flipped())
        one, two = (wc.solve(each, pbar_over_pstar=0.2) for each in (files, surface))
        # Means of maps that are turned differ by rounding.
        numpy.testing.assert_allclose(one.surface.heights, two.surface.heights, atol=1e-13)
        numpy.testing.assert_allclose(one.mean_gap, two.mean_gap, rtol=1e-9)
        frame = wc.sweep([surface, surface], pbar_over_pstar=0.2)
        numpy.testing.assert_allclose(frame.mean_gap, [two.mean_gap[0]]*2, rtol=DIGITS)
        # The sides of the first one are taken, as in the program.
        self.assertEqual(2, (wc.heights(first, length_x=2) + wc.heights(first, length_x=2.04)).keys["length_x"])
        # Files too, with what they tell, and beside heights in memory.
        on_disc = (wc.file(file="first.npy", detrend="plane", height_scale=2, **both)
                   + wc.file(file="second.npy", detrend="mean", **both).flipped())
        numpy.testing.assert_allclose(surface.heights, on_disc.heights, atol=1e-13)
        # A file without sides has those of the other map, in whichever order.
        numpy.savetxt("sides.txt", first, header="Width: 3 um\nHeight: 2 um\nValue units: um")
        bare, own = wc.file(file="second.npy", fill_missing="harmonic"), wc.file(file="sides.txt")
        for total in bare + own, own + bare, wc.heights(first, length_x=3, length_y=2, length_unit="um") + bare:
            self.assertEqual((3, 2, "um"), (total.length_x, total.length_y, total.length_unit))
        alone = wc.file(file="first.npy", length_x=3)
        for total in bare.flipped() + own, own.flipped() + bare, own + bare.flipped(), alone + bare, bare + alone.flipped():
            self.assertEqual((3, 2), (total.length_x, total.length_y))
        self.assertFalse({"length_x", "length_y"} & (bare + bare.flipped()).keys.keys())
        # The side that is assumed has been used for the cut-off.
        filtered = wc.file(file="second.npy", fill_missing="harmonic", short_wavelength=0.3).flipped()
        self.refuse("same length_x, got 3.0 and 1.0", own.__add__, filtered)
        with open("first.gsf", "wb") as file:
            files_of_package.write_gsf(file, first, {"length_x": 3, "length_y": 2}, "m")
        for pair in (wc.read("first.gsf"), wc.heights(first)), (wc.heights(first), wc.read("first.gsf")):
            total = pair[0] + pair[1]
            self.assertEqual((3, 2, "m"), (total.keys["length_x"], total.keys["length_y"], total.length_unit))
            numpy.testing.assert_allclose(total.heights - total.heights.mean(), 2*(first - first.mean()), atol=1e-5)
        # Keys that are None are none.
        self.assertEqual("mirror", (wc.heights(first, edges="mirror", length_x=None) + wc.heights(
            second, edges="mirror", length_x=3, detrend=None, fill_missing="harmonic")).keys["edges"])
        # Maps without keys are added as they are, and each map has its own trend.
        numpy.testing.assert_array_equal(first + first[::-1], (wc.heights(first) + wc.heights(first[::-1])).heights)
        plain = wc.heights(first, detrend="plane", **both) + wc.heights(second, **both)
        self.assertGreater(numpy.polyfit(numpy.arange(24), plain.heights.mean(0), 1)[0], 0.25)
        numpy.testing.assert_array_equal(second[:, ::-1], wc.heights(second).flipped().heights)
        expected = wc.solve(wc.heights(first[0] + first[1][::-1], length_x=3), pbar_over_pstar=0.2).mean_gap
        for shape in (24,), (1, 24), (24, 1):
            profile = (wc.heights(first[0].reshape(shape), length_x=3, length_unit="um")
                       + wc.heights(first[1].reshape(shape)).flipped())
            found = wc.solve(profile, pbar_over_pstar=0.2)
            self.assertEqual("um", found.length_unit)
            numpy.testing.assert_allclose(found.mean_gap, expected, rtol=1e-9)

    def test_keys_are_attributes(self):
        surface = wc.heights(numpy.eye(8), length_x=2, edges="mirror")
        self.assertEqual((2, "mirror"), (surface.length_x, surface.edges))
        self.refuse("no 'length_y'; it has heights, length_unit, kind, file, length_x, edges",
                    lambda: surface.length_y, error=AttributeError)
        for copied in copy.deepcopy(surface), pickle.loads(pickle.dumps(surface)):
            self.assertEqual(surface.keys, copied.keys)

    def test_two_bodies_that_do_not_fit(self):
        one, h = wc.heights(numpy.eye(8), length_x=2, length_unit="um"), numpy.eye(8)
        for words, other in {"same shape, got .8, 8. and .8, 9.": wc.heights(numpy.eye(8, 9)),
                             "same length_unit, got 'um' and 'm'": wc.heights(h, length_unit="m"),
                             "same length_x, got 2 and 2.13": wc.heights(h, length_x=2.13),
                             "same edges, got 'periodic' and 'mirror'": wc.heights(h, edges="mirror"),
                             "only maps are": wc.wave_2d()}.items():
            self.refuse(words, one.__add__, other)
        self.refuse("read.file, length_unit=.... converts a file, heights.factor.h, length_unit=.... an array", one.__add__,
                    wc.heights(h, length_unit="m"))
        self.refuse("a surface and int cannot be added: wavycon.heights", lambda: one + 1, error=TypeError)
        for add in lambda: one + h, lambda: h + one:
            self.refuse("a surface and ndarray cannot be added: wavycon.heights", add, error=TypeError)
        self.refuse("only maps are", wc.wave_2d().flipped)
        self.refuse("a.gsf: there is no such file", wc.file(file="a.gsf").flipped, error=OSError)

    def test_a_flat_map_is_prepared(self):
        flat = wc.heights(numpy.add.outer(numpy.arange(6.0), numpy.arange(8.0)), detrend="plane").prepared()
        self.assertEqual([[0.0]*8]*6, flat.heights.tolist())

    def test_no_folder_is_left_to_be_cleaned(self):
        h = numpy.random.default_rng(1).normal(size=(16, 24))
        numpy.savetxt("profile.txt", numpy.c_[numpy.sort(h[0]), h[0]])
        with warnings.catch_warnings():
            warnings.simplefilter("error", ResourceWarning)
            wc.solve(wc.heights(h, detrend="plane") + wc.heights(h), pbar_over_pstar=0.1)
            if importlib.util.find_spec("SurfaceTopography"):
                wc.read("profile.txt")
            gc.collect()

    def test_units_in_a_head(self):
        results = wc.solve(wc.wave_2d(), e_star=2, mean_pressure=0.1, pressure_unit="MPa", length_unit="um")
        results.to_dataframe(units=True).to_csv("units.csv", index=False)
        head, row = (self.folder/"units.csv").read_text().splitlines()
        names = head.split(",")
        self.assertEqual(["load", "pbar_over_pstar"], names[:2])
        for name in "mean_gap [um]", "peak_pressure [MPa]", "contact_area [um^2]", "status":
            self.assertIn(name, names)
        self.assertEqual(results.mean_gap[0], float(row.split(",")[names.index("mean_gap [um]")]))
        self.assertEqual("um", results.to_dataframe(units=True).attrs["units"]["mean_gap [um]"])
        self.assertEqual(list(results.table().dtype.names), list(results.to_dataframe()))

    def test_a_table_for_notebooks(self):
        text = self.solve_rough(pressure_unit="<MPa>")._repr_html_()
        self.assertEqual(4, text.count("<tr"))
        self.assertIn("mean pressure [&lt;MPa&gt;]", text)
        self.assertIn("converged", text)
        self.assertIn("<th>mean gap [length]</th><th>mean gap error [length]</th>", text)
        self.assertNotIn("red", text)
        failed = wc.solve(wc.wave_2d(), mean_pressure=[2, 0.5], hardness=1)._repr_html_()
        self.assertEqual(1, failed.count("color:red"))

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not installed")
    def test_files_of_hdf5(self):
        results = self.solve_rough(length_unit="µm")
        results.table("spots")
        results.save("run.h5")
        again = wc.load("run.h5")
        self.assert_same(results, again)
        numpy.testing.assert_array_equal(results.table("spots"), again.table("spots"))
        for name in "other.h5", "other.hdf5":
            (self.folder/name).write_text("a text")
            self.refuse("is not replaced", results.save, name, error=OSError)
        results.save("run.hdf5")
        self.assertEqual(b"\x89HDF", (self.folder/"run.hdf5").read_bytes()[:4])
        self.assert_same(results, wc.load("run.hdf5"))
        self.assertFalse((self.folder/"run.hdf5.npz").exists())

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "xarray is not installed")
    def test_xarray(self):
        results = self.solve_rough(pressure_unit="MPa")
        data = results.to_xarray()
        self.assertEqual(("load", "y", "x"), data.pressure.dims)
        numpy.testing.assert_array_equal(results[1].gap, data.gap.sel(load=2))
        numpy.testing.assert_array_equal(results.contact_area, data.contact_area)
        self.assertEqual("MPa", data.mean_pressure.attrs["units"])
        self.assertEqual("MPa", data.pressure.attrs["units"])
        self.assertNotIn("pressure", self.solve_rough(keep_fields=False).to_xarray())


class Pictures(ValuesTest):
    def setUp(self):
        self.addCleanup(matplotlib.pyplot.close, "all")

    def test_loads_that_are_not_resolved_are_open(self):
        loads = wc.solve(self.rough, pbar_over_pstar=[1e-4, 0.1, 0.3])
        self.assertEqual(["unresolved", "converged", "converged"], loads.status.tolist())
        ax = loads.plot()
        # Behind the line and its error bars.
        points = ax.lines[-1]
        self.assertEqual(("white", [loads.contact_area_fraction[0]]), (points.get_markerfacecolor(),
                                                                      points.get_ydata().tolist()))
        self.assertEqual(["not resolved"], [text.get_text() for text in ax.get_legend().get_texts()])
        self.assertIsNone(loads[1:].plot().get_legend())
        self.assertIn("unresolved", loads[0].plot_map().get_title())

    def test_nothing_is_cut_off(self):
        """At the top of the picture was the title of regions of a map that is wider than high."""
        draw = numpy.random.default_rng(3).normal
        for points, size in ((24, 36), (6.4, 4.8)), ((24, 36), (6, 3)), ((24, 36), (4, 6)), ((76, 120), (6.4, 4.8)):
            surface = wc.heights(draw(size=points), length_x=points[1], length_y=points[0], edges="mirror",
                                 short_wavelength=points[1]/5)
            one = wc.solve(surface, contact_area_fraction=0.45)[0]
            ax = one.plot_map("regions", matplotlib.pyplot.subplots(figsize=size, layout="constrained")[1])
            ax.figure.savefig("regions.png")
            width, height = ax.figure.bbox.size
            for part in ax.title, ax.xaxis.label, ax.get_legend():
                box = part.get_window_extent()
                self.assertTrue(box.x0 > 0 and box.y0 > 0 and box.x1 < width and box.y1 < height, (size, part, box))
            self.assertLess(ax.get_legend().get_window_extent().y1, ax.xaxis.label.get_window_extent().y0)

    def test_units(self):
        one = wc.solve(self.rough, e_star=2, mean_pressure=0.01, pressure_unit="MPa", length_unit="um")
        ax = one.plot("mean_gap", "contact_area")
        self.assertEqual(("contact area [µm²]", "mean gap [µm]"), (ax.get_xlabel(), ax.get_ylabel()))
        ax = one[0].plot_map()
        self.assertEqual(("mean pressure 0.01 MPa", "x [µm]"), (ax.get_title(), ax.get_xlabel()))
        # Without labels over p* and Delta.
        plain = wc.solve(self.rough, e_star=2, mean_pressure=0.01)
        ax = plain[0].plot_map("gap")
        self.assertEqual(f"mean pressure {plain[0].pbar_over_pstar:.4g} p*", ax.get_title())
        shown = ax.collections[0].get_array()
        self.assertAlmostEqual(plain[0].gap.max()/plain.amplitude, shown.max(), delta=1e-12)
        numpy.testing.assert_array_equal(plain[0].gap == 0, shown.mask.reshape(plain[0].gap.shape))

    def test_a_column_has_one_unit_in_all_tables(self):
        for surface in wc.wave_1d(amplitude=1e-6, wavelength=1e-3), wc.wave_2d(amplitude=1e-6, wavelength=1e-3):
            results = wc.solve(surface, e_star=1e9, pbar_over_pstar=0.1, pressure_unit="Pa", length_unit="m",
                               interface={"work_of_adhesion": 0.05, "friction": 0.5, "tangential_over_normal": 0.1,
                                          "nu": 0.3},
                               stress={"nu": 0.3, "section": "x"}, output={"spots": True, "lines": True, "map": True})
            units = {}
            for name in results[0]._asked_for():
                for column, unit in wc.library.table(results[0]._solution, name, 1)[1].items():
                    self.assertEqual(unit, units.setdefault(column, unit), (name, column))

    def test_pascals_and_metres_have_a_prefix(self):
        """That which suits p*, here 0.89 GPa, Delta and the side of the cell; other units are drawn as they are."""
        results = wc.solve(wc.wave_2d(amplitude=1e-6, wavelength=1e-3), e_star=2e11, mean_pressure=[1e7, 1e8],
                           pressure_unit="Pa", length_unit="m", stress={"nu": 0.3, "section": "x"})
        ax = results.plot("mean_gap")
        self.assertEqual(("mean pressure [MPa]", "mean gap [nm]"), (ax.get_xlabel(), ax.get_ylabel()))
        numpy.testing.assert_allclose(ax.lines[0].get_xydata(), numpy.c_[[10, 100], 1e9*results.mean_gap])
        ax = results[0].plot_map()
        self.assertEqual("mean pressure 10 MPa", ax.get_title())
        self.assertEqual(("x [µm]", "y [µm]"), (ax.get_xlabel(), ax.get_ylabel()))
        self.assertAlmostEqual(1e-6*results[0].pressure.max(), ax.collections[0].get_array().max(), delta=1e-9)
        ax = results[0].plot_stress_section()
        self.assertEqual(("distance [µm]", "depth [µm]"), (ax.get_xlabel(), ax.get_ylabel()))
        self.assertEqual("von Mises [MPa]", ax.collections[0].colorbar.ax.get_ylabel())
        for other in results[0].plot_map("gap"), results[0].plot_map("regions"), ax:
            self.assertGreater(other.get_xlim()[1], 490)
        self.assertEqual("contact area [m²]", results.plot("contact_area").get_ylabel())
        self.assertEqual("elastic energy [J]", results.plot("elastic_energy").get_ylabel())

    def test_a_section_is_the_same_in_whatever_order_its_depths_are_given(self):
        drawn = [wc.solve(wc.wave_2d(), pbar_over_pstar=0.2, output={"line_points": 16}, stress={
            "nu": 0.3, "section": "x", "depths": depths})[0].plot_stress_section().collections[0].get_array()
            for depths in ([0.05, 0.1, 0.3], [0.3, 0.05, 0.1, 0.1])]
        numpy.testing.assert_array_equal(*drawn)

    def test_tables_of_the_surface(self):
        """All loads have the same surface."""
        results = self.solve_rough()
        self.assertEqual((64*64, 3*64*64), (len(results.table("height")), len(results.table("map"))))
        self.assertEqual(len(results.surface.spectrum), len(results.to_dataframe("spectrum")))

    def test_regions(self):
        """What the picture says of percolation is what the table of spots says, also of a mirrored map."""
        rough = numpy.random.default_rng(3).normal(size=(24, 32))
        seen = set()
        for edges in "periodic", "mirror":
            surface = wc.heights(rough, length_x=1.0, edges=edges, short_wavelength=0.2)
            for one in wc.solve(surface, contact_area_fraction=[0.2, 0.35, 0.4, 0.45, 0.5, 0.6]):
                ax, spots = one.plot_map("regions"), one.table("spots")[0]
                named = {text.get_text() for text in ax.get_legend().get_texts()}
                for part in "contact", "gap":
                    along = [axis for axis in "xy" if spots[f"{part}_percolates_{axis}"]]
                    words = f"{part} that percolates" + (f" along {along[0]}" if len(along) == 1 else "")
                    self.assertEqual({words} if along else set(), {name for name in named if name.startswith(part)})
                    seen.add((edges, part, len(along)))
                self.assertEqual(spots["closed_pools"] > 0, "closed gap" in named)
                matplotlib.pyplot.close("all")
        self.assertEqual(8, len({(edges, part, number > 0) for edges, part, number in seen}))
        self.assertEqual({0, 1, 2}, {number for _, _, number in seen})
        # Without the table the axis is not known.
        wc.solve(surface, contact_area_fraction=0.6).save("regions.npz")
        self.assertIn("contact that percolates", self.legend(wc.load("regions.npz")[0]))
        # In the paper's series the edge is an isobar; pressures far from the contact are above zero, too.
        for solver in "beale", "series":
            for one in wc.solve(wc.wave_2d(), pbar_over_pstar=[0.02, 0.8], solver=solver):
                spots = one.table("spots")[0]
                drawn = one.plot_map("regions").collections[0].get_array().reshape(one.pressure.shape)
                self.assertAlmostEqual(spots["contact_area_fraction"], (drawn >= 2).mean(), delta=0.01)
                self.assertEqual(bool(spots["gap_percolates_x"]), "gap that percolates" in self.legend(one))
                self.assertEqual(spots["closed_pools"] > 0, "closed gap" in self.legend(one))
                self.assertEqual(not spots["contact_percolates_x"], "spots of contact" in self.legend(one))
        self.refuse("this one is a profile", wc.solve(wc.wave_1d(), pbar_over_pstar=0.2)[0].plot_map, "regions")
        ball = wc.solve(wc.ball(radius=1, length_x=0.2, points=32), e_star=2, force=1e-4)[0]
        self.refuse("this one has free edges", ball.plot_map, "regions")

    def legend(self, one):
        names = {text.get_text() for text in one.plot_map("regions").get_legend().get_texts()}
        matplotlib.pyplot.close("all")
        return names


class Problems(ValuesTest):
    def test_loads_have_the_digits_of_solve(self):
        loads = [0.02, 0.2, 0.1]
        for surface in self.rough, wc.wave_2d(), wc.wave_1d():
            with wc.problem(surface, e_star=3) as p:
                found = p.solve(mean_pressure=loads)
            again = wc.solve(surface, e_star=3, mean_pressure=loads)
            for name in "mean_gap", "contact_area_fraction", "status":
                numpy.testing.assert_array_equal(again[name], found[name])
            numpy.testing.assert_array_equal(again[2].pressure, found[2].pressure)

    def test_a_search(self):
        with wc.problem(wc.wave_2d(), accuracy=1e-6) as p:
            one = p.find(contact_area_fraction=0.3)
            self.assertAlmostEqual(0.3, one.contact_area_fraction, delta=1e-6)
            self.assertEqual([p.p_star]*2, [one.p_star, one.mean_pressure/one.pbar_over_pstar])
            self.assertEqual(one.mean_pressure, p.find(mean_pressure=one.mean_pressure).mean_pressure)
        # Results stay when the problem has ended.
        self.assertEqual(0, one.gap.min())

    def test_a_load_of_percolation(self):
        with wc.problem(self.rough, e_star=3) as p:
            tight = p.find(percolates="gap")
            found = tight.table("percolation")
            self.assertEqual(tight.mean_pressure, found["percolation"][0])
            self.assertLess(found["last_before"][0], tight.mean_pressure)
            for load, percolates in (tight, 0), (p.find(mean_pressure=found["last_before"][0]), 1):
                spots = load.table("spots")
                self.assertEqual(percolates, max(spots["gap_percolates_x"][0], spots["gap_percolates_y"][0]))
                self.assertEqual(spots["spots"][0], (load.table("spot_sizes")["region"] == "spot").sum())
            other = p.find(mean_pressure=tight.mean_pressure)
            self.refuse("needs a load that percolates finds", other.table, "percolation")
            self.refuse("'gab'; did you mean 'gap'", p.find, percolates="gab")
            self.refuse("percolates must be one word", p.find, percolates=3)
            self.refuse("percolates must be one word", p.find, percolates=None)
            self.refuse("percolates must be one word", p.solve, percolates=["gap", "contact"])
            self.refuse("no key 'percolate' in &load; did you mean 'percolates'", p.find, percolate="gap")
            self.refuse("find needs one value", p.find, percolates=["gap", "contact"])
            self.refuse("find needs one value", p.find, mean_pressure=[0.1, 0.2])
            self.refuse("mean_pressure needs a number, got 'gap'", p.find, mean_pressure="gap")
        with wc.problem(wc.wave_2d(), solver="beale") as p:
            self.refuse("estimates no errors", p.find, percolates="gap")

    def test_misuse(self):
        self.refuse("loads belong to the solve", wc.problem, self.rough, mean_pressure=1)
        self.refuse("did you mean 'e_star'", wc.problem, self.rough, e_sta=1)
        with wc.problem(self.rough) as p:
            self.refuse("did you mean 'mean_pressure'", p.solve, mean_presure=1)
            self.refuse(", and foo to wavycon.problem", p.find, contact_area_fraction=0.3, foo=1)
            self.refuse(r"no key 'gap' in &load; did you mean 'mean_gap'\?", p.find, gap=0.5)
            self.refuse("by one of", p.solve)
            self.refuse("by one of", p.solve, mean_pressure=1, mean_gap=1)
            self.refuse("number", p.solve, mean_pressure=[[1]])
            self.refuse("", p.solve, mean_pressure=-1)
            self.refuse("", p.find, mean_pressure=float("nan"))
        self.refuse("has ended", p.solve, mean_pressure=1)


class Sweeps(ValuesTest):
    def test_surfaces_and_loads_in_memory(self):
        """The digits are those of solves one after the other."""
        h = numpy.random.default_rng(1).normal(size=(16, 24))
        h[2, 3] = numpy.nan
        surfaces = {"rough": self.rough, "map": wc.heights(h, fill_missing="harmonic", length_x=2, edges="mirror")}
        loads = [0.2, 0.05]
        frame = wc.sweep(surfaces, {"load.pbar_over_pstar": [loads, 0.1]}, 2, e_star=3, pressure_unit="MPa")
        self.assertEqual(6, len(frame))
        for name, surface in surfaces.items():
            results = wc.solve(surface, e_star=3, pbar_over_pstar=loads)
            rows = frame[(frame.surface == name)].iloc[:2]
            for column in results.table().dtype.names:
                if results[column].dtype.kind == "f":
                    numpy.testing.assert_allclose(rows[column], results[column], rtol=DIGITS)
                else:
                    numpy.testing.assert_array_equal(results[column], rows[column])
        self.assertEqual(("MPa", "length"), tuple(map(frame.attrs["units"].get, ("mean_pressure", "mean_gap"))))

    def test_one_surface_and_a_list(self):
        seeds = wc.sweep(self.rough, {"surface.seed": [3, 4]}, pbar_over_pstar=0.1)
        self.assertEqual(["surface.seed", "load"], list(seeds)[:2])
        listed = wc.sweep([self.rough, wc.wave_2d()], pbar_over_pstar=0.1)
        self.assertEqual([0, 1], listed.surface.tolist())
        self.assertEqual(seeds.contact_area[0], listed.contact_area[0])

    def test_one_value(self):
        frame = wc.sweep(wc.wave_1d(), {"method.solver": "auto", "load.pbar_over_pstar": 0.1,
                                        "surface.amplitude": numpy.array(2)}, 1)
        self.assertEqual([["auto", 0.1, 2]], frame.iloc[:, :3].values.tolist())

    def test_a_list_that_is_too_long_for_the_name_of_a_case(self):
        loads = [number/101 for number in range(1, 101)]
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)   # of pandas
            frame = wc.sweep(wc.wave_1d(), {"load.pbar_over_pstar": [loads]}, 1)
        numpy.testing.assert_allclose(frame.pbar_over_pstar, loads, rtol=DIGITS)
        self.assertEqual([*range(1, 101)], frame.load.tolist())

    def test_a_wrong_key_is_an_error_before_anything_starts(self):
        with unittest.mock.patch("subprocess.Popen", side_effect=AssertionError):
            self.refuse("'surface.sed'; did you mean 'surface.seed'", wc.sweep, self.rough, {"surface.sed": [1]})
            self.refuse("did you mean 'e_star'", wc.sweep, self.rough, e_sta=1)
            self.refuse("must be a surface", wc.sweep, [1], pbar_over_pstar=1)
            self.refuse("own keys: give e_star in values, with the group", wc.sweep, "deck.nml", e_star=1)
            self.refuse("values must be a dictionary .*, got .'surface.seed'", wc.sweep, self.rough, ["surface.seed"])
            self.refuse("surface.seed must be a number", wc.sweep, self.rough, {"surface.seed": None})
            for jobs in -1, 0, 1.5:
                self.refuse(f"jobs must be a whole number, 1 or more, got {jobs}", wc.sweep, self.rough, jobs=jobs)

    def test_the_module_is_the_program(self):
        (self.folder/"deck.nml").write_text("&surface kind = 'wave_1d' / &load pbar_over_pstar = 0.5 /")
        for words, status in (["deck.nml", "--quiet"], 0), (["none.nml"], 3):
            done = subprocess.run([sys.executable, "-m", "wavycon", *words], check=False, capture_output=True, text=True,
                                  env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
            self.assertEqual(status, done.returncode, done.stderr)


class Progress(ValuesTest):
    def test_a_bar_appears_if_it_takes_long(self):
        class Bar:
            def __init__(self, total, unit, begun):
                self.total, self.n, self.texts, self.is_closed = total, 0, [], False
                bars.append(self)

            def set_postfix_str(self, text, refresh):
                self.texts.append(text)

            def update(self, steps):
                self.n += steps

            def close(self):
                self.is_closed = True

        bars = []
        with unittest.mock.patch.multiple("wavycon.progress", new_bar=Bar, PATIENCE=-1.0):
            self.solve_rough()
            self.assertEqual([(3, 3, True)], [(bar.total, bar.n, bar.is_closed) for bar in bars])
            self.assertRegex(bars[0].texts[-1], r"^\d+ iterations, residual \de-\d\d$")
            self.solve_rough(progress=False)
            self.assertEqual(1, len(bars))
        with unittest.mock.patch.multiple("wavycon.progress", new_bar=Bar):
            self.solve_rough()
            self.assertEqual(1, len(bars))


if __name__ == "__main__":
    given = go_on_with_package()
    import matplotlib
    matplotlib.use("agg")
    import matplotlib.pyplot
    import numpy
    import wavycon as wc
    from wavycon import files as files_of_package
    from wavycon import library
    main()
