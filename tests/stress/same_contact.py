"""What must not change an answer: more load brings more contact; a surface may be moved, mirrored, turned or in
other units; a load may be alone or in a sweep; there may be more threads; and a deck may be run again."""
import random

from common import Part, files_below
from random_scenes import FITTED, random_loads, random_scene
from spot_areas import area_complaints
from summaries import keep, solve

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


def order_and_symmetry(program, seed, kinds, scenes, work, failures):
    """So many scenes of each kind."""
    part = Part("order of loads, symmetry, units")
    worst = {"order": 0.0, "symmetry": 0.0, "units": 0.0}

    def count_case(name, complaints, what, value, most, files):
        worst[what] = max(worst[what], value)
        if value > most:
            complaints.append(f"{value:.1e} times the estimates, allowed {most}")
        if not part.count(name, complaints):
            keep(failures, name, files)

    for kind in kinds:
        for number in range(scenes):
            name = f"symmetry-{kind.replace(' ', '-')}-{number}"
            stream = random.Random(f"{seed} {name}")
            scene, loads = random_scene(stream, kind), random_loads(stream, 6)
            method = f"solver = '{stream.choice(('grid', 'auto'))}', accuracy = {10.0**-stream.uniform(1.0, 2.0)!r}"
            files = scene.files(loads, method)
            rows, complaints = solve(program, files, work/name)
            count_case(f"{name}-order", complaints, "order", order(rows), LARGEST_RATIO, files)
            others = {"moved": scene.moved(stream.random(), stream.random()), "mirrored": scene.mirrored()}
            if not scene.is_profile:
                others["turned"] = scene.turned()
            for change, other in others.items():
                files = other.files(loads, method)
                changed, complaints = solve(program, files, work/name)
                count_case(f"{name}-{change}", complaints, "symmetry", difference(rows, changed), LARGEST_RATIO, files)
            # Given as a sum or a map like the other, so that both are solved alike.
            rows, complaints = solve(program, scene.scaled(1.0, 1.0).files(loads, method), work/name)
            units = [10.0**stream.randint(-9, 9) for _ in range(3)]
            files = scene.scaled(*units[:2]).files(loads, method, units[2])
            changed, more = solve(program, files, work/name)
            count_case(f"{name}-units", complaints + more, "units", difference(rows, changed, ROUNDING), SOLVED, files)
    part.worst = ", ".join(f"{what} {value:.2g}" for what, value in worst.items()) + " times both estimates"
    return part


def alone_and_again(program, seed, kinds, scenes, work, failures):
    """So many scenes of each kind, each load of a sweep also alone, and as many large grids on two threads."""
    part = Part("alone, again, with threads")
    worst = {"grids alone": 0.0, "expansions alone": 0.0, "threads": 0.0}
    for kind in kinds:
        for number in range(scenes):
            name = f"again-{kind.replace(' ', '-')}-{number}"
            stream = random.Random(f"{seed} {name}")
            scene, loads = random_scene(stream, kind), random_loads(stream, 4)
            solver = "fitted" if kind in FITTED and stream.random() < 0.5 else stream.choice(("grid", "auto"))
            accuracy = 10.0**-stream.uniform(*(3.0, 10.0) if solver == "fitted" else (1.0, 2.0))
            method = f"solver = '{solver}', accuracy = {accuracy!r}"
            files = scene.files(loads, method)
            files["deck.nml"] += "&output map = t, contours = t, spots = t, histograms = t, map_points = 16 /\n"
            rows, complaints = solve(program, files, work/name)
            tables = contents(work/name/"results")
            if rows:
                complaints += area_complaints(work/name/"results", scene.cell,
                                              not scene.is_profile and scene.edges != "mirror")
            _, more = solve(program, files, work/name)
            if contents(work/name/"results") != tables:
                complaints.append("other tables when they are made again")
            failed = not part.count(f"{name}, again", complaints + more)
            # Not the load of the row, which is rounded to the digits of the table.
            for load, row in zip(loads, rows):
                single, complaints = solve(program, scene.files([load], method), work/name)
                if [(it.status, it.solver) for it in single] != [(row.status, row.solver)]:
                    complaints.append(f"not {row.status} by {row.solver} as in a sweep")
                # An expansion starts from that of the last load.
                by_expansion = row.solver == "fitted"
                what, most = ("expansions alone", LARGEST_RATIO) if by_expansion else ("grids alone", SOLVED)
                off = difference([row], single, ROUNDING if row.solver == "grid" else 0.0)
                worst[what] = max(worst[what], off)
                if off > most:
                    complaints.append(f"{off:.1e} times the estimates from that of a sweep")
                failed |= not part.count(f"{name}, alone at P = {load!r}", complaints)
            if failed:
                keep(failures, name, files)
    for number in range(scenes):
        name = f"threads-{number}"
        stream = random.Random(f"{seed} {name}")
        # Several threads are used from 2**19 points on, here without symmetry.
        scene, loads = random_scene(stream, "sum"), random_loads(stream, 2)
        files = scene.files(loads, "solver = 'grid', grid_points = 720, 736")
        rows, complaints = solve(program, files, work/name)
        others, more = solve(program, files, work/name, "--threads", "2")
        off = difference(rows, others, ROUNDING)
        worst["threads"] = max(worst["threads"], off)
        if off > SOLVED:
            complaints.append(f"{off:.1e} times the estimates with two threads")
        if not part.count(name, complaints + more):
            keep(failures, name, files)
    part.worst = ", ".join(f"{what} {value:.2g}" for what, value in worst.items()) + " times both estimates"
    return part


def contents(folder):
    """The tables in a folder."""
    return {name: (folder/name).read_bytes() for name in files_below(folder)}
