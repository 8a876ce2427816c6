#!/usr/bin/env python3
"""Times wavycon against quadprog, Goldfarb & Idnani's dual method in compiled C, on the same matrices.

usage: against_quadprog.py BENCH_SINGLE_SOLVES REFERENCE SECONDS

Blocks of solves of both alternate, so that what else the machine does falls on both alike. What calling
quadprog from Python costs is measured on a problem of one unknown and one constraint; its checks and copies
of the larger matrices come on top of that and stay in its time.
"""
import statistics
import subprocess
import sys
import time

import numpy
import quadprog

HARMONICS, POINTS = 9, 27
BLOCK = 20  # solves by one program in a row: the first of them starts with a cold cache
AGREEMENT = 1e-9  # largest difference of the two solutions, far above rounding


class Wavycon:
    """The program bench_single_solves and its quadratic programme."""

    def __init__(self, program):
        self.process = subprocess.Popen(
            [program, str(HARMONICS), str(POINTS)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        n, m = (int(word) for word in self.process.stdout.readline().split())
        self.hessian = numpy.array([self.numbers() for _ in range(n)])
        self.linear = self.numbers()
        self.normals = numpy.asfortranarray(numpy.array([self.numbers() for _ in range(m)]).T)

    def numbers(self):
        return numpy.array(self.process.stdout.readline().split(), dtype=float)

    def solve(self, load, count):
        """Status and pivots, times [ms], solution."""
        self.process.stdin.write(f'{load!r} {count}\n')
        self.process.stdin.flush()
        status, pivots = self.process.stdout.readline().split()
        return status, int(pivots), self.numbers(), self.numbers()


def time_quadprog(matrices, count):
    """Times [ms] and the last solution."""
    times = []
    for _ in range(count):
        before = time.process_time()
        answer = quadprog.solve_qp(*matrices)
        times.append(1000*(time.process_time() - before))
    return times, answer


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.split('\n\n')[1])
    wavycon = Wavycon(sys.argv[1])
    with open(sys.argv[2], encoding="utf-8") as reference:
        rows = [line for line in reference if not line.startswith("#")]
    loads = numpy.genfromtxt(rows, names=True)["pbar_over_pstar"]
    seconds = float(sys.argv[3])
    n, m = wavycon.normals.shape

    trivial = numpy.ones((1, 1)), numpy.ones(1), numpy.ones((1, 1)), numpy.zeros(1)
    overhead = statistics.median(time_quadprog(trivial, 2000)[0])

    print(f'# quadprog (Goldfarb & Idnani 1983) and wavycon in turns, {n}/{m} [ms]')
    print(f'#    a call of quadprog for one unknown and one constraint: {overhead:.4f} ms; '
          'taken off for no_call')
    print(('#{:>4}{:>8}' + 8*'{:>10}' + '{:>12}{:>8}{:>8}{:>8}').format(
        'P', 'solves', 'wavycon', 'least', 'largest', 'quadprog', 'least', 'largest', 'ratio', 'no_call',
        'difference', 'pivots', 'added', 'dropped'))
    ratios = []
    good = True
    for load in loads:
        matrices = wavycon.hessian, wavycon.linear, wavycon.normals, numpy.full(m, -load)
        ours, theirs = [], []
        end = time.perf_counter() + seconds
        while time.perf_counter() < end or not ours:
            status, pivots, times, x = wavycon.solve(float(load), BLOCK)
            ours.extend(times)
            times, answer = time_quadprog(matrices, BLOCK)
            theirs.extend(times)
        difference = abs(x - answer[0]).max()
        steps = answer[3]  # constraints added, and dropped again
        good = good and status == 'converged' and difference <= AGREEMENT
        w, q = statistics.median(ours), statistics.median(theirs)
        ratios.append((w/q, w/(q - overhead)))
        print(f'{load:5.2f}{len(ours):8d}{w:10.4f}{min(ours):10.4f}{max(ours):10.4f}'
              f'{q:10.4f}{min(theirs):10.4f}{max(theirs):10.4f}{w/q:10.3f}{w/(q - overhead):10.3f}'
              f'{difference:12.1e}{pivots:8d}{steps[0]:8d}{steps[1]:8d}', flush=True)
    mean = numpy.exp(numpy.log(ratios).mean(axis=0))
    slower = sum(ratio > 1 for ratio, _ in ratios)
    print(f'# wavycon over quadprog, geometric mean: {mean[0]:.3f}, '
          f'without the cost of a call {mean[1]:.3f}; '
          f'above 1 at {slower} of {len(ratios)} loads')
    if not good:
        sys.exit(f'against_quadprog: answers differ by more than {AGREEMENT}, or wavycon did not converge')


if __name__ == '__main__':
    main()
