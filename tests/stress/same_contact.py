"""What must not change an answer: more load brings more contact; a surface may be moved, mirrored, turned or in
other units; a load may be alone or in a sweep; there may be more threads; and a deck may be run again."""
from common import files_below
from random_scenes import FITTED, KINDS, QUICK, random_loads, random_scene
from spot_areas import area_complaints
from summaries import solve

# Largest difference over the sum of two error estimates: as README states of one estimate.
LARGEST_RATIO = 3.0
# For solutions that differ by rounding only. Rounding of gaps moves the edge of contact by its power 2/3, and can
# change the last iteration or the choice between two peaks: a grid is solved to about a thousandth of its error, and
# the difference can be as large.
ROUNDING, SOLVED = 1e-9, 1e-2
# Signs of the change of mean gap, area and peak pressure with the load.
DIRECTIONS = (-1.0, 1.0, 1.0)


def order(rows):
    """The largest change of the wrong sign from a load to the next, over the sum of both error estimates."""
    worst = 0.0
    for row, higher in zip(rows, rows[1:]):
        if row.has_numbers and higher.has_numbers:
            for off, a, b, direction in zip(row.differences(higher), row.values, higher.values, DIRECTIONS):
                if direction*(b - a) < 0.0:
                    worst = max(worst, off)
    return worst


def difference(rows, others, rounding=0.0):
    """The largest difference of two runs of the same loads beyond rounding, over the sum of both error estimates."""
    pairs = [(row, other) for row, other in zip(rows, others) if row.has_numbers and other.has_numbers]
    return max((max(row.differences(other, rounding)) for row, other in pairs), default=0.0)


def order_and_symmetry(settings, work):
    """Scenes of each kind. The numbers are over both estimates."""
    part = settings.part("order of loads, symmetry, units")

    def check(name, complaints, what, value, most, files):
        part.limit(what, value, most, complaints, f"{value:.1e} times the estimates, allowed {most}")
        part.count(name, complaints, files)

    for name, stream, kind in settings.cases("symmetry", *settings.amount((KINDS, 4), (QUICK, 1))):
        scene, loads = random_scene(stream, kind), random_loads(stream, 6)
        method = f"solver = '{stream.choice(('grid', 'auto'))}', accuracy = {10.0**-stream.uniform(1.0, 2.0)!r}"
        files = scene.files(loads, method)
        rows, complaints = solve(settings.program, files, work)
        check(f"{name}-order", complaints, "order", order(rows), LARGEST_RATIO, files)
        others = {"moved": scene.moved(stream.random(), stream.random()), "mirrored": scene.mirrored()}
        if not scene.is_profile:
            others["turned"] = scene.turned()
        for change, other in others.items():
            files = other.files(loads, method)
            changed, complaints = solve(settings.program, files, work)
            check(f"{name}-{change}", complaints, "symmetry", difference(rows, changed), LARGEST_RATIO, files)
        # Given as a sum or a map like the other, so that both are solved alike.
        rows, complaints = solve(settings.program, scene.scaled(1.0, 1.0).files(loads, method), work)
        units = [10.0**stream.randint(-9, 9) for _ in range(3)]
        files = scene.scaled(*units[:2]).files(loads, method, units[2])
        changed, more = solve(settings.program, files, work)
        check(f"{name}-units", complaints + more, "units", difference(rows, changed, ROUNDING), SOLVED, files)
    return part


def alone_and_again(settings, work):
    """Scenes of each kind, each load of a sweep also alone, and large grids on two threads. The numbers are over both
    estimates."""
    part = settings.part("alone, again, with threads")
    kinds, scenes = settings.amount((KINDS, 3), (QUICK, 1))
    for name, stream, kind in settings.cases("again", kinds, scenes):
        scene, loads = random_scene(stream, kind), random_loads(stream, 4)
        solver = "fitted" if kind in FITTED and stream.random() < 0.5 else stream.choice(("grid", "auto"))
        accuracy = 10.0**-stream.uniform(*(3.0, 10.0) if solver == "fitted" else (1.0, 2.0))
        method = f"solver = '{solver}', accuracy = {accuracy!r}"
        files = scene.files(loads, method)
        files["deck.nml"] += "&output map = t, contours = t, spots = t, histograms = t, map_points = 16 /\n"
        rows, complaints = solve(settings.program, files, work)
        tables = contents(work/"results")
        if rows:
            complaints += area_complaints(work/"results", scene.cell, not scene.is_profile and scene.edges != "mirror")
        _, more = solve(settings.program, files, work)
        if contents(work/"results") != tables:
            complaints.append("other tables when they are made again")
        part.count(f"{name}, again", complaints + more, files)
        # Not the load of the row, which is rounded to the digits of the table.
        for load, row in zip(loads, rows):
            single, complaints = solve(settings.program, scene.files([load], method), work)
            if [(it.status, it.solver) for it in single] != [(row.status, row.solver)]:
                complaints.append(f"not {row.status} by {row.solver} as in a sweep")
            # A fitted solution starts from that of the last load.
            what, most = ("fitted solutions", LARGEST_RATIO) if row.solver == "fitted" else ("grids", SOLVED)
            off = difference([row], single, ROUNDING if row.solver == "grid" else 0.0)
            part.limit(f"{what} alone", off, most, complaints, f"{off:.1e} times the estimates from that of a sweep")
            part.count(f"{name}, alone at P = {load!r}", complaints, files)
    for name, stream, kind in settings.cases("threads", ("sum",), scenes):
        # Several threads are used from 2**19 points on, here without symmetry.
        scene, loads = random_scene(stream, kind), random_loads(stream, 2)
        files = scene.files(loads, "solver = 'grid', grid_points = 720, 736")
        rows, complaints = solve(settings.program, files, work)
        others, more = solve(settings.program, files, work, "--threads", "2")
        off = difference(rows, others, ROUNDING)
        part.limit("threads", off, SOLVED, complaints, f"{off:.1e} times the estimates with two threads")
        part.count(name, complaints + more, files)
    return part


def contents(folder):
    """The tables in a folder."""
    return {name: (folder/name).read_bytes() for name in files_below(folder)}
