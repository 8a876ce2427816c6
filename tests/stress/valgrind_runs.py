"""The test programs and decks of each solver under valgrind's memcheck: no uninitialised read, no access out of bounds,
no leak."""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess

from common import write

STATUS = 99  # of a program in which valgrind found something
PATIENCE = 1800.0  # time limit of a program [s], for busy machines
# Some tests have arrays of megabytes on the stack, which valgrind takes for another stack unless told.
COMMAND = ["valgrind", "--quiet", "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=definite",
           f"--error-exitcode={STATUS}", "--max-stackframe=8388608",
           f"--suppressions={pathlib.Path(__file__).resolve().parent/'valgrind.supp'}"]
# These take 0.3 to 30 s, and minutes under valgrind, exact.adhesion more than twenty. The decks below run the same
# code.
LEFT_OUT = ("unit.fitted_details", "unit.fitted_fields", "unit.fitted_answer_stress", "exact.adhesion",
            "exact.adhesive_fields", "exact.adhesive_stresses", "exact.fitted", "exact.fitted_contact",
            "exact.free_edge_stresses", "exact.grid", "exact.interface", "exact.layers", "exact.series",
            "exact.stresses", "exact.surfaces")
LOADS = "&load pbar_over_pstar = 0.05, 0.3, 0.7, 1 /\n"
TABLES = ("&output lines = t, map = t, contours = t, spots = t, spectrum = t, height = t, line_points = 8, "
          "map_points = 8 /\n")
OF_THE_PAPER = TABLES.replace("map = t", "map = t, coefficients = t, theory = t")
COARSE = "&method solver = 'grid', accuracy = 1e-2 /\n"
# Name, deck, exit status.
DECKS = (
    ("beale 1-D", "&surface kind = 'wave_1d' /\n" + LOADS + OF_THE_PAPER + "&method solver = 'beale' /\n", 0),
    ("beale 2-D", "&surface kind = 'wave_2d' /\n" + LOADS + OF_THE_PAPER
     + "&method solver = 'beale', harmonics = 5, constraint_points = 9 /\n", 0),
    ("series", "&surface kind = 'wave_2d' /\n" + LOADS
     + "&method solver = 'series', harmonics = 5, constraint_points = 6 /\n", 0),
    ("closed form", "&surface kind = 'wave_1d' /\n" + LOADS + TABLES.replace("map = t", "map = t, theory = t")
     + "&method solver = 'auto' /\n", 0),
    ("fitted", "&surface kind = 'wave_2d' /\n" + LOADS + "&method solver = 'fitted', accuracy = 1e-2 /\n"
     "&output lines = t, details = t, line_points = 8 /\n", 0),
    ("auto, hexagonal", "&surface kind = 'hexagonal' /\n&load pbar_over_pstar = 0.02, 0.5 /\n"
     "&method solver = 'auto', accuracy = 3e-2 /\n", 0),
    ("grid, gap asked for", "&surface kind = 'wave_2d' /\n&load mean_gap_over_amplitude = 0.4 /\n" + COARSE
     + TABLES, 0),
    ("grid, area asked for", "&surface kind = 'crossed_1d', amplitude1 = 1, wavelength1 = 1, amplitude2 = 1, "
     "wavelength2 = 2 /\n&load contact_area_fraction = 0.3 /\n&method grid_points = 32 /\n" + TABLES, 0),
    ("grid, sum", "&surface kind = 'sum', amplitudes = 1, 0.5, waves_x = 1, 2, waves_y = 0, 1, phases = 0, 40 /\n"
     + LOADS + "&method grid_points = 32 /\n" + TABLES, 0),
    ("map, matrix", "&surface kind = 'file', file = 'matrix.dat' /\n" + LOADS + TABLES, 0),
    ("map, points", "&surface kind = 'file', file = 'points.dat' /\n" + LOADS + TABLES, 0),
    ("map, measured", "&surface kind = 'file', file = 'holes.dat', detrend = 'quadratic', fill_missing = 'harmonic',\n"
     "   edges = 'mirror' /\n" + LOADS + TABLES.replace("map = t", "map = t, histograms = t"), 0),
    ("map, window", "&surface kind = 'file', file = 'holes.dat', fill_missing = 'harmonic', edges = 'window' /\n"
     + LOADS + TABLES, 0),
    ("adhesion", "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.1 /\n&interface work_of_adhesion = 2 /\n"
     "&stress nu = 0.3, line = t /\n&method accuracy = 3e-2 /\n" + TABLES, 0),
    ("slip", "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.2 /\n&material e1 = 1, nu1 = 0.3 /\n"
     "&interface friction = 0.5, tangential_over_normal = 0.1, 0.3 /\n&method accuracy = 1e-2 /\n" + TABLES, 0),
    ("stresses", "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.2, 1.1 /\n"
     "&stress nu = 0.3, line = t, section = 'x', planes = t, depths = 0.1 /\n" + COARSE + TABLES, 0),
    ("layer", "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.2 /\n"
     "&material e1 = 1, nu1 = 0.3, layer_thickness = 0.1 /\n&method accuracy = 1e-2 /\n" + TABLES, 0),
    ("ball", "&surface kind = 'ball', radius = 1 /\n&load force = 0.01 /\n&stress nu = 0.3, line = t /\n"
     "&interface friction = 0.5, tangential_over_normal = 0.1, nu = 0.3 /\n"
     "&method solver = 'grid', accuracy = 3e-2 /\n", 0),
    ("self-affine", "&surface kind = 'self_affine', rms_slope = 0.1, points = 32, 48, short_wavelength = 0.2,\n"
     "   spectrum = 'random' /\n" + LOADS + TABLES.replace("map = t", "map = t, histograms = t"), 0),
    ("map, ragged", "&surface kind = 'file', file = 'ragged.dat' /\n" + LOADS, 1),
    ("flat", "&surface kind = 'wave_1d', amplitude = 0 /\n&load mean_pressure = 0, 0.3 /\n", 0),
    ("bad deck", "&surface knd = 'wave_3d', amplitude = 1e999, file = 'x /\n&lod pbar = 1,,2 /\n&load\n", 1),
)
MAPS = {"matrix.dat": "".join(" ".join(str((3*i*i + 5*j + i*j) % 7) for i in range(8)) + "\n" for j in range(8)),
        "points.dat": "".join(f"{i} {j} {(3*i*i + 5*j + i*j) % 7}\n" for i in range(5) for j in range(8)),
        "holes.dat": "".join(" ".join("nan" if (i*j) % 11 == 9 else str((3*i*i + 5*j + i*j) % 7) for i in range(13))
                             + "\n" for j in range(16)),
        "ragged.dat": "1 2 3 4\n1 2 3\n"}


