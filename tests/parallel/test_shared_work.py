#!/usr/bin/env python3
"""How ranks share the loads of a deck and what they write together.

usage: test_shared_work.py --mpiexec MPIEXEC --ranks N[,N...] --program WAVYCON --parallel WAVYCON_MPI
"""
import shutil
import subprocess

from program import ProgramTest
from ranks import main, run
from tables import Table

WAVE = "&surface kind = 'wave_2d' /\n"
SWEEP = "&load sweep_from = 0.02, sweep_to = 0.95, sweep_steps = 60 /\n"
EXIT_BAD_INPUT = 1


class SharedWork(ProgramTest):
    mpiexec = parallel = ""

    def several(self):
        """One rank has nothing to share."""
        return [ranks for ranks in self.ranks if ranks > 1]

    def solve(self, text, ranks, output, *options):
        """Runs a deck on so many ranks; 0: by the serial program."""
        (self.folder/"deck.nml").write_text(text)
        words = ["deck.nml", "--output", output, *options]
        if ranks > 0:
            return run(self.mpiexec, ranks, [self.parallel, *words], self.folder)
        return subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def test_spread_loads_do_not_depend_on_the_number_of_ranks(self):
        """They start elsewhere than in the serial program: the solutions differ by less than the error told."""
        for solver in "'fitted', accuracy = 1e-6", "'series', harmonics = 9, constraint_points = 11":
            deck = WAVE + SWEEP + f"&method solver = {solver} /\n"
            self.solve(deck, 0, "serial")
            serial = Table(self.folder/"serial"/"deck.summary.dat")
            first = None
            for ranks in self.several():
                with self.subTest(solver=solver, ranks=ranks):
                    outcome = self.solve(deck, ranks, f"ranks-{ranks}")
                    self.assertEqual((0, ""), (outcome.status, outcome.stderr))
                    self.assertIn("the loads are distributed over them", outcome.stdout)
                    text = (self.folder/f"ranks-{ranks}"/"deck.summary.dat").read_text()
                    first = first or text
                    self.assertEqual(first, text)
                    shared = Table(self.folder/f"ranks-{ranks}"/"deck.summary.dat")
                    for name in "mean_gap_over_amplitude", "contact_area_fraction":
                        for one, other in zip(serial.column(name), shared.column(name)):
                            self.assertAlmostEqual(float(one), float(other), delta=1e-6)
                    self.assertEqual(serial.column("status"), shared.column("status"))

    def test_loads_solved_by_themselves_and_their_stresses(self):
        """The digits are those of the serial program."""
        for solver in "'grid', grid_points = 64", "'beale'":
            deck = (WAVE + "&load pbar_over_pstar = 0.3, 0.1, 0.2, 1.2, 0 /\n&stress nu = 0.3, yield_stress = 1 /\n"
                    f"&method solver = {solver} /\n")
            self.solve(deck, 0, "serial")
            for ranks in self.several():
                with self.subTest(solver=solver, ranks=ranks):
                    outcome = self.solve(deck, ranks, f"ranks-{ranks}")
                    self.assertEqual((0, ""), (outcome.status, outcome.stderr))
                    self.assertIn("the loads are distributed over them", outcome.stdout)
                    for name in "deck.summary.dat", "deck.stress_largest.dat":
                        self.assertEqual((self.folder/"serial"/name).read_bytes(),
                                         (self.folder/f"ranks-{ranks}"/name).read_bytes())

    def test_the_first_rank_alone(self):
        deck = WAVE + "&load pbar_over_pstar = 0.3, 0.1, 0.2 /\n&method solver = 'fitted' /\n&output contours = t /\n"
        self.solve(deck, 0, "serial")
        outcome = self.solve(deck, max(self.ranks), "ranks")
        self.assertEqual((0, ""), (outcome.status, outcome.stderr))
        self.assertIn("the first one works alone", outcome.stdout)
        for name in "deck.summary.dat", "deck.contour.dat":
            self.assertEqual((self.folder/"serial"/name).read_bytes(), (self.folder/"ranks"/name).read_bytes())

    def interrupt(self, text, ranks):
        """A run that cannot write its summary, and whose first checkpoint has lost the end of its last load."""
        shutil.rmtree(self.folder/"results", ignore_errors=True)
        (self.folder/"results"/"deck.summary.dat").mkdir(parents=True)
        outcome = self.solve(text, ranks, "results")
        self.assertNotEqual("", outcome.stderr)
        (self.folder/"results"/"deck.summary.dat").rmdir()
        first = min((self.folder/"results").glob("deck.checkpoint*"))
        first.write_bytes(first.read_bytes()[:-1])

    def test_interrupted_runs_are_resumed_on_any_number_of_ranks(self):
        """All but the load that was not written whole are restored, and the tables are those of one run."""
        deck = WAVE + "&load pbar_over_pstar = 0.4, 0.3, 0.2, 0.1 /\n&method solver = 'grid', grid_points = %d /\n"
        # Loads are dealt to the ranks, or the columns of grids are distributed over them.
        for text in deck % 64, deck % 512 + "&output lines = .true. /\n":
            self.solve(text, 0, "whole")
            for before, now in (0, max(self.ranks)), (max(self.ranks), 0), (max(self.ranks), min(self.ranks)):
                with self.subTest(before=before, now=now, deck=text):
                    self.interrupt(text, before)
                    outcome = self.solve(text, now, "results", "--resume")
                    self.assertEqual("", outcome.stderr)
                    self.assertRegex(outcome.stdout, r"(?m)^resumed: 3 of 4 loads")
                    for path in (self.folder/"whole").glob("*.dat"):
                        self.assertEqual(path.read_bytes(), (self.folder/"results"/path.name).read_bytes())
                    self.assertEqual([], list((self.folder/"results").glob("*checkpoint*")))

    def test_files_that_are_no_checkpoints_are_refused(self):
        deck = WAVE + "&load pbar_over_pstar = 0.3, 0.1 /\n&method solver = 'grid', grid_points = 1024 /\n"
        (self.folder/"results").mkdir()
        for name, ranks in ("deck.checkpoint", 2), ("deck.checkpoint.0", 1):
            (self.folder/"results"/name).write_text("anything")
            outcome = self.solve(deck, ranks, "results", "--resume")
            self.assertEqual(EXIT_BAD_INPUT, outcome.status)
            self.assertIn(f"{name}: ", outcome.stderr)
            outcome = self.solve(deck, ranks, "results")
            self.assertEqual((0, ""), (outcome.status, outcome.stderr))
            self.assertEqual([], [path.name for path in (self.folder/"results").glob("*checkpoint*")])


if __name__ == "__main__":
    main(SharedWork)
