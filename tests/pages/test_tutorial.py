#!/usr/bin/env python3
"""The tutorial does what it shows: decks, commands and Python, in this order.

usage: test_tutorial.py --program WAVYCON --package FOLDER --environment FOLDER

A deck is saved under the name in its first line. A line `$ ...` of a block `console` is run, and what follows is what it
prints; `...` stands for any lines. A block without a name below one of Python is what this prints.
"""
import contextlib
import io
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from check_pages import comparable
from program import ProgramTest, main, take_options
from virtual_environment import go_on_with

ROOT = pathlib.Path(__file__).resolve().parents[2]


def blocks(text):
    """(language, text) of the fenced blocks of a page, in order."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def is_shown(shown, printed):
    """Whether a text is printed as shown, but for times, versions and what `...` stands for."""
    parts = [re.escape("\n".join(map(" ".join, comparable(part)))) for part in re.split(r"^\.\.\.\n", shown, flags=re.MULTILINE)]
    return re.fullmatch("(.*\n)*?".join(part + "\n" if part else "" for part in parts),
                        "\n".join(map(" ".join, comparable(printed))) + "\n") is not None


class Tutorial(ProgramTest):
    def run_commands(self, text):
        for command, shown in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
            words = shlex.split(command)
            if words[0] == "scripts/plot" and not shutil.which("gnuplot"):
                continue
            words[0] = self.program if words[0] == "wavycon" else str(ROOT/words[0])
            done = subprocess.run(words, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  check=False)
            self.assertTrue(is_shown(shown, done.stdout), f"{command}:\n{done.stdout}")

    def test_the_page(self):
        page = blocks((ROOT/"packaging/site/tutorial.md").read_text(encoding="utf-8"))
        self.assertGreater(len(page), 10)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        shutil.copy(ROOT/"inputs/measured_surface.dat", "scan.dat")
        names, printed = {}, ""
        for language, text in page:
            if language == "fortran":
                (self.folder/re.match(r"! (\S+)", text)[1]).write_text(text, encoding="utf-8")
            elif language == "console":
                self.run_commands(text)
            elif language == "python":
                with contextlib.redirect_stdout(io.StringIO()) as written:
                    exec(text, names)
                printed = written.getvalue()
            else:
                self.assertEqual(text, printed)

    def test_what_is_shown(self):
        self.assertTrue(is_shown("...\nb  1\n...\nd\n", "a\nb 1\nc\nd\n"))
        self.assertTrue(is_shown("a\n...\n", "a\nb\n"))
        self.assertFalse(is_shown("...\nb\nd\n", "a\nb\nc\nd\n"))
        self.assertFalse(is_shown("a\n", "a\nb\n"))


if __name__ == "__main__":
    go_on_with("numpy", "pandas", "matplotlib")
    sys.path.insert(0, take_options("package").package)
    os.environ["MPLBACKEND"] = "agg"
    main()
