#!/usr/bin/env python3
"""The site: what is generated has all names, and what is wrong in it is found; Site makes the whole of it.

usage: test_site.py --program WAVYCON --package FOLDER --environment FOLDER [TEST]
"""
import os
import pathlib
import re
import subprocess
import sys

from check_pages import pages
from program import ProgramTest, main, skip, take_options
from virtual_environment import python_with

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT/"packaging/site"
sys.path.insert(0, str(SITE))
import make_site  # noqa: E402


class Parts(ProgramTest):
    def test_every_page_has_its_chapter(self):
        listed = [pathlib.Path(name) for names in make_site.CHAPTERS.values() for name in names]
        self.assertEqual(sorted(set(listed)), sorted(listed))
        forms = {ROOT/".github/pull_request_template.md", *(ROOT/".github/ISSUE_TEMPLATE").iterdir()}
        self.assertEqual({page.relative_to(ROOT) for page in set(pages()) - forms},
                         {page for page in listed if page.parts[0] != "reference"})

    def test_all_functions_of_c(self):
        header = (ROOT/"src/library/wavycon.h").read_text(encoding="utf-8")
        functions = re.findall(r"^\w[\w ]*?[ *](wavycon_\w+)\(", header, re.MULTILINE)
        self.assertGreater(len(functions), 15)
        self.assertEqual(set(), set(functions) - set(re.findall(r"^## (\w+)", make_site.c_page(), re.MULTILINE)))

    def test_names_of_fortran(self):
        page = make_site.fortran_page()
        for words in ("### fitted_contact", "#### solve_load", "#### open\n",
                      "function westergaard_pressure_over_pstar", "integer, parameter, public :: converged"):
            self.assertIn(words, page)
        self.assertNotIn(", private", page)
        # All names that are listed, and procedures of types by the names by which they are called.
        umbrella = re.sub(r"&\n\s*", "", (ROOT/"src/library/wavycon.f90").read_text(encoding="utf-8"))
        listed = set(re.findall(r"\w+", " ".join(re.findall(r", only: (.*)", umbrella))))
        headings = set(re.findall(r"\w+", " ".join(re.findall(r"^####? (.*)$", page, re.MULTILINE))))
        self.assertEqual({"revision", "version"}, listed - headings)   # the file is made by CMake
        self.assertLessEqual({"open", "solve_partial_contact", "grid_solved", "shall_stop"}, headings)
        self.assertEqual(1, page.count("symmetry_diagonal = 1"))

    def test_calls_of_the_page(self):
        """The arguments that the page of the library tells are those of the procedures."""
        text = (ROOT/"src/library/README.md").read_text(encoding="utf-8")
        calls = re.findall(r"`(?:session%)?(\w+)\((.*?)\)`", text[text.index("## In Fortran"):text.index("## In C\n")] +
                           text[text.index("A solver can be **stopped**"):])
        self.assertGreater(len(calls), 14)
        sources = "".join(file.read_text(encoding="utf-8") for name in ("library", "program/run", "core/contact")
                          for file in sorted((ROOT/"src"/name).glob("*.f90")))
        for name, arguments in calls:
            said = re.findall(r"\w+", arguments)
            of_type = {"open": "open_session"}.get(name, name)
            there = re.findall(rf"^ +(?:subroutine|logical function) {of_type}\((.*?)\)", sources,
                               re.MULTILINE | re.DOTALL)
            self.assertIn([word for word in said if word != "self"],
                          [[word for word in re.findall(r"\w+", one) if word != "self"] for one in there], name)

    def test_columns(self):
        page = make_site.columns_page()
        self.assertIn("| `mean_gap` | `length` | [The summary](../outputs/README.md#the-summary) |", page)
        self.assertGreater(len(page.splitlines()), 200)

    def test_faults_are_found(self):
        page = self.folder/"page.html"
        page.write_text('<a href="#a">1</a><p id="a"><a href="page.html#b">2</a><a href="no.html">3</a>'
                        '<a href="https://x.org">4</a><script src="https://x.org/x.js"></script>')
        found = [fault.partition(": ")[2] for fault in make_site.faults_of(self.folder)]
        self.assertEqual(["no page.html#b", "no no.html", "loads https://x.org/x.js"], found)


class Site(ProgramTest):
    package = python = ""

    def test_site(self):
        done = subprocess.run([self.python, SITE/"make_site.py", "--program", self.program, "--package", self.package,
                               "--output", self.folder], capture_output=True, text=True, check=False)
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        html = self.folder/"html"
        self.assertIn(r"\tag{F1}", (html/"src/core/fitted/README.html").read_text(encoding="utf-8"))
        self.assertIn("rms_slope", (html/"reference/python.html").read_text(encoding="utf-8"))
        self.assertTrue((html/"_static/mathjax/tex-chtml.js").is_file())


if __name__ == "__main__":
    options = take_options("package", "environment")
    if "Site" in sys.argv:
        needs = [line for line in (SITE/"requirements.txt").read_text().splitlines() if line[0] != "#"]
        Site.package = options.package
        Site.python = python_with(os.path.abspath(options.environment), needs, ["sphinx", "myst_parser", "furo", "numpy"])
        if not Site.python:
            skip(f"what draws the site cannot be installed; see {options.environment}.log")
    main()
