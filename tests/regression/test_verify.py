#!/usr/bin/env python3
"""The reference values as data to cite: their description and checksums, and scripts/verify, which compares other tables."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import unittest.mock

from program import ProgramTest, main
from tables import Table

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "outputs" / "reference"
PACKAGE = json.loads((REFERENCE / "datapackage.json").read_text(encoding="utf-8"))
LOADS = "0.1", "0.22860", "0.3", "0.9"


class Description(unittest.TestCase):
    def test_checksums(self):
        sums = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in REFERENCE.glob("*.dat")}
        lines = (REFERENCE / "SHA256SUMS").read_text(encoding="ascii").splitlines()
        self.assertEqual([f"{value}  {name}" for name, value in sorted(sums.items())], lines)

    def test_tables(self):
        self.assertEqual({path.name for path in REFERENCE.glob("*.dat")},
                         {resource["path"] for resource in PACKAGE["resources"]})
        self.assertIn(PACKAGE["version"], {resource["version"] for resource in PACKAGE["resources"]})
        for resource in PACKAGE["resources"]:
            table, fields = Table(REFERENCE / resource["path"]), resource["schema"]["fields"]
            self.assertEqual(table.columns, [field["name"] for field in fields])
            self.assertEqual(table.units, [field.get("unit", "-") for field in fields])
            text = table.path.read_text(encoding="utf-8")
            self.assertIn(f"wavycon {resource['version']} ", text)
            names, = resource["dialect"]["headerRows"]
            self.assertEqual(table.columns, text.splitlines()[names - 1].split())
            by_name = {field["name"]: field for field in fields}
            # Each error is that of one column, which stands before it, in the same unit.
            errors = {field["error"]: field for field in fields if "error" in field}
            self.assertEqual({name for name in by_name if name.endswith("_error")}, set(errors))
            for name, field in errors.items():
                self.assertEqual((name, by_name[name]["unit"]), (f"{field['name']}_error", field["unit"]))
            for record in table.records():
                for name, field in by_name.items():
                    if field["type"] != "string":
                        float(record[name])
                    self.assertIn(record[name], field.get("constraints", {}).get("enum", [record[name]]))
            if "primaryKey" in resource["schema"]:
                keys = [tuple(record[name] for name in resource["schema"]["primaryKey"]) for record in table.records()]
                self.assertEqual(len(keys), len(set(keys)))


class Verify(ProgramTest):
    script = ROOT / "scripts" / "verify"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.rows = [record for record in Table(REFERENCE / "wave_2d.dat").records()
                    if any(float(record["pbar_over_pstar"]) == float(load) for load in LOADS)]

    def verify(self, text, *words, status=0):
        """Compares a file with this text. Returns the output, or the message if the status is not 0 and there is one."""
        (self.folder / "mine.csv").write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, self.script, "mine.csv", *words], cwd=self.folder, text=True,
                              env=dict(os.environ, WAVYCON=self.program), capture_output=True, check=False)
        self.assertEqual(status, done.returncode, done.stdout + done.stderr)
        return done.stderr or done.stdout

    def areas(self, factor=1.0, digits=17):
        return "pbar_over_pstar,contact_area_fraction\n" + "".join(
            f"{row['pbar_over_pstar']},{factor*float(row['contact_area_fraction']):.{digits}g}\n" for row in self.rows)

    def test_every_table_agrees_with_itself(self):
        for count, resource in enumerate(PACKAGE["resources"]):
            table = Table(REFERENCE / resource["path"])
            text = table.path.read_text(encoding="utf-8")
            if count % 2:
                text = "\n".join(",".join(row) for row in (table.columns, *table.rows()))
            found = self.verify(text, resource["name"], "--tolerance", "0")
            self.assertIn(f"rows in both ({len(table.rows())})", found)
            self.assertNotIn("not in the", found)
            if resource["name"] == "adhesion":
                # Areas that are given find the row and are not compared.
                self.assertRegex(found, r"\ncontact_area_fraction  +98  ")

    def test_a_good_table(self):
        found = self.verify(self.areas(digits=7), "wave_2d")
        self.assertIn("\nrows by: pbar_over_pstar\ncompared: contact_area_fraction\n", found)
        self.assertIn("rows in both (4): 0.1, 0.2286, 0.3, 0.9\n", found)
        self.assertRegex(found, r"\ncontact_area_fraction     4  +\d\.\de-0[789]  +\d\.\de-0[789]  +4  ")
        self.assertIn("\nagrees within 1e-06", found)

    def test_an_error_of_a_thousandth(self):
        found = self.verify(self.areas(1.001), "wave_2d", status=1)
        self.assertRegex(found, r"\ncontact_area_fraction     4  +1\.0e-03  +1\.0e-03  +0  ")
        self.assertIn("\nDIFFERS by more than 1e-06 of the value and the reference's error: contact_area_fraction in 4 of 4",
                      found)
        self.verify(self.areas(1.001), "wave_2d", "--tolerance", "1.01e-3")

    def test_tolerances_by_quantity(self):
        """Each quantity has its own tolerance, in any order beside that of the others."""
        text = "pbar_over_pstar,contact_area_fraction,perimeter\n" + "".join(
            f"{row['pbar_over_pstar']},{1.001*float(row['contact_area_fraction'])!r},{1.00001*float(row['perimeter'])!r}\n"
            for row in self.rows)
        area, others = ["--tolerance", "contact_area_fraction=1.01e-3"], ["--tolerance", "1.01e-5"]
        for words in area + others, others + area:
            self.assertIn("\nagrees within 0.00101 (contact_area_fraction), 1.01e-05 (perimeter) of the value",
                          self.verify(text, "wave_2d", *words))
        for words, name in ((area, "perimeter"), (others, "contact_area_fraction")):
            found = self.verify(text, "wave_2d", *words, status=1)
            self.assertRegex(found, rf"(?s)\nDIFFERS by more than .* error:\s{name} in [34] of 4 rows\n$")
        for word, message in (("mean_gap=1", "there is no quantity 'mean_gap' in wave_2d; did you mean "
                               "'mean_gap_over_amplitude'?"), ("contact_aera_fraction=1", "'contact_area_fraction'?"),
                              ("pbar_over_pstar=1", "There are mean_gap_over_amplitude, "), ("perimeter=", "'' is no "),
                              ("-1", "'-1' is no number that is 0 or more"), ("nan", "'nan' is no"), ("inf", "is no")):
            self.assertIn(message, self.verify(text, "wave_2d", "--tolerance", word, status=1))

    def test_loads(self):
        # One that is the same within 1e-9, one that is not, and one between.
        area = self.rows[0]["contact_area_fraction"]
        found = self.verify(f"# P in p*\n# pbar_over_pstar[-] contact_area_fraction[-] note\n0.10000000005 {area} a\n"
                            f"0.1000000002 {area} b\n0.123D0 {area} c\n", "wave_2d")
        self.assertIn("rows in both (1): 0.10000000005\n", found)
        self.assertIn("rows not in the reference (2): 0.1000000002 (line 4), 0.123D0 (line 5)\n", found)
        self.assertIn("not compared: note\n", found)

    def test_loads_that_are_solved(self):
        for row, factor in ((self.rows[2], 1.0), (self.rows[2], 1 + 3e-6)):
            # The area at a load beside that of the row, by its slope, whose change is below the tolerance.
            slope = next(float(record["contact_area_slope"]) for record in Table(REFERENCE / "interface.dat").records()
                         if (record["surface"], record["pbar_over_pstar"]) == ("wave_2d", row["pbar_over_pstar"]))
            load, area = (float(row[name]) for name in ("pbar_over_pstar", "contact_area_fraction"))
            found = self.verify(f"pbar_over_pstar,contact_area_fraction\n{load + 1e-6},{factor*(area + 1e-6*slope)}\n",
                                "wave_2d", "--solve", status=int(factor > 1))
            self.assertIn(f"\nsolved now (1): {load + 1e-6}\n", found)
            self.assertIn(f"\nrows in both (1): {load + 1e-6}\n", found)
        with unittest.mock.patch.object(type(self), "program", shutil.which("false")):
            self.assertIn("verify: the loads that the reference lacks are not solved:\n",
                          self.verify("pbar_over_pstar,perimeter\n0.123,1\n", "wave_2d", "--solve", status=1))
            for load in "-1", "1.5", "inf":
                found = self.verify(f"pbar_over_pstar,perimeter\n0.123,1\n{load},1\n", "wave_2d", "--solve", status=1)
                self.assertEqual(f"verify: mine.csv:3: the load {load} is not between 0 and 1, and --solve cannot "
                                 "solve it\n", found)
        self.assertIn("--solve needs the program wavycon, and the table wave_2d or hexagonal", self.verify(
            "surface,pbar_over_pstar,compliance\nwave_2d,0.123,1\n", "interface", "--solve", status=1))

    def test_rows_of_other_surfaces(self):
        """A collected table of wavycon has rows of any surface: those of others are not compared, nor solved."""
        row = self.rows[0]
        load, area = row["pbar_over_pstar"], row["contact_area_fraction"]
        text = (f"surface_kind,pbar_over_pstar,contact_area_fraction\nwave_2d,{load},{area}\n"
                f"hexagonal,{load},0.5\nhexagonal,0.123,0.5\n")
        for options in [], ["--solve"]:
            found = self.verify(text, "wave_2d", *options)
            self.assertIn(f"rows in both (1): {load}\n", found)
            self.assertIn(f"rows not in the reference (2): {load} (line 3), 0.123 (line 4)\n", found)
            self.assertNotIn("solved now", found)

    def test_rows_of_adhesion(self):
        """Rows without contact have no branch, and are not in the reference; those of the curve are found by their area."""
        names = "surface", "w_over_pstar_amplitude", "branch", "point", "contact_area_fraction", "pbar_over_pstar"
        record = next(record for record in Table(REFERENCE / "adhesion.dat").records() if record["branch"] == "spots")
        words = [record[name] for name in names]
        curve, separated = [*words[:3], "stable", *words[4:]], [*words[:2], "none", "separated", "0", "0"]

        def text(*rows):
            return "\n".join(map(",".join, (names, *rows))) + "\n"

        found = self.verify(text(curve, separated), "adhesion")
        self.assertIn(f"rows in both (1): {'/'.join([*words[:3], words[4]])}\n", found)
        self.assertIn("rows not in the reference (1): ", found)
        # In other columns of words there is no such row.
        self.assertIn("mine.csv:3: 'none' in the column 'surface' is none of wave_2d, hexagonal",
                      self.verify(text(curve, ["none", *separated[1:]]), "adhesion", status=1))

    def test_decimal_commas(self):
        text = self.areas().replace(",", ";").replace(".", ",")
        self.assertIn(",", text)
        self.assertEqual(self.verify(self.areas(), "wave_2d"), self.verify(text, "wave_2d"))

    def test_a_column_for_all_rows(self):
        record, = (record for record in Table(REFERENCE / "yield.dat").records()
                   if tuple(record.values())[:4] == ("hexagonal", "constrained", "0.5", "0.3"))
        name = "largest_von_mises_over_pstar"
        text = f"pbar_over_pstar;{name}\n0.5;{record[name]}\n1.0;\n"
        given = "surface=hexagonal", "lateral=constrained", "nu=0.3"
        self.assertIn("without a number in one of both: 1\n", self.verify(text, "yield", *given))
        self.assertIn("'cubic' in the column 'surface' is none of wave_2d, rectangular, hexagonal",
                      self.verify(text, "yield", "surface=cubic", *given[1:], status=1))
        self.assertIn("there is no column 'surface'. The columns are pbar_over_pstar, largest",
                      self.verify(text, "yield", status=1))

    def test_mistakes(self):
        for text, table, message in (
                (self.areas(), "wave2d", "there is no table 'wave2d'; did you mean 'wave_2d'? There are wave_2d, "),
                ("pbar_over_p,contact_area_fraction\n0.1,1\n", "wave_2d", "mine.csv: there is no column 'pbar_over_pstar'; "
                 "did you mean 'pbar_over_p'? The columns are pbar_over_p, contact_area_fraction."),
                ("pbar_over_pstar,area\n0.1,1\n", "wave_2d", "there is no quantity of wave_2d, which are mean_gap_over"),
                ("pbar_over_pstar,perimeter\n0.1,1\n0.2,long\n", "wave_2d",
                 "mine.csv:3: 'long' in the column 'perimeter' is not a number"),
                ("pbar_over_pstar,perimeter\n,1\n", "wave_2d", "mine.csv:2: '' in the column 'pbar_over_pstar' is not a"),
                ("pbar_over_pstar perimeter\n0.1\n", "wave_2d", "mine.csv:2: 1 words, but there are 2 columns\n"),
                ("pbar_over_pstar,perimeter\n0,1,1,5\n", "wave_2d", "mine.csv:2: 4 words, but there are 2 columns; "
                 "beside numbers with decimal commas columns are separated by ';'\n"),
                ("perimeter,pbar_over_pstar,perimeter\n", "wave_2d", "there are several columns 'perimeter'"),
                ("P,area\n0.1,1\n", "wave_2d", "Columns are found by their names, and may be renamed, such as P to"),
                ("\n", "wave_2d", "mine.csv: the file is empty"),
                ("# nothing\n", "wave_2d", "mine.csv: the file has no rows"),
                ("pbar_over_pstar,perimeter\n", "wave_2d", "mine.csv: the file has no rows"),
                ("pbar_over_pstar,perimeter\n0.1,NaN\n", "wave_2d", "mine.csv: line 2: perimeter is not a number\n"),
                ("pbar_over_pstar\0perimeter\n", "wave_2d", "mine.csv: the file is no text"),
                ("0.1,1\n", "wave_2d", "mine.csv:1: names of the columns must stand above the numbers"),
                ("pbar_over_pstar,perimeter\n0.123,1\n", "wave_2d", "no row of the file is in the reference")):
            with self.subTest(message):
                found = self.verify(text, table, status=1)
                self.assertTrue(found.startswith("verify: "), found)
                self.assertIn(message, found)
        self.assertIn("nothing.csv: No such file", subprocess.run(
            [self.script, "nothing.csv", "wave_2d"], capture_output=True, text=True, check=False).stderr)
        binary = self.folder/"mine.npy"
        binary.write_bytes(b"\x93NUMPY\xff")
        self.assertIn("mine.npy: the file is no text", subprocess.run(
            [self.script, binary, "wave_2d"], capture_output=True, text=True, check=False).stderr)

    def test_installed(self):
        """As `cmake --install` and the wheel have it; and a table that was changed."""
        program, data = self.folder/"bin"/"wavycon-verify", self.folder/"share"/"wavycon"/"reference"
        program.parent.mkdir()
        shutil.copy(self.script, program)
        shutil.copytree(REFERENCE, data)
        command = [sys.executable, program, REFERENCE / "merging.dat", "merging"]
        self.assertIn("\nagrees", subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        self.assertIn("usage: wavycon-verify", subprocess.run([*command[:2], "--help"], capture_output=True, text=True,
                                                              check=True).stdout)
        with open(data / "merging.dat", "a", encoding="utf-8") as file:
            file.write("# changed\n")
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(1, done.returncode)
        self.assertIn("its checksum is not that of SHA256SUMS", done.stderr)

    def test_example_of_the_page(self):
        page = (ROOT / "outputs" / "README.md").read_text(encoding="utf-8")
        file, rest = page.split("$ cat mine.csv\n")[1].split("```")[0].split("$ wavycon-verify mine.csv ")
        words, _, expected = rest.partition("\n")
        self.assertEqual(expected, self.verify(file, *words.split(), status=1))

    def test_list(self):
        found = subprocess.run([self.script, "--list"], capture_output=True, text=True, check=True).stdout
        for resource in PACKAGE["resources"]:
            self.assertIn(f"{resource['name']}: {resource['title']}\n", found)
        # A reader that ends early brings about no message.
        with subprocess.Popen([self.script, "--list"], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdout.close()
            self.assertEqual(b"", process.stderr.read())


if __name__ == "__main__":
    main()
