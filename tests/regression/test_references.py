#!/usr/bin/env python3
"""The comparison with references: differences that must be found, and others that must be ignored."""
import references
from program import ProgramTest, main

SUMMARY = """\
# wavycon
#  [-]  [-]              [-]                      [-]                 [-]         [-]              [-]
   load pbar_over_pstar  mean_gap_over_amplitude  active_constraints  iterations  residual         status
   1    1.0E-001         4.063305171914782E-001   27                  121         5.1E-016         converged
   2    5.0E-001         4.936147336729224E-002   13                   44         3.8E-016         converged
"""
MAP = "# wavycon\n# [-] [length] [length]\n# load 1: pbar/p* = 0.5, converged\nload x gap\n" + "".join(
    f"1 {i} {i*1e-3}\n" for i in range(1000))
STRESS_LINE = """\
# wavycon
# [-] [pressure] [pressure]
# load 1: pbar/p* = 0.5, converged
load stress_zz stress_xy
1 -1e9 1e-8
1 -5e8 -2e-8
"""
CONTOUR = """\
# wavycon
# [-]  [-]  [length] [length]
# load 1: pbar/p* = 0.5, converged
load  curve  x  y
1  1  1.0  0.0
1  1  0.0  1.0
1  1 -1.0  0.0


# load 2: pbar/p* = 0.6, converged
load  curve  x  y
2  1  2.0  0.0
"""


class References(ProgramTest):
    def excerpt(self, name, text):
        (self.folder/name).write_text(text)
        return references.excerpt_of(self.folder/name)

    def words(self, name, text, *changes):
        """What differs after changes (old, new) to a table."""
        changed = text
        for old, new in changes:
            self.assertIn(old, changed)
            changed = changed.replace(old, new, 1)
        return references.differences(self.excerpt(name, changed), self.excerpt(name, text))

    def summary(self, *changes):
        return self.words("a.summary.dat", SUMMARY, *changes)

    def test_an_excerpt_reads_back(self):
        for name, text in (("a.summary.dat", SUMMARY), ("a.map.dat", MAP), ("a.contour.dat", CONTOUR)):
            with self.subTest(name):
                new = self.excerpt(name, text)
                (self.folder/name).write_text(new.text())
                again = references.read_reference(self.folder/name)
                self.assertEqual((new.kind, new.head, new.columns, new.rows),
                                 (again.kind, again.head, again.columns, again.rows))
                self.assertGreater(len(new.rows), 0)

    def test_what_differs_is_seen(self):
        for change, words in ((("4.06330517", "4.06330527"), "mean_gap_over_amplitude differs in 1 of 2 rows"),
                              ((" 27 ", " 28 "), "active_constraints differs"),
                              (("converged", "inaccurate"), "status differs"),
                              (("4.063305171914782E-001", "NaN"), "mean_gap_over_amplitude differs"),
                              (("1.0E-001", "1.00000000001E-001"), "pbar_over_pstar differs"),
                              (("[-]              [-] ", "[p*]             [-] "), "it begins with"),
                              (("mean_gap_over", "mean_gap_under"), "its columns are")):
            with self.subTest(change):
                found = self.summary(change)
                self.assertEqual(1, len(found), found)
                self.assertIn(words, found[0])
        self.assertIn("it has 1 rows", self.summary((SUMMARY.splitlines(True)[-1], ""))[0])

    def test_what_may_differ_is_not_minded(self):
        self.assertEqual([], self.summary())
        self.assertEqual([], self.summary(("# wavycon", "# another"), (" 121 ", " 99 "), ("5.1E-016", "9.9E-013"),
                                          ("4.063305171914782", "4.063305175914782")))

    def test_long_tables_are_sampled(self):
        new = self.excerpt("a.map.dat", MAP)
        self.assertLess(len(new.rows), 2*references.SAMPLE)
        self.assertIn("1000 rows in 1 blocks", new.head[0])
        self.assertEqual([], self.words("a.map.dat", MAP))
        self.assertIn("gap differs", self.words("a.map.dat", MAP, ("1 0 0.0\n", "1 0 1e-6\n"))[0])
        # Rows that are not in the sample, and two of them that change places.
        for row in 2, 500, 998:
            old = f"1 {row} {row*1e-3}\n"
            self.assertIn("gap differs", self.words("a.map.dat", MAP, (old, f"1 {row} {row*1e-3 + 1e-5}\n"))[0])
        self.assertIn("gap differs", self.words("a.map.dat", MAP, ("1 2 0.002\n", "1 2 0.704\n"),
                                                ("1 704 0.704\n", "1 704 0.002\n"))[0])
        self.assertIn("it begins with", self.words("a.map.dat", MAP, ("1 1 0.001\n", ""))[0])

    def test_stresses_are_compared_with_the_largest(self):
        self.assertEqual([], self.words("a.stress_line.dat", STRESS_LINE, ("-2e-8", "3e-7"), ("-1e9", "-1.0000000005e9")))
        self.assertIn("stress_xy differs", self.words("a.stress_line.dat", STRESS_LINE, ("-2e-8", "3"))[0])
        self.assertIn("stress_zz differs", self.words("a.stress_line.dat", STRESS_LINE, ("-5e8", "-5.0000001e8"))[0])

    def test_of_contours_the_extents_count(self):
        self.assertEqual([["1", "-1", "1", "0", "1"], ["2", "2", "2", "0", "0"]],
                         self.excerpt("a.contour.dat", CONTOUR).rows)
        self.assertEqual([], self.words("a.contour.dat", CONTOUR, ("1  1  0.0  1.0\n", "1 1 0.0 1.0\n1 1 0.0 1.0\n")))
        self.assertIn("y_max", self.words("a.contour.dat", CONTOUR, ("1  1  0.0  1.0\n", "1 1 0.0 1.1\n"))[0])

    def test_a_table_must_name_its_columns(self):
        for name, text in (("a.summary.dat", "1 2 3\n"), ("a.summary.dat", SUMMARY.replace(" status\n", "\n")),
                           ("a.summary.dat", SUMMARY.replace("[-]", "", 1)),
                           ("a.summary.dat", SUMMARY.replace("residual", "load")),
                           ("a.contour.dat", CONTOUR.replace("converged\nload  curve  x  y\n2", "converged\n2"))):
            with self.subTest(text), self.assertRaises(ValueError):
                self.excerpt(name, text)


if __name__ == "__main__":
    main()
