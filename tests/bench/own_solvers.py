#!/usr/bin/env python3
"""Times and errors of wavycon's own solvers, in blocks for gnuplot. Times are processor times, user and system [ms].

usage: own_solvers.py BUILD

The program from start to finish, its start-up, and reading, surface and statistics of a map, in wall, user and system
time. 'fitted': a load of the two-dimensional and of the hexagonal wave to ever smaller accuracies, and 99 loads, each
from the one before. Grids: a load of the 2-D wave to three accuracies, and how the errors of the 1-D and the 2-D wave
fall with the step. Maps, and stresses, beside the solution that they show: a section of 128 x 64 points, the search for
the largest stresses, a plane.
"""
import array
import ctypes
import math
import pathlib
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from own import ROOT, Own, middle_and_least, reference_loads, repeated

SQUARE, HEXAGONAL, LINE = "kind = 'wave_2d'", "kind = 'hexagonal'", "kind = 'wave_1d'"
# P of each surface: away from the loads at which spots merge, 0.2286 and 0.7119, and next to them.
FITTED = {SQUARE: (0.01, 0.05, 0.1, 0.2, 0.228, 0.24, 0.3, 0.5, 0.7, 0.9),
            HEXAGONAL: (0.01, 0.1, 0.3, 0.5, 0.7, 0.72, 0.8, 0.9)}
POWERS, FINEST = (2, 3, 4, 5, 6, 8, 10), 12   # powers of ten of the accuracies, and of that of the reference
SWEEP = 99
PROCESS_RUNS, MAP_RUNS, MAP_SIDE = 20, 10, 1024   # runs of the program and of each phase of a map
MAP_SIDES, MAP_LOADS = (128, 257, 1025), (0.05, 0.2, 0.3, 0.6, 0.9)
STRESS_LOADS = 1e-3, 0.1, 0.3, 0.9
STRESSES = ("&stress nu = 0.3, section = 'x', depth_from = 0, depth_to = 1, depth_steps = 64 / "
            "&output line_points = 128 /")
ROUGH = "kind = 'self_affine', rms_slope = 0.1, long_wavelength = 0.125, short_wavelength = 0.015625, points = "


def fitted(accuracy):
    return f"solver = 'fitted', accuracy = {accuracy:g}"


def name_of(surface):
    return surface.split("'")[1]


def pairs(values, errors, truth):
    """Errors and their estimates, relative to the truth."""
    return "".join(f"{value/true - 1:11.1e}{error/true:10.1e}" for value, error, true in zip(values, errors, truth))


def process_times(command, runs=PROCESS_RUNS):
    """Medians of wall, user and system time [ms] of a command, and its least wall time."""
    rows = []
    for _ in range(runs):
        before, used = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        wall, now = time.perf_counter() - before, resource.getrusage(resource.RUSAGE_CHILDREN)
        rows.append((1000*wall, 1000*(now.ru_utime - used.ru_utime), 1000*(now.ru_stime - used.ru_stime)))
    columns = list(zip(*rows))
    return [statistics.median(column) for column in columns] + [min(columns[0])]


