"""Contact conditions of the solutions of random scenes, checked independently: see stress_scenes.f90."""
from common import RUNTIME_WORDS, run, write
from hard_maps import KINDS as HARD, QUICK as QUICK_HARD, hard_loads, hard_scene
from random_scenes import KINDS, QUICK, Scene, random_loads, random_scene
from rough_surfaces import made_surface
from summaries import PATIENCE

RESIDUALS = (1e-11, 1e-8, None)  # of grids [mean gap]; None: the default
EDGE_TOLERANCE = 5e-4  # the default is this part of the gap at the edge: (C10) of src/core/contact/README.md
ROUNDING = 1e-13  # of the solver's own sums over some thousand points [P, the surface's depth; at least Delta]
MADE = ((16, 16), (24, 12), (21, 30), (64, 1))  # points of made surfaces


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


def with_residual(stream, scene, loads, method):
    residual = stream.choice(RESIDUALS)
    return scene.files(loads, method + (f", residual = {residual!r}" if residual else "")), residual


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


def campaign(settings, work):
    """Scenes of each kind on grids, of each kind of hard map and of made surfaces, all also with a hardness. Runs
    stress_scenes."""
    part = settings.part("conditions of contact")
    most = 0
    for what, case, kinds in (("grid", grid_case, settings.amount(KINDS, QUICK)),
                              ("hard", hard_case, settings.amount(HARD, QUICK_HARD)),
                              ("made", made_case, ("self_affine",))):
        for name, stream, kind in settings.cases(f"conditions-{what}", kinds, settings.amount(24, 2)):
            files, requested = case(stream, kind)
            write(files, work)
            # Of the mean pressure, for half of the scenes.
            hardness = [repr(1.0 + 10.0**stream.uniform(-6.0, 1.5))] if stream.random() < 0.5 else []
            outcome = run([settings.programs/"stress_scenes", "deck.nml", *hardness], work, patience=PATIENCE)
            if outcome.status or RUNTIME_WORDS.search(outcome.stderr):
                words = outcome.stderr.decode(errors="replace").strip()
                part.count(name, [f"exit status {outcome.status}: {words}"], files)
            for text in outcome.stdout.decode().splitlines():
                line = [word.strip() for word in text.split("|")]
                words = [f"no answer: {line[2]}"]
                if line[0] == "grid":
                    words, worst, iterations = grid_complaints(line, requested)
                    part.limit("KKT over what is allowed", worst, 1.0, [], "")
                    most = max(most, iterations)
                part.count(name, [f"P = {float(line[1]):.6g}: {word}" for word in words], files)
    part.notes.append(f"at most {most} iterations")
    return part
