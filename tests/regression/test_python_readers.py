#!/usr/bin/env python3
"""numpy and pandas read every table by the names of its columns, as the examples of outputs/README.md do.

usage: test_python_readers.py --program WAVYCON --environment FOLDER

Where this Python lacks numpy or pandas, both are installed into a virtual environment in FOLDER, once. Exit status: 77
if they cannot be.
"""
import contextlib
import io
import os
import pathlib
import re

from program import ProgramTest, main
from sample_tables import WORDS, blocks_of, make_tables, page_examples, run_page_decks
from virtual_environment import go_on_with

# pandas reads numbers fast, to within some units of the last of 16 digits.
ROUNDING = 1e-15
# The examples' names of a table in blocks; each also has a summary, which is one block.
EXAMPLES = {"pandas": "lines", "numpy": "maps"}
IN_BLOCKS = "lines", "map"


def read_as_in(library, table):
    """The summary and the blocks that the example of a library has if it reads another table in place of its own."""
    text, = [example.split("\nprint(")[0] for example in page_examples("python")
             if f"import {library} " in example and f"\n{EXAMPLES[library]} =" in example]
    for kind in re.findall(r"outputs/demo/demo\.(\w+)\.dat", text):
        if kind in IN_BLOCKS or table.blocks == 1:
            text = text.replace(f"outputs/demo/demo.{kind}.dat", str(table.path))
    names = {}
    exec(text, names)
    return names["summary"], names[EXAMPLES[library]]


class PythonReaders(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(cls.folder)
        run_page_decks(cls)
        cls.tables = make_tables(cls)

    def test_all_tables(self):
        for table in self.tables:
            for library in EXAMPLES:
                whole, found = read_as_in(library, table)
                self.assertEqual(len(blocks_of(table)), len(found))
                for records, block in zip(blocks_of(table), found):
                    self.check(table, records, block)
                if table.blocks == 1:
                    self.check(table, table.records(), whole)

    def check(self, table, records, found):
        """A structured array or a frame: names, numbers and words."""
        columns = list(found.columns) if hasattr(found, "columns") else list(found.dtype.names)
        self.assertEqual(table.columns, columns)
        for name in columns:
            values = found[name].tolist()
            self.assertEqual(len(records), len(values))
            with self.subTest(table=table.path.name, column=name, kind=type(found)):
                for record, value in zip(records, values):
                    if name in WORDS:
                        self.assertEqual(record[name], value)
                    else:
                        self.assert_close(float(record[name]), value)

    def assert_close(self, expected, value):
        self.assertIsInstance(value, (int, float))
        if expected != expected:
            self.assertNotEqual(value, value)
        elif expected != value:
            self.assertLessEqual(abs(value - expected), ROUNDING*abs(expected))

    def test_heights_in_numpys_format(self):
        """Heights are those of the file, over their mean, and the head has their statistics."""
        rows = numpy.random.default_rng(1).normal(size=(12, 20))
        for height in rows, rows[:1]:
            numpy.savetxt("map.dat", height, fmt="%.17g")
            self.run_deck("map", "&surface kind = 'file', file = 'map.dat', length_x = 1, length_y = 1,\n"
                          "height_scale = 0.01 /\n&load pbar_over_pstar = 1 /\n&output height = t, spectrum = t /\n")
            found, expected = numpy.load("map.height.npy"), 0.01*(height - height.mean())
            self.assertEqual((height.shape, numpy.float64), (found.shape, found.dtype))
            self.assertLess(abs(found - expected).max(), 1e-16)
            head = dict(re.findall(r"(\w+)\[[^]]*\] = ([^,\s]+)", pathlib.Path("map.spectrum.dat").read_text()))
            power = abs(numpy.fft.fft2(expected)/expected.size)**2
            x, y = (2*numpy.pi*numpy.fft.fftfreq(n)*n for n in height.shape[::-1])
            # A profile has no side along y.
            squares = x**2 + y[:, None]**2
            for name, value in {"points_x": 20, "rms_height": expected.std(),
                                "skewness": (expected**3).mean()/expected.std()**3,
                                "kurtosis": (expected**4).mean()/expected.std()**4,
                                "rms_slope": numpy.sqrt((power*squares).sum()),
                                "rms_curvature": numpy.sqrt((power*squares**2).sum())/min(2, len(height))}.items():
                self.assertAlmostEqual(1.0, float(head[name])/value, delta=1e-12, msg=name)

    def test_the_examples_of_the_page(self):
        self.assertEqual(4, len(page_examples("python")))
        for example in page_examples("python"):
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(example, {})
            # The peak pressure or the contact area at P = 0.5, or the largest stress in full contact.
            expected = r"6\.5616\d" if "fine" in example else "1.20195" if "reference" in example else "0.704"
            self.assertRegex(printed.getvalue(), expected, example)


if __name__ == "__main__":
    go_on_with("numpy", "pandas")
    import numpy
    main()
