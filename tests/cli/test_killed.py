#!/usr/bin/env python3
"""What is left of a run that is killed: no process of --jobs, and no hidden part of a file after the next run.

usage: test_killed.py --program WAVYCON [unittest's options]
"""
import fcntl
import os
import platform
import signal
import subprocess
import time

from program import ProgramTest, main

# Some minutes of work, if nothing ends it.
LONG_DECK = """&surface kind = 'self_affine', rms_slope = 0.1, short_wavelength = 0.005, points = 512 /
&load sweep_from = 0.001, sweep_to = 0.01, sweep_steps = 100 /
&method solver = 'grid', grid_points = 512, residual = 1e-12 /
"""
DECK = "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.5 /\n"
PATIENCE = 20   # [s]
ENDING = 4      # [s]; some milliseconds, if nothing else runs
HOST = platform.node()[:16]


def children(process):
    with open(f"/proc/{process}/task/{process}/children", encoding="ascii") as numbers:
        return numbers.read().split()


def runs(process):
    """Whether a process is there and is no zombie, which waits for whoever has adopted it."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii") as stat:
            return stat.read().rsplit(")")[1].split()[0] not in "ZX"
    except OSError:
        return False


def wait_for(condition, patience=PATIENCE):
    begun = time.monotonic()
    while not condition() and time.monotonic() < begun + patience:
        time.sleep(0.01)
    return condition()


class Killed(ProgramTest):
    def run_of_jobs(self, ignored=()):
        def ignore():
            for one in ignored:
                signal.signal(one, signal.SIG_IGN)

        (self.folder/"long.nml").write_text(LONG_DECK)
        process = subprocess.Popen([self.program, "long.nml", "--sweep", "surface.seed=1,2", "--jobs", "2"],
                                   cwd=self.folder, stdout=subprocess.DEVNULL, preexec_fn=ignore)
        self.assertTrue(wait_for(lambda: len(children(process.pid)) == 2))
        self.assertTrue(wait_for(lambda: len(list(self.folder.glob("outputs/*/*.checkpoint"))) == 2))
        return process

    def test_jobs_end_with_their_parent(self):
        for sent in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL):
            process = self.run_of_jobs([signal.SIGTERM] if sent == signal.SIGKILL else [])
            jobs = children(process.pid)
            process.send_signal(sent)
            self.assertEqual(-sent, process.wait(PATIENCE))
            ended = wait_for(lambda: not any(map(runs, jobs)), ENDING)
            for job in filter(runs, jobs):
                os.kill(int(job), signal.SIGKILL)
            self.assertTrue(ended, f"jobs are running after {sent.name} to their parent")

    def test_the_next_run_removes_parts_of_killed_ones(self):
        results = self.folder/"results"
        results.mkdir()
        left = results/f".deck.map.dat.{HOST}.4711.part"
        strange = [results/name for name in (".deck.map.dat.elsewhere.4711.part", f".deck.map.dat.{HOST}.x.part",
                                             f"deck.map.dat.{HOST}.4711.part", f".deck.map.dat.{HOST}.4711.dat",
                                             f".deck.map.dat.x{HOST}.4711.part")]
        at_work = results/f".deck.lines.dat.{HOST}.4712.part"
        link = results/f".deck.lines.dat.{HOST}.4713.part"
        for file in (left, at_work, *strange):
            file.write_text("half")
        link.symlink_to(at_work)
        with open(at_work, "r+", encoding="ascii") as locked:
            fcntl.flock(locked, fcntl.LOCK_EX)
            self.run_deck("deck", DECK, output="results")
            self.assertFalse(left.exists())
            for file in (at_work, link, *strange):
                self.assertTrue(file.exists(), file.name)
        self.run_deck("deck", output="results")
        self.assertFalse(at_work.exists())

    def test_a_part_of_a_killed_run(self):
        (self.folder/"large.nml").write_text(DECK.replace("wave_1d", "wave_2d") + "&output map = t, map_points = 4096 /\n")
        process = subprocess.Popen([self.program, "large.nml", "--quiet", "--output", "killed"], cwd=self.folder)
        found = []
        self.assertTrue(wait_for(lambda: found.extend(self.folder.glob("killed/.large.map.npy.*.part")) or found))
        self.assertEqual(f".large.map.npy.{HOST}.{process.pid}.part", found[0].name)
        process.send_signal(signal.SIGSTOP)
        if found[0].exists():
            # Another run does not take it while the process lives.
            self.run_deck("deck", DECK, output="killed")
            self.assertTrue(found[0].exists())
        process.kill()
        process.wait(PATIENCE)
        self.run_deck("deck", DECK, output="killed")
        self.assertFalse(found[0].exists())


if __name__ == "__main__":
    main()
