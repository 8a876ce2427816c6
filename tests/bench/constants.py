#!/usr/bin/env python3
"""What a factor of 2 in each tuned constant does to time and error; scripts/constants --help has the rest.

usage: constants.py ROOT [--quick] [--factor FACTOR] [--room ROOM] [--only NAME ...]

The error of a variant is the geometric mean, over all values of all loads, of its true error over that of the unchanged
program. A true error below the reference's own error, or below ROUNDING of the value, counts as that.
"""
import argparse
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent/'regression'))
from tables import Table  # noqa: E402

ROOMS = 'fitted', 'map', 'measure', 'contact', 'stress'
ROUNDING = 1e-13
TIMEOUT = 20  # for a deck; the unchanged program takes less than two seconds [s]
TIMEOUT_OF_REFERENCE = 600  # [s]
SOLVED = 'converged', 'closed_form', 'full_contact'
STATEMENT = re.compile(r'^( *(?:integer|real\(dp\)), parameter, public :: (\w+)(?:\([^)]*\))? = )([^!\n]*?)'
                       r'( *(?:!.*)?)$', re.MULTILINE)
USE = re.compile(r'^ *use wavycon_(?:fitted|map|measure|contact|stress)_tuning, only: ((?:[^\n]*&\n)*[^\n]*)\n',
                 re.MULTILINE)
IMPLICIT = '   implicit none (type, external)\n'
NUMBER = re.compile(r'(?<![\w.])(\d+\.?\d*(?:[ed][+-]?\d+)?)(_dp)?')

WAVE = "&surface kind = 'wave_2d' /"
HEXAGONAL = "&surface kind = 'hexagonal' /"
CROSSED = ("&surface kind = 'crossed_1d', amplitude1 = 0.5, wavelength1 = 1.0, amplitude2 = 0.5, wavelength2 = 2.0 /")
RHOMBIC = "&surface kind = 'wave_2d', wavelength = 1.0, wavelength_y = 1.5 /"
LINE = "&surface kind = 'wave_1d' /"
ROUGH = "&surface kind = 'file', file = 'rough_surface.dat', length_x = 1.0, height_scale = 0.01 /"
MEASURED = ("&surface kind = 'file', file = 'measured_surface.dat', length_x = 128.0, length_y = 96.0,"
            " detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror' /")
DETAILS = '&output details = .true. /'
SUMMARY = '&output /'
MAP = '&output map = .true., map_points = 64 /'  # enough points for a table
TIGHT = "solver = 'fitted', accuracy = 1e-12"
LARGEST = "&stress nu = 0.0, 0.3, lateral = 'hydrostatic' /"
SECTION = "&stress nu = 0.3, section = 'x', depths_over_cell_x = 0.0, 0.005, 0.02, 0.1, 0.25, 0.33 /"
SAME = 'the method itself'

