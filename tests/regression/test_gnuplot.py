#!/usr/bin/env python3
"""gnuplot finds every column of every table by its name, in each block."""
import math
import shutil
import subprocess

from program import ProgramTest, main, skip
from sample_tables import WORDS, blocks_of, make_tables, page_examples, run_page_decks
from tables import Table

# Of sums of some hundred numbers.
ROUNDING = 1e-13


class Gnuplot(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.tables = make_tables(cls)

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
        run_page_decks(self)
        text, binary = page_examples("gnuplot")
        for example in (text, binary):
            # gnuplot only warns if it does not find a name or a point.
            self.assertEqual("", self.drawn(example))
            self.assertEqual(example.count("\nplot "), (self.folder/"drawn").read_text().count("\f"))
        self.assertIn("distanse", self.drawn(text.replace('"distance"', '"distanse"')))
        # The numbers of the second load.
        numbers = binary.split("\n")[0] + "\nstats" + binary[binary.index("\nplot") + 5:].split("with")[0]
        found, = self.answers([numbers.replace("using 1:2:3", "using 3") + " nooutput",
                               "print sprintf('%d %.12e', STATS_records, STATS_mean)"])
        record = Table(self.folder/"outputs"/"fine"/"fine.summary.dat").records()[1]
        self.assertEqual("4096", found[0])
        self.assertAlmostEqual(float(record["mean_pressure"]), float(found[1]), places=9)

    def drawn(self, script):
        """What gnuplot says while it draws into the file `drawn`."""
        return subprocess.run(["gnuplot"], input="set terminal dumb\nset output 'drawn'\n" + script, cwd=self.folder,
                              capture_output=True, text=True, check=False).stderr

    def answers(self, script):
        result = subprocess.run(["gnuplot"], input="set print '-'\n" + "\n".join(script) + "\n", cwd=self.folder,
                                capture_output=True, text=True, check=True)
        return [line.split() for line in result.stdout.splitlines()]


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        skip("gnuplot is not installed")
    main()
