"""Random quadratic programmes with known solutions: a table of the lines of stress_qp.f90."""
import math
import re
import subprocess
import threading

from common import RUNTIME_WORDS, Part, run

SILENCE = 300.0  # time limit of a programme [s]
# Of so many programmes one with nearly parallel constraints may be refused: among hundreds of these, rounding may keep
# the dual pass from an end, which the status tells. Of 10,000 programmes it was one.
EACH_REFUSED = 5000
FIELDS = ("case", "kind", "n", "m", "pushing", "twist_bits", "status", "verdict", "condition", "stationarity",
          "feasibility", "sign", "complementarity", "error", "own_residual", "pivots", "seconds")
RESIDUALS = FIELDS[9:13]
DECADES = 2  # of condition numbers in a line of the table of lost digits


def read_line(line):
    """The fields of a line of stress_qp; None for any other line."""
    words = [word.strip() for word in line.split("|")]
    if len(words) != len(FIELDS):
        return None
    case = dict(zip(FIELDS, words))
    for name in FIELDS:
        if name not in ("kind", "status", "verdict"):
            case[name] = float(case[name])
    return case


def run_cases(program, seed, first, last, largest, folder):
    """The cases, one by one; after a crash or a hang (None, last output)."""
    last_words = ""
    with subprocess.Popen([program, str(seed), str(first), str(last), str(largest), str(folder)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        watch = threading.Timer(SILENCE, process.kill)
        try:
            watch.start()
            for line in process.stdout:
                watch.cancel()
                watch = threading.Timer(SILENCE, process.kill)
                watch.start()
                case = read_line(line)
                if case is None:
                    last_words += line
                else:
                    yield case, ""
            process.wait()
        finally:
            watch.cancel()
            process.kill()
    if process.returncode:
        yield None, last_words or f"ended by signal {-process.returncode}: a crash, or {SILENCE:.0f} s without an answer"


def lost_digits(cases):
    """Lines of the table: the error of x and the residual by decades of the condition number."""
    lines = [f'{"condition of D":>16}{"solved":>9}{"refused":>9}{"worst KKT residual":>20}{"worst error of x":>18}'
             f'{"digits lost":>13}']
    bins = {}
    for case in cases:
        bins.setdefault(int(math.log10(case["condition"])/DECADES + 1e-9), []).append(case)
    for key in sorted(bins):
        solved = [case for case in bins[key] if case["status"] == "converged"]
        residual = max((max(case[name] for name in RESIDUALS) for case in solved), default=0.0)
        error = max((case["error"] for case in solved), default=0.0)
        digits = math.log10(max(error, 2.0**-52)/2.0**-52)
        lines.append(f'{f"1e{DECADES*key} - 1e{DECADES*(key + 1)}":>16}{len(solved):9d}{len(bins[key]) - len(solved):9d}'
                     f'{residual:20.1e}{error:18.1e}{digits:13.1f}')
    return lines


def campaign(programs, seed, count, largest, folder):
    """The part of the table, and the lines of the table of lost digits."""
    part = Part("quadratic programmes")
    folder.mkdir(parents=True, exist_ok=True)
    cases = []
    refused = 0
    first = 1
    while first <= count:
        done = first - 1
        for case, words in run_cases(programs/"stress_qp", seed, first, count, largest, folder):
            done += 1
            if case is None:
                part.count(f"case-{done}", [words.strip()])
                continue
            cases.append(case)
            complaints = []
            refused += case["verdict"] == "refused" and case["kind"] == "nearly parallel"
            if case["verdict"] == "wrong" or case["verdict"] == "refused" and (
                    case["kind"] != "nearly parallel" or refused > max(1, count//EACH_REFUSED)):
                complaints.append(f'{case["verdict"]}: {case["kind"]}, {case["n"]:.0f} x {case["m"]:.0f}, '
                                  f'condition {case["condition"]:.0e}: {case["status"]}')
            part.count(f"case-{done}.qp", complaints)
        first = done + 1
    solved = [case for case in cases if case["status"] == "converged"]
    worst = max((max(case[name] for name in RESIDUALS) for case in solved), default=0.0)
    slowest = max((case["seconds"] for case in cases), default=0.0)
    wrong = sum(case["verdict"] == "wrong" for case in cases)
    part.worst = f"KKT {worst:.1e}, {wrong} wrong, {slowest:.1f} s"
    return part, lost_digits(cases)


def discretisations(quick):
    """DIMENSION, HARMONICS, POINTS, SYMMETRY with one more point than harmonics up to ten times as many."""
    harmonics = (1, 5, 10) if quick else (1, 2, 3, 5, 8, 10, 13, 20, 31, 45, 60)
    for n in harmonics:
        for points in sorted({n + 1, 2*n, 3*n, 5*n + 1, 10*n} - {1}):
            yield 1, n, points, "full"
    harmonics = (1, 5) if quick else (1, 2, 3, 5, 9, 12, 20, 30)
    for symmetry in ("full", "diagonal", "none"):
        for n in harmonics:
            for points in sorted({n + 1, 2*n, 3*n, 10*n} - {1}):
                if n*points <= (400 if symmetry == "none" else 900):
                    yield 2, n, points, symmetry


def loads(programs, quick, folder):
    """The paper's programmes at loads from 1e-12 to 1 - 1e-12: see stress_loads.f90."""
    part = Part("loads of 'beale'")
    folder.mkdir(parents=True, exist_ok=True)
    worst = 0.0
    for discretisation in discretisations(quick):
        name = "-".join(str(word) for word in discretisation)
        outcome = run([programs/"stress_loads", *discretisation, folder], folder, patience=SILENCE)
        if outcome.status or RUNTIME_WORDS.search(outcome.stderr):
            part.count(name, [f"exit status {outcome.status}: {outcome.stderr.decode(errors='replace').strip()}"])
        for line in outcome.stdout.decode().splitlines():
            words = re.split(r"\s*\|\s*", line.strip())
            verdict, status = words[6], words[5]
            part.count(f"{name} at P = {float(words[0]):.3g}", [] if verdict == "passed" else [f"{verdict}: {status}"])
            if status == "converged":
                worst = max([worst] + [float(word) for word in words[7:11]])
    part.worst = f"KKT {worst:.1e}"
    return part
