#!/usr/bin/env python3
"""Times of the paper's quadratic programmes: by wavycon's two methods, and by other solvers on the same matrices.

usage: programmes.py BUILD SECONDS [DAQP]

Without DAQP: the paper's discretisations, by the dual method and by Beale's alone; how the time of Beale's grows with
their size; quadprog, Goldfarb & Idnani's dual method in compiled C, if this Python has it; the sweep of all loads; and
the largest series. With DAQP, a folder: DAQP, the fastest of the solvers tried, whose source is installed into the
folder from the Python package index and compiled by cc with the flags of its package. It runs with its default
tolerance of the constraints, 1e-6, and with 1e-11, at which its answers have as many digits as wavycon's.

SECONDS is the time for each load of a comparison. Blocks of solves alternate, so that what else the machine does falls
on all alike. All solves of a comparison are cold: from the matrices, without a set of active constraints.
"""
import glob
import math
import pathlib
import statistics
import subprocess
import sys
import time

from own import reference_loads

SIZES = [(9, 27), (18, 53)]   # harmonics, points a side
FEW = 9, 11   # so few points that loads start from the one before
TOLERANCES = [1e-6, 1e-11]
FLAGS = ['-O3', '-fassociative-math', '-fno-signed-zeros', '-fno-trapping-math']
VERSION = '0.11.0'
LARGEST, LARGEST_LOADS = (60, 121), (0.8, 0.6, 0.4, 0.2)
AGREEMENT = 1e-9   # largest difference of two answers, far above rounding


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
        self.process = subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True)
        self.tolerance = '' if tolerance is None else f' {tolerance!r}'

    def write(self, line):
        self.process.stdin.write(line)
        self.process.stdin.flush()

    def solve(self, load, count):
        self.write(f'{load!r}{self.tolerance} {count}\n')
        status, steps = self.process.stdout.readline().split()
        times, x = ([float(word) for word in self.process.stdout.readline().split()] for _ in range(2))
        return status, int(steps), times, x


class Wavycon(Solver):
    """bench_programmes."""

    def __init__(self, build, harmonics, points, symmetry='full', way='dual'):
        super().__init__([pathlib.Path(build)/'tests'/'bench'/'bench_programmes', harmonics, points, symmetry, way])
        self.head = self.process.stdout.readline()
        self.n, self.m = map(int, self.head.split())
        self.name = f'{self.n}/{self.m} {way}'

    def matrices(self):
        """The lines of D, c and C'."""
        self.write('0 -1\n')
        return [self.process.stdout.readline() for _ in range(self.n + 1 + self.m)]


class Daqp(Solver):
    def __init__(self, program, tolerance, wavycon):
        super().__init__([program], tolerance)
        self.name = f'DAQP {tolerance:g}'
        self.write(''.join([wavycon.head, *wavycon.matrices()]))


class Quadprog:
    """quadprog, without what its call from Python costs, as measured on a problem of one unknown and one constraint."""
    name = 'quadprog'

    def __init__(self, wavycon):
        import numpy
        import quadprog
        rows = [numpy.array(line.split(), dtype=float) for line in wavycon.matrices()]
        n = wavycon.n
        self.run, self.numpy = quadprog.solve_qp, numpy
        self.matrices = numpy.array(rows[:n]), rows[n], numpy.asfortranarray(numpy.array(rows[n + 1:]).T)
        trivial = numpy.ones((1, 1)), numpy.ones(1), numpy.ones((1, 1)), numpy.zeros(1)
        self.overhead = statistics.median(self.timed(trivial, 2000)[1])

    def timed(self, problem, count):
        times = []
        for _ in range(count):
            before = time.process_time()
            answer = self.run(*problem)
            times.append(1000*(time.process_time() - before))
        return answer, times

    def solve(self, load, count):
        *programme, normals = self.matrices
        answer, times = self.timed((*programme, normals, self.numpy.full(normals.shape[1], -load)), count)
        return 'converged', sum(answer[3]), [spent - self.overhead for spent in times], list(answer[0])


