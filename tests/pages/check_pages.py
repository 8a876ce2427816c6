#!/usr/bin/env python3
"""The pages agree with the program: links, formulas, decks, keys, columns, and logs that are shown.

usage: check_pages.py --program WAVYCON

A block fenced as ```fortran in a page of DECK_PAGES is a whole deck. Each check is also shown a page with a mistake.
"""
import pathlib
import re
import subprocess

from program import ProgramTest, main
from tables import Table

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK_PAGES = ("README.md", "inputs/README.md", "inputs/surfaces.md", "outputs/README.md")
# Headings of outputs/README.md, each with the table that it explains.
SECTIONS = {"summary": "The summary", "lines": "Lines", "theory_lines": "Closed forms along lines", "map": "Map",
            "contour": "Contours", "spots": "Spots", "spot_sizes": "Spot sizes", "percolation": "Percolation",
            "histogram": "Histograms",
            "coefficients": "Coefficients", "theory": "Theory", "details": "Details", "spectrum": "Power spectrum",
            "stress_largest": "Largest stresses", "stress_line": "Stresses below the crest",
            "stress_section": "Stresses on a section", "stress_planes": "Stresses on planes",
            "interface": "The interface", "partial_slip": "Partial slip", "slip_loop": "Loops", "slip_map": "Slip map",
            "adhesion": "Adhesion", "bounds": "Bounds"}
# Decks that together write every table, in both dimensions.
ALL_TABLES = ("lines = t, map = t, contours = t, spots = t, histograms = t, coefficients = t, theory = t, "
              "spectrum = t, bounds = t, line_points = 8, map_points = 8")
TABLE_DECKS = {
    "line": "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.5 /\n&method solver = 'beale' /\n"
            f"&output {ALL_TABLES} /\n",
    "plane": f"&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.5 /\n&method solver = 'beale' /\n"
             f"&output {ALL_TABLES} /\n",
    "expansion": "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.5 /\n"
                 "&method solver = 'fitted' /\n&output details = t /\n",
    "percolation": "&surface kind = 'wave_2d' /\n&load percolates = 'gap' /\n&method solver = 'fitted' /\n",
    "stresses": "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.5 /\n&method solver = 'auto' /\n"
                "&stress nu = 0.3, line = t, section = 'x', planes = t, depths = 0, 0.1 /\n&output map_points = 8 /\n",
    **{f"interface_{dimension}": f"&surface kind = 'wave_{dimension}' /\n&load pbar_over_pstar = 0.5 /\n"
       "&method solver = 'auto', accuracy = 1e-2 /\n&output map_points = 8 /\n"
       "&interface friction = 1, tangential_load = 0.1, nu = 0.3, slip_loop = t, slip_map = t, work_of_adhesion = 0.1 /\n"
       for dimension in ("1d", "2d")}}
# The number of a formula, and those of the appendix of [JGH], which src/paper cites as its own page does.
NUMBER = r"[A-Z]\d+[a-z]?"
APPENDIX = {f"A{number}" for number in range(1, 11)}
# Columns of the log that rounding may change.
ROUNDED = ("error",)


def read(page):
    return (ROOT/page).read_text(encoding="utf-8")


def pages():
    """Every page of the tree, builds and results of runs aside, which other tests write and remove meanwhile."""
    tops = [path for path in sorted(ROOT.iterdir()) if not re.match(r"build|\.|outputs", path.name)]
    found = [path for top in tops for path in ([top] if top.suffix == ".md" else sorted(top.rglob("*.md")))]
    return found + [ROOT/"outputs/README.md", *sorted((ROOT/"outputs/gallery").glob("*.md")),
                    *sorted((ROOT/".github").rglob("*.md"))]


