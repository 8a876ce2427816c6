#!/usr/bin/env python3
"""The library as others use it: installed, found by CMake and pkg-config, linked by Fortran, C and Python programs.

usage: test_consumers.py --build BUILD --cmake CMAKE --sources SOURCES --generator GENERATOR --c CC --fortran FC
                         --flags FLAGS

The long test, Consumers.memory, runs only if it is named.
"""
import argparse
import functools
import json
import math
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from by_ctypes import Library
from program import new_folder
from tables import Table

HERE = pathlib.Path(__file__).resolve().parent
WAVE = """&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3 /
&material e1 = 210e9, nu1 = 0.3 /
&method solver = 'auto', accuracy = 1e-4 /
"""
DECK = WAVE + """&load pbar_over_pstar = 0.9, 0.5, 0.2 /
&stress line = .true., planes = .true., depths = 1e-4, 3e-4 /
&output contours = .true., map_points = 48, 32 /
"""
MEASURED_DECK = """&surface kind = 'file', file = 'measured.dat', length_x = 4e-3, length_y = 3e-3
   detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror' /
&material e_star = 1e9 /
&method residual = 1e-10 /
&load pbar_over_pstar = 0.2 /
"""
YIELD_DECK = WAVE + """&load yield = 1 /
&stress yield_stress = 1e9 /
"""
COLUMNS = ["pbar_over_pstar", "mean_gap", "contact_area_fraction", "peak_pressure", "peak_pressure_over_pstar_error"]
STRESSES = ["stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_xz", "stress_yz"]
INVARIANTS = ["von_mises", "largest_shear", "principal_1", "principal_2", "principal_3"]
LARGEST = ["largest_von_mises", "von_mises_x", "von_mises_y", "von_mises_depth", "largest_von_mises_over_pstar_error",
           "largest_shear"]
# Seconds after which a command counts as hanging; the slowest take a few.
LONGEST = 240
# Half a unit of the last of the 16 digits that tables have.
DIGITS = 1e-15
# Von Mises, shear and principal stresses of a stress in units and of one in p*: rounding, of numbers of both signs.
INVARIANT_DIGITS = 1e-14
# Of a Fortran main program the variables live as long as the process, which the address sanitizer takes for leaks.
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", ASAN_OPTIONS="detect_leaks=0")


def run(*command, **options):
    """Runs a command; its output, which a failure shows."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL, timeout=LONGEST,
                          env=dict(ENVIRONMENT, **options.pop("environment", {})), **options)
    if done.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, command))}: exit status {done.returncode}\n{done.stdout}\n"
                             f"{done.stderr}")
    return done.stdout


def numbers(output):
    """The words of a consumer's lines, the numbers among them read."""
    rows = [line.split() for line in output.splitlines()]
    if [len(row) for row in rows] != [6, 6, 6, 4, 12, 12, 6, 6, 3, 4]:
        raise AssertionError(f"this is not what a consumer prints:\n{output}")
    return [[float(word) if "." in word else word for word in row] for row in rows]


def loads_the_library(test):
    """Marks a test in which Python loads the library, which it cannot with a sanitizer."""
    @functools.wraps(test)
    def run_or_skip(self):
        if self.is_sanitized:
            self.skipTest("Python cannot load a library with a sanitizer")
        test(self)
    return run_or_skip


