"""Common to the parts of the campaign: running the program with limits, conditions on every run, and the table."""
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent/"support"))
from tables import Table  # noqa: E402

SECONDS = 2.0  # most processor time of a deck that needs little work [s]
PATIENCE = 10.0  # a run that takes longer is killed and counts as hanging [s]

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
    "slip_loop": "",
    "slip_map": "traction|pressure|slip_state",
    "adhesion": "(?!load$).*",
}
# On surfaces with free edges, which have no p*, and on profiles no approach.
MISSING_WITH_FREE_EDGES = ".*_over_pstar|approach.*"
TABLE = re.compile(rf".*\.({'|'.join(MAY_BE_MISSING)})\.dat")


class Part:
    """A line of the table."""

    def __init__(self, name):
        self.name = name
        self.tried = self.passed = 0
        self.worst = ""  # the worst number, as text
        self.failures = []  # (name of the case, what is wrong)
        self.notes = []

    def count(self, name, complaints):
        """Counts a case, which failed if there are complaints. Returns whether it passed."""
        self.tried += 1
        if complaints:
            self.failures.append((name, "; ".join(complaints)))
        else:
            self.passed += 1
        return not complaints


class Outcome:
    """How a run ended."""

    def __init__(self, status, stdout, stderr, seconds, hung):
        self.status, self.stdout, self.stderr = status, stdout, stderr
        self.seconds, self.hung = seconds, hung


def run(arguments, folder, patience=PATIENCE, limits=(), environment=None, **options):
    """Runs a program to its end. `limits` are (resource, amount) pairs for it."""

    def set_limits():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        for name, amount in limits:
            resource.setrlimit(name, (amount, amount))

    variables = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    if environment is not None:
        variables = environment
    begun = processor_time()
    with subprocess.Popen([str(word) for word in arguments], cwd=folder, env=variables, stdin=subprocess.DEVNULL,
                          stdout=options.get("stdout", subprocess.PIPE), stderr=options.get("stderr", subprocess.PIPE),
                          preexec_fn=set_limits) as process:
        hung = False
        try:
            stdout, stderr = process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            process.kill()
            stdout, stderr = process.communicate()
            hung = True
    return Outcome(process.returncode, stdout or b"", stderr or b"", processor_time() - begun, hung)


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


def table_complaints(table, may_be_missing):
    """Entries of a table that are no numbers and should be."""
    return [f"{name} is {word}" for row in table.rows() for name, word in zip(table.columns, row)
            if OVERFLOW.fullmatch(word) or word == "NaN" and not re.fullmatch(may_be_missing, name)]


def check_all(part, program, cases, work, failures, limits=()):
    """Runs `--check` of cases, which are a name, {file: bytes} with deck.nml among them, more words of the command, and
    a function that says what is wrong with the outcome. Returns the part."""
    slowest, accepted = ("", 0.0), 0
    for name, files, words, judge in cases:
        for file, content in files.items():
            (work/file).write_bytes(content)
        outcome = run([program, "--check", "deck.nml", *words], work, limits=limits)
        complaints = complaints_about(outcome, (0, 1, 3)) + judge(outcome)
        made = files_below(work) - set(files)
        if made:
            complaints.append(f"--check makes {sorted(made)[0]}")
        slowest = max(slowest, (name, outcome.seconds), key=lambda pair: pair[1])
        accepted += outcome.status == 0
        if not part.count(name, complaints):
            for file, content in files.items():
                save(failures/name, file, content)
        for file in files:
            (work/file).unlink()
    part.worst = f"{accepted} accepted, {slowest[1]:.2f} s ({slowest[0]})"
    return part


def save(folder, name, content):
    """Saves the input of a failing case."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder/name).write_bytes(content)
