#!/usr/bin/env python3
"""Times of wavycon and of other programs on rough surfaces, to equal residuals, on one thread each.

usage: rough_cases.py --build DIRECTORY [option ...], by the Python that peer_install.py names

Surfaces are self-affine with the Hurst exponent 0.8, on a square cell of N x N points; their longest wave is 1/8 of the
cell, their shortest has so many points. A load is given by the fraction of the points in contact, to 1 %, or by P, the
mean pressure over p*, which closes the gap. Each program gets the tolerance with which it is fastest to the residual
wanted, found by trial. The time is processor time from the heights to the pressures; it is the median of three
solutions if they do not take long; user, system and wall time are those of the whole process, with its start and its
files, at the first of them. All residuals are computed by the same routine from the pressures.

bytes_a_point is the most memory of the whole process. With --table the rows go to a file too, from which those of other
cases are kept: the cases can be measured in parts.
"""
import argparse
import math
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import numpy  # noqa: E402
import peer_install  # noqa: E402
import rough_runs  # noqa: E402
import rough_surface  # noqa: E402

CODES = [rough_runs.OWN, 'aspher', 'tamaas', 'contactmechanics', 'slippy']
COLUMNS = ['points', 'shortest_wave', 'load', 'code', 'status', 'P', 'contact', 'time[s]', 'iterations',
           'transform_pairs', 'residual', 'complementarity', 'load_error', 'mean_gap', 'tolerance', 'bytes_a_point',
           'user[s]', 'system[s]', 'wall[s]']
KEY = 4       # columns that name a row
WIDTHS = [7, 14, 9, 17, 12, 22, 11, 10, 11, 16, 10, 16, 11, 11, 10, 15, 9, 11, 9]


def numbers(kind):
    return lambda text: [kind(word) for word in text.split(',') if word]


