#!/usr/bin/env python3
"""scripts/plot draws every kind of table, and says what it cannot draw.

usage: test_plot.py --program WAVYCON [unittest's options]

The long tests, Plot.every_table_in_every_format and Plot.strips_have_clean_ends, run only if they are named.
"""
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

from ink import dejavu_alone, inked_borders
from program import ProgramTest, main, skip

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT/"scripts"/"pictures"))
import fields  # noqa: E402
import kinds  # noqa: E402
import stresses  # noqa: E402
from axes import Scale, axis, chosen, marked_up  # noqa: E402
from picture import fitted  # noqa: E402
from table import NotATable, Table  # noqa: E402

OUTLINE = "rgb( 48,  51,  56)"   # `outline` of figure_style.gp
SOUND_START = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}
WAVE = """\
&surface kind = 'wave_2d' /
&load pbar_over_pstar = 0, 0.1, 0.5 /
"""
TABLES = "lines = t, map = t, contours = t, map_points = 16, line_points = 16"
# Marks and words that gnuplot, a shell or svg could take for commands.
TITLE = "Steel_1 {a}^2 'b' @c & 100 % \\n `touch CANARY` $(touch CANARY)"
DECKS = {
    "auto": WAVE + "&method solver = 'fitted' /\n&output " + TABLES + ", spots = t, theory = t, details = t /",
    "paper": WAVE + "&method solver = 'beale' /\n&output " + TABLES + ", theory = t, coefficients = t /",
    "bounded": WAVE + "&method solver = 'grid', grid_points = 32 /\n&output bounds = t /",
    "line": "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.1, 0.6 /\n"
            "&method solver = 'beale' /\n&output " + TABLES + ", spots = t, histograms = t, theory = t, coefficients = t /",
    "oblong": "&surface kind = 'wave_2d', wavelength = 30, wavelength_y = 60 /\n&load pbar_over_pstar = 0.3 /\n&output " + TABLES + " /",
    "npy": WAVE + "&method solver = 'auto' /\n&output map = t, contours = t, map_points = 16, map_format = 'npy' /",
    "si": f"&scene title = \"{TITLE}\", pressure_unit = 'Pa', length_unit = 'm' /\n"
          "&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3 /\n&material e_star = 230e9 /\n"
          "&load pbar_over_pstar = 0.05, 0.4 /\n&method solver = 'auto' /\n&output " + TABLES + ", spots = t /",
    "sweep": "&surface kind = 'wave_1d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 19 /\n"
             "&method solver = 'auto' /\n&output lines = t, contours = t, line_points = 16 /",
    "stress": WAVE.replace("0, 0.1", "0.1") + "&stress nu = 0.3, line = t, section = 'x', planes = t,\n"
              "depths_over_cell_x = 0, 0.05, 0.2 /\n&method solver = 'grid' /\n&output contours = t, map_points = 8 /",
    "bodies": "&scene pressure_unit = 'Pa', length_unit = 'm' /\n"
              "&surface kind = 'wave_1d', amplitude = 1e-6, wavelength = 1e-3 /\n"
              "&material e1 = 210e9, nu1 = 0.3, e2 = 70e9, nu2 = 0.33 /\n&load pbar_over_pstar = 0.1, 0.6 /\n"
              "&stress line = t, section = 'x', planes = t, depth_steps = 9, yield_stress = 1e9, 2e8 /\n"
              "&method solver = 'auto' /\n&output map_points = 16, map_format = 'npy' /",
    "rough": "&scene length_unit = 'um' /\n&surface kind = 'sum', length_x = 20, length_y = 30,\n"
             "amplitudes = 1, 0.4, 0.2, waves_x = 1, 2, 0, waves_y = 0, 1, 7 /\n&load pbar_over_pstar = 0.1 /\n"
             "&output spectrum = t, height = t, map_points = 24, 16 /",
    "profile": "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.1 /\n"
               "&output spectrum = t, height = t, map_points = 16 /",
    "unsolved": "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.1, 0.22861 /\n"
                "&method solver = 'fitted', accuracy = 1e-6 /",
    "slip": WAVE.replace("0, 0.1", "0.1") +
            "&interface friction = 0.5, tangential_over_normal = 0.1, 0.3, nu = 0.3, slip_loop = t, slip_map = t,\n"
            "work_of_adhesion = 0.05, resistivity1 = 1, resistivity2 = 1 /\n&method solver = 'auto', accuracy = 1e-2 /\n"
            "&output map_points = 16 /",
    "free": "&scene pressure_unit = 'MPa', length_unit = 'mm' /\n&surface kind = 'ball', radius = 1, length_x = 0.2, points = 32 /\n"
            "&material e_star = 2 /\n&load force = 1e-4, 1e-3 /\n&stress nu = 0.3 /\n"
            "&output map = t, contours = t, lines = t, spots = t, histograms = t /",
    "pull": "&scene pressure_unit = 'MPa', length_unit = 'mm' /\n&surface kind = 'ball', radius = 1 /\n"
            "&load force = 1e-4 /\n&interface work_of_adhesion = 1e-5 /",
    "map": "&surface kind = 'file', file = 'heights.txt' /\n&load pbar_over_pstar = 0.1, 0.5 /",
}
# What pictures show and what they do not, with bars between, by the words for scripts/plot.
SHOWN = {
    "auto.summary.dat": ("auto|contact area A/A0|mean pressure p̄/p*",
                         "pressure)|error unknown|the rms slope|converged|not accurate"),
    "auto.lines.dat": ("auto|pressure p/p*", ""),
    "auto.map.dat": ("auto|gap g/Δ", ""),
    "auto.theory_lines.dat": ("auto|distance along the diagonal|p̄/p* = 0.1 p̄/p* = 0.5", ""),
    "auto.contour.dat": ("auto|y|mean pressure p̄/p*", ""),
    "auto.theory.dat": ("auto|mean gap ḡ/Δ", ""),
    "auto.details.dat": ("auto|perimeter", ""),
    "bounded.bounds.dat": ("distance between the bounds|complementary energy, over itself|mean pressure p̄/p*", ""),
    "paper.coefficients.dat": ("paper|harmonic", ""),
    "auto.spots.dat": ("auto|closed pools|percolates along|mean pressure p̄/p*", ""),
    # A few spots have whole numbers, a short axis more numbers than powers of ten.
    "auto.spot_sizes.dat": ("auto|number of at least this area| 0 1 2 ", ""),
    "line.histogram.dat": ("line|density of pressure|gap g/Δ", ""),
    "si.summary.dat": ("[MPa]|mean gap ḡ [µm]", ""),
    "si.map.dat": ("x [µm]", ""),
    "si.spots.dat": ("mean pressure p̄ [MPa]", ""),
    # Lengths without a label are those of the deck.
    "oblong.map.dat": (" 60 ", ""),
    "oblong.contour.dat": (" 60 ", ""),
    "oblong.lines.dat": (" 10 ", ""),
    "rough.spectrum.dat": ("wave number q [rad/µm]|spectrum C [µm4]|spectrum C1 [µm3]|along x|along y", ""),
    "profile.spectrum.dat": ("wave number q| 2 5 10 ", "along|["),
    "rough.height.npy": ("height [µm]| 30 ", ""),
    "profile.height.npy": ("height/Δ", ""),
    # Unknown errors of a grid are NaN, but so are those of the paper's series, which is not marked.
    "map.summary.dat": ("error unknown or as large as the value|the rms slope", ""),
    "paper.summary.dat": ("converged", "error unknown"),
    "line.summary.dat": ("closed form", ""),
    "unsolved.summary.dat": ("not accurate", ""),
    "--loads 2,19 sweep.lines.dat": ("p̄/p* = 0.1 p̄/p* = 0.95", ""),
    "--compare auto.lines.dat paper.lines.dat": ("p̄/p* = 0.1, p̄/p* = 0.5", ""),
    "--compare auto.lines.dat sweep.lines.dat": ("p̄/p*", ""),
    # Units only where they are the same; no title.
    "--compare si.summary.dat auto.summary.dat": ("p̄", "MPa|Steel"),
    "--compare si.summary.dat si.summary.dat": ("MPa", ""),
    # By symmetry there is no shear stress below the crest.
    "stress.stress_largest.dat": ("von Mises stress σvM/p*|shear stress τmax/p*|depth z|mean pressure p̄/p*",
                                  "over yield|σxz"),
    "stress.stress_line.dat": ("σxx/p*|σzz/p*|σvM/p*|τmax/p*|depth z|p̄/p* = 0.5", "over yield|σxz"),
    "stress.stress_section.dat": ("depth z|distance|von Mises stress σvM/p*|p̄/p* = 0.1", "over yield|σxz"),
    "stress.stress_planes.dat": ("z = 0.05|von Mises stress|p̄/p* = 0.1", "over yield|σxz"),
    "--variable stress_xz stress.stress_section.dat": ("σxz/p*", ""),
    "--depths 3 --loads=2 stress.stress_planes.dat": ("z = 0.2", "z = 0.05"),
    "bodies.stress_largest.dat": ("first body|second body|[MPa]|[µm]|over yield stress", ""),
    "--body 2 bodies.stress_largest.dat": ("[MPa]", "first body"),
    "--body 2 --depths 1,9 bodies.stress_planes.npy": ("[MPa]", ""),
    "slip.interface.dat": ("contact stiffness|resistance", ""),
    "slip.partial_slip.dat": ("stick area|displacement|load 1|load 2", ""),
    "slip.slip_loop.dat": ("tangential load|displacement", ""),
    "slip.slip_map.dat": ("1|0.5", ""),
    "slip.adhesion.dat": ("p̄/p*|pull-off|jump to spots|unstable|separate pools", ""),
    "pull.adhesion.dat": ("force [10−3 N]|contact area [mm2]|[µm]", ""),
    # With free edges there is no p*: loads are mean pressures. Tables with the loads over p* alone take them from the
    # summary; errors are those in units.
    "free.map.dat": ("kPa", "nan|NaN"),
    "free.contour.dat": ("kPa", "nan|NaN"),
    "free.lines.dat": ("kPa", "nan|NaN"),
    "free.spots.dat": ("mean pressure|[kPa]", ""),
    "free.stress_largest.dat": ("[kPa]", "error unknown"),
    "free.histogram.dat": ("density of pressure [1/kPa]", ""),
}
# Too few points for error estimates.
HEIGHTS = "1 0 1 2\n0 1 2 1\n1 2 4 3\n0 1 1 2\n"


