"""Tables of every kind, and the examples of outputs/README.md, for the tests of programs that read them."""
import pathlib
import re
import subprocess

from tables import Table

PAGE = pathlib.Path(__file__).resolve().parents[2] / "outputs" / "README.md"
LOADS = "&load pbar_over_pstar = 0, 0.2, 0.6, 1 /\n"
ALL = ("lines = t, map = t, contours = t, spots = t, histograms = t, histogram_bins = 8, spectrum = t, line_points = 8, "
       "map_points = 8")
HEIGHTS = "".join(" ".join(str((3*i*i + 5*j + i*j) % 7) for i in range(8)) + "\n" for j in range(8))
# Both dimensions, every solver and table, labels of units, loads without numbers, a single load, tables without rows.
# The histograms of a fitted solution take seconds; grids have them too.
DECKS = {
    "line": f"&surface kind = 'wave_1d' /\n{LOADS}&method solver = 'beale' /\n"
            f"&output {ALL}, coefficients = t, theory = t /\n",
    "plane": f"&surface kind = 'wave_2d' /\n{LOADS}&method solver = 'beale' /\n"
             f"&output {ALL}, coefficients = t, theory = t /\n",
    "closed_form": f"&surface kind = 'wave_1d' /\n{LOADS}&method solver = 'auto' /\n&output {ALL}, theory = t /\n",
    "fitted": "&surface kind = 'crossed_1d', amplitude1 = 1, wavelength1 = 2, amplitude2 = 1, wavelength2 = 1 /\n"
              "&load pbar_over_pstar = 0, 0.1, 0.3, 1 /\n"
              f"&method solver = 'fitted' /\n&output {ALL}, details = t /\n".replace("histograms = t, ", ""),
    "grid": f"&surface kind = 'hexagonal' /\n{LOADS}&method solver = 'grid', accuracy = 0.1 /\n&output {ALL} /\n",
    "file": f"&surface kind = 'file', file = 'heights.txt' /\n{LOADS}&output {ALL} /\n",
    "units": "&scene title = 'With [labels] # of units', pressure_unit = 'N/mm^2', length_unit = 'mm' /\n"
             f"&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.3 /\n&method solver = 'beale' /\n&output {ALL} /\n",
    "stress": "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0, 0.3 /\n&method solver = 'grid', grid_points = 16 /\n"
              "&stress nu = 0.3, 0.2, yield_stress = 1, line = t, section = 'diagonal', planes = t, depths = 0, 0.1 /\n"
              "&output line_points = 8, map_points = 8 /\n",
    "no_edge": "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0, 1 /\n&output contours = t /\n",
    "flat": f"&surface kind = 'wave_2d', amplitude = 0 /\n&load mean_pressure = 0, 1 /\n&output {ALL} /\n",
}
# Decks of these in one table of --table, and columns of text.
COLLECTED = "plane", "grid", "no_edge"
WORDS = "solver", "status", "direction", "region", "deck", "case", "surface_kind", "method_solver"


def make_tables(test):
    """Runs the decks in the folder of a ProgramTest, and returns all tables."""
    (test.folder/"heights.txt").write_text(HEIGHTS)
    for name, text in DECKS.items():
        # 2: a load of `fitted` has no solution, by intention.
        test.run_deck(name, text, statuses=(2,) if name == "fitted" else (0,))
    test.run_deck(COLLECTED[0], None, *(f"{name}.nml" for name in COLLECTED[1:]), "--table", "collected.dat",
                  "--set", "material.e_star=2", output="collected")
    return [Table(path) for path in sorted(test.folder.glob("*.dat"))]


def blocks_of(table):
    """The records of each block."""
    records = table.records()
    return [records[start:end] for start, end in zip(table.starts, [*table.starts[1:], len(records)])]


def page_examples(language):
    """The examples of outputs/README.md in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def run_page_decks(test):
    """Runs the decks of these examples in the folder of a ProgramTest, where they also find the reference values."""
    for deck in page_examples("fortran"):
        (test.folder/"deck.nml").write_text(deck)
        subprocess.run([test.program, "deck.nml", "--quiet"], cwd=test.folder, check=True)
    (test.folder/"outputs"/"reference").symlink_to(PAGE.parent/"reference")