def program(build):
    """The program, and what it does before the first load."""
    program, bench = pathlib.Path(build)/"wavycon", pathlib.Path(build)/"tests"/"bench"/"bench_map"
    print(f"# Processes from start to finish, {PROCESS_RUNS} runs of each: medians [ms], least wall time. start_up: "
          f"the program with\n# --version; sweep: inputs/paper_2d_sweep.nml. {MAP_RUNS} runs for the phases of a map of "
          f"{MAP_SIDE} x {MAP_SIDE} heights, each less\n# the one before: start of a process; reading of the file; "
          "surface through the points; statistics and roughness.\n"
          "#           phase      wall      user    system     least")
    with tempfile.TemporaryDirectory() as folder:
        def row(name, times):
            print(f"{name:>17}" + "".join(f"{value:10.3f}" for value in times), flush=True)

        row("start_up", process_times([program, "--version"]))
        row("sweep", process_times([program, ROOT/"inputs"/"paper_2d_sweep.nml", "--quiet", "--output", folder]))
        numbers = random.Random(1)
        heights = array.array("d", (numbers.gauss(0, 1) for _ in range(MAP_SIDE**2)))
        gsf, text = pathlib.Path(folder)/"map.gsf", pathlib.Path(folder)/"map.txt"
        head = f"Gwyddion Simple Field 1.0\nXRes = {MAP_SIDE}\nYRes = {MAP_SIDE}\n".encode()
        gsf.write_bytes(head + b"\0"*(4 - len(head) % 4) + array.array("f", heights).tobytes())
        with open(text, "w", encoding="ascii") as out:
            for i in range(0, MAP_SIDE**2, MAP_SIDE):
                out.write(" ".join(f"{height:.6e}" for height in heights[i:i + MAP_SIDE]) + "\n")
        for path in gsf, text:
            last = [0.0]*4
            for phase in "start", "read", "surface", "statistics":
                times = process_times([bench, path, phase], MAP_RUNS)
                row(path.suffix[1:] + "_" + phase, [now - before for now, before in zip(times, last)])
                last = times
    print("\n")


def fitted_loads(own):
    print("# Fitted solutions: a load from nothing. Errors of mean gap, area and peak pressure and their estimates are "
          f"relative,\n# against an accuracy of 1e-{FINEST}.")
    print("# surface   accuracy       P steps  time[ms]     least  gap_error  estimate area_error  estimate peak_error  "
          "estimate")
    for surface, loads in FITTED.items():
        for load in loads:
            truth, _ = own.values(own.solved(surface, fitted(10.0**-FINEST), load)[0])
            for power in POWERS:
                solution, times = own.solved(surface, fitted(10.0**-power), load)
                steps, = own.numbers(solution, "iterations")
                print(f"{name_of(surface):>11} {10.0**-power:9.0e}{load:8.3f}{steps:6.0f}"
                      + middle_and_least(times) + pairs(*own.values(solution), truth), flush=True)
    print(f"\n\n# The sweep of {SWEEP} loads, each from the one before\n# surface   accuracy   time[s]")
    for surface in FITTED:
        for accuracy in 1e-6, 1e-10:
            _, times = repeated(lambda: own.scene(surface, fitted(accuracy)),
                                lambda scene: [own.load(scene, i/(SWEEP + 1)) for i in range(1, SWEEP + 1)], 1)
            print(f"{name_of(surface):>11} {accuracy:9.0e}{times[0]/1000:10.3f}", flush=True)


def grids(own):
    print("\n\n# Grids: a load of the 2-D wave from nothing. Errors are relative, against fitted solutions.")
    print("# accuracy      P iterations  time[ms]     least  gap_error  estimate area_error  estimate "
          "peak_error  estimate")
    for accuracy in 1e-2, 1e-3, 1e-4:
        for load in reference_loads():
            truth, _ = own.values(own.solved(SQUARE, fitted(1e-9), load)[0])
            solution, times = own.solved(SQUARE, f"solver = 'grid', accuracy = {accuracy:g}", load)
            iterations, status = own.numbers(solution, "iterations", "status_code")
            if status >= 10:
                sys.exit(f"own_solvers: a grid is not as accurate as asked for, at P = {load}")
            print(f"{accuracy:10.0e}{load:7.2f}{iterations:11.0f}" + middle_and_least(times)
                  + pairs(*own.values(solution), truth), flush=True)


