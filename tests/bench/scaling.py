#!/usr/bin/env python3
"""Weak and strong scaling of wavycon-mpi on a rough surface: time, iterations and memory against the number of ranks.

Surface: self-affine, Hurst exponent 0.8, rms slope 1, roll-off at a tenth of the cell, 8 steps to the shortest wave.
Loads: mean pressures over E* rms slope. Residual: 1e-8. Series:

    strong   grids of given points a side on all numbers of ranks
    weak     N x N points a rank: cells of N x (ranks N) points with the same spectrum. A load has about the same
             contact area on all of them, but not the same number of iterations

All runs are repeated in turn, so that other work on the machine meets all of them alike; times are medians. `total` is
the time from start to end, `solve` what the log gives as solved and measured. A rank's memory is the most that its
process had (ru_maxrss). With --bench the program bench_ranks adds the time of an iteration on the last grid, and of the
parts of an iteration, for scaling_model.py. gnuplot reads the table's blocks by name: runs, iterations, parts.
"""
import argparse
import collections
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

DECK = """&surface
   kind = 'self_affine', rms_slope = 1, hurst = 0.8, seed = 1
   length_x = 1, rolloff_wavelength = 0.1, short_wavelength = {shortest}
   points = {x}, {y}
/
&load
   mean_pressure = {pressures}
/
&method
   solver = 'grid', residual = 1e-8
/
"""
STEPS = 8   # of the grid to the shortest wave
Grid = collections.namedtuple('Grid', 'x y')
RUN_COLUMNS = ['ranks', 'points_x', 'points_y', 'pressure', 'contact_area', 'iterations', 'total[s]', 'least_total[s]',
               'solve[s]', 'least_solve[s]', 'most_solve[s]', 'processor_time[s]', 'most_memory[MB]', 'bytes_a_point']
ITERATION_COLUMNS = ['ranks', 'points_x', 'points_y', 'pressure', 'contact_area', 'iterations', 'iteration[ms]',
                     'least[ms]', 'transform_pairs', 'double_pairs']
PART_COLUMNS = ['ranks', 'points_x', 'points_y', 'part', 'time[ms]', 'least[ms]']


def numbers(words):
    return [int(word) for word in words.split(',') if word]


def arguments():
    here = os.path.dirname(os.path.abspath(__file__))
    build = os.path.join(here, '..', '..', 'build')
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=os.path.join(build, 'wavycon-mpi'), help='wavycon-mpi')
    parser.add_argument('--bench', help='bench_ranks, which the target bench builds')
    parser.add_argument('--serial', help='wavycon, measured beside it; its number of ranks is shown as 0')
    parser.add_argument('--launch', default='mpirun -n {ranks}', help='starts programs on ranks [%(default)s]')
    parser.add_argument('--ranks', type=numbers, default=[1, 2], help='[1,2]')
    parser.add_argument('--strong', type=numbers, default=[1024], help='points a side [1024]')
    parser.add_argument('--weak', type=numbers, default=[], help='N; none if not given')
    parser.add_argument('--pressures', default='0.005,0.05,0.3', help='[%(default)s]')
    parser.add_argument('--repeats', type=int, default=3, help='[%(default)s]')
    parser.add_argument('--seconds', default='1', help='spent on each part of an iteration [%(default)s]')
    parser.add_argument('--table', default='scaling.dat', help='[%(default)s]')
    parser.add_argument('--as-rank', nargs=argparse.REMAINDER, help=argparse.SUPPRESS)
    return parser.parse_args()


def run_as_rank(directory, *command):
    """Runs one rank and notes the memory and the processor time that it took."""
    with subprocess.Popen(command) as child:
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    unit = 1 if sys.platform == 'darwin' else 1024
    with open(os.path.join(directory, f'{os.uname().nodename}.{os.getpid()}.rank'), 'w', encoding='utf-8') as out:
        out.write(f'{usage.ru_maxrss*unit} {usage.ru_utime + usage.ru_stime}\n')
    return child.returncode