# Of each room the decks: surface, loads, method, output, and the reference: a table of outputs/reference or the method
# of a tighter solution. Constants that only files on stresses use have decks of their own. Loads of `wave_2d` in rising
# order from 0.236 on are a sweep; each starts from the one before.
CASES = {
    'fitted': [
        (WAVE, '0.01, 0.1, 0.2, 0.5, 0.9', "solver = 'fitted', accuracy = 1e-9", DETAILS, 'wave_2d'),
        (WAVE, '0.05, 0.226, 0.25, 0.7', "solver = 'fitted', accuracy = 1e-5", DETAILS, 'wave_2d'),
        (WAVE, '0.236, 0.28, 0.35', "solver = 'fitted', accuracy = 1e-6", DETAILS, 'wave_2d'),
        (HEXAGONAL, '0.05, 0.3, 0.6, 0.75, 0.9', "solver = 'fitted', accuracy = 1e-7", DETAILS, 'hexagonal'),
        (CROSSED, '0.01, 0.05, 0.5, 0.9', "solver = 'fitted', accuracy = 1e-6", DETAILS, TIGHT),
        (RHOMBIC, '0.02, 0.15, 0.4, 0.9', "solver = 'fitted', accuracy = 1e-6", DETAILS, TIGHT),
        (WAVE, '0.2', "solver = 'fitted', accuracy = 1e-7", MAP, TIGHT),
        (WAVE, '0.5', "solver = 'fitted', accuracy = 1e-7", MAP, TIGHT),
    ],
    'map': [
        (MEASURED, '0.02, 0.2', "solver = 'grid', residual = 1e-10", SUMMARY, SAME),
    ],
    'measure': [
        (WAVE, '0.05, 0.2, 0.25, 0.5, 0.9', "solver = 'grid', accuracy = 1e-4", SUMMARY, 'wave_2d'),
        (WAVE, '0.01, 0.1, 0.2, 0.5, 0.9', "solver = 'grid', grid_points = 128", SUMMARY, 'wave_2d'),
        (HEXAGONAL, '0.05, 0.3, 0.6, 0.75, 0.9', "solver = 'grid', grid_points = 128", SUMMARY, 'hexagonal'),
        (CROSSED, '0.02, 0.1, 0.9', "solver = 'grid', grid_points = 128", SUMMARY, TIGHT),
    ],
    'contact': [
        (WAVE, '0.01, 0.05, 0.2, 0.25, 0.5, 0.9', "solver = 'grid', accuracy = 1e-3", SUMMARY, 'wave_2d'),
        (HEXAGONAL, '0.05, 0.3, 0.6, 0.75, 0.9', "solver = 'grid', accuracy = 1e-3", SUMMARY, 'hexagonal'),
        (LINE, '0.001, 0.01, 0.2, 0.5, 0.9', "solver = 'grid', accuracy = 1e-4", SUMMARY, "solver = 'auto'"),
        (CROSSED, '0.02, 0.1, 0.9', "solver = 'grid', accuracy = 1e-3", SUMMARY, TIGHT),
        (ROUGH, '0.02, 0.2, 0.6', "solver = 'grid', accuracy = 1e-2", SUMMARY, "solver = 'grid', accuracy = 1e-3"),
        (ROUGH, '0.02, 0.2, 0.6', "solver = 'grid'", SUMMARY, "solver = 'grid', residual = 1e-12"),
        (WAVE, '0.05, 0.5', "solver = 'grid', grid_points = 128", SUMMARY, 'wave_2d'),
    ],
    'stress': [
        (WAVE, '0.02, 0.15, 0.4, 0.9', "solver = 'grid', accuracy = 1e-3", LARGEST, TIGHT),
        (WAVE, '0.02, 0.15, 0.4, 0.9', "solver = 'fitted', accuracy = 1e-6", LARGEST, TIGHT),
        (HEXAGONAL, '0.05, 0.3, 0.6, 0.9', "solver = 'fitted', accuracy = 1e-6", LARGEST, TIGHT),
        (LINE, '0.02, 0.15, 0.4, 0.9', "solver = 'auto'", LARGEST, SAME),
        (LINE, '0.02, 0.15, 0.4, 0.9', "solver = 'grid', accuracy = 1e-4", LARGEST, "solver = 'auto'"),
        (ROUGH, '0.02, 0.1, 0.2, 0.4, 0.6, 0.8', "solver = 'grid'", LARGEST, SAME),
        (ROUGH, '0.02, 0.2, 0.6', "solver = 'grid', grid_points = 512", LARGEST, SAME),
    ],
    'fitted, stresses': [
        (WAVE, '0.02, 0.226, 0.4, 0.9', "solver = 'fitted', accuracy = 1e-6", LARGEST, TIGHT),
        (HEXAGONAL, '0.05, 0.3, 0.6, 0.9', "solver = 'fitted', accuracy = 1e-6", LARGEST, TIGHT),
        (WAVE, '0.02, 0.226, 0.4, 0.9', "solver = 'fitted', accuracy = 1e-9", SECTION, SAME),
        (RHOMBIC, '0.02, 0.4', "solver = 'fitted', accuracy = 1e-9", SECTION, SAME),
    ],
}
# The program that makes the references: finer rules of the stresses, and a finer search for the largest.
REFERENCE_CONSTANTS = {
    'search_accuracy': '1e-13_dp', 'gain_part': '1e-9_dp', 'refined_places': '6', 'close_to_largest': '0.5_dp',
    'plane_ratio': '1.25_dp', 'waves_in_depth': '28.0_dp', 'plane_points': '48', 'most_models': '10',
    'near_clearance': '1.6_dp', 'rule_angles_factor': '2.0_dp', 'rule_radii_factor': '2.3_dp', 'ray_points': '18.0_dp',
    'ray_angles_per_unit': '7.0_dp', 'ray_points_per_unit': '2.2_dp', 'ray_angles_of_strain': '1.6_dp',
}
# Columns of a map that are solved for, and of a section.
MAP_FIELDS = 'pressure', 'gap', 'displacement'
SECTION_FIELDS = 'stress_xx', 'stress_yy', 'stress_zz', 'stress_xz'


