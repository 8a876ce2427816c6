#!/usr/bin/env python3
"""numpy and pandas read every table by the names of its columns, as the examples of outputs/README.md do.

usage: test_python_readers.py --program WAVYCON --environment FOLDER

numpy and pandas are installed into a virtual environment in FOLDER, once. Exit status: 77 if they cannot be.
"""
import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]
from sample_tables import WORDS, blocks_of, make_tables, page_examples, run_page_deck  # noqa: E402
from virtual_environment import python_with  # noqa: E402

SKIPPED = 77
# pandas reads numbers fast, to within some units of the last of 16 digits.
ROUNDING = 1e-15
# Of each library's example: the table in blocks that it reads, beside the summary, and its name for these blocks.
EXAMPLES = {"pandas": ("lines", "lines"), "numpy": ("map", "maps")}


def examples():
    """{library: example}."""
    found = {}
    for example in page_examples("python"):
        name, = [name for name in EXAMPLES if f"import {name} " in example]
        found[name] = example
    return found


def read_as_in(library, kind, name, path):
    """What an example has under a name if it reads another table in the place of that kind."""
    text, names = examples()[library], {}
    exec(text[:text.index("\nprint(")].replace(f"outputs/demo/demo.{kind}.dat", str(path)), names)
    return names[name]


class PythonReaders(unittest.TestCase):
    program = ""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        run_page_deck(cls.program, pathlib.Path(folder.name))
        cls.tables = make_tables(cls.program, pathlib.Path(folder.name))

    def test_all_tables(self):
        for table in self.tables:
            for library, (kind, name) in EXAMPLES.items():
                found = read_as_in(library, kind, name, table.path)
                self.assertEqual(len(blocks_of(table)), len(found))
                for records, block in zip(blocks_of(table), found):
                    self.check(table, records, block)
                if table.blocks == 1:
                    self.check(table, table.records(), read_as_in(library, "summary", "summary", table.path))

    def check(self, table, records, found):
        """A structured array or a frame: names, numbers and words."""
        columns = list(found.columns) if hasattr(found, "columns") else list(found.dtype.names)
        self.assertEqual(table.columns, columns)
        for name in columns:
            values = found[name].tolist()
            self.assertEqual(len(records), len(values))
            for record, value in zip(records, values):
                with self.subTest(table=table.path.name, column=name, kind=type(found)):
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

    def test_the_examples_of_the_page(self):
        self.assertEqual(set(EXAMPLES), set(examples()))
        for library, example in examples().items():
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(example, {})
            # The contact area at P = 0.5.
            self.assertIn("0.704", printed.getvalue(), library)


def main():
    program, environment = (str(pathlib.Path(sys.argv[sys.argv.index(name) + 1]).resolve())
                            for name in ("--program", "--environment"))
    python = python_with(environment, ["numpy", "pandas"], ["numpy", "pandas"], options=["--only-binary", ":all:"])
    if not python:
        print(f"SKIPPED: numpy and pandas cannot be installed; see {environment}.log")
        sys.exit(SKIPPED)
    if pathlib.Path(sys.prefix).resolve() != pathlib.Path(environment):
        os.execv(python, [python, *sys.argv])
    PythonReaders.program = program
    unittest.main(argv=sys.argv[:1])


if __name__ == "__main__":
    main()
