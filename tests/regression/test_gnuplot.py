#!/usr/bin/env python3
"""gnuplot reads all rows, blocks and numbers of the tables."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from tables import Table  # noqa: E402

SKIPPED = 77
DECK = """\
&surface kind = '{}' /
&load pbar_over_pstar = 0, 0.2, 0.6, 1 /
&output lines = t, map = t, contours = t, coefficients = t, theory = t, line_points = 8, map_points = 8 /
"""
# gnuplot prints six digits after the point.
DIGITS = 1e-6


class Gnuplot(unittest.TestCase):
    program = ""

    def test_all_tables(self):
        for kind in ("wave_1d", "wave_2d"):
            with tempfile.TemporaryDirectory() as scratch:
                folder = pathlib.Path(scratch)
                (folder / "case.nml").write_text(DECK.format(kind))
                subprocess.run([self.program, folder / "case.nml", "--quiet", "--output", folder], check=True)
                paths = sorted(folder.glob("*.dat"))
                self.assertEqual(6, len(paths))
                for path in paths:
                    with self.subTest(kind=kind, table=path.name):
                        self.check(Table(path))

    def check(self, table):
        last = [place for place, name in enumerate(table.columns, 1) if not name.startswith("status")][-1]
        words = self.statistics(f"stats '{table.path}' using 1:{last} nooutput\n"
                                "print STATS_records, STATS_invalid, STATS_blocks, STATS_sum_x, STATS_sum_y\n")
        rows = table.rows()
        self.assertEqual([len(rows), 0, table.blocks], [int(float(word)) for word in words[:3]])
        for word, column in zip(words[3:], (1, last)):
            expected = sum(float(row[column - 1]) for row in rows)
            self.assertLessEqual(abs(float(word) - expected), DIGITS*max(1.0, abs(expected)))

    def statistics(self, script):
        result = subprocess.run(["gnuplot"], input=script, capture_output=True, text=True, check=True)
        return result.stderr.split()


if __name__ == "__main__":
    Gnuplot.program = str(pathlib.Path(sys.argv.pop(sys.argv.index("--program") + 1)).resolve())
    sys.argv.remove("--program")
    if not shutil.which("gnuplot"):
        print("SKIPPED: gnuplot is not installed")
        sys.exit(SKIPPED)
    unittest.main()