def orders(own, surface, exact, sides):
    """Errors on grids of ever more points, and the slopes of straight lines through their logarithms."""
    loads = [i/10 for i in range(1, 10)]
    truth = {load: own.values(own.solved(surface, exact, load)[0])[0] for load in loads}
    print(f"\n\n# Grids: absolute errors of {name_of(surface)}, gap in Delta and peak in p*, root mean squares over "
          "nine\n# loads P = 0.1 .. 0.9\n"
          "# points a side   mean_gap       area       peak")
    rows = []
    for side in sides:
        squares = [0.0]*3
        for load in loads:
            scene = own.scene(surface, f"solver = 'grid', grid_points = {side}")
            found, _ = own.values(own.load(scene, load))
            squares = [square + (value - true)**2/len(loads)
                       for square, value, true in zip(squares, found, truth[load])]
        rows.append([math.sqrt(square) for square in squares])
        print(f"{side:12d}" + "".join(f"{error:11.1e}" for error in rows[-1]), flush=True)
    steps = [-math.log(side) for side in sides]
    steps = [step - sum(steps)/len(steps) for step in steps]
    slopes = [sum(math.log(row[i])*step for row, step in zip(rows, steps))/sum(step**2 for step in steps)
              for i in range(3)]
    print("#    order:  " + "".join(f"{slope:11.1f}" for slope in slopes))


def solvers():
    """(surface, method, accuracy) of maps and stresses."""
    for accuracy in 1e-4, 1e-10:
        for surface in SQUARE, HEXAGONAL:
            yield surface, fitted(accuracy), f"{accuracy:g}"
    yield SQUARE, "solver = 'grid'", "1e-3"
    yield LINE, "solver = 'closed_form'", "exact"


def head_of(surface, method, accuracy):
    return f"{name_of(method):>13} {name_of(surface):>11}{accuracy:>9}"


def maps(own):
    print("\n\n# Maps: a load solved, and its fields on the points of a map; medians and least times\n"
          "#     solver     surface accuracy      P  solve[ms]  points   map[ms]     least")
    for surface, method, accuracy in solvers():
        for load in MAP_LOADS:
            for side in MAP_SIDES:
                rows = 1 if surface == LINE else side
                fields = [(ctypes.c_double*(side*rows))() for _ in range(3)]
                # The fields begin with nothing prepared.
                solve = []

                def prepare():
                    solution, times = own.solved(surface, method, load, fields=True, repeats=1)
                    solve[:] = times
                    return solution

                _, times = repeated(prepare, lambda solution: own.library.get_grid(solution, side, rows, None, *fields))
                print(head_of(surface, method, accuracy) + f"{load:7.2f}{solve[0]:11.2f}{side:8d}"
                      + middle_and_least(times), flush=True)


def stresses(own):
    print("\n\n# Stresses: a load solved, the table of a section of 128 x 64 points, of the largest von Mises and shear "
          "stress, and a\n# plane of 128 x 128 points, or of those of the map, at a depth of 0.1; least times [ms]\n"
          "#     solver     surface accuracy        P      solve    section     search      plane")
    cases = [(*case, 128) for case in solvers()]
    cases += [(ROUGH + str(side), "solver = 'grid'", str(side), side) for side in (256, 1024)]
    for surface, method, accuracy, side in cases:
        rows = 1 if surface == LINE else side
        plane, solve = (ctypes.c_double*(6*side*rows))(), []

        def prepare():
            solution, times = own.solved(surface, method, load, fields=True, more=STRESSES, repeats=1)
            solve[:] = times
            return solution

        def table(name):
            return lambda solution: own.alive.append(own.library.new_table(solution, name))

        for load in STRESS_LOADS:
            runs = [table(b"stress_section"), table(b"stress_largest"), lambda solution: own.library.get_stress_plane(
                solution, side, rows, None, 0.1, 0.3, b"free", plane, None)]
            times = [min(repeated(prepare, run, 3)[1]) for run in runs]
            print(head_of(surface, method, accuracy) + f"{load:9.0e}{solve[0]:11.2f}"
                  + "".join(f"{least:11.2f}" for least in times), flush=True)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    program(sys.argv[1])
    own = Own(sys.argv[1])
    fitted_loads(own)
    grids(own)
    orders(own, LINE, "solver = 'closed_form'", [128*2**k for k in range(5)])
    orders(own, SQUARE, fitted(1e-9), [32*2**k for k in range(5)])
    maps(own)
    stresses(own)


if __name__ == "__main__":
    main()
