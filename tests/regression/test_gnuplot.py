#!/usr/bin/env python3
"""gnuplot finds every column of every table by its name, in each block."""
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from sample_tables import WORDS, blocks_of, make_tables, page_examples, run_page_deck  # noqa: E402

SKIPPED = 77
# Of sums of some hundred numbers.
ROUNDING = 1e-13


class Gnuplot(unittest.TestCase):
    program = ""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.tables = make_tables(cls.program, pathlib.Path(folder.name))

    def test_numbers(self):
        for table in self.tables:
            self.assertEqual(max(table.blocks, 1), len(blocks_of(table)))
            script, expected = [f"table = '{table.path}'"], []
            for place, records in enumerate(blocks_of(table)):
                for name in table.columns:
                    values = [] if name in WORDS else [float(record[name]) for record in records]
                    values = [value for value in values if not math.isnan(value)]
                    if values:
                        script += [f'stats table index {place} using "{name}" nooutput',
                                   "print sprintf('%d %.16e', STATS_records, STATS_sum)"]
                        expected.append((place, name, values))
            answers = self.answers(script)
            self.assertEqual(len(expected), len(answers), table.path)
            for (place, name, values), (count, total) in zip(expected, answers):
                with self.subTest(table=table.path.name, index=place, column=name):
                    self.assertEqual(len(values), int(count))
                    self.assertTrue(math.isclose(float(total), math.fsum(values), rel_tol=0.0,
                                                 abs_tol=ROUNDING*math.fsum(map(abs, values))), total)

    def test_words(self):
        for table in self.tables:
            for name in set(WORDS) & set(table.columns):
                for word in {record[name] for record in table.records()}:
                    found = self.answers([f'stats "{table.path}" using (strcol("{name}") eq "{word}") nooutput',
                                          "print sprintf('%d', STATS_sum)"])
                    self.assertEqual([[str(sum(record[name] == word for record in table.records()))]], found)

    def test_the_examples_of_the_page(self):
        example, = page_examples("gnuplot")
        with tempfile.TemporaryDirectory() as folder:
            run_page_deck(self.program, pathlib.Path(folder))
            # gnuplot says nothing else about a name that it does not find or about a block without points.
            result = subprocess.run(["gnuplot"], input="set terminal dumb\nset output 'drawn'\n" + example, cwd=folder,
                                    capture_output=True, text=True, check=True)
            self.assertEqual("", result.stderr)
            self.assertEqual(example.count("\nplot "), (pathlib.Path(folder)/"drawn").read_text().count("\f"))
            wrong = example.replace('"distance"', '"distanse"')
            self.assertNotEqual(example, wrong)
            result = subprocess.run(["gnuplot"], input="set terminal dumb\nset output 'drawn'\n" + wrong, cwd=folder,
                                    capture_output=True, text=True, check=False)
            self.assertIn("distanse", result.stderr)

    def answers(self, script):
        result = subprocess.run(["gnuplot"], input="set print '-'\n" + "\n".join(script) + "\n", capture_output=True,
                                text=True, check=True)
        return [line.split() for line in result.stdout.splitlines()]


if __name__ == "__main__":
    Gnuplot.program = str(pathlib.Path(sys.argv.pop(sys.argv.index("--program") + 1)).resolve())
    sys.argv.remove("--program")
    if not shutil.which("gnuplot"):
        print("SKIPPED: gnuplot is not installed")
        sys.exit(SKIPPED)
    unittest.main()
