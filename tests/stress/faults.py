"""Faults of the machine: full disks, removed directories, signals, limits, environments. No table may be incomplete."""
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import time

from common import complaints_about, files_below, finish, result_complaints, run, start, stripped, write

NOBODY = 65534
DECK = ("&surface kind = 'wave_2d' /\n&method solver = 'beale' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 19 /\n"
        "&output lines = t, map = t, contours = t, spots = t, histograms = t, theory = t, coefficients = t,\n"
        "spectrum = t, line_points = 64, map_points = 64 /\n")
# Half a second of work, half of it writing.
LONG_DECK = DECK.replace("sweep_steps = 19", "sweep_steps = 150").replace("map = t", "map = f").replace("histograms = t", "histograms = f")
# To be resumed: solvers that solve each load by itself and solvers that start from the last load; with and without
# fields.
TO_RESUME = {
    "beale": LONG_DECK,
    "series": LONG_DECK.replace("solver = 'beale'", "solver = 'series', harmonics = 9, constraint_points = 11"),
    "grids": DECK.replace("solver = 'beale'", "solver = 'grid', accuracy = 1e-3").replace(
        "theory = t, coefficients = t,\nspectrum = t, line_points = 64, map_points = 64",
        "line_points = 16, map_points = 16"),
    "fitted": "&surface kind = 'wave_2d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 91 /\n"
                  "&method solver = 'auto', accuracy = 1e-3 /\n",
    "areas": "&surface kind = 'hexagonal' /\n&load contact_area_fraction = 0.1, 0.3, 0.5, 0.7, 0.9 /\n"
             "&method solver = 'grid', accuracy = 1e-2 /\n&output contours = t /\n",
}
SECONDS = 60.0  # most processor time of a run, and time limit [s]
LEAST_MEGABYTES = 250  # of address space with which the program must run or report
TABLES = ("summary", "lines", "map", "contour", "spots", "spot_sizes", "histogram", "theory", "theory_lines",
          "coefficients", "spectrum")


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


def leftovers(folder):
    return [name for name in files_below(folder) if name.endswith(".part")]


