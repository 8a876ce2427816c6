"""The program compiled in other ways: the same numbers at every level of optimisation, and no report of the
sanitizers."""
import functools
import os
import pathlib
import shutil
import subprocess

import fuzz_decks
import fuzz_maps
from common import Settings, Table, complaints_about, files_below, run, write

ROOT = pathlib.Path(__file__).resolve().parents[2]

SECONDS = 120.0  # time limit of a deck; without optimisation none takes as long
SANITIZED_SECONDS = 8.0  # most processor time of a mutated deck: five times as much as without sanitizers
SANITIZERS = "-fsanitize=address,undefined -fno-omit-frame-pointer"
LEVELS = {"O0": "-O0", "O3": "-O3", "native": "-O3 -march=native"}
# Largest differences, relative to the largest number of a column. A series has the same active set at every level and
# differs by the rounding of sums of some thousand terms. A grid differs by the residual of its iteration; its error
# estimates differ by that of the coarser grids, which are solved less far.
TOLERANCES = {"series": 1e-11, "grid": 1e-9}
OF_ESTIMATES = 1e-3
DECKS = {
    "wave_1d": ("series", "&surface kind = 'wave_1d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 19 /\n"
                "&method solver = 'beale' /\n&output lines = t, coefficients = t, theory = t /\n"),
    "wave_2d": ("series", "&surface kind = 'wave_2d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 10 /\n"
                "&method solver = 'beale' /\n"
                "&output lines = t, map = t, coefficients = t, theory = t, line_points = 32, map_points = 32 /\n"),
    "closed_form": ("series", "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 1e-9, 0.3, 0.999 /\n"
                    "&method solver = 'auto' /\n&output lines = t, theory = t /\n"),
    "grid": ("grid", "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.05, 0.5, 0.9 /\n"
             "&method solver = 'grid', grid_points = 64, residual = 1e-12 /\n&output lines = t, line_points = 32 /\n"),
    "self_affine": ("grid", "&surface kind = 'self_affine', rms_height = 0.01, spectrum = 'random', points = 64,\n"
                    "short_wavelength = 0.05 /\n&load pbar_over_pstar = 0.02, 0.5 /\n"
                    "&method solver = 'grid', residual = 1e-12 /\n&output lines = t /\n"),
}


def build(name, build_type, flags, c_flags=""):
    """Builds the program. Returns its path, or None and the last words of the failed command."""
    folder = ROOT/"build"/name
    configure = ["cmake", "-S", ROOT, "-B", folder, "-D", f"CMAKE_BUILD_TYPE={build_type}", "-D", "WAVYCON_TESTS=OFF",
                 "-D", f"CMAKE_Fortran_FLAGS={flags}", "-D", f"CMAKE_C_FLAGS={c_flags}"]
    if shutil.which("ninja") and not folder.exists():
        configure += ["-G", "Ninja"]
    for command in (configure, ["cmake", "--build", folder, "--target", "wavycon", "--parallel", str(os.cpu_count())]):
        result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if result.returncode:
            return None, (result.stdout + result.stderr)[-2000:]
    return folder/"wavycon", ""


def solve(program, text, folder):
    """Runs a deck; what is wrong with the run."""
    write({"deck.nml": text}, folder)
    outcome = run([program, "deck.nml", "--output", "results"], folder, patience=SECONDS)
    return complaints_about(outcome, (0,), seconds=SECONDS)


def compare(one, other, kind):
    """The largest difference of two tables over the largest number of its column; infinity if words or shapes differ.
    Differences of a grid's error estimates count less, by the ratio of the tolerances.

    The residual, a rounding error, and the iterations are left out: they are no results."""
    one, other = Table(one), Table(other)
    if one.columns != other.columns or len(one.lines) != len(other.lines):
        return float("inf")
    worst = 0.0
    for column in set(one.columns) - {"iterations", "residual"}:
        pairs = [(row[column], another[column]) for row, another in zip(one.records(), other.records())]
        try:
            values = [(float(a), float(b)) for a, b in pairs if not a == b == "NaN"]
        except ValueError:
            if any(a != b for a, b in pairs):
                return float("inf")
            continue
        size = max((max(abs(a), abs(b)) for a, b in values), default=0.0)
        if size > 0.0:
            weight = TOLERANCES[kind]/OF_ESTIMATES if kind == "grid" and column.endswith("_error") else 1.0
            worst = max([worst] + [weight*abs(a - b)/size for a, b in values])
    return worst


def levels(settings, work):
    part = settings.part("optimisation levels")
    for level, flags in LEVELS.items():
        # CMake adds no flags of its own to this build type.
        program, words = build(f"stress-{level}", "None", flags)
        if not program:
            part.count(f"build {level}", [words])
            continue
        for name, (kind, text) in DECKS.items():
            complaints = solve(program, text, work/level/name)
            first, results = (work/each/name/"results" for each in (next(iter(LEVELS)), level))
            if files_below(first) != files_below(results):
                complaints.append("other tables than with -O0")
            for table in sorted(files_below(first) & files_below(results)):
                if table.endswith(".dat"):
                    off = compare(first/table, results/table, kind)
                    part.limit(kind, off, TOLERANCES[kind], complaints, f"{table} differs by {off:.1e} from -O0")
            part.count(f"{name}, {flags}", complaints)
    return part


def sanitizers(settings, work):
    """Runs decks by the program compiled with -fcheck=all, traps and sanitizers."""
    part = settings.part("sanitizers")
    program, words = build("stress-sanitize", "Debug", SANITIZERS, SANITIZERS)
    if not program:
        part.count("build", [words])
        return part
    suppressions = pathlib.Path(__file__).resolve().parent/"libgfortran.supp"
    os.environ.update(LSAN_OPTIONS=f"suppressions={suppressions}:print_suppressions=0",
                      UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1")
    checks, runs = settings.amount((500, 60), (50, 10))
    sanitized = Settings(**dict(vars(settings), program=program))
    for fuzz, amount in ((fuzz_decks.fuzz_checks, checks),
                         (functools.partial(fuzz_decks.fuzz_runs, seconds=SANITIZED_SECONDS), runs),
                         (fuzz_maps.fuzz_checks, checks), (fuzz_maps.fuzz_binary, checks), (fuzz_maps.fuzz_runs, runs)):
        fuzzed = fuzz(sanitized, work, amount)
        part.tried += fuzzed.tried
        part.passed += fuzzed.passed
        part.failures += fuzzed.failures
    for name, (_, text) in DECKS.items():
        part.count(name, solve(program, text, work))
    return part
