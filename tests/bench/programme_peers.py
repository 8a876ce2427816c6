#!/usr/bin/env python3
"""Times wavycon's quadratic programmes against DAQP, the fastest of the solvers tried, in C on the same matrices.

usage: programme_peers.py BENCH_SINGLE_SOLVES DIRECTORY REFERENCE SECONDS

DAQP's source is installed into DIRECTORY from the Python package index and compiled by cc with the flags of its
package. Blocks of solves alternate, so that what else the machine does falls on all alike. All solves are cold: from
the matrices, without a set of active constraints. DAQP runs with its default tolerance of the constraints, 1e-6, and
with 1e-11, at which its answers have as many digits as wavycon's.
"""
import glob
import math
import pathlib
import statistics
import subprocess
import sys
import time

SIZES = [(9, 27), (18, 53)]   # harmonics, points a side
TOLERANCES = [1e-6, 1e-11]
FLAGS = ['-O3', '-fassociative-math', '-fno-signed-zeros', '-fno-trapping-math']
VERSION = '0.11.0'


def compiled_daqp(directory):
    """The compiled program time_daqp."""
    directory = pathlib.Path(directory)
    program = directory / 'time_daqp'
    source = pathlib.Path(__file__).with_name('time_daqp.c')
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        python = str(directory / 'bin' / 'python')
        subprocess.run([sys.executable, '-m', 'venv', str(directory)], check=True)
        pip = [python, '-m', 'pip', '--disable-pip-version-check', '-q']
        subprocess.run(pip + ['install', 'numpy', 'cython', 'setuptools', 'wheel'], check=True)
        subprocess.run(pip + ['download', '--no-deps', '--no-build-isolation', '--no-binary', ':all:', '-d',
                              str(directory), f'daqp=={VERSION}'], check=True)
        subprocess.run(['tar', '-xf', f'daqp-{VERSION}.tar.gz'], cwd=directory, check=True)
        code = directory / f'daqp-{VERSION}' / 'csrc'
        subprocess.run(['cc'] + FLAGS + ['-I', str(code / 'include'), '-o', str(program), str(source)]
                       + glob.glob(str(code / 'src' / '*.c')) + ['-lm'], check=True)
    return str(program)


class Solver:
    """A program that reads loads and answers with status and count, times [ms] and x."""

    def __init__(self, command, tolerance=None):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.tolerance = '' if tolerance is None else f' {tolerance!r}'

    def solve(self, load, count):
        self.process.stdin.write(f'{load!r}{self.tolerance} {count}\n')
        self.process.stdin.flush()
        status, steps = self.process.stdout.readline().split()
        times, x = ([float(word) for word in self.process.stdout.readline().split()] for _ in range(2))
        return status, int(steps), times, x


def compare(program, daqp, size, loads, seconds):
    wavycon = Solver([program] + [str(number) for number in size])
    head = wavycon.process.stdout.readline()
    n, m = (int(word) for word in head.split())
    solvers = [wavycon] + [Solver([daqp], tolerance) for tolerance in TOLERANCES]
    lines = [head] + [wavycon.process.stdout.readline() for _ in range(n + 1 + m)]
    for solver in solvers[1:]:
        solver.process.stdin.writelines(lines)
    block = max(1, 20000//(n*m))

    print(f'# wavycon and DAQP {VERSION} with the tolerances {TOLERANCES} in turns, {n}/{m}: '
          'median and least time [ms]; pivots or iterations; largest difference from wavycon')
    print('#   P' + ''.join(f'{name:>10}{"least":>10}{"steps":>7}' for name in ['wavycon', 'daqp', 'daqp'])
          + f'{"ratio":>8}{"ratio":>8}{"difference":>12}{"difference":>12}')
    ratios, good = [], True
    for load in loads:
        times = [[] for _ in solvers]
        end = time.perf_counter() + seconds
        while time.perf_counter() < end or not times[0]:
            answers = [solver.solve(load, block) for solver in solvers]
            for series, answer in zip(times, answers):
                series.extend(answer[2])
        medians = [statistics.median(series) for series in times]
        ratios.append([medians[0]/median for median in medians[1:]])
        differences = [max(abs(a - b) for a, b in zip(answers[0][3], answer[3])) for answer in answers[1:]]
        good = good and answers[0][0] == 'converged' and differences[-1] < 1e-9
        print(f'{load:5.2f}' + ''.join(f'{median:10.4f}{min(series):10.4f}{answer[1]:7d}'
                                       for median, series, answer in zip(medians, times, answers))
              + ''.join(f'{ratio:8.3f}' for ratio in ratios[-1])
              + ''.join(f'{d:12.1e}' for d in differences), flush=True)
    means = [math.exp(statistics.mean(math.log(ratio) for ratio in column)) for column in zip(*ratios)]
    print(f'# wavycon over DAQP, geometric mean: {means[0]:.3f}; at equal digits {means[1]:.3f}\n\n')
    return good


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__.split('\n\n')[1])
    program, directory, reference, seconds = sys.argv[1:]
    daqp = compiled_daqp(directory)
    with open(reference, encoding='utf-8') as lines:
        loads = [float(line.split()[0]) for line in lines if not line.startswith('#') and line.split()[0][0].isdigit()]
    if not all([compare(program, daqp, size, loads, float(seconds)) for size in SIZES]):
        sys.exit('programme_peers: answers differ by more than 1e-9, or wavycon did not converge')


if __name__ == '__main__':
    main()