def options():
    description, more = __doc__.split('\n\n', 2)[0], __doc__.split('\n\n', 2)[2]
    parser = argparse.ArgumentParser(description=description, epilog=more,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', required=True, help='where wavycon is built, its target bench too')
    parser.add_argument('--peers', help='where the other programs are or will be installed (BUILD/peers)')
    parser.add_argument('--points', type=numbers(int), default=[1024], help='along a side (1024)')
    parser.add_argument('--cutoff', type=numbers(int), default=[16], help='points on the shortest wave (16)')
    parser.add_argument('--contact', type=numbers(float), default=[], help='fractions of the points')
    parser.add_argument('--pressure', type=numbers(float), default=[], help='values of P')
    parser.add_argument('--codes', type=numbers(str), default=CODES, help=','.join(CODES))
    parser.add_argument('--residual', type=float, default=1e-8, help='wanted of all (1e-8)')
    parser.add_argument('--limit', type=float, default=120.0, help='processor time of a solution [s] (120)')
    parser.add_argument('--repeats', type=int, default=3, help='solutions behind a time (3)')
    parser.add_argument('--seed', type=int, default=rough_surface.SEED, help=f'of the phases ({rough_surface.SEED})')
    parser.add_argument('--table', help='file to which the rows are added')
    parser.add_argument('--head', default='', help='lines for the head of the table, of the machine')
    parser.add_argument('--missing', action='store_true', help='leave out what the table already has')
    return parser.parse_args()


def read_table(path):
    """Rows of words by their first KEY words."""
    rows = {}
    if path and os.path.exists(path):
        for line in pathlib.Path(path).read_text(encoding='utf-8').splitlines():
            words = line.split()
            if len(words) == len(COLUMNS) and not line.startswith('#'):
                rows[tuple(words[:KEY])] = words
    return rows


def write_table(path, head, rows):
    """A block for each surface and program, under its name, with the lighter loads first."""
    blocks = {}
    for key, words in rows.items():
        blocks.setdefault((int(key[0]), int(key[1]), CODES.index(key[3])), []).append(words)
    with open(path + '.new', 'w', encoding='utf-8') as out:
        out.write('\n'.join(head) + '\n')
        for (points, cutoff, code), found in sorted(blocks.items()):
            out.write(f'\n\n# {points} {cutoff} {CODES[code]}\n{titles()}\n')
            for words in sorted(found, key=lambda words: float(words[COLUMNS.index('P')])):
                out.write(row(words) + '\n')
        out.write('\n\n' + '\n'.join(ratios(rows)) + '\n')
    os.replace(path + '.new', path)


def ratios(rows):
    """Lines: times of the other programs over wavycon's, lighter loads first."""
    lines = ['# Time over that of wavycon; >: the residual was not reached in this time.',
             '#' + ''.join(f'{name:>{width}}' for name, width in zip(COLUMNS, WIDTHS[:3]))[1:] + '     contact'
             + ''.join(f'{code:>18}' for code in CODES[1:])]
    status, time, pressure, contact = (COLUMNS.index(name) for name in ('status', 'time[s]', 'P', 'contact'))
    own = {key[:3]: words for key, words in rows.items() if key[3] == CODES[0] and words[status] == 'reached'}

    def order(item):
        case, words = item
        return int(case[0]), -int(case[1]), float(words[pressure])

    for case, mine in sorted(own.items(), key=order):
        line = ''.join(f'{word:>{width}}' for word, width in zip(case, WIDTHS)) + f'{mine[contact]:>12}'
        for code in CODES[1:]:
            other = rows.get((*case, code))
            ratio = f'{float(other[time])/float(mine[time]):.3g}' if other else '-'
            line += f"{ratio if not other or other[status] == 'reached' else '>' + ratio:>18}"
        lines.append(line)
    return lines


def row(words):
    return ''.join(f'{word:>{width}}' for word, width in zip(words, WIDTHS))


def titles():
    return '#' + row(COLUMNS)[1:]


def words_of(key, full, load, run, residual):
    """The row of a solution."""
    found, nan = run.judgement, math.nan
    status = run.status
    if status in ('good', 'unconverged') and rough_runs.reaches(run, residual):
        status = 'reached'
    elif status == 'good':
        status = 'missed'
    values = [nan]*5 if found is None else [found.contact, found.residual, found.complementarity, found.load_error,
                                            found.mean_gap]
    return [*key, status, f'{load/full:.14e}', f'{values[0]:.6f}', f'{run.seconds:.3f}', f'{run.iterations:g}',
            f'{run.pairs:.1f}', f'{values[1]:.2e}', f'{values[2]:.2e}', f'{values[3]:.1e}', f'{values[4]:.3e}',
            f'{run.tolerance:.1e}', f'{run.megabytes*1024**2/int(key[0])**2:.1f}',
            *(f'{seconds:.3f}' for seconds in run.process)]


class Measurement:
    """Solves cases and adds their rows to `rows`; `told` is called with each."""

    def __init__(self, given, pythons, rows, told):
        self.given, self.rows, self.told = given, rows, told
        bench = os.path.join(given.build, 'tests', 'bench')
        self.commands = {code: rough_runs.command_of(code, bench, pythons) for code in given.codes
                         if code == rough_runs.OWN or code in pythons}
        self.own = rough_runs.command_of(rough_runs.OWN, bench, pythons)
        self.ratios = dict(rough_runs.START)   # of tolerance and residual, the last ones

    def surface(self, points, cutoff, directory):
        """All loads of a surface."""
        heights = rough_surface.rough_surface(points, points/cutoff)
        full = rough_surface.full_contact_pressure(heights)
        case = rough_runs.Case(heights, 0.0, directory, self.given.limit)
        heights.tofile(case.input)
        # From the file from now on: the programs get the memory.
        case.heights = heights = numpy.memmap(case.input, float, 'r', shape=heights.shape)
        loads = [(f'A={value:g}', value) for value in self.given.contact]
        loads += [(f'P={value:g}', value) for value in self.given.pressure]
        for name, value in loads:
            keys = [(str(points), str(cutoff), name, code) for code in self.commands]
            keys = [key for key in keys if not (self.given.missing and key in self.rows)]
            if keys:
                case.load = value*full if name.startswith('P') else self.contact_load(case, keys[0][:3], value, full)
                for key in keys:
                    self.solve(case, key, full)

    def contact_load(self, case, key, fraction, full):
        """The mean pressure for a contact fraction: that of the other rows of the case, if there are any.

        The search begins with that of the same surface on the finest other grid in the table."""
        same = [(int(other[0]), float(words[COLUMNS.index('P')])*full) for other, words in self.rows.items()
                if other[2] == key[2] and int(other[0])*int(key[1]) == int(key[0])*int(other[1])]
        for points, load in same:
            if points == int(key[0]):
                return load
        case.load = max(same)[1] if same else rough_surface.pressure_for_contact(case.heights, fraction)
        return rough_runs.load_for_contact(case, self.own, fraction)

    def solve(self, case, key, full):
        """One program."""
        code, aim = key[-1], self.given.residual
        run = rough_runs.solve_to(case, self.commands[code], aim, self.ratios[code]*aim, self.given.repeats)
        if rough_runs.reaches(run, aim) and code != rough_runs.OWN:
            self.ratios[code] = run.tolerance/aim
        self.rows[key] = words_of(key, full, case.load, run, aim)
        self.told(self.rows[key])


def main():
    given = options()
    rough_surface.SEED = given.seed
    directory = given.peers or os.path.join(given.build, 'peers')
    pythons, notes = {}, []
    for code in given.codes:
        if code not in CODES:
            sys.exit(f"rough_cases: no program '{code}': {', '.join(CODES)}")
        if code != rough_runs.OWN:
            python = peer_install.python_with(code, directory)
            if python:
                pythons[code] = python
            else:
                notes.append(f'# {code}: SKIPPED, it could not be installed')
    head = ['# Rough surfaces: times of solutions to a residual of '
            f'{given.residual:g}, one thread each; limit {given.limit:g} s.',
            f'# load: fraction of points in contact (A) or P, the mean pressure over p*. Seed of the phases: {given.seed}.',
            *given.head.splitlines(), *notes]
    rows = read_table(given.table)
    print('\n'.join(head) + '\n' + titles(), flush=True)

    def told(words):
        print(row(words), flush=True)
        if given.table:
            write_table(given.table, head, rows)

    measurement = Measurement(given, pythons, rows, told)
    with tempfile.TemporaryDirectory() as scratch:
        for points in given.points:
            for cutoff in given.cutoff:
                measurement.surface(points, cutoff, scratch)
    print('\n\n' + '\n'.join(ratios(rows)))


if __name__ == '__main__':
    main()
