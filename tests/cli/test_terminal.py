#!/usr/bin/env python3
"""What a user sees of a long run: progress on a terminal alone, and after Ctrl-C how to go on.

usage: test_terminal.py --program WAVYCON [unittest's options]
"""
import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import termios
import time

from program import ProgramTest, main

DECK = """&surface kind = 'self_affine', rms_slope = 0.1, short_wavelength = 0.01, points = 256 /
&load contact_area_fraction = 0.02, 0.05, 0.1, 0.2 /
&method solver = 'grid', grid_points = 256, residual = 1e-12 /
"""
PATIENCE = 60   # [s]


class Terminal(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder/"a place").mkdir()
        (cls.folder/"a place"/"deck.nml").write_text(DECK)

    def on_terminal(self, columns, is_own):
        """What a run writes to a terminal, its own or, as under mpirun, that of nobody."""
        ours, its = pty.openpty()
        fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("4H", 24, columns, 0, 0))

        def take_terminal():
            os.setsid()
            if is_own:
                fcntl.ioctl(its, termios.TIOCSCTTY, 0)

        process = subprocess.Popen([self.program, "a place/deck.nml"], cwd=self.folder, stdout=its,
                                   stderr=subprocess.PIPE, preexec_fn=take_terminal)
        os.close(its)
        said = b""
        while True:
            try:
                some = os.read(ours, 65536)
            except OSError:   # the end of a terminal
                break
            if not some:
                break
            said += some
        process.communicate(timeout=PATIENCE)
        os.close(ours)
        self.assertEqual(0, process.returncode)
        return said.decode().replace("\r\n", "\n")

    def test_progress_fits_the_terminal_and_tells_the_time_left(self):
        for columns in (40, 100):
            lines = [part for line in self.on_terminal(columns, True).split("\n")
                     for part in line.split("\r")[1:] if part]
            self.assertGreater(len(lines), 2)
            for line in lines:
                if re.match("load|iter|stress| *$", line):
                    self.assertLess(len(line), columns)
            self.assertTrue(any(re.match(r"load [234] of 4, \d+ s, some \d+ s left: ", line) for line in lines), lines)

    def test_no_progress_where_nobody_looks(self):
        self.assertNotIn("\r", self.on_terminal(80, False))

    def test_an_interrupted_run_says_how_to_go_on(self):
        command = [self.program, "a place/deck.nml", "--set", "scene.title=it's", "--output", "kept"]
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        checkpoint = self.folder/"kept"/"deck.checkpoint"
        begun = time.monotonic()
        first = None
        while process.poll() is None and time.monotonic() < begun + PATIENCE:
            size = checkpoint.stat().st_size if checkpoint.exists() else 0
            first = first or size
            if first and size > first:
                break
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=PATIENCE)
        self.assertEqual(-signal.SIGINT, process.returncode)
        found = re.fullmatch(r"\nwavycon: interrupted: ([1-4]) of 4 loads are kept in kept/deck.checkpoint; "
                             r"the same command with --resume goes on\n", said)
        self.assertIsNotNone(found, said)
        done = subprocess.run([*command, "--resume"], cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertIn(f"resumed: {found[1]} of 4 loads", done.stdout)

    def test_interrupted_jobs_say_how_to_go_on(self):
        command = [self.program, "a place/deck.nml", "--sweep", "surface.seed=1,2,3,4", "--jobs", "2", "--output", "jobs"]
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        begun = time.monotonic()
        while process.poll() is None and time.monotonic() < begun + PATIENCE and \
                not list(self.folder.glob("jobs/*.checkpoint")):
            time.sleep(0.005)
        os.killpg(process.pid, signal.SIGINT)   # as Ctrl-C on a terminal
        _, said = process.communicate(timeout=PATIENCE)
        self.assertEqual(-signal.SIGINT, process.returncode)
        self.assertRegex(said, r"^\nwavycon: interrupted: [0-3] of 4 decks are done; "
                               r"the same command with --resume goes on\n$")


if __name__ == "__main__":
    main()
