"""Common to the parts of the campaign: running the program with limits, conditions on every run, and the table."""
import argparse
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent/"support"))
from program import hear_signals  # noqa: E402
from rough_map import rough_map  # noqa: E402, F401
from tables import Table  # noqa: E402

hear_signals()

SECONDS = 2.0  # most processor time of a deck that needs little work [s]
PATIENCE = 60.0  # a run that takes longer, also on a busy machine, is killed and counts as hanging [s]
MOST_KEPT = 10**6  # bytes of a file of a case that failed
MOST_SHOWN = 20  # failures of a part that are printed

# Messages of the compiler's run-time library, the sanitizers and the C library after a programming error.
RUNTIME_WORDS = re.compile(
    rb"Fortran runtime error|At line \d+ of file|Backtrace for|Error termination|Program received signal"
    rb"|AddressSanitizer|LeakSanitizer|runtime error:|double free|corrupted|Segmentation|IEEE_|STOP|ERROR STOP")

# Characters that act on a terminal or are invisible: controls, marks of the writing direction, line ends, odd blanks.
UNFIT = re.compile("[\x00-\x09\x0b-\x1f\x7f-\xa0\xad\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f"
                   "\ud800-\udfff\ufeff\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e0fff\U0010fffe\U0010ffff]")

# Overflow, and fields too narrow for their numbers.
OVERFLOW = re.compile(r"[+-]?(inf|infinity)|\*{3,}", re.IGNORECASE)
# The kinds of tables, and the columns in which NaN stands for what a solver or a surface does not have.
MAY_BE_MISSING = {
    "summary": ".*_error|.*_at_hardness_fraction|contact_area_(counted|corrected)_fraction|linear_area_fraction|"
               "elastic_energy.*",
    "lines": "",
    "map": "",
    "contour": "",
    "spots": "perimeter",
    "spot_sizes": "perimeter|load_fraction|mean_pressure|x|y",
    "histogram": "",
    "coefficients": "",
    "theory": "(?!load$|pbar_over_pstar$).*",
    "theory_lines": "(westergaard|dundurs|hertz|crack)_.*",
    "details": "(trough|saddle|elastic|perimeter).*",
    "spectrum": "spectrum_[12]d",
    "stress_largest": "stress_over_yield_stress.*|.*_error",
    "stress_line": "stress_error",
    "stress_section": "stress_error",
    "stress_planes": "stress_error",
    "interface": "(contact_stiffness|contact_area_slope|mean_gap_curvature|contact_resistance).*",
    "partial_slip": "stick_.*|tangential_over_limit|.*displacement.*|tangential_stiffness|cycle_energy.*",
    "slip_loop": "displacement",
    "slip_map": "traction|pressure|slip_state",
    "adhesion": "(?!load$).*",
    "bounds": "(energy|approach|mean_gap)_.*",
}
# On surfaces with free edges, which have no p*, at the border no peak, and on profiles no approach.
MISSING_WITH_FREE_EDGES = ".*_over_pstar|approach.*|peak_pressure"
TABLE = re.compile(rf".*\.({'|'.join(MAY_BE_MISSING)})\.dat")


class Part:
    """A line of the table; cases that fail are kept in a folder."""

    def __init__(self, name, failures):
        self.name, self.kept_in = name, failures
        self.tried = self.passed = 0
        self.worst = ""  # the worst number, as text
        self.numbers = {}  # the worst numbers by their names, shown in place of it
        self.failures = []  # (name of the case, what is wrong)
        self.notes = []

    def count(self, name, complaints, files=()):
        """Counts a case, which failed if there are complaints: its files are then kept. Returns whether it passed."""
        self.tried += 1
        if not complaints:
            self.passed += 1
            return True
        self.failures.append((name, "; ".join(complaints)))
        for file in files:
            (self.kept_in/name).mkdir(parents=True, exist_ok=True)
            (self.kept_in/name/file).write_bytes(as_bytes(files[file])[:MOST_KEPT])
        return False

    def limit(self, what, value, most, complaints, words):
        """Notes a number, and complains in these words if it is larger than allowed."""
        self.numbers[what] = max(self.numbers.get(what, 0.0), value)
        if not value <= most:
            complaints.append(words)

    def show(self, seconds):
        """Prints the line, the notes and the failures."""
        worst = self.worst or ", ".join(f"{what} {value:.2g}" for what, value in self.numbers.items())
        print(f"{self.name:40}{self.tried:8d}{self.passed:8d}{len(self.failures):8d}{seconds:9.0f}  {worst}")
        for line in self.notes:
            print(f"   {line}")
        for case, words in self.failures[:MOST_SHOWN]:
            print(f"   FAILED {case}: {words}")
        if len(self.failures) > MOST_SHOWN:
            print(f"   and {len(self.failures) - MOST_SHOWN} more")
        sys.stdout.flush()


class Settings(argparse.Namespace):
    """What the command line asks for, and the folder `results` for the cases of a part that fail."""

    def part(self, name):
        return Part(name, self.results)

    def amount(self, full, quick):
        return quick if self.quick else full

    def cases(self, what, kinds, numbers):
        """Name, random numbers and kind of so many cases of each kind."""
        for kind in kinds:
            for number in range(numbers):
                name = f"{what}-{kind}-{number}".replace(" ", "-")
                yield name, random.Random(f"{self.seed} {name}"), kind


def as_bytes(content):
    return content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass")


