"""What the tests in Python share: the program, the folder that they run it in, and their command line.

ctest has this directory in PYTHONPATH.
"""
import argparse
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77  # exit status of a test that cannot run here; ctest shows it


class ProgramTest(unittest.TestCase):
    """Tests of the program, in a folder of the class."""
    program = ""

    @classmethod
    def setUpClass(cls):
        cls.folder = new_folder(cls.addClassCleanup)

    @classmethod
    def run_deck(cls, name, text=None, *options, output=".", statuses=(0,), **environment):
        """Writes NAME.nml, if there is a text, and runs it there. environment: variables. Returns the status."""
        if text is not None:
            (cls.folder/f"{name}.nml").write_text(text, encoding="utf-8")
        done = subprocess.run([cls.program, f"{name}.nml", "--quiet", "--output", output, *options], cwd=cls.folder,
                              env=dict(os.environ, **environment), check=False)
        if done.returncode not in statuses:
            raise AssertionError(f"{name}.nml: exit status {done.returncode}")
        return done.returncode


def new_folder(add_cleanup):
    """A folder for the files of a test, which add_cleanup(procedure) removes."""
    folder = tempfile.TemporaryDirectory(prefix="a folder with blanks ")
    add_cleanup(folder.cleanup)
    return pathlib.Path(folder.name).resolve()


def take_options(*names):
    """The values of options --NAME VALUE, which are taken off the command line: what is left is unittest's."""
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    for name in names:
        parser.add_argument(f"--{name}", required=True)
    given, sys.argv[1:] = parser.parse_known_args()
    return given


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIPPED)


def hear_signals():
    """After nohup, or in the background of a script, these signals are ignored, also by all that a test starts."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def main():
    """Runs the tests of a file by `FILE --program WAVYCON [unittest's options]`."""
    hear_signals()
    ProgramTest.program = str(pathlib.Path(take_options("program").program).resolve())
    unittest.main()