def constants(text):
    """Names and values of a tuning module, in order."""
    return [(name, value) for _, name, value, _ in STATEMENT.findall(text)]


def scaled(value, factor):
    """The same literal, or array of them, with each number times a factor."""
    def replace(match):
        number, kind = match.groups()
        if kind:
            return f'{float(number.replace("d", "e"))*factor!r}_dp'
        return str(round(int(number)*factor))
    return NUMBER.sub(replace, value)


def declaration(name, value):
    """A constant's declaration, with the kind spelt out."""
    if value.startswith('['):
        name += '(*)'
    if '_dp' in value:
        value = re.sub(r'([\d.]+)(?:e([+-]?\d+))?_dp', lambda m: f'{m[1]}d{m[2] or 0}', value)
        return f'double precision, parameter :: {name} = {value}'
    return f'integer, parameter :: {name} = {value}'


class Tree:
    """A copy of the sources, and its build.

    In the copy each module declares the constants that it uses itself, so that a new value has only those compiled
    again.
    """

    def __init__(self, root, directory):
        self.root, self.sources, self.build = root, directory/'sources', directory/'build'
        self.directory = directory
        self.sources.mkdir()
        for name in ('CMakeLists.txt', 'CMakePresets.json', 'LICENSE'):
            if (root/name).exists():
                shutil.copy(root/name, self.sources)
        shutil.copytree(root/'src', self.sources/'src')
        self.values = {}
        for room in ROOMS:
            self.values.update(constants((root/'src'/room/'tuning.f90').read_text(encoding='utf-8')))
        self.users = {name: [] for name in self.values}
        for path in sorted(self.sources.glob('src/*/*.f90')):
            self._declare_constants(path)
        ninja = ['-G', 'Ninja'] if shutil.which('ninja') else []
        self._run(['cmake', '-S', self.sources, '-B', self.build, *ninja, '-D', 'CMAKE_BUILD_TYPE=Release',
                   '-D', 'WAVYCON_TESTS=OFF'], stop=True)

    def _run(self, command, stop=False):
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              check=False, text=True)
        if done.returncode and stop:
            sys.exit(f'{done.stdout}\nconstants: failed: {" ".join(map(str, command))}')
        return done.returncode == 0

    def _declare_constants(self, path):
        text = path.read_text(encoding='utf-8')
        used = USE.search(text)
        if not used:
            return
        names = re.findall(r'\w+', used[1])
        for name in names:
            self.users[name].append(path)
        lines = ''.join(f'   {declaration(name, self.values[name])}\n' for name in names)
        text = text.replace(used[0], '').replace(IMPLICIT, IMPLICIT + lines, 1)
        path.write_text(text, encoding='utf-8')

    def set_constant(self, name, value):
        """Gives a constant another value, in all modules that use it."""
        for path in self.users[name]:
            text = path.read_text(encoding='utf-8')
            text = re.sub(rf'^ *[a-z ]+, parameter :: {name}(?:\(\*\))? = .*$', f'   {declaration(name, value)}', text,
                          flags=re.MULTILINE)
            path.write_text(text, encoding='utf-8')

    def program(self, name, stop=False):
        """Builds the program; None if it does not compile."""
        if not self._run(['cmake', '--build', self.build, '--target', 'wavycon'], stop):
            return None
        return shutil.copy(self.build/'wavycon', self.directory/name)


def values_with_errors(path):
    """By load the values of a table that have errors, with these, each by name."""
    table = Table(path)
    names = [name for name in table.columns if f'{name}_error' in table.columns]
    values = {}
    for record in table.records():
        of_load = values.setdefault(float(record['pbar_over_pstar']), {})
        for name in names:
            of_load[f'{name} {record.get("body", "")}'] = float(record[name]), float(record[f'{name}_error'])
    return values