def found(words, folder, status):
    """What valgrind reports of a run, or a wrong exit status."""
    # Kernels with instructions that valgrind supports.
    variables = dict(os.environ, OPENBLAS_CORETYPE="Haswell", OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    log = folder/"valgrind.log"
    command = COMMAND + [f"--log-file={log}"] + [str(word) for word in words]
    try:
        result = subprocess.run(command, cwd=folder, env=variables, stdin=subprocess.DEVNULL, capture_output=True,
                                timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return [f"takes longer than {PATIENCE:.0f} s"]
    if result.returncode == STATUS or log.read_text(errors="replace").strip():
        lines = [re.sub(r"^==\d+== *", "", line) for line in log.read_text(errors="replace").splitlines()]
        return ["; ".join(line for line in lines if line)[:400]]
    if result.returncode != status:
        return [f"exit status {result.returncode}"]
    return []


def cases(settings, work):
    """Name, command, folder and exit status of each run."""
    program, programs = settings.programs/"stress_program", settings.programs.parent
    for name, text, status in DECKS:
        if not settings.quick or name in ("beale 1-D", "map, ragged"):
            write({"deck.nml": text, **MAPS}, work/name)
            yield name, [program, "deck.nml"], work/name, status
    if settings.quick:
        return
    folder = work/"many decks"
    decks = {f"{name.replace(' ', '-')}.nml": text for name, text, _ in DECKS[:5] + DECKS[-1:]}
    write(decks, folder)
    options = [*sorted(decks), "--keep-going", "--table", "all.dat", "--set", "surface.amplitude=2", "--set",
               "scene.title=it's"]
    yield "many decks", [program, *options], folder, 1
    yield "many decks, --check", [program, "--check", *options], folder, 1
    for path in sorted(programs.glob("unit/unit.*")) + sorted(programs.glob("exact/exact.*")):
        if path.is_file() and os.access(path, os.X_OK) and path.name not in LEFT_OUT:
            write({}, work/path.name)
            yield path.name, [path], work/path.name, 0


def campaign(settings, work):
    part = settings.part("valgrind")
    if not shutil.which("valgrind"):
        part.worst = "skipped: valgrind is not installed"
        return part
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = [(name, pool.submit(found, words, folder, status))
                for name, words, folder, status in cases(settings, work)]
        for name, run in runs:
            log = work/name/"valgrind.log"
            part.count(name, run.result(), {"valgrind.log": log.read_bytes()} if log.exists() else {})
    if not settings.quick:
        part.notes.append("left out, for they take minutes: " + ", ".join(LEFT_OUT))
    return part
