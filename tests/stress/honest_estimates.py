"""Error estimates of random scenes against true errors, from a much finer solution, a closed form or an expansion."""
import math
import random

from common import Part
from random_scenes import FITTED, random_loads, random_scene
from rough_surfaces import deck
from summaries import ROUNDING, VALUES, keep, solve

# As README states: the fraction of errors below the estimates, and the largest error over its estimate.
CONFIDENCE, LARGEST_RATIO = 0.95, 3.0
FEWEST = 100  # estimates of which the fraction is checked
# Finest accuracies for which the finer solution takes about a second: by kind, where a quarter of the cell is solved,
# and of other kinds.
FINEST = {"wave_1d": 1e-4, "profile": 1e-4, "sum": 1e-2, "file": 1e-2, "even file": 1e-2,
          "mirrored file": 1e-2}
FINEST_OF_OTHERS = 3e-3
COARSEST = 1e-1
# Maps with a hardness, their number, and what they have besides VALUES.
HARD, LOAD_OVER_HARDNESS = "grid with a hardness", (0.05, 0.95)
HARD_MAPS, QUICK_HARD_MAPS = 300, 6
OF_HARDNESS = ("area_at_hardness_fraction", "load_at_hardness_fraction")
# Balls and rough maps on balls, with free edges, their number, and their values.
FREE, FREE_SCENES, QUICK_FREE_SCENES = "grid with free edges", 300, 6
OF_FREE_EDGES = ("approach", "contact_area", "peak_pressure")
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


def hard_case(stream):
    """The files of a random map with a hardness, on its own points, and those of a grid that is four times as fine."""
    points = stream.choice((64, 64, 128, 256))
    longest = stream.choice((0.5, 1.0))
    surface = (f"kind = 'self_affine', length_x = 1, length_y = 1, points = {points}, {points}, rms_slope = 0.1,\n"
               f"   hurst = {stream.choice((0.3, 0.8, 1.0))!r}, spectrum = '{stream.choice(('ideal', 'random'))}',\n"
               f"   long_wavelength = {longest!r}, rolloff_wavelength = {stream.choice((0.5, 1.0))*longest!r},\n"
               f"   short_wavelength = {stream.choice((2.5, 4.0, 8.0, 16.0))/points!r}, seed = {stream.randint(1, 2**30)}")
    # p* is some 0.2 E* on such maps.
    load = 0.2*10.0**stream.uniform(-4.5, 0.2)
    hardness = load/stream.uniform(*LOAD_OVER_HARDNESS)
    return [{"deck.nml": deck(surface, [load], f"solver = 'grid', grid_points = {grid}", hardness)}
            for grid in (points, 4*points)]


def free_case(stream):
    """The files of a ball to a random accuracy, or of a rough map on a ball on its own points, and those of a much finer
    solution."""
    radius = 10.0**stream.uniform(-0.5, 1.5)
    if stream.random() < 0.5:
        accuracy = 10.0**stream.uniform(-3.5, -1.5)
        surface = f"kind = 'ball', radius_x = {radius!r}, radius_y = {radius*10.0**stream.uniform(-1.0, 1.0)!r}"
        # A load that moves the edge between the points of its grids.
        loads = [force*10.0**stream.uniform(0.0, 0.5) for force in (1e-6, 1e-5, 1e-4)]
        methods = [f"accuracy = {each!r}" for each in (accuracy, accuracy/FINER)]
    else:
        points = stream.choice((64, 99, 128, 255))
        surface = (f"kind = 'self_affine', edges = 'free', points = {points}, rms_slope = {10.0**stream.uniform(-3, -1)!r},\n"
                   f"   form_radius = {radius!r}, hurst = {stream.choice((0.3, 0.8, 1.0))!r},\n"
                   f"   long_wavelength = {stream.choice((0.25, 1.0))!r},\n"
                   f"   short_wavelength = {stream.choice((4.0, 8.0, 16.0))/points!r}, seed = {stream.randint(1, 2**30)}")
        loads = [10.0**stream.uniform(-5.0, -1.5)/radius for _ in range(3)]
        methods = [f"grid_points = {grid}" for grid in (points, 4*points)]
    return [{"deck.nml": f"&surface {surface} /\n&load force = {', '.join(map(repr, loads))} /\n"
                         f"&method solver = 'grid', {method} /\n"} for method in methods]


def ratios_of(row, truth, names):
    """Of each value its error beyond that of the truth over its estimate, None if one is unknown, and the estimate."""
    for name in names:
        value, true = float(row.words[name]), float(truth.words[name])
        allowed, own = (max(float(each.words[f"{name}_error"]), ROUNDING) for each in (row, truth))
        known = not math.isnan(allowed + own)
        yield name, max(abs(value - true) - own, 0.0)/allowed if known else None, allowed


def campaign(program, seed, kinds, scenes, work, failures):
    """So many scenes of each kind with each solver for it, maps with a hardness, and surfaces with free edges."""
    part = Part("error estimates")
    ratios = {solver: [] for solver in ("grid", "fitted", HARD, FREE)}
    more_values = {HARD: VALUES + OF_HARDNESS, FREE: OF_FREE_EDGES}
    rare = {HARD: hard_case, FREE: free_case}
    unknown = dict.fromkeys(ratios, 0)
    cases = [(kind, solver, number) for kind in kinds for solver in ("grid", "fitted") for number in range(scenes)
             if solver == "grid" or kind in FITTED]
    cases += [("self_affine", HARD, number) for number in range(HARD_MAPS if scenes > 1 else QUICK_HARD_MAPS)]
    cases += [("free edges", FREE, number) for number in range(FREE_SCENES if scenes > 1 else QUICK_FREE_SCENES)]
    for kind, solver, number in cases:
        name = f"estimates-{solver}-{kind}-{number}".replace(" ", "-")
        stream = random.Random(f"{seed} {name}")
        files, finer = rare[solver](stream) if solver in rare else random_case(stream, kind, solver)
        rows, complaints = solve(program, files, work/name)
        truths, more = solve(program, finer, work/name)
        for row, truth in zip(rows, truths):
            if not (row.has_numbers and truth.has_numbers):
                continue  # spots have merged
            for value, ratio, allowed in ratios_of(row, truth, more_values.get(solver, VALUES)):
                if ratio is None:
                    unknown[solver] += 1
                    continue
                ratios[solver].append(ratio)
                if ratio > LARGEST_RATIO:
                    complaints.append(f"{value} of load {row.words['load']} is off by {ratio:.1f} times its estimate, {allowed:.1e}")
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
