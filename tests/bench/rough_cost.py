#!/usr/bin/env python3
"""What wavycon costs on rough surfaces: against the contact fraction, and against the number of points.

usage: rough_cost.py BUILD TABLE LARGEST HEAD, by the Python that peer_install.py names

BUILD: where wavycon is built, its target bench too. LARGEST: points along a side of the largest grid; the contact
fraction varies on a grid of a quarter as many. HEAD: lines for the head of the table.

The surfaces are those of rough_cases.py. Their shortest wave has 16 points where the contact varies, and is 1/32 of the
cell where the grid does. Times are processor times to a residual of 1e-8, medians of three. The memory is the most of
the whole process. Exponents are of least squares between the logarithms, over the ranges told.
"""
import os
import sys
import tempfile

import numpy

sys.dont_write_bytecode = True
import rough_runs  # noqa: E402
import rough_surface  # noqa: E402

RESIDUAL = 1e-8
LIMIT = 600.0       # [s] of a solution
FRACTIONS = 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 0.99, 0.999
LIGHT = 0.11        # largest contact of the fit
SERIES = 0.01, 0.2, 0.8   # contact of the series of grids
CUTOFF = 16         # points on the shortest wave where the contact varies
WAVES = 32          # on the cell's side of the shortest wave of the series
LEAST = 256         # points along a side of the coarsest grid
COLUMNS = ['points', 'P', 'contact', 'time[s]', 'iterations', 'transform_pairs', 'residual', 'bytes_a_point']


def measured(case, command, full):
    """The numbers of COLUMNS for a load."""
    run = rough_runs.solve_to(case, command, RESIDUAL, RESIDUAL)
    if not rough_runs.reaches(run, RESIDUAL):
        sys.exit(f'rough_cost: P = {case.load/full} on {case.heights.shape} points is not solved: {run.status}')
    points = case.heights.shape[0]
    return [points, case.load/full, run.judgement.contact, run.seconds, run.iterations, run.pairs,
            run.judgement.residual, run.megabytes*1024**2/points**2]


def exponent(x, y):
    return numpy.polyfit(numpy.log(x), numpy.log(y), 1)[0]


def block(name, rows):
    """Lines of a block for gnuplot."""
    formats = '{:8.0f}', '{:14.6e}', '{:12.6f}', '{:10.3f}', '{:12.0f}', '{:16.1f}', '{:11.1e}', '{:15.1f}'
    titles = '#' + ''.join(f'{title:>{width}}' for title, width in
                           zip(COLUMNS, (8, 14, 12, 10, 12, 16, 11, 15)))[1:]
    return ['', '', f'# {name}', titles] + [''.join(form.format(value) for form, value in zip(formats, row))
                                           for row in rows]


def start(points, shortest, directory):
    """A case without load, and p*."""
    case = rough_runs.Case(rough_surface.rough_surface(points, shortest), 0.0, directory, LIMIT)
    case.heights.tofile(case.input)
    return case, rough_surface.full_contact_pressure(case.heights)


def find_load(case, command, fraction):
    case.load = rough_surface.pressure_for_contact(case.heights, fraction)
    case.load = rough_runs.load_for_contact(case, command, fraction)


def against_contact(command, points, directory):
    """Rows for each contact fraction."""
    case, full = start(points, points/CUTOFF, directory)
    rows = []
    for fraction in FRACTIONS:
        find_load(case, command, fraction)
        rows.append(measured(case, command, full))
        print(f'bench: contact {fraction:g} done', file=sys.stderr)
    return rows


def against_points(command, largest, directory):
    """Rows for each grid, by contact fraction. The load is that of the coarsest grid."""
    loads, series = {}, {fraction: [] for fraction in SERIES}
    points = LEAST
    while points <= largest:
        case, full = start(points, WAVES, directory)
        for fraction, rows in series.items():
            if fraction not in loads:
                find_load(case, command, fraction)
                loads[fraction] = case.load
            case.load = loads[fraction]
            rows.append(measured(case, command, full))
        print(f'bench: {points} points done', file=sys.stderr)
        points *= 2
    return series


def exponents(points, rows, series):
    """Lines on how the cost grows."""
    contact, time, pairs = (numpy.array([row[i] for row in rows if row[2] <= LIGHT]) for i in (2, 3, 5))
    lines = ['# Exponents of least squares:',
             f'# {points} x {points} points, contact {contact.min():.2g} to {contact.max():.2g}: '
             f'time ~ contact^{exponent(contact, time):.3f}, transform pairs ~ contact^{exponent(contact, pairs):.3f}']
    for fraction, found in series.items():
        sides, _, _, time, _, pairs, _, memory = numpy.array(found).T
        lines.append(f'# contact {fraction:g}, N = {sides[0]:.0f} to {sides[-1]:.0f} points a side: '
                     f'time ~ N^{exponent(sides, time):.2f}, transform pairs ~ N^{exponent(sides, pairs):.2f}, '
                     f'{memory[-1]:.0f} bytes a point on the last grid')
    return lines


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__.split('\n\n')[1])
    build, table, largest, head = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4]
    command = rough_runs.command_of(rough_runs.OWN, os.path.join(build, 'tests', 'bench'), {})
    with tempfile.TemporaryDirectory() as directory:
        rows = against_contact(command, largest//4, directory)
        series = against_points(command, largest, directory)
    lines = ['# wavycon on rough surfaces, to a residual of 1e-8, one thread.', *head.splitlines(),
             *exponents(largest//4, rows, series), *block('contact', rows)]
    for fraction, found in series.items():
        lines += block(f'points {fraction:g}', found)
    with open(table + '.new', 'w', encoding='utf-8') as out:
        out.write('\n'.join(lines) + '\n')
    os.replace(table + '.new', table)
    print('\n'.join(lines))


if __name__ == '__main__':
    main()
