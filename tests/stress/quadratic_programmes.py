"""Random quadratic programmes with known solutions: a table of the lines of stress_qp.f90."""
import itertools
import math
import re

from common import RUNTIME_WORDS, run, write

TOGETHER = 100  # programmes that are solved by one process
SILENCE = 300.0  # time limit of a process [s]
# Of so many programmes one with nearly parallel constraints may be refused: among hundreds of these, rounding may keep
# the dual pass from an end, which the status tells. Of 10,000 programmes it was one.
EACH_REFUSED = 5000
# Of so many programmes Beale's method may refuse one: where nearly parallel constraints or a condition number of 1e10
# cost digits, no pass may end within 1e-12, which the status tells. Of 10,000 programmes it refused 17; the dual method
# solved 16 of these.
EACH_REFUSED_BY_BEALE = 500
# Below this load Beale's method may end without a minimum if all harmonics are free, which the status tells. Of 2,196
# loads these were two or three of 1e-12 p*, as the processor rounds.
LIGHT = 1e-11
FIELDS = ("case", "kind", "n", "m", "pushing", "twist_bits", "beale", "status", "verdict", "condition",
          "stationarity", "feasibility", "sign", "complementarity", "error", "own_residual", "pivots", "seconds")
RESIDUALS = FIELDS[10:14]
DECADES = 2  # of condition numbers in a line of the table of lost digits


def read_line(line):
    """The fields of a line of stress_qp; None for any other line."""
    words = [word.strip() for word in line.split("|")]
    if len(words) != len(FIELDS):
        return None
    case = dict(zip(FIELDS, words))
    for name in FIELDS:
        if name not in ("kind", "beale", "status", "verdict"):
            case[name] = float(case[name])
    return case


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


def campaign(settings, work):
    """The notes are the table of lost digits."""
    part = settings.part("quadratic programmes")
    count, largest = settings.amount((10000, 300), (400, 30))
    write({}, work)
    cases = []
    refused = refused_by_beale = wrong = 0
    while part.tried < count:
        first = part.tried + 1
        outcome = run([settings.programs/"stress_qp", settings.seed, first, min(first + TOGETHER, count), largest], work,
                      patience=SILENCE)
        for case in filter(None, map(read_line, outcome.stdout.decode().splitlines())):
            cases.append(case)
            complaints = []
            refused += case["verdict"] == "refused" and case["kind"] == "nearly parallel"
            refused_by_beale += case["beale"] == "refused"
            wrong += "wrong" in (case["verdict"], case["beale"])
            if case["verdict"] == "wrong" or case["verdict"] == "refused" and (
                    case["kind"] != "nearly parallel" or refused > max(1, count//EACH_REFUSED)):
                complaints.append(case["verdict"])
            if case["beale"] == "wrong" or case["beale"] == "refused" and (
                    refused_by_beale > max(1, count//EACH_REFUSED_BY_BEALE)):
                complaints.append(f'{case["beale"]} by Beale\'s method')
            complaints = [f'{words}: {case["kind"]}, {case["n"]:.0f} x {case["m"]:.0f}, '
                          f'condition {case["condition"]:.0e}: {case["status"]}' for words in complaints]
            part.count(command_of(settings, part.tried + 1, largest), complaints)
        if outcome.status or part.tried < first:
            part.count(command_of(settings, part.tried + 1, largest),
                       [f"exit status {outcome.status}: {outcome.stderr.decode(errors='replace').strip()}"])
    worst = max((max(case[name] for name in RESIDUALS) for case in cases if case["status"] == "converged"), default=0.0)
    part.worst = f"KKT {worst:.1e}, {wrong} wrong, {max((case['seconds'] for case in cases), default=0.0):.1f} s"
    part.notes = [f"{refused_by_beale} refused by Beale's method, {refused} by the dual method",
                  *lost_digits(cases)]
    return part


def command_of(settings, number, largest):
    return f"stress_qp {settings.seed} {number} {number} {largest}"


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


def loads(settings, work):
    """The paper's programmes at loads from 1e-12 to 1 - 1e-12: see stress_loads.f90."""
    part = settings.part("loads of the series")
    write({}, work)
    refused = 0
    for words in itertools.product(("beale", "series"), discretisations(settings.quick)):
        words = words[0], *words[1]
        name = " ".join(map(str, words))
        outcome = run([settings.programs/"stress_loads", *words], work, patience=SILENCE)
        if outcome.status or RUNTIME_WORDS.search(outcome.stderr):
            part.count(name, [f"exit status {outcome.status}: {outcome.stderr.decode(errors='replace').strip()}"])
        for line in outcome.stdout.decode().splitlines():
            load, verdict, status, residual = re.split(r"\s*\|\s*", line.strip())
            if status == "converged":
                part.limit("KKT", float(residual), 1.0, [], "")
            is_known = words[0] == "beale" and words[-1] == "none" and float(load) < LIGHT and verdict == "refused"
            refused += is_known
            part.count(f"stress_loads {name} at P = {float(load):.3g}",
                       [] if verdict == "passed" or is_known else [f"{verdict}: {status}"])
    part.notes.append(f"{refused} of the lightest loads refused by Beale's method")
    return part