def without_fences(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(text):
    """The names that GitHub gives to the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", without_fences(text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(path, text):
    broken = []
    for target in re.findall(r"\]\(([^)\s]+)\)", without_fences(text)):
        if re.match(r"[a-z]+:", target):
            continue
        place, _, anchor = target.partition("#")
        file = path.parent/place if place else path
        if not file.exists() or (anchor and anchor not in anchors(text if not place else file.read_text("utf-8"))):
            broken.append(target)
    return broken


def faults_of_formulas(text):
    """The formulas between dollar signs that some reader of Markdown would not draw."""
    text = re.sub(r"`[^`]*`|^    .*$", "", without_fences(text), flags=re.MULTILINE)
    parts = text.split("$$")
    displays, prose = parts[1::2], parts[0::2]
    faults = [] if len(parts) % 2 else ["$$ is not closed"]
    inline = []
    for line in "\n".join(prose).splitlines():
        if line.count("$") % 2:
            faults.append(line)
        inline += re.findall(r"\$([^$]*)\$", line)
    for formula in inline + displays:
        if any(formula.count(first) != formula.count(last)
               for first, last in (("{", "}"), (r"\left", r"\right"), (r"\begin", r"\end"))):
            faults.append(formula)
    # Markdown takes a backslash before a sign, the mark of a list, and a blank line for its own.
    faults += [formula for formula in inline if re.search(r"\\[^A-Za-z]", formula)]
    faults += [formula for formula in displays
               if re.search(r"^\s*([-+*>#]|\d+[.)])\s|\n\s*\n|\\[^A-Za-z\\\s]", formula, re.MULTILINE)]
    # Not all draw a displayed formula in a list.
    faults += re.findall(r"^ +\$\$", text, re.MULTILINE)
    # Some take what stands in parentheses after a formula for its number.
    return faults + [after for after in prose[1:] if re.match(r"\s*\(", after)]


def numbers_of_formulas(text):
    """The numbers that the formulas of a page bear: as tags, in a line of code, or after a sentence or blanks."""
    return {number for place in (r"\\tag\{%s\}", r"^ {4}.*\(%s\)", r"(?:[.)]| ) \(%s\)")
            for number in re.findall(place % f"({NUMBER})", text, re.MULTILINE)}


def numbers_cited(text):
    return set(re.findall(r"\(([ACEFGIMQS]\d+[a-z]?)\)", text))


def decks(text):
    return re.findall(r"^```fortran\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def section(text, heading):
    """What stands below a heading of the second level."""
    found = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found[1] if found else ""


def explained_columns(text):
    """{name: units} of the columns in a section's tables: names in the first cell, units in the second."""
    return {name: set(re.findall(r"`([^`]*)`", units)) or {units.strip()}
            for names, units in re.findall(r"^\| (`[^|]*?) \|([^|]*)\|", text, re.MULTILINE)
            for name in re.findall(r"`(\w+)`", names)}


def explained_statuses(text):
    """{status: code} in the rows with a number in the second cell."""
    return {name: int(code) for names, code in re.findall(r"^\| (`[^|]*?) \| (\d+) \|", text, re.MULTILINE)
            for name in re.findall(r"`(\w+)`", names)}


def statuses_of_sources():
    """{status: code} as the sources have them."""
    text = read("src/core/contact/solution_record.f90")
    codes = {name: int(code) for line in re.findall(r"integer, parameter, public :: (.*)", text)
             for name, code in re.findall(r"(\w+) = (\d+)", line)}
    statuses = re.search(r"statuses\(\*\) = \[(.*?)\]\n", text, re.DOTALL)[1].replace("other_failure +", "")
    names = re.search(r"names\(\*\) = \[(.*?)\]\n", text, re.DOTALL)[1]
    return {name: codes.get(constant, codes["other_failure"])
            for constant, name in zip(re.findall(r"[a-z_]+", statuses), re.findall(r"'(\w+)'", names), strict=True)}


def named_keys(text):
    """The keys in the brief reference of inputs/README.md, where groups and values of keys are quoted too."""
    return set(re.findall(r"`(\w+)`", section(text, "Groups and keys")))


def keys_of_help(words):
    return set(re.findall(r"^   (\w+) {1,}\S", words[words.index("&scene"):], re.MULTILINE))


def comparable(log):
    """A log without version, times and what rounding may change."""
    lines, left_out = [], ()
    for line in log.splitlines():
        words = line.split()
        if re.match(r"wavycon \d|\[ *[\d.]+ s\]", line):
            continue
        if words[:1] == ["pbar/p*"]:
            left_out = [place for place, name in enumerate(words) if name in ROUNDED]
        elif words and not re.match(r"[\d.]", words[0]):
            left_out = ()
        lines.append([word for place, word in enumerate(words) if place not in left_out])
    return lines


class Pages(ProgramTest):
    def run_program(self, *arguments, folder=None):
        return subprocess.run([self.program, *map(str, arguments)], cwd=folder, capture_output=True, text=True)

    def test_links(self):
        self.assertIn(ROOT/"README.md", pages())
        for path in pages():
            self.assertEqual([], broken_links(path, path.read_text("utf-8")), path)

    def test_broken_links_are_found(self):
        text = "## A b\n[1](nowhere.md) [2](README.md) [3](#a-b) [4](#c) [5](README.md#citing) [6](README.md#d)"
        self.assertEqual(["nowhere.md", "#c", "README.md#d"], broken_links(ROOT/"README.md", text))

    def test_formulas(self):
        for path in pages():
            self.assertEqual([], faults_of_formulas(path.read_text("utf-8")), path)

    def test_faults_of_formulas_are_found(self):
        right = "$a_1$ and `$b` cost\n\n$$\nx = \\left( y \\right) \\\\\n\\tag{E1}\n$$\n\nfor\n\n    $(code)\n"
        self.assertEqual([], faults_of_formulas(right))
        for old, new in (("$a_1$", "$a_1"), ("$$\n\nfor", "\nfor"), ("a_1", "a_{1"), (r"\left", ""), ("a_1", r"a\,b"),
                         (r"\left", "+\n+ z \\left"), ("for", "(see) for"), (r"\tag", "\n\\tag"),
                         (r"\tag", r"\; \tag"), ("\n$$", "\n  $$")):
            self.assertNotEqual([], faults_of_formulas(right.replace(old, new, 1)), new)

    def test_numbers_of_formulas(self):
        """Each number of a formula that the sources cite stands on a page."""
        found = [number for path in sorted((ROOT/"src").rglob("README.md"))
                 for number in numbers_of_formulas(path.read_text("utf-8"))]
        self.assertGreater(len(found), 200)
        for path in sorted((ROOT/"src").rglob("*")):
            if path.suffix in (".f90", ".F90", ".inc", ".md", ".h", ".c", ".py"):
                self.assertEqual(set(), numbers_cited(path.read_text("utf-8")) - APPENDIX - set(found), path)

    def test_missing_numbers_are_found(self):
        self.assertEqual({"E1", "F12a"}, numbers_of_formulas("$$\nx \\tag{E1}\n$$\n    y = z   (F12a)\nas (E2) says"))
        self.assertEqual({"E2", "F12a"}, numbers_cited("by (E2) and (F12a), eq. (17)"))

    def test_decks(self):
        deck = self.folder/"deck.nml"
        for page in DECK_PAGES:
            self.assertGreater(len(decks(read(page))), 0, page)
            for text in decks(read(page)):
                deck.write_text(text)
                checked = self.run_program("--check", deck, folder=ROOT/"inputs")
                self.assertEqual(0, checked.returncode, f"{page}:\n{text}\n{checked.stderr}")

    def test_each_deck_of_inputs_is_listed(self):
        listed = section(read("inputs/README.md"), "The decks in this directory")
        for path in sorted((ROOT/"inputs").iterdir()):
            if path.suffix in (".nml", ".dat"):
                self.assertIn(f"`{path.name}`", listed)

    def columns(self):
        """{name: units} of the columns of each kind of table."""
        found = {kind: {} for kind in SECTIONS}
        for name, text in TABLE_DECKS.items():
            self.run_deck(name, text)
        for path in self.folder.glob("*.dat"):
            table = Table(path)
            for name, unit in zip(table.columns, table.units):
                found[path.name.split(".")[1]].setdefault(name, set()).add(unit)
        return found

    def test_columns(self):
        page = read("outputs/README.md")
        tables = {name for path in (ROOT/"src/program/report").glob("*tables.f90")
                  for name in re.findall(r"table_type\('(\w+)'", path.read_text(encoding="utf-8"))}
        # The heights have no columns but x, y and one more.
        self.assertEqual(tables - {"height"}, set(SECTIONS))
        for kind, columns in self.columns().items():
            self.assertGreater(len(columns), 0, kind)
            self.assertEqual(columns, explained_columns(section(page, SECTIONS[kind])), kind)

    def test_missing_columns_are_found(self):
        text = ("## Map\n| Column | Unit | Meaning |\n|---|---|---|\n| `x`, `y` | `length` | Like `z` |\n"
                "| `load` | - | |\n| `area` | `a^2`, in 1-D `a` | |\n## Lines\n| `p` | - | |\n")
        self.assertEqual({"x": {"length"}, "y": {"length"}, "load": {"-"}, "area": {"a^2", "a"}},
                         explained_columns(section(text, "Map")))

    def test_statuses(self):
        page = section(read("outputs/README.md"), "Statuses and exit statuses")
        self.assertGreater(len(statuses_of_sources()), 10)
        self.assertEqual(statuses_of_sources(), explained_statuses(page))
        self.assertNotEqual(statuses_of_sources(), explained_statuses(page.replace("| 10 |", "| 12 |")))

    def test_keys(self):
        keys = keys_of_help(self.run_program("--help").stdout)
        self.assertGreater(len(keys), 40)
        self.assertEqual(keys, named_keys(read("inputs/README.md")))

    def test_missing_keys_are_found(self):
        text = "## Groups and keys\n| `&surface` | `kind`: `'wave_1d'` (1.0) |\n## More\n`wavelength`\n"
        self.assertEqual({"kind"}, named_keys(text))

    def test_the_log_in_readme(self):
        text = read("README.md")
        shown = re.findall(r"^```\n(deck: .*?)^```$", text, re.MULTILINE | re.DOTALL)
        self.assertEqual(1, len(shown))
        (self.folder/"first.nml").write_text(decks(text)[0])
        log = self.run_program("first.nml", folder=self.folder).stdout
        self.assertEqual(comparable(log), comparable(shown[0]))
        self.assertNotEqual(comparable(log), comparable(shown[0].replace("0.045078", "0.045079")))

    def test_the_load_of_fitted(self):
        """The load that the page of fitted collocation follows: its log, and the areas of rising degrees."""
        text = section(read("src/core/fitted/README.md"), "One load, from the deck to its digits")
        deck, log = (re.findall(rf"^    {start}.*\n(?:    .*\n)+", text, re.MULTILINE)[0] for start in ("&", "pbar"))
        (self.folder/"one.nml").write_text(deck)
        printed = comparable(self.run_program("one.nml", folder=self.folder).stdout)
        for line in comparable(log):
            self.assertIn(line, printed)
        self.assertNotIn(comparable(log.replace("0.384749", "0.384748"))[1], printed)
        sweep = re.search(r"one.nml --sweep (\S+)", text)[1]
        self.assertEqual(0, self.run_program("one.nml", "--sweep", sweep, folder=self.folder).returncode)
        tables = [Table(path).records()[0] for path in self.folder.glob("outputs/one-*/*.details.dat")]
        self.assertEqual({row["degree"]: f"{float(row['contact_area_fraction']):.12f}" for row in tables},
                         dict(re.findall(r"^\| (\d+) .*\| (0\.\d{12}) \|", text, re.MULTILINE)))


if __name__ == "__main__":
    main()
