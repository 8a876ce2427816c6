#!/usr/bin/env python3
"""What wavycon costs on rough surfaces: against the contact fraction, and against the number of points.

usage: rough_cost.py BUILD ENVIRONMENTS TABLE LARGEST HEAD

BUILD: where wavycon is built, its target bench too. ENVIRONMENTS: for a Python with numpy. LARGEST: points along a side
of the largest grid; the contact fraction varies on a grid of a quarter as many. HEAD: lines for the head of the table.

The surfaces are those of rough_cases.py. Their shortest wave has 16 points where the contact varies, and is 1/32 of the
cell where the grid does. Times are processor times to a residual of 1e-8, medians of three. The memory is the most of
the whole process. Exponents are of least squares between the logarithms, over the ranges told.
"""
import os
import sys
import tempfile

sys.dont_write_bytecode = True
import peer_install  # noqa: E402

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
    import rough_runs
    run = rough_runs.solve_to(case, command, RESIDUAL, RESIDUAL)
    if not rough_runs.reaches(run, RESIDUAL):
        sys.exit(f'rough_cost: P = {case.load/full} on {case.heights.shape} points is not solved: {run.status}')
    points = case.heights.shape[0]
    return [points, case.load/full, run.judgement.contact, run.seconds, run.iterations, run.pairs,
            run.judgement.residual, run.megabytes*1024**2/points**2]


def exponent(x, y):
    import numpy
    return numpy.polyfit(numpy.log(x), numpy.log(y), 1)[0]


def block(name, rows):
    """Lines of a block for gnuplot."""
    formats = '{:8.0f}', '{:14.6e}', '{:12.6f}', '{:10.3f}', '{:12.0f}', '{:16.1f}', '{:11.1e}', '{:15.1f}'
    titles = '#' + ''.join(f'{title:>{width}}' for title, width in
                           zip(COLUMNS, (8, 14, 12, 10, 12, 16, 11, 15)))[1:]
    return ['', '', f'# {name}', titles] + [''.join(form.format(value) for form, value in zip(formats, row))
                                           for row in rows]


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__.split('\n\n')[1])
    build, environments, table, largest = sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4])
    try:
        import numpy
    except ImportError:
        python = peer_install.python_with_numpy(environments)
        if not python:
            sys.exit('rough_cost: numpy could not be installed')
        os.execv(python, [python, *sys.argv])
    import rough_runs
    import rough_surface
    command = rough_runs.command_of(rough_runs.OWN, os.path.join(build, 'tests', 'bench'), {})

    def prepared(points, shortest, directory):
        heights = rough_surface.rough_surface(points, shortest)
        case = rough_runs.Case(heights, 0.0, directory, LIMIT)
        heights.tofile(case.input)
        return case, rough_surface.full_contact_pressure(heights)

    series = {}
    with tempfile.TemporaryDirectory() as directory:
        points = largest//4
        case, full = prepared(points, points/CUTOFF, directory)
        against_contact = []
        for fraction in FRACTIONS:
            case.load = rough_surface.pressure_for_contact(case.heights, fraction)
            case.load = rough_runs.load_for_contact(case, command, fraction)
            against_contact.append(measured(case, command, full))
            print(f'bench: contact {fraction:g} done', file=sys.stderr)
        loads = {}
        points = LEAST
        while points <= largest:
            case, full = prepared(points, WAVES, directory)
            for fraction in SERIES:
                if fraction not in loads:
                    case.load = rough_surface.pressure_for_contact(case.heights, fraction)
                    loads[fraction] = rough_runs.load_for_contact(case, command, fraction)
                case.load = loads[fraction]
                series.setdefault(fraction, []).append(measured(case, command, full))
            print(f'bench: {points} points done', file=sys.stderr)
            points *= 2

    contact, time, pairs = (numpy.array([row[i] for row in against_contact]) for i in (2, 3, 5))
    light = contact <= LIGHT
    low, high = contact[light].min(), contact[light].max()
    head = ['# wavycon on rough surfaces, to a residual of 1e-8, one thread.', *sys.argv[5].splitlines(),
            '# Exponents of least squares:',
            f'# {largest//4} x {largest//4} points, contact {low:.2g} to {high:.2g}: time ~ contact^'
            f'{exponent(contact[light], time[light]):.3f}, transform pairs ~ contact^'
            f'{exponent(contact[light], pairs[light]):.3f}']
    for fraction, rows in series.items():
        values = numpy.array(rows)
        head.append(f'# contact {fraction:g}, {LEAST} to {largest} points a side: time ~ N^'
                    f'{exponent(values[:, 0], values[:, 3]):.2f}, transform pairs ~ N^'
                    f'{exponent(values[:, 0], values[:, 5]):.2f}, N points a side')
    head.append('# most memory of the process on the largest grid: '
                f'{max(rows[-1][-1] for rows in series.values()):.0f} bytes a point')
    lines = head + block('contact', against_contact)
    for fraction, rows in series.items():
        lines += block(f'points {fraction:g}', rows)
    with open(table + '.new', 'w', encoding='utf-8') as out:
        out.write('\n'.join(lines) + '\n')
    os.replace(table + '.new', table)
    print('\n'.join(lines))


if __name__ == '__main__':
    main()
