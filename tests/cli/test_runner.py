#!/usr/bin/env python3
"""run_cases.py must fail if the program differs from a case, or if a case cannot be read."""
import pathlib
import subprocess
import sys

from program import ProgramTest, main

RUNNER = pathlib.Path(__file__).resolve().parent / "run_cases.py"

SOUND = """\
# A remark.
case: a run
file deck.nml:
   &surface kind = 'wave_1d' /
   &load pbar_over_pstar = 1 /
bytes odd: \\x41\\n
run:
   cat odd && wavycon deck.nml --quiet && wavycon --nonsense
status: 1
stdout:
   A
stderr:
   wavycon: unknown option '--nonsense'
   ...
makes: outputs/deck/deck.{resolved.nml,summary.dat}
case: decks that are refused
refused:
   &method harmonics = 0,
      symmetry = 'half' /
   1:21: harmonics must be an integer from 1 to 60, got '0'
   2:15: symmetry must be 'full', 'diagonal' or 'none', got the text 'half'
   &surface kind = 'wave_2d', amplitude = -1 /
   1:40: amplitude must be a number >= 0, got '-1'
"""

# Name of the test, lines of SOUND, their replacement, what the runner must print.
FAILURES = [
    ("status", "status: 1\n", "status: 2\n", "exit status 1, expected 2"),
    ("no status", "status: 1\n", "", "exit status 1, expected 0"),
    ("stdout", "   A\n", "   B\n", "stdout is not as expected"),
    ("stdout not mentioned", "stdout:\n   A\n", "", "stdout is not as expected"),
    ("a line of stderr", "'--nonsense'\n", "'--nonsens'\n", "stderr is not as expected"),
    ("the rest of stderr", "   ...\n", "", "stderr is not as expected"),
    ("a file too many", ",summary.dat", "", "was made, but is not expected: outputs/deck/deck.s"),
    ("a file too few", ",summary.dat", ",summary.dat,more", "was not made: outputs/deck/deck.more"),
    ("the place of a refusal", "1:21", "1:20", "stderr is not as expected"),
    ("the words of a refusal", "from 1 to 60", "from 1 to 61", "stderr is not as expected"),
    ("a refusal too few", SOUND.splitlines(True)[-1], "", "stderr is not as expected"),
    ("a refusal without a deck", "   &method harmonics = 0,\n      symmetry = 'half' /\n", "", "expected in 'refused:'"),
    ("a line that no deck has", "1:21", "9:21", "expected in 'refused:'"),
    ("a keyword misspelt", "stderr:\n", "sdterr:\n", "no such keyword: sdterr"),
    ("a line without a keyword", "status: 1\n", "status 1\n", "expected 'keyword:'"),
    ("a case without a run", SOUND[SOUND.index("run:"):SOUND.index("status:")], "", "runs nothing"),
    ("no case at all", SOUND, "# nothing\n", "no cases"),
]


class Runner(ProgramTest):
    def outcome(self, cases):
        path = self.folder/"some.cases"
        path.write_text(cases)
        result = subprocess.run([sys.executable, RUNNER, "--program", self.program, path], capture_output=True,
                                text=True, check=False)
        return result.returncode, result.stdout + result.stderr

    def test_a_sound_case_passes(self):
        status, output = self.outcome(SOUND)
        self.assertEqual(0, status, output)
        self.assertIn("2 cases, 0 failed, 0 skipped", output)

    def test_anything_else_fails(self):
        for name, old, new, words in FAILURES:
            with self.subTest(name):
                self.assertEqual(1, SOUND.count(old))
                status, output = self.outcome(SOUND.replace(old, new))
                self.assertEqual(1, status, output)
                self.assertIn(words, output)


if __name__ == "__main__":
    main()
