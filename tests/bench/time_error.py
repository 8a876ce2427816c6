#!/usr/bin/env python3
"""Time against error of wavycon and other programs, in one run on one thread each.

usage: time_error.py BUILD ENVIRONMENTS REFERENCE TABLE SECONDS

SECONDS: approximate time of a solver for a load. BUILD has the shared library; the other programs are installed in
ENVIRONMENTS. The table goes to TABLE, as blocks for gnuplot (one for each load and solver), a summary to standard
output. wavycon runs by grids and the collocation fitted to the edge to ever smaller accuracies, and by the paper's
series with ever more harmonics.

Errors are relative to the values of the collocation fitted to the edge, accurate to some 1e-13, which must agree with all
digits of REFERENCE, values of other programs. The effective error of a run is the largest of its own error and those
of all finer runs of the same solver, as an error that passes through zero is small by chance. The finest run has no
finer one.
"""
import itertools
import math
import os
import statistics
import subprocess
import sys
import time

from own import Own, Table
from peer_install import PEERS, python_with

LOADS = '0.05', '0.2', '0.5', '0.9'
QUANTITIES = 'gap', 'area', 'peak'
TARGETS = [10.0**-k for k in range(2, 9)]
RATIO_TARGETS = 1e-5, 1e-3, 1e-3  # of the three quantities, for the ratios
OWN = 'wavycon-grid', 'wavycon-fitted', 'wavycon-series'
RATED = 'wavycon-grid', 'wavycon-fitted'  # for the ratios
HANG = 5  # a solver is ended after so many times its time
GROWTH = 6  # largest ratio of the times of two runs of a solver
HARMONICS = 5, 7, 9, 12, 15, 20, 25, 30
FINEST = 1e-12


def references(path):
    """Values, and half a unit of their last digits, both of all three quantities, by load."""
    found = {}
    for load, *words in Table(path).rows():
        found[float(load)] = [float(word) for word in words], [0.5*10.0**-len(word.split('.')[1]) for word in words]
    return found


def run(command, seconds):
    """Lines of the standard output, as far as the program came in its time."""
    environment = dict(os.environ, OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1', MKL_NUM_THREADS='1',
                       NUMBA_NUM_THREADS='1')
    try:
        done = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              timeout=HANG*seconds, check=False)
    except subprocess.TimeoutExpired as ended:
        return (ended.stdout or b'').decode().splitlines() + [f'# ended after {HANG*seconds:.0f} s']
    lines = done.stdout.decode().splitlines()
    return lines if done.returncode == 0 else lines + [f'# failed with status {done.returncode}']


def judged(rows, reference):
    """Rows of fineness, time and values, with the errors and the effective errors in place of the values."""
    worst = [0.0]*3
    answer = []
    for fineness, milliseconds, values in sorted(rows, reverse=True):
        errors = [abs(value/true - 1) for value, true in zip(values, reference)]
        worst = [max(pair) for pair in zip(worst, errors)]
        answer.insert(0, (fineness, milliseconds, errors, worst))
    return answer


def time_to(runs, targets):
    """Least time of a run whose effective errors all reach their targets; None is no target."""
    return min((milliseconds for _, milliseconds, _, worst in runs
                if all(t is None or w <= t for w, t in zip(worst, targets))), default=None)


def text(milliseconds):
    return '-' if milliseconds is None else f'{milliseconds:.3g}'


def methods():
    """wavycon's solvers, each with its methods from coarse to fine."""
    return zip(OWN, ([(k, f"solver = 'grid', accuracy = {0.1*0.5**k:g}") for k in range(36)],
                     [(k, f"solver = 'fitted', accuracy = 1e-{k}") for k in range(2, 13)],
                     [(n, f"solver = 'series', harmonics = {n}, constraint_points = {n + 1}") for n in HARMONICS]))


def run_own(own, load, seconds):
    """Solver and row of each run of wavycon. Of accuracies with the same solution only the first is told."""
    for solver, series in methods():
        end, last = time.process_time() + seconds, None
        for fineness, method in series:
            solution, times = own.solved("kind = 'wave_2d'", method, load)
            values, _ = own.values(solution)
            if own.numbers(solution, 'status_code')[0] < 10 and values != last:
                yield solver, (fineness, statistics.median(times), values)
            last = values
            if time.process_time() + GROWTH*min(times)/1000 > end:
                break


def measure_wave(own, commands, seconds):
    """Runs by solver and load, reference values and their errors by load, and the remarks of the solvers."""
    found, exact, remarks = {}, {}, []
    for load in map(float, LOADS):
        exact[load] = own.values(own.solved("kind = 'wave_2d'", f"solver = 'fitted', accuracy = {FINEST}", load)[0])
        for solver, row in run_own(own, load, seconds):
            found.setdefault(solver, {}).setdefault(load, []).append(row)
        print(f'bench: wavycon at P = {load} done', file=sys.stderr)
    for name, command in commands:
        for load in LOADS:
            for line in run([*command, f'{seconds:g}', load], seconds + 20):
                if line.startswith('#'):
                    remarks.append(line if name in line else f'# {name} at P = {load}: {line[2:]}')
                    continue
                solver, at, fineness, milliseconds, _, *values = line.split()
                row = int(fineness), float(milliseconds), [float(value) for value in values]
                found.setdefault(solver, {}).setdefault(float(at), []).append(row)
            print(f'bench: {name} at P = {load} done', file=sys.stderr)
    return found, exact, remarks


