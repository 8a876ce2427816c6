"""Contact conditions of the solutions of random scenes, checked independently: see stress_scenes.f90."""
import random

from common import RUNTIME_WORDS, Part, run
from hard_maps import KINDS as HARD, QUICK as QUICK_HARD, hard_loads, hard_scene
from random_scenes import FITTED, QUICK, Scene, random_loads, random_scene
from rough_surfaces import made_surface
from summaries import PATIENCE, keep, write

RESIDUALS = (1e-11, 1e-8, None)  # of grids [mean gap]; None: the default
EDGE_TOLERANCE = 5e-4  # the default is this part of the gap at the edge: (C10) of src/contact/README.md
ROUNDING = 1e-13  # of the solver's own sums over some thousand points [P, the surface's depth; at least Delta]
MADE = ((16, 16), (24, 12), (21, 30), (64, 1))  # points of made surfaces
SAMPLES = 2  # random points of an expansion


def grid_case(stream, kind):
    """The files of a random scene on a grid that resolves all its waves, and the residual requested."""
    scene = random_scene(stream, kind)
    loads = random_loads(stream, 3) + [stream.choice((1e-12, 1e-8, 1.0 - 1e-8, 1.0 - 1e-12))]
    method = "solver = 'grid'"
    if not scene.heights:
        # Few points: the check sums over all pairs of them in quadruple precision.
        points = [2*stream.randint(6, 100 if scene.is_profile else 18) for _ in range(2)]
        method += f", grid_points = {points[0]}, {points[1]}"
    return with_residual(stream, scene, loads, method)


def hard_case(stream, kind):
    """Likewise of a hard map."""
    return with_residual(stream, hard_scene(stream, kind), hard_loads(stream, 3), "solver = 'grid'")


def made_case(stream, kind):
    """Likewise of a surface made from its spectrum, on its own points."""
    words, cell, _, _ = made_surface(stream, MADE)
    return with_residual(stream, Scene(kind, cell, words=words), random_loads(stream, 3), "solver = 'grid'")


def hardness(stream):
    """A random hardness over the mean pressure, as a word."""
    return repr(1.0 + 10.0**stream.uniform(-6.0, 1.5))


def with_residual(stream, scene, loads, method):
    residual = stream.choice(RESIDUALS)
    return scene.files(loads, method + (f", residual = {residual!r}" if residual else "")), residual


def fitted_case(stream, kind):
    """The files of a random scene for expansions, and the accuracy requested."""
    scene = random_scene(stream, kind)
    loads = random_loads(stream, 3)
    accuracy = 10.0**-stream.uniform(3.0, 10.0)
    # Fields have the accuracy only if an output needs them.
    method = f"solver = 'fitted', accuracy = {accuracy!r} /\n&output lines = t"
    return scene.files(loads, method), accuracy


def grid_complaints(line, requested):
    """What is wrong with a solution on a grid, its residual over what is allowed, and its iterations."""
    load, residual, complementarity, gap, reported, size, edge_gap, depth, iterations = map(float, line[3:])
    # A surface with pits is many times Delta deep, and the rounding of its gaps is larger. A wave is 2 Delta deep.
    rounding = ROUNDING*max(1.0, depth/2.0)
    allowed = (requested*abs(size) if requested else EDGE_TOLERANCE*edge_gap) + rounding
    words = []
    if line[2] not in ("converged", "unresolved"):
        words.append(line[2])
    for name, value, most in (("mean pressure", load, ROUNDING), ("gap reported", gap, rounding),
                              ("gap in contact or overlap", residual, allowed),
                              ("pressure times gap", complementarity, allowed),
                              ("residual reported", residual - reported*abs(size), rounding)):
        if not value <= most:
            words.append(f"{name}: {value:.1e}, allowed {most:.1e}")
    return words, residual/allowed, int(iterations)


def expansion_complaints(line, accuracy):
    """What is wrong with an expansion, and its worst violation over what is allowed; 0 if the check is less sharp.

    Next to merging the pressure of a pool is less accurate than mean gap, area and peak: its accuracy is the
    residual reported."""
    contact, noise, tension, overlap, balance, reported, *errors = map(float, line[3:])
    accuracy = max(accuracy, *errors)
    words = []
    worst = 0.0
    if line[2] not in ("converged", "not_accurate"):
        words.append(line[2])
    for name, value, most in (("gap or pressure where it must be zero", contact - noise, max(accuracy, reported)),
                              ("tension", tension, accuracy), ("overlap", overlap, accuracy),
                              ("load or mean gap", balance, accuracy)):
        worst = max(worst, value/most)
        if not value <= most:
            words.append(f"{name}: {value:.1e}, allowed {most:.1e}")
    return words, worst if noise <= accuracy else 0.0


CASES = {"grid": grid_case, "hard": hard_case, "made": made_case, "fitted": fitted_case,
         "grid with a hardness": grid_case, "hard with a hardness": hard_case, "made with a hardness": made_case}


def campaign(program, seed, kinds, scenes, work, failures):
    """So many scenes of each kind on grids, as many of each kind of hard map and of made surfaces, all also with a
    hardness, and as many of each kind that expansions can solve. Runs stress_scenes."""
    part = Part("conditions of contact")
    grid_worst = expansion_worst = 0.0
    unanswered = blunt = most = 0
    # The short form has few kinds.
    hard = HARD if len(kinds) > len(QUICK) else QUICK_HARD
    cases = [(kind, solver, number) for solver in ("grid", "grid with a hardness") for kind in kinds
             for number in range(scenes)]
    cases += [(kind, solver, number) for solver in ("hard", "hard with a hardness") for kind in hard
              for number in range(scenes)]
    cases += [("self_affine", solver, number) for solver in ("made", "made with a hardness")
              for number in range(scenes)]
    cases += [(kind, "fitted", number) for kind in kinds if kind in FITTED for number in range(scenes)]
    for kind, solver, number in cases:
        name = f"conditions-{solver}-{kind}-{number}".replace(" ", "-")
        stream = random.Random(f"{seed} {name}")
        files, requested = CASES[solver](stream, kind)
        write(files, work/name)
        more = [hardness(stream)] if "hardness" in solver else []
        outcome = run([program, "deck.nml", seed, SAMPLES, *more], work/name, patience=PATIENCE)
        failed = False
        if outcome.status or RUNTIME_WORDS.search(outcome.stderr):
            words = outcome.stderr.decode(errors="replace").strip()
            failed = not part.count(name, [f"exit status {outcome.status}: {words}"])
        for text in outcome.stdout.decode().splitlines():
            line = [word.strip() for word in text.split("|")]
            if line[0] == "none" and solver == "fitted" and line[2] == "not_found":
                unanswered += 1  # spots have merged
                continue
            if line[0] == "grid":
                words, worst, iterations = grid_complaints(line, requested)
                grid_worst, most = max(grid_worst, worst), max(most, iterations)
            elif line[0] == "expansion":
                words, worst = expansion_complaints(line, requested)
                expansion_worst = max(expansion_worst, worst)
                blunt += worst <= 0.0
            else:
                words = [f"no answer: {line[2]}"]
            failed |= not part.count(f"{name} at P = {float(line[1]):.6g}", words)
        if failed:
            keep(failures, name, files)
    part.worst = (f"KKT {grid_worst:.2f} times the residual allowed in at most {most} iterations on grids, "
                  f"{expansion_worst:.2f} times accuracy or residual in expansions; "
                  f"{unanswered} merged, {blunt} too sharp to tell")
    return part