def run(words, directory):
    """The output of a command and its time."""
    before = time.perf_counter()
    environment = dict(os.environ, OMP_NUM_THREADS=os.environ.get('OMP_NUM_THREADS', '1'), OPENBLAS_NUM_THREADS='1')
    done = subprocess.run(words, env=environment, cwd=directory, stdout=subprocess.PIPE, check=False, text=True)
    if done.returncode:
        sys.exit(f"scaling: {shlex.join(words)} ended with status {done.returncode}\n{done.stdout}")
    return done.stdout, time.perf_counter() - before


def launcher(given, ranks):
    return shlex.split(given.launch.format(ranks=ranks)) if ranks else []


def write_deck(path, grid, pressures):
    with open(path, 'w', encoding='utf-8') as out:
        out.write(DECK.format(x=grid.x, y=grid.y, shortest=STEPS/grid.x, pressures=pressures))


def summary_of(path):
    """The first load's values by the names of the columns."""
    with open(path, encoding='utf-8') as lines:
        names, values = [line.split() for line in lines if not line.startswith('#')][:2]
    return dict(zip(names, values))


def run_program(given, ranks, grid, pressure):
    """The numbers of one run: area, iterations, total, solve, processor time, most memory of a rank, bytes a point."""
    with tempfile.TemporaryDirectory(dir=os.getcwd()) as directory:
        write_deck(os.path.join(directory, 'rough.nml'), grid, pressure)
        program = os.path.abspath(given.program if ranks else given.serial)
        wrapper = [sys.executable, os.path.abspath(__file__), '--as-rank', directory]
        log, total = run([*launcher(given, ranks), *wrapper, program, 'rough.nml', '--output', '.'], directory)
        solve = float(re.search(r'\[ *([0-9.]+) s\] solved and measured', log).group(1))
        summary = summary_of(os.path.join(directory, 'rough.summary.dat'))
        usage = []
        for entry in os.scandir(directory):
            if entry.name.endswith('.rank'):
                with open(entry.path, encoding='utf-8') as lines:
                    usage.append([float(word) for word in lines.read().split()])
    if len(usage) != max(ranks, 1):
        sys.exit(f'scaling: {len(usage)} processes where {ranks} ranks were started')
    memory, processor = zip(*usage)
    return (float(summary['contact_area_counted_fraction']), int(summary['iterations']), total, solve, sum(processor),
            max(memory)/1e6, sum(memory)/(grid.x*grid.y))


def run_bench(given, ranks, grid):
    """Loads as (area, iterations, time, pairs, those in double precision), and the times of parts by their names."""
    with tempfile.TemporaryDirectory(dir=os.getcwd()) as directory:
        write_deck(os.path.join(directory, 'rough.nml'), grid, given.pressures)
        words, _ = run([*launcher(given, ranks), os.path.abspath(given.bench), 'rough.nml', given.seconds], directory)
    lines = [line.split() for line in words.splitlines()]
    loads = [[float(word) for word in line[2:7]] for line in lines if line[:1] == ['load']]
    return loads, {line[1]: float(line[2]) for line in lines if line[:1] == ['part']}


def measure(given, cases):
    """After each repetition what was measured by then: runs, loads on the last grid and parts, lists by case."""
    runs, loads, parts = (collections.defaultdict(list) for _ in range(3))
    for repeat in range(given.repeats):
        for ranks, grid in cases:
            for pressure in given.pressures.split(','):
                runs[ranks, grid, pressure].append(run_program(given, ranks, grid, pressure))
            if given.bench and ranks:
                found, times = run_bench(given, ranks, grid)
                for pressure, load in zip(given.pressures.split(','), found):
                    loads[ranks, grid, pressure].append(load)
                for name, seconds in times.items():
                    parts[ranks, grid, name].append(seconds)
        print(f'scaling: {repeat + 1} of {given.repeats} repetitions', file=sys.stderr)
        yield repeat + 1, runs, loads, parts


def processor_name():
    try:
        with open('/proc/cpuinfo', encoding='utf-8') as lines:
            return next(line.split(':')[1].strip() for line in lines if line.startswith('model name'))
    except (OSError, StopIteration):
        return os.uname().machine


def median(values):
    return statistics.median(values)