def check_references(exact, independent):
    for load, (values, errors) in exact.items():
        others, halves = independent[load]
        for quantity, value, error, other, half in zip(QUANTITIES, values, errors, others, halves):
            # The last digit given may be wrong by one.
            if abs(value - other) > error + 3*half:
                sys.exit(f'time_error: {quantity} at P = {load} is {value}, and {other} in the independent reference')


def write_runs(out, results, floors):
    for load, floor in floors.items():
        for solver in [*OWN, *PEERS]:
            out.write(f'# P = {load}, {solver}\n')
            if load == next(iter(floors)) and solver == OWN[0]:
                out.write('# fineness  time[ms] of user and system, relative errors of gap, area, peak; those that '
                          'count;\n# the floors of these\n')
            runs = results.get(solver, {}).get(load, [])
            # gnuplot counts blocks: an empty one must be there.
            for fineness, milliseconds, errors, worst in runs or [(0, math.nan, [math.nan]*3, [math.nan]*3)]:
                out.write(f'{fineness:10d}{milliseconds:12.4g}'
                          + ''.join(f'{x:12.2e}' for x in [*errors, *worst, *floor]) + '\n')
            out.write('\n\n')


def write_times(results, floors):
    print('# Times to relative errors [ms]; -: not reached in the time given; '
          'floor: the reference has fewer digits')
    print(f'#{"solver":>17}{"P":>6}{"of":>6}' + ''.join(f'{target:9.0e}' for target in TARGETS))
    for solver, by_load in results.items():
        for load, runs in by_load.items():
            for q, quantity in enumerate(QUANTITIES):
                cells = []
                for target in TARGETS:
                    wanted = [target if k == q else None for k in range(3)]
                    cells.append('floor' if target < floors[load][q] else text(time_to(runs, wanted)))
                print(f'{solver:>18}{load:6.2f}{quantity:>6}' + ''.join(f'{cell:>9}' for cell in cells))


def write_ratios(results, floors):
    print('\n\n# Time of a peer over the time of a solver of wavycon, to relative errors of 1e-5 in gap,\n'
          '# 1e-3 in area, 1e-3 in peak, and of all three at once. >: the peer did not get there, and its\n'
          '# longest run took so much; -: the solver of wavycon did not get there.')
    print(f'#{"peer":>17}{"over":>16}{"P":>6}{"gap":>10}{"area":>10}{"peak":>10}{"all":>10}')
    aims = [[target if k == q else None for k, target in enumerate(RATIO_TARGETS)] for q in range(3)]
    aims.append(list(RATIO_TARGETS))
    for peer, own, load in itertools.product(PEERS, RATED, floors):
        theirs = results.get(peer, {}).get(load)
        ours = results.get(own, {}).get(load, [])
        if theirs:
            cells = []
            for aim in aims:
                mine, other = time_to(ours, aim), time_to(theirs, aim)
                if mine is None:
                    cells.append('-')
                elif other is None:
                    cells.append(f'>{max(row[1] for row in theirs)/mine:.3g}')
                else:
                    cells.append(f'{other/mine:.3g}')
            print(f'{peer:>18}{own:>16}{load:6.2f}' + ''.join(f'{cell:>10}' for cell in cells))


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__.split('\n\n')[1])
    build, environments, reference, table = sys.argv[1:5]
    seconds = float(sys.argv[5])
    here = os.path.dirname(os.path.abspath(__file__))
    known = references(reference)

    pythons = {}
    head = ['# Time against error, one thread each. P = pbar/p*. Peers solve the smaller, square cell.']
    for peer, (requirement, _) in PEERS.items():
        python = python_with(peer, environments)
        if python:
            pythons[peer] = python
            head.append(f'# {requirement.replace("==", " ")}')
        else:
            head.append(f'# {requirement.replace("==", " ")}: SKIPPED, it could not be installed')
            print(f'bench: {requirement} could not be installed and is SKIPPED', file=sys.stderr)

    commands = [(name, [python, os.path.join(here, 'time_error_peer.py'), name]) for name, python in pythons.items()]
    found, exact, remarks = measure_wave(Own(build), commands, seconds)
    check_references(exact, known)
    floors = {load: [error/value for value, error in zip(*numbers)] for load, numbers in exact.items()}
    results = {solver: {load: judged(rows, exact[load][0]) for load, rows in by_load.items()}
               for solver, by_load in found.items()}
    with open(table + '.new', 'w', encoding='utf-8') as out:
        out.write('\n'.join(head + remarks) + '\n')
        write_runs(out, results, floors)
    os.replace(table + '.new', table)
    print('\n'.join(head + remarks))
    write_times(results, floors)
    write_ratios(results, floors)


if __name__ == '__main__':
    main()
