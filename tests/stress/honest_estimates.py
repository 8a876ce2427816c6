"""Error estimates of random scenes against true errors, from a much finer solution, a closed form or an expansion."""
import itertools
import math
import random

from common import Part
from random_scenes import FITTED, random_loads, random_scene
from summaries import VALUES, keep, solve

# As README states: the fraction of errors below the estimates, and the largest error over its estimate.
CONFIDENCE, LARGEST_RATIO = 0.95, 3.0
FEWEST = 100  # estimates of which the fraction is checked
# Finest accuracies for which the finer solution takes about a second: by kind, where a quarter of the cell is solved,
# and of other kinds.
FINEST = {"wave_1d": 1e-4, "profile": 1e-4, "sum": 1e-2, "file": 1e-2, "even file": 1e-2,
          "mirrored file": 1e-2}
FINEST_OF_OTHERS = 3e-3
COARSEST = 1e-1
FITTED_ACCURACIES = (1e-10, 1e-3)
FINER, FITTED_FINER, FINEST_FITTED = 10.0, 100.0, 1e-12  # ratio of the accuracies of grids, of expansions; finest


def random_case(stream, kind, solver):
    """The files of a random scene to solve, and those of the finer solution."""
    scene = random_scene(stream, kind)
    loads = random_loads(stream, 4)
    finest, coarsest = FITTED_ACCURACIES if solver == "fitted" else (FINEST.get(kind, FINEST_OF_OTHERS), COARSEST)
    accuracy = finest*(coarsest/finest)**stream.random()
    if solver == "fitted":
        truth = f"solver = 'fitted', accuracy = {max(accuracy/FITTED_FINER, FINEST_FITTED)!r}"
    else:
        truth = f"solver = 'auto', accuracy = {accuracy/FINER!r}"
    return scene.files(loads, f"solver = '{solver}', accuracy = {accuracy!r}"), scene.files(loads, truth)


def campaign(program, seed, kinds, scenes, work, failures):
    """So many scenes of each kind with each solver for it."""
    part = Part("error estimates")
    ratios, unknown = {"grid": [], "fitted": []}, {"grid": 0, "fitted": 0}
    for kind, solver, number in itertools.product(kinds, ratios, range(scenes)):
        if solver == "fitted" and kind not in FITTED:
            continue
        name = f"estimates-{solver}-{kind.replace(' ', '-')}-{number}"
        files, finer = random_case(random.Random(f"{seed} {name}"), kind, solver)
        rows, complaints = solve(program, files, work/name)
        truths, more = solve(program, finer, work/name)
        for row, truth in zip(rows, truths):
            if not (row.has_numbers and truth.has_numbers):
                continue  # spots have merged
            for which, value in enumerate(VALUES):
                if math.isinf(row.errors[which] + truth.errors[which]):
                    unknown[solver] += 1
                    continue
                error = abs(row.values[which] - truth.values[which])
                ratio = max(error - truth.errors[which], 0.0)/row.errors[which]
                ratios[solver].append(ratio)
                if ratio > LARGEST_RATIO:
                    complaints.append(f"{value} at P = {row.load!r} is off by {ratio:.1f} times its estimate, "
                                      f"{row.errors[which]:.1e}")
        if not part.count(name, complaints + more):
            keep(failures, name, files)
    words = []
    for solver, all_ratios in ratios.items():
        held = sum(ratio <= 1.0 for ratio in all_ratios)/max(len(all_ratios), 1)
        words.append(f"{solver} {max(all_ratios, default=0.0):.2f} times, "
                     f"{100*held:.1f} % of {len(all_ratios)} hold, {unknown[solver]} are unknown")
        if len(all_ratios) >= FEWEST:
            part.count(f"estimates of {solver}", [] if held >= CONFIDENCE else [f"only {100*held:.1f} % hold"])
    part.worst = "; ".join(words)
    return part
