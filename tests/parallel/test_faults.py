#!/usr/bin/env python3
"""Faults of one rank or of the machine: all ranks end soon, with one message and no incomplete file.

usage: test_faults.py --mpiexec MPIEXEC --ranks 3 --program WAVYCON --parallel WAVYCON_MPI
"""
import os
import pathlib
import shutil
import signal
import subprocess
import time

from program import ProgramTest, new_folder, skip
from ranks import finish, main, run, start

RANKS = 3
SOON = 20.0  # of processes that share a processor [s]
SURFACE = ("&surface kind = 'sum', length_x = 2, length_y = 1, amplitudes = 1, 0.4, 0.15, waves_x = 1, 0, 3, "
           "waves_y = 0, 1, 2, phases = 0, 0, 60 /\n")
# Grids that are distributed over the ranks, also those of many loads as a table needs their fields. The loads of the first
# deck take some seconds.
LONG_DECK = (SURFACE + "&load sweep_from = 0.01, sweep_to = 0.5, sweep_steps = 40 /\n"
             "&method solver = 'grid', grid_points = 512 /\n&output histograms = t /\n")
DECK = (SURFACE + "&load pbar_over_pstar = 0.2 /\n&method solver = 'grid', grid_points = 256, 320 /\n"
        "&output map = t, map_format = 'npy', contours = t /\n")
EXIT_BAD_INPUT, EXIT_NOT_CONVERGED, EXIT_FILE_TROUBLE = 1, 2, 3


def rank_of_launcher():
    """A shell expression for the number of a rank, by Open MPI's variable or that of MPICH."""
    return "${OMPI_COMM_WORLD_RANK-${PMI_RANK-}}"


def processes_of(launcher, name):
    """The processes below a launcher that run a program of this name, by number."""
    parents = {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder/"stat").read_text().rsplit(")", 1)[1].split()
            if (folder/"exe").resolve().name == name and words[0] != "Z":
                parents[int(folder.name)] = int(words[1])
            else:
                parents.setdefault(-int(folder.name), int(words[1]))
        except (OSError, IndexError):
            continue
    known = {abs(process): parent for process, parent in parents.items()}

    def is_below(process):
        while process > 1:
            if process == launcher:
                return True
            process = known.get(process, 0)
        return False

    return sorted(process for process in parents if process > 0 and is_below(process))


