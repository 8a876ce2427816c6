"""Faults of the machine: full disks, removed directories, signals, limits, environments. No table may be incomplete."""
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import time

from common import Part, complaints_about, files_below, result_complaints, run

NOBODY = 65534
DECK = ("&surface kind = 'wave_2d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 19 /\n"
        "&output lines = t, map = t, contours = t, spots = t, histograms = t, theory = t, coefficients = t,\n"
        "spectrum = t, line_points = 64, map_points = 64 /\n")
# Half a second of work, half of it writing.
LONG_DECK = DECK.replace("sweep_steps = 19", "sweep_steps = 150").replace("map = t", "map = f").replace("histograms = t", "histograms = f")
# To be resumed: solvers that solve each load by itself and solvers that start from the last load; with and without
# fields.
TO_RESUME = {
    "series": LONG_DECK,
    "grids": DECK.replace("theory = t, coefficients = t,\nspectrum = t, line_points = 64, map_points = 64",
                          "line_points = 16, map_points = 16")
    + "&method solver = 'grid', accuracy = 1e-3 /\n",
    "expansions": "&surface kind = 'wave_2d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 91 /\n"
                  "&method solver = 'auto', accuracy = 1e-3 /\n",
    "areas": "&surface kind = 'hexagonal' /\n&load contact_area_fraction = 0.1, 0.3, 0.5, 0.7, 0.9 /\n"
             "&method solver = 'grid', accuracy = 1e-2 /\n&output contours = t /\n",
}
LEAST_MEGABYTES = 250  # of address space with which the program must run or report
TABLES = ("summary", "lines", "map", "contour", "spots", "spot_sizes", "histogram", "theory", "theory_lines",
          "coefficients", "spectrum")


def prepare(folder, text=DECK):
    folder.mkdir(parents=True)
    (folder/"deck.nml").write_text(text)


def whole(folder, reference):
    """Which tables differ from those of an undisturbed run."""
    words = result_complaints(folder, files_below(folder))
    for path in folder.rglob("*.dat"):
        good = reference/path.name
        if not good.exists():
            words.append(f"{path.name} should not be there")
        elif stripped(path) != stripped(good):
            words.append(f"{path.name} is not that of an undisturbed run")
    return words


def stripped(path):
    """A table without its head, which may name paths and programs."""
    return [line for line in path.read_text(errors="replace").splitlines() if not line.startswith("#")]


def leftovers(folder):
    return [name for name in files_below(folder) if name.endswith(".part")]


