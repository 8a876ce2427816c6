#!/usr/bin/env python3
"""Times of wavycon-mpi on a rough surface against the number of ranks, beside those of the serial program.

Surface: self-affine, Hurst exponent 0.8, rms slope 1, roll-off at a tenth of the cell, 8 steps to the shortest wave;
mean pressure 0.3 E*, residual 1e-8. The runs of a grid are repeated in turn, so that other work on the machine meets all of
them alike. Each row: points a side, ranks (0: the serial program), iterations on all grids, contact area, median and
least of the times from the start of the first grid to the measures [s], over the time of one rank, and bytes a point of
all processes together.
"""
import argparse
import os
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT/"tests"/"support"))
from tables import Table  # noqa: E402

DECK = """&surface kind = 'self_affine', rms_slope = 1, hurst = 0.8, seed = 1, length_x = 1, rolloff_wavelength = 0.1,
   short_wavelength = {shortest}, points = {points} /
&load mean_pressure = 0.3 /
&method solver = 'grid', residual = 1e-8 /
"""
# What a rank runs: the program, and a line with the most memory that it took [kB on Linux].
AS_RANK = "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); " \
    "print('memory', resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, flush=True)"


def numbers(words):
    return [int(word) for word in words.split(",")]


def measure(given, ranks, points):
    """Time [s], iterations, contact area and bytes a point of a run."""
    with tempfile.TemporaryDirectory() as folder:
        deck = pathlib.Path(folder)/"rough.nml"
        deck.write_text(DECK.format(points=points, shortest=8/points))
        launcher = shlex.split(given.launch.format(ranks=ranks)) if ranks else []
        program = given.build/("wavycon-mpi" if ranks else "wavycon")
        done = subprocess.run([*launcher, sys.executable, "-c", AS_RANK, program, deck, "--output", folder],
                              env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1"),
                              stdout=subprocess.PIPE, text=True, check=True)
        row, = Table(deck.with_suffix(".summary.dat")).records()
    memory = sum(map(int, re.findall(r"^memory (\d+)", done.stdout, re.MULTILINE)))
    return (float(re.search(r"\[ *([\d.]+) s\] solved and measured", done.stdout)[1]), row["iterations"],
            float(row["contact_area_counted_fraction"]), 1024*memory/points**2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT/"build", help="by scripts/build --mpi all [build]")
    parser.add_argument("--launch", default="mpirun -n {ranks}", help="starts programs on ranks [%(default)s]")
    parser.add_argument("--ranks", type=numbers, default=[0, 1, 2], help="[0,1,2]")
    parser.add_argument("--points", type=numbers, default=[1024, 2048, 4096], help="along a side [1024,2048,4096]")
    parser.add_argument("--repeats", type=int, default=3, help="[%(default)s]")
    given = parser.parse_args()
    print("points ranks iterations contact_area time[s] least[s] time_over_one_rank bytes_a_point")
    for points in given.points:
        runs = {ranks: [] for ranks in given.ranks}
        for _ in range(given.repeats):
            for ranks, found in runs.items():
                found.append(measure(given, ranks, points))
        times = {ranks: statistics.median(run[0] for run in found) for ranks, found in runs.items()}
        for ranks, found in runs.items():
            _, iterations, area, memory = found[0]
            print(points, ranks, iterations, f"{area:.5f} {times[ranks]:.3f} {min(run[0] for run in found):.3f} "
                  f"{times[ranks]/times.get(1, float('nan')):.3f} {memory:.1f}", flush=True)


if __name__ == "__main__":
    main()