def write(files, folder):
    """Writes {name: text or bytes} into a new folder."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, content in files.items():
        (folder/name).parent.mkdir(parents=True, exist_ok=True)
        (folder/name).write_bytes(as_bytes(content))


class Outcome:
    """How a run ended."""

    def __init__(self, status, stdout, stderr, seconds, hung):
        self.status, self.stdout, self.stderr = status, stdout, stderr
        self.seconds, self.hung = seconds, hung


def start(arguments, folder, limits=(), environment=None, before=None):
    """Starts a program. `limits` are (resource, amount) pairs for it; `before` is called in its process."""

    def prepare():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        for name, amount in limits:
            resource.setrlimit(name, (amount, amount))
        if before:
            before()

    variables = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1") if environment is None else environment
    process = subprocess.Popen([str(word) for word in arguments], cwd=folder, env=variables, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=prepare)
    process.begun = time.monotonic()
    return process


def finish(process, patience=PATIENCE):
    """Waits for its end."""
    begun, hung = processor_time(), False
    with process:
        try:
            stdout, stderr = process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            process.kill()
            stdout, stderr = process.communicate()
            hung = True
    return Outcome(process.returncode, stdout, stderr, processor_time() - begun, hung)


def run(arguments, folder, patience=PATIENCE, **options):
    """Runs a program to its end."""
    return finish(start(arguments, folder, **options), patience)


def processor_time():
    """Processor time of all programs that have ended [s], which does not depend on other load of the machine."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def memory_limits(program, part, address_space):
    """Limits of a run to so many bytes of address space; none if the program cannot start with them, as sanitizers
    reserve terabytes."""
    limits = [(resource.RLIMIT_AS, address_space)]
    if run([program, "--version"], "/", limits=limits).status == 0:
        return limits
    part.notes.append("memory is not bounded: the program does not start within the bound")
    return []


def complaints_about(outcome, statuses=(0, 1, 2, 3), seconds=SECONDS):
    """What is wrong with a run, whatever its input: hanging, signals, unknown statuses, unfit messages."""
    words = []
    if outcome.hung:
        return [f"hangs: killed after {outcome.seconds:.0f} s of processor time"]
    if outcome.status < 0:
        words.append(f"killed by signal {signal.Signals(-outcome.status).name}")
    elif outcome.status not in statuses:
        words.append(f"exit status {outcome.status}")
    if outcome.seconds > seconds:
        words.append(f"takes {outcome.seconds:.1f} s")
    for stream, text in (("stdout", outcome.stdout), ("stderr", outcome.stderr)):
        match = RUNTIME_WORDS.search(text)
        if match:
            words.append(f"{stream} says '{match.group().decode()}'")
        try:
            clean = text.decode()
        except UnicodeDecodeError:
            words.append(f"{stream} is not UTF-8")
            continue
        match = UNFIT.search(clean)
        if match:
            words.append(f"{stream} holds the character {match.group()!a}")
    if outcome.status in (1, 3) and not outcome.stderr:
        words.append("fails without a word")
    if outcome.status == 0 and outcome.stderr:
        words.append("succeeds with words on stderr")
    return words


def files_below(folder):
    """The files and links below a folder, relative to it."""
    return {str(path.relative_to(folder)) for path in pathlib.Path(folder).rglob("*")
            if path.is_symlink() or not path.is_dir()}


def result_complaints(folder, names):
    """What is wrong with result files: parts left behind, incomplete lines, NaN, infinity or overflowed fields."""
    words = []
    for name in sorted(names):
        if name.endswith(".part"):
            words.append(f"{name} is left behind")
        kind = TABLE.fullmatch(name)
        if not kind:
            continue
        path = pathlib.Path(folder)/name
        text = path.read_text(errors="replace")
        may_be_missing = MAY_BE_MISSING[kind[1]]
        if ", free edges" in text[:2000]:
            may_be_missing += "|" + MISSING_WITH_FREE_EDGES
        if not text.endswith("\n"):
            words.append(f"{name} does not end with a line")
        try:
            complaints = table_complaints(Table(path), may_be_missing)
            words += [f"{name}: {complaint}" for complaint in complaints[:1]]
        except ValueError as error:
            words.append(str(error))
    return words


def stripped(path):
    """A table without its head, which may name paths and programs."""
    return [line for line in path.read_text(errors="replace").splitlines() if not line.startswith("#")]


def table_complaints(table, may_be_missing):
    """Entries of a table that are no numbers and should be."""
    return [f"{name} is {word}" for row in table.rows() for name, word in zip(table.columns, row)
            if OVERFLOW.fullmatch(word) or word == "NaN" and not re.fullmatch(may_be_missing, name)]


def check_all(part, program, cases, work, limits=()):
    """Runs `--check` of cases: a name, {file: content} with deck.nml among them, more words of the command, and a
    function that says what is wrong with the outcome. Returns the part."""
    slowest, accepted = ("", 0.0), 0
    for name, files, words, judge in cases:
        write(files, work)
        outcome = run([program, "--check", "deck.nml", *words], work, limits=limits)
        complaints = complaints_about(outcome, (0, 1, 3)) + judge(outcome)
        made = files_below(work) - set(files)
        if made:
            complaints.append(f"--check makes {sorted(made)[0]}")
        slowest = max(slowest, (name, outcome.seconds), key=lambda pair: pair[1])
        accepted += outcome.status == 0
        part.count(name, complaints, files)
    part.worst = f"{accepted} accepted, {slowest[1]:.2f} s ({slowest[0]})"
    return part
