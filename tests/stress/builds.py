"""The program compiled in other ways: the same numbers at every level of optimisation, and no report of the
sanitizers."""
import functools
import os
import pathlib
import shutil
import subprocess

import fuzz_decks
import fuzz_maps
from common import Part, Table, complaints_about, files_below, run

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
                "&output lines = t, coefficients = t, theory = t /\n"),
    "wave_2d": ("series", "&surface kind = 'wave_2d' /\n&load sweep_from = 0.05, sweep_to = 0.95, sweep_steps = 10 /\n"
                "&output lines = t, map = t, coefficients = t, theory = t, line_points = 32, map_points = 32 /\n"),
    "closed_form": ("series", "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 1e-9, 0.3, 0.999 /\n"
                    "&method solver = 'auto' /\n&output lines = t, theory = t /\n"),
    "grid": ("grid", "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.05, 0.5, 0.9 /\n"
             "&method solver = 'grid', grid_points = 64, residual = 1e-12 /\n&output lines = t, line_points = 32 /\n"),
    "self_affine": ("grid", "&surface kind = 'self_affine', rms_height = 0.01, spectrum = 'random', points = 64,\n"
                    "short_wavelength = 0.05 /\n&load pbar_over_pstar = 0.02, 0.5 /\n"
                    "&method solver = 'grid', residual = 1e-12 /\n&output lines = t /\n"),
}


def build(source, folder, build_type, flags, c_flags=""):
    """Builds the program. Returns its path, or None and the last words of the failed command."""
    configure = ["cmake", "-S", source, "-B", folder, "-D", f"CMAKE_BUILD_TYPE={build_type}", "-D", "WAVYCON_TESTS=OFF",
                 "-D", f"CMAKE_Fortran_FLAGS={flags}", "-D", f"CMAKE_C_FLAGS={c_flags}"]
    if shutil.which("ninja") and not folder.exists():
        configure += ["-G", "Ninja"]
    for command in (configure, ["cmake", "--build", folder, "--target", "wavycon", "--parallel", str(os.cpu_count())]):
        result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if result.returncode:
            return None, (result.stdout + result.stderr)[-2000:]
    return folder/"wavycon", ""


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


def levels(source, builds, work):
    part = Part("optimisation levels")
    worst = {"series": 0.0, "grid": 0.0}
    for level, flags in LEVELS.items():
        # CMake adds no flags of its own to this build type.
        program, words = build(source, builds/f"stress-{level}", "None", flags)
        if not program:
            part.count(f"build {level}", [words])
            continue
        for name, (kind, text) in DECKS.items():
            folder = work/level/name
            folder.mkdir(parents=True)
            (folder/"deck.nml").write_text(text)
            outcome = run([program, "deck.nml", "--output", "results"], folder, patience=SECONDS)
            complaints = complaints_about(outcome, (0,), seconds=SECONDS)
            first = work/next(iter(LEVELS))/name/"results"
            for table in sorted(files_below(first)):
                if not table.endswith(".dat") or not (folder/"results"/table).exists():
                    continue
                difference = compare(first/table, folder/"results"/table, kind)
                worst[kind] = max(worst[kind], difference)
                if difference > TOLERANCES[kind]:
                    complaints.append(f"{table} differs by {difference:.1e} from -O0")
            if files_below(first) != files_below(folder/"results"):
                complaints.append("other tables than with -O0")
            part.count(f"{name}, {flags}", complaints)
    part.worst = ", ".join(f"{kind} {difference:.1e} (allowed {TOLERANCES[kind]:.0e})"
                           for kind, difference in worst.items())
    return part


def sanitizers(source, builds, seed, quick, work, failures):
    """Runs decks by the program compiled with -fcheck=all, traps and sanitizers."""
    program, words = build(source, builds/"stress-sanitize", "Debug", SANITIZERS, SANITIZERS)
    part = Part("sanitizers")
    if not program:
        part.count("build", [words])
        return part
    suppressions = pathlib.Path(__file__).resolve().parent/"libgfortran.supp"
    os.environ.update(LSAN_OPTIONS=f"suppressions={suppressions}:print_suppressions=0",
                      UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1")
    run_decks = functools.partial(fuzz_decks.fuzz_runs, seconds=SANITIZED_SECONDS)
    for number, (fuzz, amount) in enumerate((
            (fuzz_decks.fuzz_checks, 50 if quick else 500), (run_decks, 10 if quick else 60),
            (fuzz_maps.fuzz_checks, 50 if quick else 500), (fuzz_maps.fuzz_binary, 50 if quick else 500),
            (fuzz_maps.fuzz_runs, 10 if quick else 60))):
        folder = work/f"mutated {number}"
        folder.mkdir()
        fuzzed = fuzz(program, seed, amount, folder, failures)
        part.tried += fuzzed.tried
        part.passed += fuzzed.passed
        part.failures += fuzzed.failures
    for name, (_, text) in DECKS.items():
        folder = work/"sanitized"/name
        folder.mkdir(parents=True)
        (folder/"deck.nml").write_text(text)
        outcome = run([program, "deck.nml", "--output", "results"], folder, patience=SECONDS)
        part.count(name, complaints_about(outcome, (0,), seconds=SECONDS))
    return part
