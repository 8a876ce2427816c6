#!/usr/bin/env python3
"""One mistake in a deck is one message: no further ones that only follow from it.

usage: test_one_mistake.py --program WAVYCON

Into the decks of inputs/ one mistake is put at a time: for each key a value of no type, misspelt names, no value, and
the key left out; for each group a misspelt name; each mistake once for each kind of surface. The program reports at most
one problem.
"""
import pathlib
import re
import shutil
import subprocess

from program import ProgramTest, main

INPUTS = pathlib.Path(__file__).resolve().parents[2]/"inputs"
ENTRY = re.compile(r"\b(\w+)\s*=\s*((?:'[^']*'|[^\s,/!&='\"]+)(?:\s*,\s*(?:'[^']*'|[^\s,/!&='\"]+\b)(?!\s*=))*),?")
LARGE = "challenge.nml"   # its surface would take most of the time


def mistakes(text):
    """Decks with one mistake each, by the words that name it."""
    for entry in ENTRY.finditer(text):
        key, before, behind = entry[1], text[:entry.start()], text[entry.end():]
        yield f"{key} = ~", f"{before}{key} = ~ {behind}"
        yield f"{key} =", f"{before}{key} = {behind}"
        yield f"{key}qq", f"{before}{key}qq = {entry[2]}, {behind}"
        yield f"x{key[:-1]}", f"{before}x{key[:-1]} = {entry[2]}, {behind}"
        yield f"no {key}", before + behind
    for group in re.finditer(r"&(\w+)", text):
        yield f"{group[0]}zz", f"{text[:group.end()]}zz{text[group.end():]}"


class OneMistake(ProgramTest):
    def test_it_is_one_message(self):
        decks, done = {}, set()
        for data in INPUTS.iterdir():
            if data.suffix != ".nml" and data.is_file():
                shutil.copy(data, self.folder)
        for path in sorted(set(INPUTS.glob("*.nml")) - {INPUTS/LARGE}):
            lines = path.read_text(encoding="utf-8").splitlines()
            text = "\n".join(line if "'" in line else re.sub("!.*", "", line) for line in lines) + "\n"
            kind = re.search("kind *= *'(.*?)'", text)[1]
            for words, deck in mistakes(text):
                if (kind, words) in done:
                    continue
                done.add((kind, words))
                name = f"{len(decks)}.nml"
                (self.folder/name).write_text(deck, encoding="utf-8")
                decks[name] = path.stem, words
        self.assertGreater(len(decks), 500)
        run = subprocess.run([self.program, "--check", "--quiet", *decks], cwd=self.folder, capture_output=True, text=True,
                             check=False)
        reported = re.findall(r"^(\d+\.nml).*? error 1 of (?:at least )?(\d+): ", run.stderr, re.MULTILINE)
        self.assertGreater(len(reported), len(decks)//2)
        for name, number in reported:
            deck, words = decks[name]
            if number != "1":
                with self.subTest(deck=deck, mistake=words):
                    self.fail("\n".join(re.findall(rf"^{name}.*", run.stderr, re.MULTILINE)))


if __name__ == "__main__":
    main()