class Consumers(unittest.TestCase):
    options = None

    @classmethod
    def setUpClass(cls):
        cls.folder = new_folder(cls.addClassCleanup)
        cls.prefix = cls.folder / "prefix"
        options = cls.options
        cls.is_sanitized = "-fsanitize" in options.flags
        run(options.cmake, "--install", options.build, "--prefix", cls.prefix)
        # The installation must not need the place that it was configured for.
        cls.prefix = cls.prefix.rename(cls.folder / "moved")
        cls.library = next(cls.prefix.glob("lib*/**/libwavycon." + ("dylib" if sys.platform == "darwin" else "so")))
        cls.lib = cls.library.parent
        for project, name in ((HERE, "project"), (HERE / "only_c", "only_c")):
            run(options.cmake, "-S", project, "-B", cls.folder / name, "-G", options.generator, "-D",
                f"CMAKE_PREFIX_PATH={cls.prefix}", *cls.compilers())
            run(options.cmake, "--build", cls.folder / name)
        # The program that the digits are compared with is the installed one.
        heights = [[((7*i*i + 3*j*j + i*j) % 11 + 0.25*i)/1048576 for i in range(16)] for j in range(12)]
        heights[2][5] = math.nan
        (cls.folder / "measured.dat").write_text("".join(" ".join(map(repr, row)) + "\n" for row in heights))
        for name, deck in (("deck", DECK), ("yield", YIELD_DECK), ("measured", MEASURED_DECK)):
            (cls.folder / f"{name}.nml").write_text(deck)
            run(cls.prefix / "bin" / "wavycon", f"{name}.nml", "--output", ".", "--quiet", cwd=cls.folder)
        cls.expected = numbers(run(cls.folder / "project" / "consumer_fortran"))

    @classmethod
    def compilers(cls):
        options = cls.options
        return [f"-DCMAKE_C_COMPILER={options.c}", f"-DCMAKE_Fortran_COMPILER={options.fortran}",
                f"-DCMAKE_C_FLAGS={options.flags}", f"-DCMAKE_Fortran_FLAGS={options.flags}"]

    def pkg_config(self, *arguments):
        if not shutil.which("pkg-config"):
            self.skipTest("there is no pkg-config")
        return shlex.split(run("pkg-config", *arguments, "wavycon",
                               environment={"PKG_CONFIG_PATH": str(self.lib / "pkgconfig")}))

    def path_of_library(self):
        return {name: str(self.lib) for name in ("LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")}

    def check_row(self, row, columns, values):
        """Checks numbers against columns of a table."""
        for column, value in zip(columns, values):
            self.assertLessEqual(abs(float(row[column]) - value), DIGITS*abs(value), column)

    def test_digits_of_the_deck(self):
        table = Table(self.folder / "deck.summary.dat").records()
        self.assertEqual(3, len(table))
        for row, values in zip(table, self.expected):
            self.assertEqual(row["status"], values[-1])
            self.check_row(row, COLUMNS, values)
        highest, in_contact, open_gap, edges = self.expected[3]
        contour = Table(self.folder / "deck.contour.dat").records()
        self.assertEqual(len({row["curve"] for row in contour if row.get("load") == "3"}), int(edges))
        # The map of the last load: its highest point is at most the peak, and the peak lies on it, at the crest.
        self.assertLessEqual(abs(highest - self.expected[2][3]), 1e-6*highest)
        self.assertGreater(in_contact, 0)
        self.assertGreater(open_gap, 0)

    def test_digits_of_the_stresses(self):
        below = [row for row in Table(self.folder / "deck.stress_line.dat").records() if row.get("load") == "3"]
        self.assertEqual(2, len(below))
        for row, values in zip(below, self.expected[4:6]):
            self.check_row(row, STRESSES + ["stress_error"], values[:7])
            for column, value in zip(INVARIANTS, values[7:]):
                self.assertLessEqual(abs(float(row[column]) - value), INVARIANT_DIGITS*abs(values[2]), column)
        plane = [row for row in Table(self.folder / "deck.stress_planes.dat").records()
                 if row.get("load") == "3" and float(row["depth"]) == 1e-4]
        self.assertEqual(48*32, len(plane))
        self.check_row(plane[4*48 + 7], STRESSES, self.expected[6])
        self.check_row(Table(self.folder / "deck.stress_largest.dat").records()[2], LARGEST, self.expected[7])
        # A pressure of 200 MPa on average and 1100 MPa at the crest.
        self.assertLess(self.expected[4][2], -2e8)
        self.assertGreater(self.expected[7][0], 1e8)

    def test_digits_of_first_yield(self):
        first, = Table(self.folder / "yield.summary.dat").records()
        self.check_row(first, ["mean_pressure", "contact_area_fraction"], self.expected[8][:2])
        self.assertEqual(first["status"], self.expected[8][-1])
        largest, = Table(self.folder / "yield.stress_largest.dat").records()
        self.assertAlmostEqual(float(largest["largest_von_mises"])/1e9, 1, delta=1e-4)

    def test_digits_of_a_measured_map(self):
        row, = Table(self.folder / "measured.summary.dat").records()
        self.check_row(row, ["mean_gap", "contact_area", "mean_pressure"], self.expected[9][:3])
        self.assertEqual(row["status"], self.expected[9][-1])
        self.assertLess(float(row["contact_area"]), 4e-3*3e-3)

    def test_tables_are_drawn(self):
        if not shutil.which("gnuplot"):
            self.skipTest("there is no gnuplot")
        self.assertIn("usage: wavycon-plot", run(self.prefix/"bin"/"wavycon-plot", "--help"))
        run(self.prefix/"bin"/"wavycon-plot", self.folder/"deck.summary.dat")
        self.assertTrue((self.folder/"deck.summary.png").is_file())
        # With the reference values beside the points.
        deck = self.folder/"paper.nml"
        deck.write_text("&surface kind = 'wave_2d' / &load pbar_over_pstar = 0.2 / &method solver = 'beale' /\n")
        run(self.prefix/"bin"/"wavycon", deck, "--quiet", "--output", self.folder)
        run(self.prefix/"bin"/"wavycon-plot", self.folder/"paper.summary.dat")
        self.assertTrue((self.folder/"paper.summary.png").is_file())

    def test_tables_are_compared(self):
        self.assertIn("\nagrees", run(self.prefix/"bin"/"wavycon-verify", "deck.summary.dat", "wave_2d", "--tolerance",
                                      "1e-4", cwd=self.folder))

    def test_fortran_with_the_shared_library(self):
        self.assertEqual(self.expected, numbers(run(self.folder / "project" / "consumer_fortran_shared")))

    def test_c_with_the_static_library(self):
        self.assertEqual(self.expected, numbers(run(self.folder / "project" / "consumer_c")))

    def test_a_project_in_c_alone(self):
        self.assertEqual(self.expected, numbers(run(self.folder / "only_c" / "consumer_c_shared")))

    def test_pkg_config_with_the_shared_library(self):
        program = self.folder / "by_pkg_config"
        run(self.options.c, *shlex.split(self.options.flags), HERE / "consumer.c", "-o", program,
            *self.pkg_config("--cflags", "--libs"))
        output = run(program, environment=self.path_of_library())
        self.assertEqual(self.expected, numbers(output))

    def test_pkg_config_with_the_static_library(self):
        program = self.folder / "static_by_pkg_config"
        words = self.pkg_config("--cflags", "--libs", "--static")
        words[words.index("-lwavycon")] = self.lib / "libwavycon.a"
        run(self.options.c, *shlex.split(self.options.flags), HERE / "consumer.c", "-o", program, *words)
        self.assertEqual(self.expected, numbers(run(program)))

    def test_programs_of_the_page(self):
        page = (self.options.sources / "src" / "library" / "README.md").read_text()
        blocks = [(language, block) for language in ("fortran", "c")
                  for block in (part.split("```")[0] for part in page.split(f"```{language}\n")[1:])]
        self.assertEqual(["fortran", "fortran", "c"], [language for language, _ in blocks])
        found = []
        for number, (language, block) in enumerate(blocks):
            source = self.folder / f"page{number}"
            suffix, compiler, text = {
                "fortran": (".f90", self.options.fortran, f"program page\n{block}end program page\n"),
                "c": (".c", self.options.c,
                      f"#include <stdio.h>\n#include <wavycon.h>\nint main(void)\n{{\n{block}}}\n"),
            }[language]
            source.with_suffix(suffix).write_text(text)
            run(compiler, *shlex.split(self.options.flags), source.with_suffix(suffix), "-o", source,
                *self.pkg_config("--cflags", "--libs"))
            found.append(run(source, environment=self.path_of_library()))
        # The mean gap and the area of one load in all languages, to the digits that they print.
        found = [[float(word) for word in output.split()[:2]] for output in found]
        for other in found:
            for one, same in zip(found[0], other):
                self.assertAlmostEqual(one/same, 1, delta=1e-5)

    @loads_the_library
    def test_keys(self):
        groups = {group["name"]: group for group in json.loads(Library(self.library).text(None, "keys"))}
        self.assertEqual(["scene", "material", "surface", "load", "stress", "interface", "method", "output"], list(groups))
        keys = {name: {key["name"]: key for key in group["keys"]} for name, group in groups.items()}
        # The program's --help is made from the same tables.
        reference = run(self.prefix / "bin" / "wavycon", "--help")
        for key in (key for group in keys.values() for key in group.values()):
            self.assertIn(f"\n   {key['name']} ", reference)
            self.assertIn(key["type"], ("real", "integer", "logical", "text", "choice"))
            self.assertTrue(key["meaning"])
        self.assertEqual((0, True, None, "pressure", False), tuple(keys["material"]["e_star"][what] for what in (
            "least", "above", "most", "unit", "required")))
        self.assertIn("self_affine", keys["surface"]["kind"]["choices"])
        self.assertTrue(keys["surface"]["kind"]["required"])
        self.assertEqual(["wave_1d", "wave_2d", "hexagonal"], keys["surface"]["amplitude"]["read_by"])
        self.assertNotIn("read_by", keys["material"]["e_star"])

    @loads_the_library
    def test_page_and_completion_have_all_options_and_keys(self):
        share = self.prefix / "share"
        page = (share / "man" / "man1" / "wavycon.1").read_text()
        scripts = [(share / place).read_text() for place in ("bash-completion/completions/wavycon",
                                                             "zsh/site-functions/_wavycon")]
        shown = run(self.prefix / "bin" / "wavycon", "--help").split("\n\n&")[0]
        options = re.findall(r"\n   (--[\w-]+)", shown)
        self.assertGreaterEqual(len(options), 12)
        for option in options:
            self.assertIn(".TP\n\\fB" + option.replace("-", "\\-") + "\\fR", page)
            for script in scripts:
                self.assertRegex(script, rf"[ '*]{option}\b")
        for group in json.loads(Library(self.library).text(None, "keys")):
            own = page.split(f".SS &{group['name']}\n")[1].split("\n.SS ")[0]
            self.assertEqual([key["name"] for key in group["keys"]], re.findall(r"^\.TP\n\\fB(\w+)", own, re.MULTILINE))
            for key in group["keys"]:
                # The meaning is a line of its own.
                self.assertIn("\n.br\n", own.split(f"\\fB{key['name']}\\fR\n")[1].split("\n.TP")[0])
                words = [".true.", ".false."] if key["type"] == "logical" else key.get("choices", [])
                for script, pattern in zip(scripts, (r"{}\) words='(.*)' ;;", r"{}\) choices=\((.*)\) ;;")):
                    self.assertIn(f" {group['name']}.{key['name']} ", script.replace("\n", " ").replace("'", " "))
                    found = re.findall(pattern.format(rf"\b{group['name']}\.{key['name']}"), script)
                    self.assertEqual([" ".join(words)]*bool(words), found)
        for command in (["man", "--warnings", "-l"], ["groff", "-man", "-ww", "-z"], ["mandoc", "-T", "lint", "-W",
                                                                                     "warning"]):
            if shutil.which(command[0]):
                done = subprocess.run([*command, share / "man" / "man1" / "wavycon.1"], stdin=subprocess.DEVNULL,
                                      capture_output=True, text=True, check=False, timeout=LONGEST)
                self.assertEqual((0, ""), (done.returncode, done.stderr), command)

    def test_completion(self):
        share = self.prefix / "share"
        if shutil.which("zsh"):
            run("zsh", "-n", share / "zsh" / "site-functions" / "_wavycon")
        if not shutil.which("bash"):
            self.skipTest("there is no bash")
        script = share / "bash-completion" / "completions" / "wavycon"
        run("bash", "-n", script)
        folder = self.folder / "completion"
        (folder / "decks of mine").mkdir(parents=True)
        for name in ("one.nml", "one.dat"):
            (folder / name).touch()
        for line, expected in {
                "wavycon --ch": ["--check"],
                "wavycon one.nml --s": ["--set", "--sweep"],
                "wavycon --help su": ["surface"],
                "wavycon --set surface.ki": ["surface.kind="],
                "wavycon --set  method.solver=f": ["fitted"],
                "wavycon --set=surface.edges=": ["periodic", "mirror", "window", "free"],
                "wavycon --sweep output.map=.true.,.": [".true.,.true.", ".true.,.false."],
                "wavycon --set load.yield=": [],
                "wavycon --jobs ": [],
                "wavycon o": ["one.nml"],
                "wavycon ": ["one.nml", "decks of mine"],
                "wavycon --output d": ["decks of mine"],
                "wavycon --table=one": ["one.nml", "one.dat"]}.items():
            done = run("bash", "-c", 'source "$1"; COMP_LINE=$2 COMP_POINT=${#2}; _wavycon; '
                       'printf "%s\\n" "${COMPREPLY[@]}"', "bash", script, line, cwd=folder)
            self.assertEqual(sorted(expected), sorted(filter(None, done.splitlines())), line)

    def test_misuse(self):
        self.assertEqual("0 failures\n", run(self.folder / "project" / "misuse", cwd=self.folder))

    def test_threads(self):
        self.assertEqual("0 failures\n", run(self.folder / "project" / "threads"))

    def memory(self):
        if self.is_sanitized:
            self.skipTest("valgrind cannot run a program with a sanitizer")
        if not shutil.which("valgrind"):
            self.skipTest("there is no valgrind")
        for program in (self.folder / "project" / "misuse", self.folder / "only_c" / "consumer_c_shared"):
            run("valgrind", "--quiet", "--leak-check=full", "--show-leak-kinds=definite,indirect,possible",
                "--errors-for-leak-kinds=definite,indirect,possible", "--error-exitcode=1", program, cwd=self.folder)

    def test_subproject(self):
        options = self.options
        run(options.cmake, "-S", HERE / "subproject", "-B", self.folder / "subproject", "-G", options.generator,
            "-D", f"FETCHCONTENT_SOURCE_DIR_WAVYCON={options.sources}", *self.compilers())
        listed = run(pathlib.Path(options.cmake).with_name("ctest"), "-N", "--test-dir", self.folder / "subproject")
        self.assertIn("Total Tests: 0", listed)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sources", type=pathlib.Path, required=True)
    for name in ("build", "cmake", "generator", "c", "fortran", "flags"):
        parser.add_argument(f"--{name}", required=True)
    Consumers.options, others = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *others], verbosity=2)