class Faults:
    """The cases, each a method; `reference` holds the tables of an undisturbed run."""

    def __init__(self, settings, work):
        self.program, self.work, self.amount = settings.program, work, settings.amount
        self.stream = random.Random(f"{settings.seed} faults")
        self.part = settings.part("faults")
        self.number = 0
        outcome = self.run(self.folder())
        self.reference = self.work/"case 1"/"results"
        if complaints_about(outcome, (0,), SECONDS):
            raise SystemExit(f"the undisturbed run fails: {outcome.stderr.decode(errors='replace')}")

    def folder(self, text=DECK):
        """A new folder with a deck."""
        self.number += 1
        folder = self.work/f"case {self.number}"
        write({"deck.nml": text}, folder)
        return folder

    def start(self, folder, *words, results="results", **options):
        return start([self.program, "deck.nml", "--output", results, *words], folder, **options)

    def run(self, folder, *words, patience=SECONDS, **options):
        return finish(self.start(folder, *words, **options), patience)

    def in_shell(self, folder, script, *words):
        """Runs a line for sh, in which $0 is the program."""
        return run(["sh", "-c", script, self.program, *words], folder, patience=SECONDS)

    def count(self, name, outcome, statuses, folder=None):
        """Counts a case, whose tables must be those of the undisturbed run."""
        differ = whole(folder, self.reference) if folder else []
        self.part.count(name, complaints_about(outcome, statuses, SECONDS) + differ)

    def file_size_limits(self):
        sizes = sorted(path.stat().st_size for path in self.reference.iterdir())
        limits = {0, 1, 511} | {size + change for size in sizes for change in (-1, 0)}
        limits |= {self.stream.randrange(sizes[-1]) for _ in range(self.amount(60, 5))}
        for limit in sorted(limits):
            folder = self.folder()
            outcome = self.run(folder, limits=[(resource.RLIMIT_FSIZE, limit)])
            self.count(f"files of at most {limit} bytes", outcome, (0, 3) if limit >= sizes[-1] else (3,), folder)

    def full_disk(self):
        """A small file system in memory, if mounting is permitted; and /dev/full in the place of each file."""
        mount = self.folder()
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(mount)], capture_output=True,
                              check=False).returncode == 0
        if not made:
            self.part.notes.append("SKIPPED a small file system: mounting is not permitted")
        else:
            try:
                for filled in (0, 20000, 40000, 60000, 65536):
                    (mount/"filler").write_bytes(b"x"*filled)
                    outcome = self.run(self.folder(), results=mount/"results")
                    self.count(f"disk of 64 kB, {filled} bytes of it taken", outcome, (3,), mount)
                    shutil.rmtree(mount/"results", ignore_errors=True)
            finally:
                subprocess.run(["umount", str(mount)], check=False)
        # The user did not request the checkpoint: the run goes on without it.
        for table in ("resolved.nml", *(f"{name}.dat" for name in TABLES), "checkpoint"):
            folder = self.folder()
            (folder/"results").mkdir()
            outcome = self.in_shell(folder, 'ln -s /dev/full "results/deck.$1"; "$0" deck.nml --output results; '
                                            'status=$?; rm -f "results/deck.$1"; exit $status', table)
            self.count(f"/dev/full for {table}", outcome, (0,) if table == "checkpoint" else (3,), folder)

    def directories(self):
        for name, spoil in (("gone", lambda folder: shutil.rmtree(folder/"results")),
                            ("moved", lambda folder: (folder/"results").rename(folder/"elsewhere")),
                            ("a file", self.replace_by_file)):
            for delay in (0.02, 0.1, 0.2, 0.3, 0.5):
                folder = self.folder(LONG_DECK)
                process = self.start(folder)
                while process.poll() is None and not (folder/"results"/"deck.resolved.nml").exists():
                    time.sleep(0.002)
                time.sleep(delay)
                try:
                    spoil(folder)
                except OSError:
                    pass  # the program is writing to it; the run is a case all the same
                self.part.count(f"output directory {name} after {delay} s",
                                complaints_about(finish(process, SECONDS), (0, 3), SECONDS) +
                                [f"{left} is left behind" for left in leftovers(folder)
                                 if not left.startswith("elsewhere")])
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
            outcome = self.run(folder, before=step_down)
        except (OSError, subprocess.SubprocessError):
            self.part.notes.append("SKIPPED a directory that may not be written to: nobody cannot run the program")
            return
        self.count("output directory may not be written to", outcome, (3,))

    def interrupted(self, folder, length, signals, *words):
        """Starts a run and sends it a signal within its length: what is wrong with its end, and when it was sent."""
        process = self.start(folder, *words)
        delay, sent = self.stream.uniform(0, length), self.stream.choice(signals)
        time.sleep(delay)
        process.send_signal(sent)
        outcome = finish(process, SECONDS)
        said = [] if outcome.status in (0, -sent) else [f"exit status {outcome.status} after {sent.name}"]
        if sent != signal.SIGKILL:
            # A process cannot remove anything after SIGKILL.
            said += [f"{name} is left behind" for name in leftovers(folder)]
            if re.search(rb"Backtrace|Program received", outcome.stderr):
                said.append("says 'Backtrace'")
        return said, delay

    def undisturbed(self, text):
        """The folder and the length [s] of a run."""
        folder, begun = self.folder(text), time.monotonic()
        self.count("sweep to be interrupted", self.run(folder), (0,))
        return folder, time.monotonic() - begun

    def signals(self):
        good, length = self.undisturbed(LONG_DECK)
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL):
            for _ in range(self.amount(25, 3)):
                folder = self.folder(LONG_DECK)
                said, delay = self.interrupted(folder, length, [sent])
                said += [f"{path.name} is not that of an undisturbed run" for path in folder.rglob("*.dat")
                         if stripped(path) != stripped(good/"results"/path.name)]
                self.part.count(f"{sent.name} after {delay:.2f} of {length:.2f} s", said)

    def resumed(self):
        """Sweeps that are interrupted, some two or three times, and resumed: the tables are the same, byte by byte."""
        found = 0
        times = self.amount(15, 4)
        for name, text in TO_RESUME.items():
            good, length = self.undisturbed(text)
            for _ in range(times):
                folder = self.folder(text)
                words, more, delays = [], (), []
                for _ in range(self.stream.randrange(1, 4)):
                    signals = signal.SIGINT, signal.SIGTERM, signal.SIGKILL
                    said, delay = self.interrupted(folder, length, signals, *more)
                    # A later run removes what a killed one left.
                    words += [word for word in said if not word.endswith("left behind")]
                    delays.append(f"{delay:.2f}")
                    more = ("--resume",)
                outcome = self.run(folder, *more)
                match = re.search(rb"^resumed: (\d+) of", outcome.stdout, re.MULTILINE)
                found += bool(match and int(match.group(1)))
                words += complaints_about(outcome, (0,), SECONDS)
                for path in (good/"results").iterdir():
                    other = folder/"results"/path.name
                    if not other.exists() or other.read_bytes() != path.read_bytes():
                        words.append(f"{path.name} is not that of an undisturbed run")
                if (folder/"results"/"deck.checkpoint").exists():
                    words.append("the checkpoint is left behind")
                self.part.count(f"{name} interrupted after {', '.join(delays)} of {length:.2f} s and resumed", words)
        self.part.notes.append(f"{found} of {times*len(TO_RESUME)} resumed runs found finished loads")

    def two_runs(self):
        for _ in range(self.amount(10, 2)):
            folder = self.folder()
            words = []
            for process in [self.start(folder) for _ in range(3)]:
                words += complaints_about(finish(process, SECONDS), (0,), SECONDS)
            self.part.count("three runs into one directory", words + whole(folder, self.reference) +
                            ([] if (folder/"results"/"deck.map.dat").exists() else ["a table is missing"]) +
                            (["a checkpoint is left"] if (folder/"results"/"deck.checkpoint").exists() else []))

    def memory(self):
        grid = ("&surface kind = 'wave_2d', wavelength_y = 2 /\n&load pbar_over_pstar = 0.5 /\n"
                "&method solver = 'grid', grid_points = 2048 /\n")
        for amount in (20, 100, 150, 250, 300, 500, 1000):
            for name, text in (("series", DECK), ("grid", grid)):
                folder = self.folder(text)
                outcome = self.run(folder, patience=15, limits=[(resource.RLIMIT_AS, amount*1000000)])
                # Below some 200 MB the loader ends the program or OpenBLAS waits for memory for ever: only the files of
                # the program are checked.
                words = [] if amount < LEAST_MEGABYTES else complaints_about(outcome, (0, 1, 3), SECONDS)
                if name == "series":
                    words += whole(folder, self.reference)
                if outcome.status == 0 and not (folder/"results"/"deck.summary.dat").exists():
                    words.append("succeeds without a result")
                self.part.count(f"memory of {amount} MB, {name}", words)

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
            self.count(f"environment: {name}", self.run(folder, environment=environment), (0,), folder)

    def streams(self):
        for name, tail in (("stdout closed", ">&-"), ("stderr closed", "2>&-"), ("stdin closed", "<&-"),
                           ("all closed", "<&- >&- 2>&-"), ("stdout full", ">/dev/full"), ("stderr full", "2>/dev/full")):
            script = f'"$0" deck.nml --output results {tail}'
            folder = self.folder()
            self.count(name, self.in_shell(folder, script), (3,) if name == "stdout full" else (0,), folder)
            outcome = self.in_shell(self.folder("&surface kind = 'no' /\n"), script)
            self.part.count(f"{name}, a bad deck", [] if outcome.status == 1 else [f"exit status {outcome.status}"])
        folder = self.folder(LONG_DECK)
        outcome = self.in_shell(folder, '"$0" deck.nml --output results | head -1')
        self.part.count("stdout is a pipe that is closed", complaints_about(outcome, (0,), SECONDS) +
                        [f"{name} is left behind" for name in leftovers(folder)])


def campaign(settings, work):
    faults = Faults(settings, work)
    for case in (faults.file_size_limits, faults.full_disk, faults.directories, faults.signals, faults.resumed,
                 faults.two_runs, faults.memory, faults.environments, faults.streams):
        case()
    return faults.part
