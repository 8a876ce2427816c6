"""The conditions of contact of answers to random scenes, checked independently: see stress_scenes.f90."""
import random

from common import RUNTIME_WORDS, Part, run
from random_scenes import FITTED, random_loads, random_scene
from summaries import PATIENCE, keep, write

PROMISED = 1e-11  # residual of a grid that is asked for [mean gap]
ROUNDING = 1e-13  # of the solver's own sums over some thousand points [P, Delta]
SAMPLES = 2  # random points of an expansion


def grid_case(stream, kind):
    """The files of a random scene on a grid that carries all its waves."""
    scene = random_scene(stream, kind)
    loads = random_loads(stream, 3) + [stream.choice((1e-12, 1e-8, 1.0 - 1e-8, 1.0 - 1e-12))]
    method = "solver = 'grid'"
    if not scene.heights:
        # Sums in quadruple precision over all pairs of points.
        points = [2*stream.randint(6, 100 if scene.is_profile else 18) for _ in range(2)]
        method += f", grid_points = {points[0]}, {points[1]}"
    return scene.files(loads, method)


def fitted_case(stream, kind):
    """The files of a random scene by expansions, and the accuracy asked for."""
    scene = random_scene(stream, kind)
    loads = random_loads(stream, 3)
    accuracy = 10.0**-stream.uniform(3.0, 10.0)
    # Fields are as accurate only if they are asked for.
    method = f"solver = 'fitted', accuracy = {accuracy!r} /\n&output lines = t"
    return scene.files(loads, method), accuracy


def grid_complaints(line):
    """What is wrong with an answer on a grid, and its residual [mean gap, or what rounding leaves of it]."""
    load, residual, complementarity, gap, told, size = map(float, line[3:])
    allowed = PROMISED*abs(size) + ROUNDING
    words = []
    if line[2] != "converged":
        words.append(line[2])
    for name, value, most in (("mean pressure", load, ROUNDING), ("gap told", gap, ROUNDING),
                              ("gap in contact or overlap", residual, allowed),
                              ("pressure times gap", complementarity, allowed),
                              ("residual told", residual - told*abs(size), ROUNDING)):
        if not value <= most:
            words.append(f"{name}: {value:.1e}, allowed {most:.1e}")
    return words, PROMISED*residual/allowed


def expansion_complaints(line, accuracy):
    """What is wrong with an expansion, and its worst violation over what is allowed; 0 if the check is less sharp.

    Where spots are about to touch, or islands, the pressure of an island is less exact than mean gap, area and peak:
    the residual told says how exact it is."""
    contact, noise, tension, overlap, balance, told, *errors = map(float, line[3:])
    accuracy = max(accuracy, *errors)
    words = []
    worst = 0.0
    if line[2] not in ("converged", "not_accurate"):
        words.append(line[2])
    for name, value, most in (("gap or pressure where there is to be none", contact - noise, max(accuracy, told)),
                              ("tension", tension, accuracy), ("overlap", overlap, accuracy),
                              ("load or mean gap", balance, accuracy)):
        worst = max(worst, value/most)
        if not value <= most:
            words.append(f"{name}: {value:.1e}, allowed {most:.1e}")
    return words, worst if noise <= accuracy else 0.0


def campaign(program, seed, kinds, scenes, work, failures):
    """So many scenes of each kind on grids, and as many of those that expansions know. Runs stress_scenes."""
    part = Part("conditions of contact")
    grid_worst = expansion_worst = 0.0
    unanswered = blunt = 0
    cases = [(kind, "grid", number) for kind in kinds for number in range(scenes)]
    cases += [(kind, "fitted", number) for kind in kinds if kind in FITTED for number in range(scenes)]
    for kind, solver, number in cases:
        name = f"conditions-{solver}-{kind.replace(' ', '-')}-{number}"
        stream = random.Random(f"{seed} {name}")
        files, accuracy = (grid_case(stream, kind), None) if solver == "grid" else fitted_case(stream, kind)
        write(files, work/name)
        outcome = run([program, "deck.nml", seed, SAMPLES], work/name, patience=PATIENCE)
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
                words, worst = grid_complaints(line)
                grid_worst = max(grid_worst, worst)
            elif line[0] == "expansion":
                words, worst = expansion_complaints(line, accuracy)
                expansion_worst = max(expansion_worst, worst)
                blunt += worst <= 0.0
            else:
                words = [f"no answer: {line[2]}"]
            failed |= not part.count(f"{name} at P = {float(line[1]):.6g}", words)
        if failed:
            keep(failures, name, files)
    part.worst = (f"KKT {grid_worst:.1e} on grids, {expansion_worst:.2f} times accuracy or residual told in expansions; "
                  f"{unanswered} merged, {blunt} too sharp to tell")
    return part