class Plot(ProgramTest):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder/"heights.txt").write_text(HEIGHTS)
        for case, deck in DECKS.items():
            cls.run_deck(case, deck + "\n", statuses=(2,) if case == "unsolved" else (0,))
        # All tables but those that have more than can be shown, which is said.
        cls.tables = sorted(path.name for path in cls.folder.glob("*.*")
                            if path.suffix in (".dat", ".npy") and not path.name.startswith(("sweep", "bodies")))
        # Pictures by the words for scripts/plot. Each call takes longer than a picture: most are drawn at once.
        cls.at_once = cls.run_plot("--format", "svg", *cls.tables)
        cls.pictures = {(name,): cls.folder/pathlib.Path(name).with_suffix(".svg") for name in cls.tables}

        # What is drawn for a machine without Times, None if this one does not have DejaVu.
        cls.wide_faces = dejavu_alone(cls.folder)

    @classmethod
    def run_plot(cls, *words, variables=None):
        return subprocess.run([ROOT/"scripts"/"plot", *words], cwd=cls.folder, capture_output=True, text=True,
                              check=False, env=variables)

    def plot(self, *words, status=0):
        """Runs scripts/plot. Returns what it writes on standard output and on standard error."""
        result = self.run_plot(*words)
        self.assertEqual(status, result.returncode, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result.stdout, result.stderr

    def drawn(self, *words, name=None):
        """The words of a picture that is drawn without any message."""
        if words not in self.pictures:
            said, complaints = self.plot("--format", "svg", *words)
            self.assertEqual("", complaints)
            self.pictures[words] = self.folder/said.removeprefix("picture: ").strip()
        picture = self.pictures[words]
        if name:
            self.assertEqual(name, picture.name)
        # Texts are broken up where the face changes.
        xml.dom.minidom.parse(str(picture))   # one document, not several
        shown = re.sub(r"<title>.*?</title>", "", picture.read_text(encoding="utf-8"), flags=re.S)
        return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", "", shown)))

    def test_every_kind_of_table(self):
        self.assertEqual(set(kinds.DRAWN), {Table(self.folder/name).kind for name in self.tables})
        self.check_pictures("svg", self.at_once)

    def every_table_in_every_format(self):
        for form in SOUND_START:
            self.check_pictures(form, self.run_plot("--format", form, *self.tables, variables=self.wide_faces))
        self.check_borders(self.tables)

    def test_nothing_is_cut_off(self):
        """With the wide letters of DejaVu, and with numbers that differ little."""
        tables = "rough.summary.dat", "slip.interface.dat"
        self.check_pictures("png", self.run_plot(*tables, variables=self.wide_faces), tables)
        self.check_borders(tables)

    def check_borders(self, tables):
        for table in tables:
            with self.subTest(table=table):
                self.assertEqual([], inked_borders((self.folder/table).with_suffix(".png")))

    def check_pictures(self, form, drawn, tables=()):
        """All tables are drawn in a format, without a message."""
        pictures = [pathlib.Path(name).with_suffix(f".{form}") for name in tables or self.tables]
        self.assertEqual((0, ""), (drawn.returncode, drawn.stderr))
        self.assertEqual([f"picture: {picture}" for picture in pictures], drawn.stdout.splitlines())
        for picture in pictures:
            with self.subTest(picture=picture):
                self.assertTrue((self.folder/picture).read_bytes().startswith(SOUND_START[form]))

    def test_labels(self):
        """gnuplot's svg leaves out what lies outside of the picture."""
        for picture, (present, absent) in SHOWN.items():
            shown = self.drawn(*picture.split())
            with self.subTest(picture=picture):
                for words in present.split("|"):
                    self.assertIn(words, shown)
                for words in filter(None, absent.split("|")):
                    self.assertNotIn(words, shown)
        self.assertEqual(3, self.drawn("auto.summary.dat").count("mean pressure p̄/p*"))

    def test_units(self):
        """One unit a run: loads, pressures and stresses; places and depths; gaps."""
        for case in ("si", "bodies"):
            for path in sorted(self.folder.glob(f"{case}.*.svg")):
                if not re.search("compare|theory.svg", path.name):
                    self.assertNotRegex(path.read_text(encoding="utf-8"), r"GPa|kPa|\(mm|nm\b")

    def test_maps_of_small_spots(self):
        """Contact has panels of its own and no outlines that would hide it; colours end below a single peak."""
        self.run_deck("small", "&surface kind = 'self_affine', rms_slope = 0.1, short_wavelength = 0.016,\npoints = 256 /\n"
                      "&load contact_area_fraction = 0.1, 0.45 /\n&output map = t, contours = t, spots = t /\n")
        for picture, contact, outlined in (("small.map", True, False), ("auto.map", True, True)):
            shown = self.drawn(f"{picture}.dat")
            text = (self.folder/f"{picture}.svg").read_text(encoding="utf-8")
            self.assertEqual(contact, "contact" in shown)
            self.assertEqual(outlined, f"stroke='{OUTLINE}'" in text)
        self.assertRegex(self.drawn("small.map.dat"), "pressure p/p[*] largest [0-9.]+")
        self.assertNotIn("largest", self.drawn("auto.map.dat"))
        # Sizes of spots are lines without points.
        self.drawn("small.spot_sizes.dat")
        text = (self.folder/"small.spot_sizes.svg").read_text(encoding="utf-8")
        self.assertNotIn("translate", re.sub("<g[^>]*>", "", text))

    def test_regions(self):
        """What a map shows of regions is what the table of spots says. Beale's edge is an isobar."""
        for name in "line.map.dat", "free.map.dat":
            self.assertIn("repeated along x and y", self.plot("--variable", "regions", name, status=3)[1])
        if subprocess.run(["python3", "-c", "import numpy"], capture_output=True, check=False).returncode:
            self.assertIn("regions need numpy", self.plot("--variable", "regions", "auto.map.dat", status=3)[1])
            return
        words = re.compile("closed gap|spots of contact|[a-z]+ that percolates")
        for name in "auto.map.dat", "paper.map.dat":
            for load, expected in enumerate(({"gap that percolates"}, {"gap that percolates", "spots of contact"},
                                             {"closed gap", "contact that percolates"}), 1):
                drawn = self.drawn("--variable", "regions", "--loads", str(load), name)
                with self.subTest(name=name, load=load):
                    self.assertEqual(expected, set(words.findall(drawn)))

    def test_heights(self):
        """Without a summary beside it the points are counted."""
        (self.folder/"alone").mkdir()
        shutil.copy(self.folder/"rough.height.npy", self.folder/"alone")
        self.assertIn(" 15 ", self.drawn("alone/rough.height.npy"))

    def test_titles(self):
        """The deck's title stands as it is, in the middle of the upper edge of every picture."""
        pictures = [f"si.{kind}" for kind in ("summary", "lines", "map", "contour")]
        pictures += [f"{case}.{kind}" for case in ("line", "auto") for kind in ("contour", "map", "lines", "theory")]
        for picture in pictures + ["line.coefficients", "auto.details", "unsolved.summary", "npy.map"]:
            words = self.drawn(f"{picture}.{'npy' if picture == 'npy.map' else 'dat'}")
            case = picture.split(".")[0]
            title = f"si: {TITLE}" if case == "si" else case
            with self.subTest(picture=picture):
                self.assertIn(title, words)
                text = (self.folder/f"{picture}.svg").read_text(encoding="utf-8")
                before = text[:text.index(f">{html.escape(title, quote=False)}</text>")]
                x, y = re.findall(r'translate\(([^,]*),([^)]*)\)" stroke="none"', before)[-1]
                self.assertAlmostEqual(float(re.search(r'width="(\d+)"', text)[1])/2, float(x), delta=1)
                self.assertAlmostEqual(20, float(y), delta=1)

    def test_strips_of_profiles(self):
        """The strips of a load cover its contact area: cut at the ends of the cell they are two."""
        self.drawn("line.contour.dat")
        text = (self.folder/"line.contour.svg").read_text(encoding="utf-8")
        strips = {}
        for path in re.findall(r"<path stroke='rgb\(  0, 101, 163\)'\s+d='([^']*)'", text):
            for start, y, end in re.findall(r"M([\d.]+),([\d.]+) L([\d.]+),\2\s", path):
                strips.setdefault(y, []).append(float(end) - float(start))
        self.assertEqual([2, 2], [len(lengths) for lengths in strips.values()])
        frame = re.search(r"d='M([\d.]+),[\d.]+ L\1,[\d.]+ L([\d.]+),[\d.]+ M", text)
        areas = sorted(sum(lengths)/(float(frame[2]) - float(frame[1])) for lengths in strips.values())
        for expected, area in zip(Table(self.folder/"line.summary.dat").column("contact_area_fraction"), areas):
            self.assertAlmostEqual(expected, area, delta=2e-3)

    def strips_have_clean_ends(self):
        """The strips of a wave are symmetric, row by row of the picture. gnuplot reads the picture."""
        self.plot("line.contour.dat")
        subprocess.run(["gnuplot", "-d"], cwd=self.folder, check=True, text=True, input="set table 'pixels'\n"
                       "plot 'line.contour.png' binary filetype=png using ($1 == 0 && $2 == 101) with image\n")
        rows = {}
        for line in (self.folder/"pixels").read_text().splitlines():
            words = line.split()
            if words and words[0] != "#" and float(words[2]):
                rows.setdefault(int(words[1]), []).append(int(words[0]))
        low, high = (end(end(row) for row in rows.values()) for end in (min, max))
        self.assertGreater(len(rows), 10)
        for row in rows.values():
            left = max(x for x in row if x < (low + high)/2)
            right = min(x for x in row if x > (low + high)/2)
            self.assertAlmostEqual(left - low, high - right, delta=2)

    def test_errors_too_large_for_a_bar(self):
        for name, column, error in (("auto.summary", "contact_area_fraction_error", "1.0"),
                                    ("stress.stress_largest", "largest_shear_error", "NaN")):
            lines = (self.folder/f"{name}.dat").read_text().splitlines()
            words = lines[-1].split()
            words[Table(self.folder/f"{name}.dat").names.index(column)] = error
            changed = f"open.{name.split('.')[1]}.dat"
            (self.folder/changed).write_text("\n".join(lines[:-1] + [" ".join(words)]) + "\n")
            self.assertIn("error unknown or as large as the value", self.drawn(changed))

    def test_compare(self):
        words = self.drawn("--compare", "auto.summary.dat", "paper.summary.dat", name="auto.summary.compare.svg")
        self.assertIn("auto", words)
        self.assertIn("paper", words)
        for others in (("auto.lines.dat", "auto.summary.dat"), ("auto.map.dat", "paper.map.dat")):
            self.assertIn("can be compared", self.plot("--compare", *others, status=3)[1])
        self.assertIn("no load in common", self.plot("--compare", "auto.lines.dat", "si.lines.dat", status=3)[1])
        self.assertIn("--compare needs", self.plot("--compare", "auto.lines.dat", status=1)[1])

    def test_many_loads(self):
        _, complaints = self.plot("--format", "svg", "sweep.lines.dat")
        self.assertIn("8 of its 19 loads", complaints)
        self.assertIn("none of the loads 99; there are 1 to 19",
                      self.plot("--loads", "99", "sweep.lines.dat", status=3)[1])
        said, complaints = self.plot("--format", "svg", "--loads", "2,99", "sweep.lines.dat")
        self.assertEqual("plot: sweep.lines.dat: it has none of the loads 99; there are 1 to 19\n", complaints)
        self.assertTrue(said)
        self.assertIn("--loads: needs numbers", self.plot("--loads", "a", "sweep.lines.dat", status=1)[1])

    def test_stresses(self):
        for words, complaint in ((("--variable", "stress_ab", "stress.stress_section.dat"), "no stress 'stress_ab'"),
                                 (("--variable", "foo", "auto.map.dat"), "no variable 'foo'; there are regions"),
                                 (("--variable", "regions", "auto.lines.dat"), "no variables to choose from"),
                                 (("--depths", "4", "stress.stress_planes.dat"), "none of the depths 4"),
                                 (("--body", "2", "stress.stress_line.dat"), "no stresses of body 2"),
                                 (("--body", "2", "stress.stress_largest.dat"), "no stresses of body 2")):
            self.assertIn(complaint, self.plot(*words, status=3)[1])
        self.assertIn("--body: invalid choice", self.plot("--body", "3", "stress.stress_line.dat", status=1)[1])

    def test_the_interface(self):
        """Blocks of loads and tangential loads have names, in both formats, and what is left out is said."""
        self.run_deck("array", DECKS["slip"].replace("map_points", "map_format = 'npy', map_points")
                      .replace("0.1, 0.3", "0.1, 0.2, 0.3") + "\n")
        for table in "slip.slip_loop.dat", "slip.slip_map.dat":
            self.assertIn("load 2, Q/(f p̄) = 0.2", self.drawn(table))
            self.assertNotIn("load 2, ", self.drawn("--loads", "1", table))
            self.assertIn("none of the loads 9", self.plot("--loads", "9", table, status=3)[1])
        self.assertIn("4 of its 6 loads and tangential", self.plot("--format", "svg", "array.slip_map.npy")[1])
        self.assertRegex(self.drawn("--loads", "2", "array.slip_map.npy"), "load 2, .* = 0.2.*slips.*sticks.* = 0.6")

    def test_free_edges(self):
        # Each of the three quantities has a bar at both loads.
        self.drawn("free.summary.dat")
        text = (self.folder/"free.summary.svg").read_text(encoding="utf-8")
        paths = " ".join(re.findall(r"<path stroke='rgb\(  0, 101, 163\)'\s+d='([^']*)'", text))
        self.assertEqual(6, len(re.findall(r"M([\d.]+),[\d.]+ L\1,", paths)))
        self.run_deck("hertz", DECKS["free"].replace("spots = t", "theory = t") + "\n")
        self.assertIn("no loads over p*", self.plot("hertz.theory.dat", status=3)[1])
        # Beside others it is left out.
        said, complaints = self.plot("hertz.theory.dat", "hertz.summary.dat")
        self.assertEqual("picture: hertz.summary.png\n", said)
        self.assertIn("no loads over p*", complaints)

    def test_all_loads_are_on_the_axis_of_adhesion(self):
        """The loads in full contact too. Numbers along it are so few that they have room."""
        self.run_deck("full", "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0, 3 /\n"
                      "&interface work_of_adhesion = 0.02 /\n")
        shown = self.drawn("full.adhesion.dat")
        self.assertIn(" 2.5 3 ", shown)
        self.assertIn(" 0 1 2 3 ", shown)

    def test_fields_with_adhesion(self):
        """They stand beside the summary and edges with adhesion; contact is where the gap is closed, under tension too;
        a load that is separated is left out, which is said; a load of 0 is 0."""
        self.run_deck("sticky", "&scene pressure_unit = 'MPa', length_unit = 'um' /\n"
                      "&surface kind = 'wave_2d', amplitude = 0.01, wavelength = 1 /\n&material e_star = 1000 /\n"
                      "&load mean_pressure = -1, 0, 10, 30 /\n&interface work_of_adhesion = 0.02 /\n"
                      "&stress nu = 0.3, line = t, planes = t, depths = 0.05 /\n"
                      "&output map = t, contours = t, lines = t, map_format = 'npy', map_points = 16 /\n")
        for adhesive, family in enumerate(("", "adhesion_")):
            table = Table(self.folder/f"sticky.{family}lines.dat")
            self.assertEqual((adhesive, family), (table.adhesive, table.family))
            self.assertEqual([True, bool(adhesive)], [table.is_contact(pressure, 0.0) for pressure in (1.0, -1.0)])
        for kind in "map.npy", "lines.dat", "stress_line.dat", "stress_planes.npy":
            name = f"sticky.adhesion_{kind}"
            said, complaints = self.plot("--format", "svg", name)
            self.assertEqual(f"picture: {name[:-4]}.svg\n", said)
            self.assertEqual(f"plot: {name}: load 1 has no numbers and is not shown\n", complaints)
            shown = self.drawn("--loads", "2,3,4", name)
            self.assertIn("p̄ = 0 MPa", shown)
            self.assertNotRegex(shown, "nan|NaN|−1 MPa")
            if kind.endswith("npy"):
                text = (self.folder/f"{name[:-4]}.svg").read_text(encoding="utf-8")
                self.assertIn(f"stroke='{OUTLINE}'", text)
        self.assertRegex(self.drawn("--loads", "4", "sticky.adhesion_map.npy"), r"−60 .*pressure p \[MPa\]")
        self.assertIn(" 10 mean pressure", self.drawn("sticky.adhesion_contour.dat"))
        shown = self.drawn("sticky.adhesion.dat")
        self.assertEqual((2, 0), (shown.count("p̄ [MPa]"), shown.count("p̄/p*")))
        with_numpy = subprocess.run([sys.executable, "-c", "import numpy"], capture_output=True, check=False)
        if with_numpy.returncode == 0:
            self.assertNotIn("gap", self.drawn("--loads", "4", "--variable", "regions", "sticky.adhesion_map.npy"))
        (self.folder/"bad").mkdir(exist_ok=True)
        shutil.copy(self.folder/"sticky.adhesion_map.npy", self.folder/"bad"/"alone.adhesion_map.npy")
        self.assertIn("load 2", self.drawn("--loads", "2,3", "bad/alone.adhesion_map.npy"))
        self.assertIn("need the summary",
                      self.plot("--variable", "regions", "bad/alone.adhesion_map.npy", status=3)[1])

    def test_contacts_without_adhesion_say_so(self):
        """In decks with adhesion. A map in numpy's format takes the head of the summary. A long title is cut before."""
        long = f"&scene title = '{'A long title ' * 15}' /\n"
        self.run_deck("both", long + WAVE + "&interface work_of_adhesion = 0.05 /\n"
                      "&output map = t, lines = t, map_format = 'npy', map_points = 16, height = t /\n")
        for name, is_said in (("summary.dat", True), ("interface.dat", True), ("lines.dat", True), ("map.npy", True),
                              ("adhesion.dat", False), ("adhesion_lines.dat", False), ("adhesion_map.npy", False),
                              ("height.npy", False)):
            with self.subTest(table=name):
                self.plot("--format", "svg", "--loads", "2", f"both.{name}")
                self.pictures[f"both.{name}",] = (self.folder/f"both.{name}").with_suffix(".svg")
                self.assertEqual(is_said, "… (contact without adhesion)" in self.drawn(f"both.{name}"))
        self.assertIn("without adhesion", self.drawn("--compare", "both.lines.dat", "auto.lines.dat"))
        self.assertNotIn("without adhesion", self.drawn("--compare", "both.lines.dat", "both.adhesion_lines.dat"))
        self.assertNotIn("without adhesion", self.drawn("auto.summary.dat"))

    def test_stresses_of_two_bodies(self):
        for name in ("bodies.stress_line.dat", "bodies.stress_section.dat", "bodies.stress_planes.npy"):
            self.assertIn("--body 2 shows the second", self.plot("--format", "svg", name)[1])
        # Loads, bodies and depths of both formats are the same.
        self.run_deck("bodies", DECKS["bodies"].replace("'npy'", "'text'") + "\n", output="bad")
        binary, text = (Table(self.folder/name) for name in ("bodies.stress_planes.npy", "bad/bodies.stress_planes.dat"))
        self.assertEqual([(block.load, block.body, block.columns["depth"][0]) for block in text.blocks],
                         [(block.load, block.body, block.columns["depth"][0]) for block in binary.blocks])
        self.assertEqual(2*2*9, len(binary.blocks))

    def test_depths_in_any_order(self):
        pictures = set()
        for folder, depths in ("rising", "0.1, 0.2, 0.4"), ("mixed", "0.4, 0.1, 0.2"):
            self.run_deck("depths", "&surface kind = 'wave_2d' / &load pbar_over_pstar = 0.2 /\n"
                          f"&stress nu = 0.3, line = t, depths = {depths} /\n", output=folder)
            self.plot("--format", "svg", f"{folder}/depths.stress_line.dat")
            pictures.add((self.folder/folder/"depths.stress_line.svg").read_bytes())
        self.assertEqual(1, len(pictures))

    def test_compared_stresses(self):
        for kind in ("line", "largest"):
            shown = self.drawn("--compare", f"stress.stress_{kind}.dat", f"stress.stress_{kind}.dat",
                               name=f"stress.stress_{kind}.compare.svg")
            self.assertIn("σvM/p*", shown)
        section = "stress.stress_section.dat"
        self.assertIn("can be compared", self.plot("--compare", section, section, status=3)[1])

    def test_files_that_are_no_tables(self):
        head = (self.folder/"auto.summary.dat").read_text().splitlines()[:7]
        contents = {"text.dat": b"Once upon a time.\n1 2 3\n", "numbers.dat": b"1 2 3\n4 5 6\n", "nothing.dat": b"",
                    "other.dat": b"# a\nx y\n1 2\n", "head.summary.dat": "\n".join(head).encode() + b"\n",
                    "raw.dat": bytes(range(256)), "array.npy": b"\x93NUMPY\x01\x00\x10\x00{'descr': '<f8'}"}
        for name, content in contents.items():
            (self.folder/"bad").mkdir(exist_ok=True)
            (self.folder/"bad"/name).write_bytes(content)
            with self.subTest(name=name):
                said, complaints = self.plot(f"bad/{name}", status=3)
                self.assertEqual("", said)
                self.assertRegex(complaints, rf"^plot: bad/{name}: .+\n$")
        self.assertIn("no rows", self.plot("bad/head.summary.dat", status=3)[1])
        self.assertEqual("plot: nowhere.dat: No such file or directory\n", self.plot("nowhere.dat", status=3)[1])
        self.plot("bad", status=3)
        for name in "bad/all.dat", "bad/all.csv":
            self.run_deck("auto", None, "--table", name)
            self.assertIn("draw their summaries", self.plot(name, status=3)[1])
        # Tables that have no picture say so, or whose picture shows the same.
        self.run_deck("tight", "&surface kind = 'wave_2d' /\n&load percolates = 'gap' /\n&output csv = t /\n")
        self.assertIn("has no picture: it is one load", self.plot("tight.percolation.dat", status=3)[1])
        self.assertIn("draw the .dat", self.plot("tight.summary.csv", status=3)[1])
        shortened = (self.folder/"npy.map.npy").read_bytes()[:-8]
        (self.folder/"bad"/"short.map.npy").write_bytes(shortened)
        self.assertIn("cut short", self.plot("bad/short.map.npy", status=3)[1])

    def test_other_tables_are_drawn_beside_a_bad_one(self):
        said, complaints = self.plot("nowhere.dat", "auto.summary.dat", status=3)
        self.assertEqual("picture: auto.summary.png\n", said)
        self.assertIn("nowhere.dat", complaints)

    def test_names_are_not_commands(self):
        names = ("a'b; touch CANARY.summary.dat", "$(touch CANARY) `touch CANARY`.lines.dat", "<x {-Bold_^.map.dat",
                 "a' . system('touch CANARY') . '.summary.dat", "| touch CANARY.lines.dat", "#!touch CANARY.map.dat",
                 "-e.summary.dat", "%s %d.lines.dat", "*?[a]~.map.dat")
        for name in names:
            shutil.copy(self.folder/("auto." + name.split(".")[-2] + ".dat"), self.folder/name)
        self.assertEqual("", self.plot("--", *names)[1])
        self.assertFalse((self.folder/"CANARY").exists())
        name = b"\xff.summary.dat"
        shutil.copy(self.folder/"auto.summary.dat", os.path.join(os.fsencode(self.folder), name))
        result = subprocess.run([ROOT/"scripts"/"plot", name], cwd=self.folder, capture_output=True, check=False)
        self.assertEqual((0, b"picture: \xff.summary.png\n", b""), (result.returncode, result.stdout, result.stderr))

    def test_command_line(self):
        self.assertIn("--compare", self.plot("--help")[0])
        for words in ("--help",), ("auto.summary.dat",):
            reader, writer = os.pipe()
            os.close(reader)
            done = subprocess.run([ROOT/"scripts"/"plot", *words], cwd=self.folder, stdout=writer,
                                  stderr=subprocess.PIPE, check=False)
            os.close(writer)
            self.assertEqual((3, b""), (done.returncode, done.stderr))
        (self.folder/"mine").write_text("#!/bin/sh\necho mine \"$2\"\n")
        (self.folder/"mine").chmod(0o755)
        done = self.run_plot("auto.summary.dat", variables={**os.environ, "PYTHON": "./mine"})
        self.assertEqual("mine auto.summary.dat\n", done.stdout)

    def test_options_without_effect_are_said(self):
        for words in ("--loads", "1"), ("--depths", "1"), ("--body", "2"):
            self.assertEqual(f"plot: auto.summary.dat: {words[0]} has no effect on this picture\n",
                             self.plot("--format", "svg", *words, "auto.summary.dat")[1])
        self.assertIn("--depths has no", self.plot("--format", "svg", "--depths", "1", "stress.stress_line.dat")[1])

    def test_a_variable_has_a_picture_of_its_own(self):
        for variable in (), ("--variable", "stress_xz"):
            name = "stress.stress_section" + ".".join(("", *variable[1:])) + ".svg"
            self.assertEqual(f"picture: {name}\n",
                             self.plot("--format", "svg", *variable, "stress.stress_section.dat")[0])

    def test_columns_of_tables_of_loads(self):
        """Any column of numbers is drawn against the mean pressure; of largest stresses those of one body."""
        shown = self.drawn("--variable", "elastic_energy", "si.summary.dat", name="si.summary.elastic_energy.svg")
        for words in "mean pressure p̄ [MPa]", "elastic_energy [10−6 N*m]":
            self.assertIn(words, shown)
        for table, column in (("auto.details", "perimeter"), ("auto.theory", "hertz_peak_pressure_over_pstar"),
                              ("auto.spots", "largest_spot_area_fraction"), ("slip.interface", "contact_stiffness"),
                              ("stress.stress_largest", "von_mises_depth"), ("bounded.bounds", "points_x"),
                              ("free.spots", "perimeter")):
            shown = self.drawn("--variable", column, f"{table}.dat", name=f"{table}.{column}.svg")
            self.assertIn(column, shown)
            self.assertIn("mean pressure p̄", shown)
        # The error of a column makes bars.
        self.drawn("--variable", "contact_area", "free.summary.dat")
        text = (self.folder/"free.summary.contact_area.svg").read_text(encoding="utf-8")
        paths = " ".join(re.findall(r"<path stroke='rgb\(  0, 101, 163\)'\s+d='([^']*)'", text))
        self.assertEqual(2, len(re.findall(r"M([\d.]+),[\d.]+ L\1,", paths)))
        of_body = []
        for body in "12":
            self.plot("--format", "svg", "--body", body, "--variable", "largest_shear", "bodies.stress_largest.dat")
            of_body.append((self.folder/"bodies.stress_largest.largest_shear.svg").read_text(encoding="utf-8"))
        self.assertNotEqual(*of_body)
        words = "--compare", "--variable", "residual", "auto.summary.dat", "paper.summary.dat"
        self.assertRegex(self.drawn(*words, name="auto.summary.residual.compare.svg"), "auto.*paper|paper.*auto")
        for column, complaint in (("status", "has no number"), ("foo", "is not there; those with numbers are load, pbar"),
                                  ("percolation_over_pstar_error", "has no number")):
            self.assertIn(f"--variable {column}: this column {complaint}",
                          self.plot("--variable", column, "auto.summary.dat", status=3)[1])
        self.assertIn("its units differ, N*m and pressure*length^2*length", self.plot(
            "--compare", "--variable", "elastic_energy", "si.summary.dat", "auto.summary.dat", status=3)[1])

    def test_words_of_the_command_line(self):
        for words in ((), ("--format", "gif", "a"), ("--format",), ("--what", "a")):
            self.assertIn("usage: scripts/plot", self.plot(*words, status=1)[1])


def lightness(colour):
    """CIE's lightness of a colour, 0 to 100; colour: rrggbb."""
    parts = [int(colour[k:k + 2], 16)/255 for k in (0, 2, 4)]
    red, green, blue = [part/12.92 if part <= 0.04045 else ((part + 0.055)/1.055)**2.4 for part in parts]
    return 116*(0.2126*red + 0.7152*green + 0.0722*blue)**(1/3) - 16


class Numbers(unittest.TestCase):
    def test_axes_are_those_of_the_data(self):
        for loads in ([1e-4, 2e-4, 3e-4], [50.0, 200.0, 900.0], [0.2], [0.0, 0.0], []):
            low, high, step, wide = axis(loads)
            self.assertFalse(wide)
            self.assertLess(low, high)
            self.assertTrue(all(low <= load <= high for load in loads))
            self.assertLessEqual((high - low)/step, 8)
            if max(loads, default=0) > 0:
                self.assertLess(high, 1.4*max(loads))
        self.assertEqual(1.0, axis([0.01, 0.9], up_to=1.0)[1])
        # Tics of nearly equal numbers do not read alike, and a single one does not lie at an end.
        self.assertEqual(0.0, axis([0.99999*0.78, 0.78])[0])
        # Nor are they longer than the margins have room for.
        for low, high in ((0.2417, 0.24195), (0.0199, 0.0201), (0.96203, 0.96309), (4990.0, 5000.0)):
            start, end, step, _ = axis([low, high])
            self.assertLess(start, low)
            self.assertLessEqual(max(len(f"{k*step:g}") for k in range(round(start/step), round(end/step) + 1)), 6)
        # Many light loads: logarithmic; loads distributed over the range are not.
        self.assertTrue(axis([1e-6, 1e-5, 1e-4, 1e-3])[-1])
        self.assertFalse(axis([1e-3, 0.2, 0.5, 0.9])[-1])

    def test_scales(self):
        self.assertEqual(("GPa", 1e-9), (Scale(2e9, "Pa").unit, Scale(2e9, "Pa").factor))
        # The largest number is 1 to 1000.
        for most, unit, shown in ((5e-7, "m", "nm"), (1.2e-6, "m", "µm"), (0.24, "mm", "µm"), (0.27, "GPa", "MPa"),
                                  (0.9999, "mm", "mm"), (750, "MPa", "MPa"), (2000, "GPa", "GPa"), (2e5, "Pa", "kPa")):
            self.assertEqual(shown, Scale(most, unit).unit)
        self.assertEqual(("ksi", 3), (Scale(2e4, "ksi").unit, Scale(2e4, "ksi").power))
        self.assertEqual("N/mm^{2}", marked_up("N/mm^2"))
        self.assertEqual("p = 0.2 GPa", Scale(2e9, "Pa").value("p", 0.2))
        self.assertEqual("p = 10^{−5}", Scale(1.0).value("p", 1e-5))

    def test_colour_maps_read_in_grey(self):
        """Equal steps of a number are equal steps of lightness, within a fifth of them."""
        maps = re.findall(r'set palette defined \((.*?)\)"', (ROOT/"scripts/figure_style.gp").read_text(), re.S)
        self.assertEqual(5, len(maps))
        for colours in maps:
            stops = [(float(number), lightness(colour)) for number, colour in re.findall(r"(-?\d+) '#(\w+)'", colours)]
            slopes = [(second[1] - first[1])/(second[0] - first[0]) for first, second in zip(stops, stops[1:])]
            for slope in slopes:
                self.assertAlmostEqual(1.0, slope/(sum(slopes)/len(slopes)), delta=0.2)
        for picture in list((ROOT/"scripts").glob("*.sh")) + list((ROOT/"scripts/pictures").glob("*.py")):
            if picture.name != "fig09.sh":   # contact and gap alone
                self.assertNotIn("set palette defined", picture.read_text())

    def test_titles_fit(self):
        self.assertEqual(("case", 15.0), fitted("case", "", 430))
        self.assertEqual(("Case", 15.0), fitted("case", "Case", 430))
        self.assertEqual(("case: Steel", 15.0), fitted("case", "Steel", 430))
        words, size = fitted("case", "x"*70, 430)
        self.assertEqual("x"*70, words)
        self.assertTrue(10 < size < 15)
        words, size = fitted("case", "x"*200, 430)
        self.assertEqual(10.0, size)
        self.assertRegex(words, "^x{80,95}…$")

    def test_chosen_loads(self):
        self.assertEqual([0, 1, 2], chosen(3, 4))
        self.assertEqual([0, 6, 12, 18], chosen(19, 4))

    def test_cells_are_closed(self):
        """What gnuplot draws of a map ends with the first column and row, a period on, wherever the points lie."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)/"x.map.dat"
            for offset in (0.0, 0.5):
                rows = "".join(f"1 {(i + offset)/4} {2*(j + offset)/3} {10*i + j} {i - j} 0 0\n"
                               for j in range(3) for i in range(4))
                path.write_text("# surface: file, Delta[length] = 1, cell_x[length] = 1, cell_y[length] = 2\n"
                                "load x y pressure gap displacement undeformed_gap\n" + rows)
                records, columns, count = fields.closed(Table(path), 0, lambda *numbers: numbers)
                self.assertEqual((5, 4), (columns, count))
                numbers = [number for record in records for number in record]
                points = [numbers[4*k:4*k + 4] for k in range(20)]
                self.assertEqual([1 + offset/4, 2*offset/3, 0.0, 0.0], points[4])
                self.assertEqual([offset/4, 2 + 2*offset/3, 0.0, 0.0], points[15])
                self.assertEqual([1 + (0 + offset)/4, 2*(1 + offset)/3, 1.0, -1.0], points[9])

    def test_sections_are_resampled(self):
        """Depths that are unequally spaced, in any order, become equally spaced ones."""
        rows = {0.0: (1.0, 2.0), 0.1: (3.0, 4.0), 0.4: (9.0, 1.0)}
        block = {"distance": [], "depth": [], "von_mises": []}
        for depth in (0.1, 0.0, 0.4):
            for distance, value in zip((0.0, 0.5), rows[depth]):
                for name, number in (("distance", distance), ("depth", depth), ("von_mises", value)):
                    block[name].append(number)
        records, columns, count = stresses.resampled(block, "von_mises", 1.0, 1.0)
        numbers = [number for record in records for number in record]
        self.assertEqual((2, 2*3*count), (columns, len(numbers)))
        for k in range(0, len(numbers), 3):
            distance, depth, value = numbers[k:k + 3]
            i, (low, high) = int(2*distance), (0.0, 0.1) if depth < 0.1 else (0.1, 0.4)
            expected = rows[low][i] + (rows[high][i] - rows[low][i])*(depth - low)/(high - low)
            self.assertAlmostEqual(expected, value, delta=1e-12)
        self.assertEqual([0.5, 0.4, 1.0], [round(number, 12) for number in numbers[-3:]])

    def test_a_table_needs_names(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)/"old.summary.dat"
            path.write_text("# pbar_over_pstar[-] status[-]\n0.1 converged\n")
            with self.assertRaises(NotATable):
                Table(path)


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        skip("gnuplot is not installed")
    main()