class Deck:
    """One deck, its references, and what the unchanged program makes of it."""

    def __init__(self, directory, name, case):
        self.surface, self.loads, self.method, self.output, self.reference = case
        self.directory, self.name = directory, name
        self.path = self._write(name, self.method)

    def _write(self, name, method):
        path = self.directory/f'{name}.nml'
        path.write_text(f'{self.surface}\n&load pbar_over_pstar = {self.loads} /\n&method {method} /\n{self.output}\n',
                        encoding='utf-8')
        return path

    def find_references(self, program, root):
        """The reference values and their errors: by load, then by name. Stresses of a section have one error, as they
        may be zero."""
        if self.reference in ('wave_2d', 'hexagonal'):
            known = values_with_errors(root/'outputs'/'reference'/f'{self.reference}.dat')
            self.truth = {load: known[load] for load in map(float, self.loads.split(','))}
            return
        path = self._write(f'{self.name}_tight', self.method if self.reference == SAME else self.reference)
        _, results = self.run(program, path, TIMEOUT_OF_REFERENCE)
        self.truth = {}
        for load, row in results['rows'].items():
            of_section = [abs(value) for name, (value, _) in row.items() if name.startswith('section')]
            error = ROUNDING*max(of_section, default=0.0)
            self.truth[load] = {name: (value, error if name.startswith('section') else 0.0)
                                for name, (value, _) in row.items()}

    def run(self, program, path=None, timeout=TIMEOUT):
        """User time [s] and results, None where there are none."""
        path = path or self.path
        out = self.directory/'results'
        shutil.rmtree(out, ignore_errors=True)
        before = os.times().children_user
        try:
            subprocess.run([program, path, '--quiet', '--output', out], stdin=subprocess.DEVNULL,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=timeout, check=False)
        except subprocess.TimeoutExpired:
            return math.nan, None
        time = os.times().children_user - before
        summary = out/f'{path.stem}.summary.dat'
        if not summary.exists():
            return math.nan, None
        results = {'solved': {float(record['pbar_over_pstar']): record['status'] in SOLVED
                              for record in Table(summary).records()},
                   'rows': values_with_errors(summary)}
        for name in ('details', 'stress_largest'):
            table = out/f'{path.stem}.{name}.dat'
            if table.exists():
                results['rows'] = values_with_errors(table)
        section = out/f'{path.stem}.stress_section.dat'
        if section.exists():
            self._add_section(results, section)
        for path_of_map in sorted(out.glob('*.map.dat')):
            self._add_map(results, path_of_map)
        results['text'] = repr(results)
        return time, results

    @staticmethod
    def _add_section(results, path):
        """Some components of the stress at each place."""
        loads = list(results['rows'])
        for i, record in enumerate(Table(path).records()):
            row = results['rows'][loads[int(record['load']) - 1]]
            for name in SECTION_FIELDS:
                row[f'section {i} {name}'] = float(record[name]), float(record['stress_error'])

    @staticmethod
    def _add_map(results, path):
        """The largest pressure and gap errors of a map have no estimates: each number is a value of the first load."""
        first = next(iter(results['rows'].values()), {})
        for i, record in enumerate(Table(path).records()):
            for name in MAP_FIELDS:
                first[f'map {i} {name}'] = float(record[name]), math.inf

    def compare(self, results, base):
        """Logarithms of the errors over the base's, the largest error over its estimate, and the loads lost."""
        if results is None:
            return [], 0.0, len(self.truth)
        logs, worst, lost = [], 0.0, 0
        for load, truth in self.truth.items():
            if not results['solved'].get(load):
                lost += base['solved'].get(load, False)
                continue
            for name, (true_value, true_error) in truth.items():
                if not all(name in own['rows'].get(load, {}) for own in (results, base)):
                    continue
                value, estimate = results['rows'][load][name]
                if not math.isfinite(value):
                    continue
                floor = max(true_error, ROUNDING*abs(true_value), 1e-3*ROUNDING)
                error = abs(value - true_value)
                if error > floor and estimate > 0:
                    worst = max(worst, error/estimate)
                of_base = abs(base['rows'][load][name][0] - true_value)
                if max(error, of_base) > floor:
                    logs.append(math.log(max(error, floor)/max(of_base, floor)))
        return logs, worst, lost


def measure(decks, programs, repeats):
    """Of each program the median of its time, and its results by deck. The programs take turns."""
    times, results = {name: [[] for _ in decks] for name in programs}, {name: [] for name in programs}
    for repeat in range(repeats):
        for i, deck in enumerate(decks):
            for name, program in programs.items():
                time, result = deck.run(program)
                times[name][i].append(time)
                if repeat == 0:
                    results[name].append(result)
    return {name: sum(map(statistics.median, own)) for name, own in times.items()}, results


