"""The guaranteed bounds of energy and approach: those of coarse grids against far more accurate solutions, and as judges
of the solvers' own numbers."""
import math

from common import Table
from random_scenes import FITTED, KINDS, QUICK, random_loads, random_scene
from summaries import solve

LARGEST_RATIO = 3.0  # of the solver's own distance from the bounds over its error estimate, as README states of one
ROUNDING = 1e-9  # of numbers of fitted solutions that are exact to 1e-10


def campaign(settings, work):
    """Scenes of each kind at six loads. Numbers: the largest distance of a solver's own energy from the bounds over its
    estimate, and the median relative width."""
    part = settings.part("guaranteed bounds")
    cases, widths = 0, []
    for name, stream, kind in settings.cases("bounds", *settings.amount((KINDS, 13), (QUICK, 1))):
        scene, loads = random_scene(stream, kind), random_loads(stream, 6)
        points = 16*stream.randint(2, 5)
        coarse = f"solver = 'grid', grid_points = {points}"
        if stream.random() < 0.3:
            coarse = f"accuracy = {10.0**-stream.uniform(1.0, 4.0)!r}"
        fine = f"solver = 'grid', grid_points = {4*points}"
        if kind in FITTED:
            fine = "solver = 'fitted', accuracy = 1e-10"
        files = scene.files(loads, coarse)
        rows, complaints = solved(settings.program, files, work, with_bounds=True)
        judges, more = solved(settings.program, scene.files(loads, fine), work, with_bounds=kind not in FITTED)
        complaints += more
        for row, judge in ((rows[load], judges[load]) for load in rows if load in judges):
            widths.append((row.bounds[0][1] - row.bounds[0][0])/judge.own[0])
            for own, error, (lower, upper), (low, high) in zip(row.own, row.errors, row.bounds, judge.bounds):
                cases += 1
                if not (lower <= upper and low <= upper and lower <= high):
                    complaints.append(f"P = {row.load}: in [{lower!r}, {upper!r}] and in [{low!r}, {high!r}]")
                part.limit("own numbers", max(lower - own, own - upper, 0.0)/max(error, ROUNDING), LARGEST_RATIO,
                           complaints, f"P = {row.load}: the solver's {own!r} is not in [{lower!r}, {upper!r}]")
        part.count(name, complaints, files)
    part.notes.append(f"{cases} bounds of energy and approach")
    part.numbers["width"] = sorted(widths)[len(widths)//2]
    return part


class Bounded:
    """The solver's own energy and approach of a load in p* and Delta, and their bounds."""

    def __init__(self, summary, bounds=None):
        self.load, approach = float(summary["pbar_over_pstar"]), float(summary["approach_over_amplitude"])
        elastic = "elastic_energy_over_pstar_amplitude"
        self.own = [self.load*approach - float(summary[elastic]), approach]
        error = float(summary["mean_gap_over_amplitude_error"])
        # An error that is unknown may have any size.
        self.errors = [math.inf if math.isnan(it) else it
                       for it in (self.load*error + float(summary[f"{elastic}_error"]), error)]
        self.bounds = [(value - ROUNDING, value + ROUNDING) for value in self.own]
        if bounds:
            self.bounds = [[float(bounds[f"{what}_{end}_over_{unit}amplitude"]) for end in ("lower", "upper")]
                           for what, unit in (("energy", "pstar_"), ("approach", ""))]


def solved(program, files, work, with_bounds):
    """The partial contacts of a deck by their loads, and what is wrong with the run. Without bounds the solver's own
    numbers take their place."""
    files = dict(files)
    files["deck.nml"] += "&output bounds = t /\n" if with_bounds else ""
    rows, complaints = solve(program, files, work)
    if not rows:
        return {}, complaints
    tables = [Table(work/"results"/f"deck.{kind}.dat").records()
              for kind in (("summary", "bounds") if with_bounds else ("summary",))]
    return {row.load: Bounded(*words) for words, row in zip(zip(*tables), rows)
            if row.has_numbers and row.solver != "none"}, complaints