def run_row(case, found):
    ranks, grid, pressure = case
    area, iterations, total, solve, processor, memory, bytes_a_point = zip(*found)
    if len(set(iterations)) > 1:
        print(f'scaling: the iterations of a run differ: {iterations}', file=sys.stderr)
    return [ranks, grid.x, grid.y, pressure, f'{area[0]:.5f}', iterations[0], f'{median(total):.3f}',
            f'{min(total):.3f}', f'{median(solve):.3f}', f'{min(solve):.3f}', f'{max(solve):.3f}',
            f'{median(processor):.3f}', f'{median(memory):.1f}', f'{median(bytes_a_point):.1f}']


def iteration_row(case, found):
    ranks, grid, pressure = case
    area, iterations, seconds, pairs, double_pairs = zip(*found)
    return [ranks, grid.x, grid.y, pressure, f'{area[0]:.5f}', f'{iterations[0]:.0f}', f'{1e3*median(seconds):.4f}',
            f'{1e3*min(seconds):.4f}', f'{pairs[0]:.3f}', f'{double_pairs[0]:.3f}']


def part_row(case, found):
    ranks, grid, name = case
    return [ranks, grid.x, grid.y, name, f'{1e3*median(found):.5f}', f'{1e3*min(found):.5f}']


def block(name, columns, rows):
    rows = [columns, *[[str(word) for word in row] for row in rows]]
    widths = [max(len(row[i]) for row in rows) + 2 for i in range(len(columns))]
    lines = [''.join(word.rjust(width) for word, width in zip(row, widths)) for row in rows]
    return ['', '', f'# {name}', '#' + lines[0][1:], *lines[1:]]


def speed_up_lines(rows, iterations):
    """Lines of the head: ranks against one, one against the serial program; weak scaling is that of an iteration."""
    solve = {(row[0], row[1], row[2], row[3]): float(row[8]) for row in rows}
    iteration = {(row[0], row[1], row[2], row[3]): float(row[6]) for row in iterations}
    lines = []
    for (ranks, x, y, pressure), seconds in solve.items():
        if ranks > 1 and (1, x, y, pressure) in solve:
            lines.append(f'# {x} x {y} points, pressure {pressure}: {ranks} ranks solve '
                         f'{solve[1, x, y, pressure]/seconds:.2f} times as fast as one')
        if ranks == 1 and (0, x, y, pressure) in solve:
            lines.append(f'# {x} x {y} points, pressure {pressure}: one rank takes '
                         f'{seconds/solve[0, x, y, pressure]:.3f} times the time of the serial program')
    for (ranks, x, y, pressure), time_of_one in iteration.items():
        if y == ranks*x and ranks > 1 and (1, x, x, pressure) in iteration:
            lines.append(f'# {x} x {x} points a rank, pressure {pressure}: efficiency of an iteration on {ranks} ranks '
                         f'{iteration[1, x, x, pressure]/time_of_one:.2f}')
    return lines


def main():
    if sys.argv[1:2] == ['--as-rank']:
        sys.exit(run_as_rank(*sys.argv[2:]))
    given = arguments()
    cases = [(ranks, Grid(points, points)) for points in given.strong
             for ranks in ([0] if given.serial else []) + given.ranks]
    cases += [(ranks, Grid(points, points*ranks)) for points in given.weak for ranks in given.ranks
              if ranks > 1 or points not in given.strong]
    before = os.getloadavg()[0]
    for repeats, runs, loads, parts in measure(given, cases):
        rows = [run_row(*item) for item in runs.items()]
        iterations = [iteration_row(*item) for item in loads.items()]
        lines = [f'# wavycon-mpi on rough surfaces, to a residual of 1e-8: {os.path.basename(__file__)}',
                 f'# machine: {processor_name()}, {os.cpu_count()} of them; load average before: {before:.2f}',
                 f'# launched by: {given.launch}; {os.environ.get("OMP_NUM_THREADS", "1")} threads a rank; medians of '
                 f'{repeats}',
                 *speed_up_lines(rows, iterations), *block('runs', RUN_COLUMNS, rows),
                 *block('iterations', ITERATION_COLUMNS, iterations),
                 *block('parts', PART_COLUMNS, [part_row(*item) for item in parts.items()])]
        with open(given.table + '.new', 'w', encoding='utf-8') as out:
            out.write('\n'.join(lines) + '\n')
        os.replace(given.table + '.new', given.table)
    print('\n'.join(lines))


if __name__ == '__main__':
    main()