def is_running(process):
    """Whether a process exists and has not ended."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (OSError, IndexError):
        return False


class Faults(ProgramTest):
    mpiexec = parallel = ""

    def setUp(self):
        self.folder = new_folder(self.addCleanup)

    def write(self, text):
        (self.folder/"deck.nml").write_text(text)

    def command(self, *options):
        return [self.parallel, "deck.nml", "--output", "results", *options]

    def in_shell(self, preparation, *options):
        """The command, after a preparation that a shell does in each rank, whose number is $rank."""
        return ["sh", "-c", f'rank={rank_of_launcher()}; {preparation}; exec "$0" "$@"', *self.command(*options)]

    def results(self):
        folder = self.folder/"results"
        return sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []

    def assert_failed(self, outcome, status, words, may_remain=()):
        """One message, the status, no tables but those named, and no part of one."""
        self.assertIsNotNone(outcome.status, f"hangs: {outcome.stdout}{outcome.stderr}")
        self.assertLess(outcome.seconds, SOON)
        self.assertEqual(status, outcome.status, outcome.stderr)
        lines = [line for line in outcome.stderr.splitlines() if line]
        self.assertEqual(1, len(lines), outcome.stderr)
        self.assertRegex(lines[0], words)
        self.assertEqual([], [name for name in self.results() if name not in may_remain])

    # Ranks that are killed.

    def kill(self, number, sent):
        """Kills a rank of a run that has solved a load, and returns how the run ended."""
        self.write(LONG_DECK)
        shutil.rmtree(self.folder/"results", ignore_errors=True)
        process = start(self.mpiexec, RANKS, self.command(), self.folder)
        try:
            begun = time.monotonic()
            # All ranks have written a load, of which each has 0.5 to 0.8 MB, and not only a part of one.
            while sum(path.stat().st_size > 1000000 for path in (self.folder/"results").glob("*.checkpoint.*")) < RANKS:
                self.assertIsNone(process.poll(), "ends too early")
                self.assertLess(time.monotonic() - begun, SOON)
                time.sleep(0.02)
            ranks = processes_of(process.pid, pathlib.Path(self.parallel).name)
            self.assertEqual(RANKS, len(ranks))
            os.kill(ranks[number], sent)
        finally:
            outcome = finish(process, SOON)
        self.assertIsNotNone(outcome.status, "hangs")
        self.assertNotEqual(0, outcome.status)
        deadline = time.monotonic() + SOON
        while any(map(is_running, ranks)) and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual([], [rank for rank in ranks if is_running(rank)])
        self.assertEqual([], [name for name in self.results() if name.endswith((".dat", ".npy"))])
        return outcome

    def test_a_killed_rank_ends_all_and_the_run_can_be_resumed(self):
        for number in range(RANKS):
            with self.subTest(rank=number):
                self.kill(number, signal.SIGKILL)
        self.kill(1, signal.SIGKILL)
        # Another number of ranks goes on from the checkpoints of all.
        outcome = run(self.mpiexec, 2, self.command("--resume"), self.folder)
        self.assertEqual((0, ""), (outcome.status, outcome.stderr))
        self.assertRegex(outcome.stdout, r"(?m)^resumed: [1-9]")
        resumed = (self.folder/"results"/"deck.summary.dat").read_text()
        self.assertEqual([], [name for name in self.results() if "checkpoint" in name])
        run(self.mpiexec, RANKS, self.command(), self.folder)
        self.assertEqual((self.folder/"results"/"deck.summary.dat").read_text(), resumed)

    def test_a_terminated_rank_leaves_no_part(self):
        self.kill(0, signal.SIGTERM)
        self.assertEqual([], [name for name in self.results() if name.endswith(".part")])

    # Files and disks.

    def test_a_map_that_one_rank_cannot_read(self):
        """That rank is in another directory, which has the same deck."""
        for number in range(RANKS):
            with self.subTest(rank=number):
                self.write("&surface kind = 'file', file = 'map.dat' /\n&load pbar_over_pstar = 0.1 /\n")
                (self.folder/"map.dat").write_text("0 1 0 2\n1 2 0 1\n0 0 2 1\n3 1 2 0\n")
                other = self.folder/"other"
                other.mkdir(exist_ok=True)
                shutil.copy(self.folder/"deck.nml", other)
                outcome = run(self.mpiexec, RANKS, self.in_shell(f'[ "$rank" != {number} ] || cd other'), self.folder,
                              SOON)
                self.assertIsNotNone(outcome.status, "hangs")
                self.assertEqual(1, outcome.stderr.count("map.dat"), outcome.stderr)
                self.assertIn(outcome.status, (EXIT_BAD_INPUT, EXIT_FILE_TROUBLE))
                self.assertEqual([], self.results())

    def test_a_directory_that_one_rank_does_not_share(self):
        """The first rank writes the map, for all."""
        self.write(DECK)
        (self.folder/"other"/"results").mkdir(parents=True)
        outcome = run(self.mpiexec, RANKS, self.in_shell('[ "$rank" != 1 ] || cd other'), self.folder, SOON)
        self.assertEqual((0, ""), (outcome.status, outcome.stderr), outcome.stdout)
        self.assertIn("deck.map.npy", self.results())

    def test_options_of_one_rank(self):
        self.write(DECK)
        outcome = run(self.mpiexec, RANKS, self.in_shell('[ "$rank" != 1 ] || set -- "$@" --bad'), self.folder, SOON)
        self.assertEqual(EXIT_BAD_INPUT, outcome.status, outcome.stderr)
        self.assertEqual(1, outcome.stderr.count("wavycon: unknown option '--bad'"), outcome.stderr)

    def test_a_directory_that_cannot_be_made(self):
        self.write(DECK)
        (self.folder/"results").write_text("a file")
        outcome = run(self.mpiexec, RANKS, self.command(), self.folder, SOON)
        self.assert_failed(outcome, EXIT_FILE_TROUBLE, "results")

    def test_full_disk(self):
        """A small file system: without room for the resolved deck, for the map of 3.9 MB, for the contours."""
        disk = self.folder/"disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", disk], capture_output=True,
                          check=False).returncode != 0:
            print("SKIPPED: a small file system cannot be mounted")
            self.skipTest("mounting is not permitted")
        self.addCleanup(subprocess.run, ["umount", disk], check=False)
        self.write(DECK)
        for room in 0, 20000, 3000000, 3980000:
            with self.subTest(room=room):
                (disk/"filler").write_bytes(b"x"*(8*1024*1024 - room))
                outcome = run(self.mpiexec, RANKS, [self.parallel, "deck.nml", "--output", disk/"results"], self.folder,
                              SOON)
                self.assertIsNotNone(outcome.status, "hangs")
                self.assertEqual(EXIT_FILE_TROUBLE, outcome.status, outcome.stdout + outcome.stderr)
                self.assertEqual(1, outcome.stderr.count("wavycon: "), outcome.stderr)
                self.assertEqual([], [name for name in sorted(path.name for path in (disk/"results").glob("*"))
                                      if name.endswith((".part", ".npy", ".dat"))])
                shutil.rmtree(disk/"results", ignore_errors=True)

    # Memory.

    def test_a_rank_without_memory(self):
        """The limit is above what MPI and the libraries take and below what the grid needs."""
        self.write(SURFACE + "&load pbar_over_pstar = 0.2 /\n&method solver = 'grid', grid_points = 8192 /\n")
        outcome = run(self.mpiexec, RANKS, self.in_shell('[ "$rank" != 1 ] || ulimit -v 1100000'), self.folder, SOON)
        self.assertIsNotNone(outcome.status, "hangs")
        self.assertEqual(EXIT_NOT_CONVERGED, outcome.status, outcome.stderr)
        self.assertIn(" no_memory\n", outcome.stdout)
        self.assertEqual(["deck.resolved.nml", "deck.summary.dat"], self.results())


if __name__ == "__main__":
    if not pathlib.Path("/proc").is_dir():
        skip("processes are found in /proc, which this system lacks")
    main(Faults)
