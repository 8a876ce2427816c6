#!/usr/bin/env python3
"""No figure is cut off on a machine whose only faces are DejaVu's, which are wider than Times; figures follow their
decks.

usage: test_figures.py --program WAVYCON [unittest's options]

The long test, Figures.every_figure_in_every_format, runs only if it is named.
"""
import html
import os
import pathlib
import re
import shutil
import subprocess

from ink import dejavu_alone, inked_borders
from program import ProgramTest, main, skip

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMATS = "png", "svg", "pdf"


class Figures(ProgramTest):

    @classmethod
    def setUpClass(cls):
        """The scripts write into the tree that they stand in: a copy of it."""
        super().setUpClass()
        for name in "scripts", "inputs", "outputs/reference":
            shutil.copytree(ROOT/name, cls.folder/name)
        # Without DejaVu the machine's own faces are tried.
        cls.variables = {**(dejavu_alone(cls.folder) or os.environ), "WAVYCON": cls.program}

    def check(self, *figures, formats=("png",)):
        for figure in figures:
            for form in formats:
                # The tables of the first format are drawn again in the others: no program runs, but for times.
                draws_again = form != formats[0] and figure != "bounds"
                variables = {**self.variables, "WAVYCON": "true"} if draws_again else self.variables
                with self.subTest(figure=figure, format=form):
                    done = subprocess.run([self.folder/"scripts"/f"{figure}.sh", "--format", form], env=variables,
                                          capture_output=True, text=True, check=False)
                    self.assertEqual((0, ""), (done.returncode, done.stderr))
                    picture = pathlib.Path(done.stdout.strip())
                    self.assertEqual(self.folder/"outputs"/"figures"/f"{figure}.{form}", picture)
                    if form == "png":
                        self.assertEqual([], inked_borders(picture))

    def test_some(self):
        self.check("fig03", "fig04")

    def changed(self, figure, *changes):
        """The words of a figure whose decks are changed. changes: a deck, a pattern and what replaces it."""
        kept = {}
        for deck, pattern, new in changes:
            path = self.folder/"inputs"/f"{deck}.nml"
            kept.setdefault(path, path.read_text(encoding="utf-8"))
            text, count = re.subn(pattern, new, path.read_text(encoding="utf-8"))
            self.assertEqual(1, count)
            path.write_text(text, encoding="utf-8")
        self.check(figure, formats=("svg",))
        for path, text in kept.items():
            path.write_text(text, encoding="utf-8")
        picture = (self.folder/"outputs"/"figures"/f"{figure}.svg").read_text(encoding="utf-8")
        return re.sub(r"\s+", " ", html.unescape(re.sub(r"<title>.*?</title>|<[^>]*>", "", picture)))

    def test_loads_are_those_of_the_deck(self):
        loads = r"(pbar_over_pstar =).*"
        for figure, new, words in (("fig02", "0.25, 0.5, 0.95", (" 0.25 ", "p̄/p* = 0.95 ", "Dundurs et al., 0.5 ")),
                                   ("fig05", "0.25, 0.95", (" 0.25 ", "p̄/p* = 0.95 ")),
                                   ("fig06", "0.15, 0.95", ("0.15 to 0.95 ", "(23) at 0.15, (24) at 0.95 ")),
                                   ("fig06", "0.5", ("(23) at 0.5,",))):
            shown = self.changed(figure, (figure, loads, rf"\1 {new}"))
            for some in words:
                with self.subTest(figure=figure, words=some):
                    self.assertIn(some, shown)

    def test_grey_curves_are_of_the_same_loads(self):
        loads = r"(pbar_over_pstar =).*"
        for new, is_grey in ("0.5, 0.95", True), ("0.25, 0.95", False):
            shown = self.changed("fig05", ("fig05", loads, rf"\1 {new}"))
            self.assertEqual(is_grey, "to the 60th" in shown)
            picture = (self.folder/"outputs"/"figures"/"fig05.svg").read_text(encoding="utf-8")
            # A curve in either panel, and the line of the key.
            self.assertEqual(3*is_grey, len(re.findall(r"<path stroke='rgb\(140, 140, 140\)'", picture)))

    def test_places_are_over_the_wavelength(self):
        """The pictures of a wave of other lengths are the same."""
        for figure in "fig01", "fig02", "fig04", "fig05", "fig06", "figA1":
            decks = sorted(path.stem for path in (self.folder/"inputs").glob(f"{figure}*.nml"))
            picture = self.folder/"outputs"/"figures"/f"{figure}.svg"
            self.check(figure, formats=("svg",))
            of_unit_wave = picture.read_text(encoding="utf-8")
            self.changed(figure, *((deck, "(?=kind = 'wave_)", "amplitude = 0.5, wavelength = 4, ") for deck in decks))
            with self.subTest(figure=figure):
                self.assertEqual(of_unit_wave, picture.read_text(encoding="utf-8"))

    def every_figure_in_every_format(self):
        figures = re.search("^for figure in (.*); do", (ROOT/"scripts"/"figures").read_text(encoding="utf-8"), re.M)[1]
        self.check(*figures.split(), formats=FORMATS)


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        skip("gnuplot is not installed")
    main()
