"""Running a scene and reading its summary."""
import math

from common import Table, complaints_about, files_below, result_complaints, run, write

PATIENCE = 300.0  # time limit of a deck [s]: the finer solutions take long
VALUES = ("mean_gap_over_amplitude", "contact_area_fraction", "peak_pressure_over_pstar")
ROUNDING = 4e-15  # of values of order one: least error estimate, as closed forms give zero


class Row:
    """A row of a summary."""

    def __init__(self, words):
        self.words = words
        self.status, self.solver = words["status"], words["solver"]
        self.load = float(words["pbar_over_pstar"])
        self.values = [float(words[name]) for name in VALUES]
        # An error that is unknown may have any size.
        errors = [float(words[f"{name}_error"]) for name in VALUES]
        self.errors = [math.inf if math.isnan(error) else max(error, ROUNDING) for error in errors]

    @property
    def has_numbers(self):
        """Whether there are numbers, as accurate as requested or not."""
        return self.status in ("converged", "closed_form", "unresolved", "not_accurate")

    def differences(self, other, rounding=0.0):
        """Differences of gap, area and peak from another row beyond rounding, over the sum of both error estimates."""
        return [max(abs(a - b) - rounding, 0.0)/(e + f)
                for a, b, e, f in zip(self.values, other.values, self.errors, other.errors)]


def solve(program, files, folder, *words):
    """The rows of a deck's summary, in its order, and what is wrong with the run."""
    write(files, folder)
    outcome = run([program, "deck.nml", "--output", "results", "--quiet", *words], folder, patience=PATIENCE)
    # Status 2: a load that misses the accuracy has the status not_accurate.
    complaints = complaints_about(outcome, (0, 2), seconds=PATIENCE)
    complaints += result_complaints(folder, files_below(folder))
    if outcome.status not in (0, 2):
        return [], complaints + [outcome.stderr.decode(errors="replace").strip()]
    return [Row(words) for words in Table(folder/"results"/"deck.summary.dat").records()], complaints