def compare(solvers, loads, seconds):
    """A table of the first solver and others in turns. Whether the first converged, and the last agrees with it."""
    own = solvers[0]
    block = max(1, 20000//(own.n*own.m))
    print(f'# In turns: {", ".join(solver.name for solver in solvers)}. Of each median and least time [ms], pivots or '
          'iterations;\n# of all but the first the time over that of the first, and the largest difference from it')
    print('#   P' + ''.join(f'{solver.name:>18}{"least":>10}{"steps":>7}' for solver in solvers)
          + (f'{"ratio":>8}{"differs":>9}')*(len(solvers) - 1))
    ratios, medians, good = [], [], True
    for load in loads:
        times = [[] for _ in solvers]
        end = time.perf_counter() + seconds
        while time.perf_counter() < end or not times[0]:
            answers = [solver.solve(load, block) for solver in solvers]
            for series, answer in zip(times, answers):
                series.extend(answer[2])
        medians.append([statistics.median(series) for series in times])
        ratios.append([median/medians[-1][0] for median in medians[-1][1:]])
        # Solvers without a size of their own have the first one's programme.
        differences = [max(abs(a - b) for a, b in zip(answers[0][3], answer[3]))
                       if getattr(solver, 'm', own.m) == own.m else math.nan
                       for solver, answer in zip(solvers[1:], answers[1:])]
        good = good and answers[0][0] == 'converged' and not differences[-1] > AGREEMENT
        print(f'{load:5.2f}' + ''.join(f'{median:18.4f}{min(series):10.4f}{answer[1]:7d}'
                                       for median, series, answer in zip(medians[-1], times, answers))
              + ''.join(f'{ratio:8.3f}{difference:9.1e}' for ratio, difference in zip(ratios[-1], differences)),
              flush=True)
    means = [math.exp(statistics.mean(map(math.log, column))) for column in zip(*ratios)]
    print('# means over the loads [ms]: ' + ' '.join(f'{statistics.mean(column):.4f}' for column in zip(*medians))
          + '; geometric means of the ratios: ' + ' '.join(f'{mean:.3f}' for mean in means) + '\n\n')
    return good


def sweep(solver, loads):
    """Time [ms] of the loads, each from the one before; the least of some."""
    return min(sum(solver.solve(load, 0 if load < max(loads) else 1)[2][0] for load in sorted(loads, reverse=True))
               for _ in range(20))


def alone(solver, loads):
    """Time [ms] of the loads, each on its own."""
    return sum(statistics.median(solver.solve(load, 20)[2]) for load in loads)


def paper(build, loads, seconds):
    """The paper's discretisations, and points on as many intervals as there are harmonics. The paper: 49/378 take about
    20 times as long as 29/196."""
    usual = Wavycon(build, *SIZES[0])
    good = compare([usual, Wavycon(build, *SIZES[0], 'diagonal'), Wavycon(build, *SIZES[0], 'full', 'beale'),
                    Wavycon(build, *SIZES[0], 'diagonal', 'beale'), Wavycon(build, 9, 10)], loads, seconds)
    good = compare([Wavycon(build, *SIZES[0], symmetry, 'beale') for symmetry in ('full', 'diagonal', 'none')], loads,
                   seconds) and good
    try:
        good = compare([usual, Quadprog(usual)], loads, seconds) and good
    except ImportError:
        print('# quadprog (Goldfarb & Idnani 1983): SKIPPED, this Python does not have it\n\n')
    beale, few = Wavycon(build, *SIZES[0], 'full', 'beale'), Wavycon(build, *FEW)
    print(f'# The sweep of all loads [ms]: {beale.name} {alone(beale, loads):.3f}; {usual.name} '
          f'{alone(usual, loads):.3f}; {few.name} {alone(few, loads):.3f}, from load to load {sweep(few, loads):.3f}')
    largest = Wavycon(build, *LARGEST)
    print(f'# {largest.n}/{largest.m}, mean of loads from 0.8 to 0.2, from load to load [ms]: '
          f'{sum(largest.solve(load, 0)[2][0] for load in LARGEST_LOADS)/len(LARGEST_LOADS):.1f}')
    return good


def against_daqp(build, folder, loads, seconds):
    daqp, good = compiled_daqp(folder), True
    for size in SIZES:
        own = Wavycon(build, *size)
        good = compare([own, *(Daqp(daqp, tolerance, own) for tolerance in TOLERANCES)], loads, seconds) and good
    return good


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__.split('\n\n')[1])
    build, seconds, loads = sys.argv[1], float(sys.argv[2]), reference_loads()
    good = against_daqp(build, sys.argv[3], loads, seconds) if sys.argv[3:] else paper(build, loads, seconds)
    if not good:
        sys.exit(f'programmes: answers differ by more than {AGREEMENT}, or wavycon did not converge')


if __name__ == '__main__':
    main()
