#!/usr/bin/env python3
"""Each deck of inputs/ runs and agrees with its reference. The decks are listed when the test runs.

usage: test_inputs.py --program WAVYCON [unittest's options]

The decks of large grids run only if Inputs.slow_decks_agree_with_their_references is named.
"""
import subprocess

import references
from program import ProgramTest, main


# They take longer than all others together. regression.reference_table solves some of their loads.
SLOW = {"challenge"}


class Inputs(ProgramTest):
    def test_each_deck_agrees_with_its_reference(self):
        self.check_decks([deck for deck in references.decks() if deck.stem not in SLOW])

    def slow_decks_agree_with_their_references(self):
        self.check_decks([deck for deck in references.decks() if deck.stem in SLOW])

    def check_decks(self, decks):
        self.assertGreater(len(decks), 0)
        for deck in decks:
            with self.subTest(deck.stem):
                self.check(deck)

    def check(self, deck):
        folder = references.REFERENCES / deck.stem
        how = f"tests/regression/remake --program {self.program} {deck.stem}"
        if not folder.is_dir():
            self.fail(f"{deck} has no reference; make it with\n   {how}")
        try:
            new = references.run(self.program, deck, self.folder)
        except subprocess.CalledProcessError as error:
            self.fail(f"{deck}: exit status {error.returncode}")
        self.assertEqual(sorted(path.name for path in folder.iterdir()), sorted(new),
                         f"{deck} makes other tables than its reference has; if that is right:\n   {how}")
        words = [f"{name}: {line}" for name, excerpt in new.items()
                 for line in references.differences(excerpt, references.read_reference(folder / name))]
        if words:
            self.fail("\n".join([f"{deck}:"] + words + ["If the new numbers are the right ones:", f"   {how}"]))

    def test_each_reference_has_a_deck(self):
        names = [deck.stem for deck in references.decks()]
        for folder in references.REFERENCES.iterdir():
            self.assertIn(folder.name, names)

    def test_references_stay_small(self):
        size = sum(path.stat().st_size for path in references.REFERENCES.rglob("*") if path.is_file())
        self.assertLess(size, references.LARGEST)


if __name__ == "__main__":
    main()