def cells(name, times, results, decks):
    """A variant's time, error, estimate and lost loads as text."""
    base = results['base']
    ratio = times[name]/times['base']
    time = f'{ratio:.2f}' if math.isfinite(ratio) else 'ended'
    if all(own and own['text'] == other['text'] for own, other in zip(results[name], base)):
        return time, '=', '=', '0'
    logs, worst, lost = [], 0.0, 0
    for deck, own, other in zip(decks, results[name], base):
        more, largest, missing = deck.compare(own, other)
        logs, worst, lost = logs + more, max(worst, largest), lost + missing
    error = f'{math.exp(statistics.fmean(logs)):.3g}' if logs else '-'
    return time, error, f'{worst:.2g}', str(lost)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        sys.exit(f'constants: {message}; scripts/constants --help has the options')


def main():
    parser = Parser(prog='scripts/constants', add_help=False)
    parser.add_argument('root', type=pathlib.Path)
    parser.add_argument('--quick', action='store_true')
    parser.add_argument('--factor', type=float, default=2.0)
    parser.add_argument('--room', choices=ROOMS, action='append')
    parser.add_argument('--only', action='append')
    options = parser.parse_args()
    repeats = 1 if options.quick else 3
    texts = {room: (options.root/'src'/room/'tuning.f90').read_text(encoding='utf-8') for room in ROOMS}
    known = [name for text in texts.values() for name, _ in constants(text)]
    unknown = [name for name in options.only or [] if name not in known]
    if unknown:
        parser.error(f'no constant {unknown[0]} in src/*/tuning.f90')
    with tempfile.TemporaryDirectory() as scratch:
        directory = pathlib.Path(scratch)
        for name in ('rough_surface.dat', 'measured_surface.dat'):
            shutil.copy(options.root/'inputs'/name, directory)
        tree = Tree(options.root, directory)
        base = tree.program('base', stop=True)
        for name, value in REFERENCE_CONSTANTS.items():
            tree.set_constant(name, value)
        reference = tree.program('reference', stop=True)
        for name in REFERENCE_CONSTANTS:
            tree.set_constant(name, tree.values[name])
        for room in options.room or ROOMS:
            chosen = [(name, value) for name, value in constants(texts[room])
                      if not options.only or name in options.only]
            of_stresses = [(name, value) for name, value in chosen
                           if all(re.search('stress|spot_integral', path.name) for path in tree.users[name])]
            for cases in (room, f'{room}, stresses'):
                if cases not in CASES:
                    continue
                own = chosen if room == 'stress' else of_stresses if cases != room else \
                    [constant for constant in chosen if constant not in of_stresses]
                if own:
                    measure_cases(tree, (base, reference), cases, own, (repeats, options.factor))


def measure_cases(tree, programs, cases, chosen, how):
    """Prints a table: each constant times and over the factor, on one set of decks."""
    base, reference = programs
    repeats, by = how
    decks = [Deck(tree.directory, f'{re.sub(", ", "_", cases)}_{i}', case) for i, case in enumerate(CASES[cases])]
    for deck in decks:
        deck.find_references(reference, tree.root)
    times, results = measure(decks, {'base': base}, repeats)
    worst = max(deck.compare(own, own)[1] for deck, own in zip(decks, results['base']))
    room = cases.split(',')[0]
    print(f'\nsrc/{room}/tuning.f90. The unchanged program takes {times["base"]:.2f} s; its largest true error over '
          f'its error estimate is {worst:.2g}.\n')
    smaller, larger = ('half', 'twice') if by == 2 else (f'1/{by:g}', f'{by:g} times')
    print(f'| constant | value | time, {smaller} / {larger} | error | estimate | lost |')
    print('|---|---|---|---|---|---|', flush=True)
    for name, value in chosen:
        programs = {'base': base}
        columns = {}
        for variant, factor in (('half', 1/by), ('twice', by)):
            new = scaled(value, factor)
            if new == value:
                columns[variant] = '-', '-', '-', '-'
                continue
            tree.set_constant(name, new)
            program = tree.program(variant)
            if program:
                programs[variant] = program
            else:
                columns[variant] = 'does not compile', '-', '-', '-'
        tree.set_constant(name, value)
        if len(programs) > 1:
            times, results = measure(decks, programs, repeats)
            for variant in programs:
                columns[variant] = cells(variant, times, results, decks)
        pairs = (' / '.join(both) for both in zip(columns['half'], columns['twice']))
        print(f'| `{name}` | {value.replace("_dp", "")} | ' + ' | '.join(pairs) + ' |', flush=True)


if __name__ == '__main__':
    main()
