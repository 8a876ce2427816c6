"""Running a scene and reading its summary."""
import shutil

from common import complaints_about, files_below, result_complaints, run, save
from extremes import table

PATIENCE = 300.0  # seconds that a deck may take: the truth of an estimate is a much finer solve
VALUES = ("mean_gap_over_amplitude", "contact_area_fraction", "peak_pressure_over_pstar")
ERRORS = ("mean_gap_error", "contact_area_error", "peak_pressure_error")
ROUNDING = 4e-15  # of values of the order of one: closed forms say that they have no error


class Row:
    """A load of a summary."""

    def __init__(self, words):
        self.words = words
        self.status, self.solver = words["status"], words["solver"]
        self.load = float(words["pbar_over_pstar"])
        self.values = [float(words[name]) for name in VALUES]
        self.errors = [max(float(words[name]), ROUNDING) for name in ERRORS]

    @property
    def told(self):
        """Whether there are numbers, be they as accurate as asked for or not."""
        return self.status in ("converged", "closed_form", "not_accurate")

    def off(self, other, rounding=0.0):
        """Differences from another row beyond rounding, over both estimates, of gap, area and peak."""
        return [max(abs(a - b) - rounding, 0.0)/(e + f)
                for a, b, e, f in zip(self.values, other.values, self.errors, other.errors)]


def write(files, folder):
    """A new folder with a deck and what it needs."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, text in files.items():
        (folder/name).write_text(text)


def solve(program, files, folder, *words):
    """The rows of a deck's summary, in its order, and what is wrong with the run."""
    write(files, folder)
    outcome = run([program, "deck.nml", "--output", "results", "--quiet", *words], folder, patience=PATIENCE)
    # A load that cannot be had as accurately as asked for says so, in a row and in the status.
    complaints = complaints_about(outcome, (0, 2), seconds=PATIENCE)
    complaints += result_complaints(folder, files_below(folder))
    if outcome.status not in (0, 2):
        return [], complaints + [outcome.stderr.decode(errors="replace").strip()]
    return [Row(words) for words in table(folder/"results"/"deck.summary.dat")], complaints


def keep(failures, name, files):
    """Keeps a failing case, with its height map."""
    for file, text in files.items():
        save(failures/name, file, text.encode())