class Faults:
    """The cases, each a method; `reference` holds the tables of an undisturbed run."""

    def __init__(self, program, seed, quick, work):
        self.program, self.quick, self.work = program, quick, work
        self.stream = random.Random(f"{seed} faults")
        self.part = Part("faults")
        self.skipped = []
        self.notes = []
        self.reference = work/"reference"/"results"
        self.number = 0
        prepare(self.reference.parent)
        outcome = run([program, "deck.nml", "--output", "results"], self.reference.parent)
        if complaints_about(outcome, (0,), seconds=60):
            raise SystemExit(f"the undisturbed run fails: {outcome.stderr.decode(errors='replace')}")

    def folder(self, text=DECK):
        self.number += 1
        folder = self.work/f"case {self.number}"
        prepare(folder, text)
        return folder

    def count_case(self, name, outcome, folder, statuses, reference=True):
        words = complaints_about(outcome, statuses, seconds=60)
        if reference:
            words += whole(folder, self.reference)
        self.part.count(name, words)

    def file_size_limits(self):
        sizes = sorted(path.stat().st_size for path in self.reference.iterdir())
        limits = {0, 1, 511} | {size + change for size in sizes for change in (-1, 0)}
        limits |= {self.stream.randrange(sizes[-1]) for _ in range(5 if self.quick else 60)}
        for limit in sorted(limits):
            folder = self.folder()
            outcome = run([self.program, "deck.nml", "--output", "results"], folder,
                          limits=[(resource.RLIMIT_FSIZE, limit)])
            self.count_case(f"files of at most {limit} bytes", outcome, folder, (0, 3) if limit >= sizes[-1] else (3,))

    def full_disk(self):
        """A small file system in memory, if mounting is permitted; and /dev/full in the place of each file."""
        mount = self.work/"small disk"
        mount.mkdir()
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(mount)], capture_output=True,
                              check=False).returncode == 0
        if not made:
            self.skipped.append("a small file system: mounting is not permitted")
        else:
            try:
                for filled in (0, 20000, 40000, 60000, 65536):
                    (mount/"filler").write_bytes(b"x"*filled)
                    folder = self.folder()
                    outcome = run([self.program, "deck.nml", "--output", mount/"results"], folder)
                    words = complaints_about(outcome, (3,), seconds=60) + whole(mount, self.reference)
                    self.part.count(f"disk of 64 kB, {filled} bytes of it taken", words)
                    shutil.rmtree(mount/"results", ignore_errors=True)
            finally:
                subprocess.run(["umount", str(mount)], check=False)
        for table in ("resolved.nml", *(f"{name}.dat" for name in TABLES)):
            folder = self.folder()
            (folder/"results").mkdir()
            script = 'ln -s /dev/full "results/.deck.$1.$$.part"; exec "$0" deck.nml --output results'
            outcome = run(["sh", "-c", script, self.program, table], folder)
            self.count_case(f"/dev/full for {table}", outcome, folder, (3,))
        # The user did not request the checkpoint: the run goes on without it.
        folder = self.folder()
        (folder/"results").mkdir()
        outcome = run(["sh", "-c", script, self.program, "checkpoint"], folder)
        self.count_case("/dev/full for the checkpoint", outcome, folder, (0,))

    def directories(self):
        for name, spoil in (("gone", lambda folder: shutil.rmtree(folder/"results")),
                            ("moved", lambda folder: (folder/"results").rename(folder/"elsewhere")),
                            ("a file", self.replace_by_file)):
            for delay in (0.02, 0.1, 0.2, 0.3, 0.5):
                folder = self.folder(LONG_DECK)
                process = self.start(folder)
                self.wait_for(folder/"results"/"deck.resolved.nml", process)
                time.sleep(delay)
                try:
                    spoil(folder)
                except OSError:
                    pass  # the program is writing to it; the run is a case all the same
                self.part.count(f"output directory {name} after {delay} s",
                                complaints_about(self.outcome(process), (0, 3), seconds=60) +
                                [f"{name} is left behind" for name in leftovers(folder)
                                 if not name.startswith("elsewhere")])
        if os.geteuid() == 0:
            self.as_nobody()

    @staticmethod
    def replace_by_file(folder):
        shutil.rmtree(folder/"results")
        (folder/"results").write_text("precious\n")

    def as_nobody(self):
        """A directory without write permission, by another user than root."""

        def step_down():
            os.setgroups([])
            os.setgid(NOBODY)
            os.setuid(NOBODY)

        folder = self.folder()
        (folder/"results").mkdir(mode=0o555)
        try:
            process = subprocess.Popen([self.program, "deck.nml", "--output", "results"], cwd=folder, preexec_fn=step_down,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        except (OSError, subprocess.SubprocessError):
            self.skipped.append("a directory that may not be written to: nobody cannot run the program")
            return
        self.part.count("output directory may not be written to",
                        complaints_about(self.outcome(process), (3,), seconds=60))

    def start(self, folder, *words):
        process = subprocess.Popen([self.program, "deck.nml", "--output", "results", *words], cwd=folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.begun = time.monotonic()
        return process

    @staticmethod
    def outcome(process):
        try:
            stdout, stderr = process.communicate(timeout=60)
            hung = False
        except subprocess.TimeoutExpired:
            process.kill()
            stdout, stderr = process.communicate()
            hung = True
        result = run(["true"], "/")
        result.status, result.stdout, result.stderr, result.hung = process.returncode, stdout, stderr, hung
        return result

    @staticmethod
    def wait_for(path, process):
        while process.poll() is None and not path.exists():
            time.sleep(0.002)

    def signals(self):
        undisturbed = self.folder(LONG_DECK)
        begun = time.monotonic()
        good = self.outcome(self.start(undisturbed))
        length = time.monotonic() - begun
        self.part.count("sweep to be interrupted", complaints_about(good, (0,), seconds=60))
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL):
            for _ in range(3 if self.quick else 25):
                folder = self.folder(LONG_DECK)
                process = self.start(folder)
                delay = self.stream.uniform(0, length)
                time.sleep(delay)
                process.send_signal(sent)
                outcome = self.outcome(process)
                words = []
                if outcome.status not in (0, -sent):
                    words.append(f"exit status {outcome.status}")
                if sent != signal.SIGKILL and re.search(rb"Backtrace|Program received", outcome.stderr):
                    words.append("says 'Backtrace'")
                for path in folder.rglob("*.dat"):
                    if stripped(path) != stripped(undisturbed/"results"/path.name):
                        words.append(f"{path.name} is not that of an undisturbed run")
                # A process cannot remove anything after SIGKILL.
                if sent != signal.SIGKILL:
                    words += [f"{name} is left behind" for name in leftovers(folder)]
                self.part.count(f"{sent.name} after {delay:.2f} of {length:.2f} s", words)

    def resumed(self):
        """Sweeps that are interrupted, some two or three times, and resumed: the tables are the same, byte by byte."""
        found = 0
        times = 4 if self.quick else 15
        for name, text in TO_RESUME.items():
            undisturbed = self.folder(text)
            process = self.start(undisturbed)
            self.part.count(f"{name}, to be resumed", complaints_about(self.outcome(process), (0,), seconds=60))
            length = time.monotonic() - process.begun
            for _ in range(times):
                folder = self.folder(text)
                words, more, delays = [], (), []
                for _ in range(self.stream.randrange(1, 4)):
                    process = self.start(folder, *more)
                    delays.append(self.stream.uniform(0, length))
                    time.sleep(delays[-1])
                    sent = self.stream.choice((signal.SIGINT, signal.SIGTERM, signal.SIGKILL))
                    process.send_signal(sent)
                    outcome = self.outcome(process)
                    if outcome.status not in (0, -sent):
                        words.append(f"exit status {outcome.status} when interrupted")
                    more = ("--resume",)
                outcome = self.outcome(self.start(folder, *more))
                match = re.search(rb"^resumed: (\d+) of", outcome.stdout, re.MULTILINE)
                found += bool(match and int(match.group(1)))
                words += complaints_about(outcome, (0,), seconds=60)
                for path in (undisturbed/"results").iterdir():
                    other = folder/"results"/path.name
                    if not other.exists():
                        words.append(f"{path.name} is missing")
                    elif other.read_bytes() != path.read_bytes():
                        words.append(f"{path.name} is not that of an undisturbed run")
                if (folder/"results"/"deck.checkpoint").exists():
                    words.append("the checkpoint is left behind")
                places = ", ".join(f"{delay:.2f}" for delay in delays)
                self.part.count(f"{name} interrupted after {places} of {length:.2f} s and resumed", words)
        self.notes.append(f"{found} of {times*len(TO_RESUME)} resumed runs found finished loads")

    def two_runs(self):
        for _ in range(2 if self.quick else 10):
            folder = self.folder()
            processes = [self.start(folder) for _ in range(3)]
            words = []
            for process in processes:
                words += complaints_about(self.outcome(process), (0,), seconds=60)
            self.part.count("three runs into one directory", words + whole(folder, self.reference) +
                            ([] if (folder/"results"/"deck.map.dat").exists() else ["a table is missing"]) +
                            (["a checkpoint is left"] if (folder/"results"/"deck.checkpoint").exists() else []))

    def memory(self):
        megabyte = 1000000
        grid = ("&surface kind = 'wave_2d', wavelength_y = 2 /\n&load pbar_over_pstar = 0.5 /\n"
                "&method solver = 'grid', grid_points = 2048 /\n")
        least = None
        asleep = []
        for amount in (20, 100, 150, 250, 300, 500, 1000):
            limits = [(resource.RLIMIT_AS, amount*megabyte)]
            for name, text in (("series", DECK), ("grid", grid)):
                folder = self.folder(text)
                outcome = run([self.program, "deck.nml", "--output", "results"], folder, limits=limits, patience=15)
                # Below some 200 MB the loader ends the program or OpenBLAS waits for memory for ever: only the files of
                # the program are checked.
                if amount < LEAST_MEGABYTES:
                    words = []
                    if outcome.hung:
                        asleep.append(f"{amount} MB ({name})")
                else:
                    words = complaints_about(outcome, (0, 1, 3), seconds=60)
                if name == "series":
                    words += whole(folder, self.reference)
                if outcome.status == 0 and not (folder/"results"/"deck.summary.dat").exists():
                    words.append("succeeds without a result")
                if outcome.status == 0 and name == "series" and least is None:
                    least = amount
                self.part.count(f"memory of {amount} MB, {name}", words)
        if asleep:
            self.notes.append(f"OpenBLAS waits for ever for memory at {', '.join(asleep)}")
        self.part.worst = f"needs {least} MB"

    def environments(self):
        # The choice of kernels of OpenBLAS is kept: others round differently.
        kernels = {name: os.environ[name] for name in ("OPENBLAS_CORETYPE",) if name in os.environ}
        basic = dict(kernels, PATH=os.environ["PATH"])
        cases = {
            "nothing": kernels,
            "no HOME": basic,
            "C": dict(basic, LC_ALL="C"),
            "a locale that is not there": dict(basic, LC_ALL="xx_YY.UTF-8", LANG="nonsense"),
            "decimal commas": dict(basic, LC_ALL="de_DE.UTF-8", LC_NUMERIC="de_DE.UTF-8", LANG="de_DE.UTF-8"),
            "unbuffered": dict(basic, GFORTRAN_UNBUFFERED_ALL="1"),
            "TMPDIR that is not there": dict(basic, TMPDIR="/nowhere/at/all"),
            "TERM=dumb, columns": dict(basic, TERM="dumb", COLUMNS="1"),
            "threads": dict(basic, OMP_NUM_THREADS="7", OPENBLAS_NUM_THREADS="7"),
            "record marks": dict(basic, GFORTRAN_CONVERT_UNIT="swap", GFORTRAN_SHOW_LOCUS="1"),
            "list separator": dict(basic, GFORTRAN_LIST_SEPARATOR=";;;", GFORTRAN_DEFAULT_RECL="50"),
        }
        for name, environment in cases.items():
            folder = self.folder()
            outcome = run([self.program, "deck.nml", "--output", "results"], folder, environment=environment)
            self.count_case(f"environment: {name}", outcome, folder, (0,))

    def streams(self):
        for name, tail in (("stdout closed", ">&-"), ("stderr closed", "2>&-"), ("stdin closed", "<&-"),
                           ("all closed", "<&- >&- 2>&-"), ("stdout full", ">/dev/full"), ("stderr full", "2>/dev/full")):
            folder = self.folder()
            outcome = run(["sh", "-c", f'"$0" deck.nml --output results {tail}', self.program], folder)
            self.count_case(name, outcome, folder, (0,))
            folder = self.folder("&surface kind = 'no' /\n")
            outcome = run(["sh", "-c", f'"$0" deck.nml --output results {tail}', self.program], folder)
            self.part.count(f"{name}, a bad deck", [] if outcome.status == 1 else [f"exit status {outcome.status}"])
        folder = self.folder(LONG_DECK)
        outcome = run(["sh", "-c", '"$0" deck.nml --output results | head -1', self.program], folder)
        self.part.count("stdout is a pipe that is closed", complaints_about(outcome, (0,), seconds=60) +
                        [f"{name} is left behind" for name in leftovers(folder)])


def campaign(program, seed, quick, work, _failures):
    faults = Faults(program, seed, quick, work)
    faults.file_size_limits()
    faults.full_disk()
    faults.directories()
    faults.signals()
    faults.resumed()
    faults.two_runs()
    faults.memory()
    faults.environments()
    faults.streams()
    faults.part.notes = [f"SKIPPED {words}" for words in faults.skipped] + faults.notes
    return faults.part
