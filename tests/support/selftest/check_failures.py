#!/usr/bin/env python3
"""Runs a test program that must fail and compares its report with the marks in its .pf file.

usage: check_failures.py PROGRAM SOURCE.pf
       check_failures.py PROGRAM TEXT      the report must end with the line TEXT
"""

import pathlib
import re
import subprocess
import sys


def expected_failures(source):
    """{line number, or name of a test: texts that the report must hold}"""
    lines = source.read_text(encoding='utf-8').splitlines()
    expected = {}
    for number, line in enumerate(lines, 1):
        if mark := re.match(r'\s*! fails: (.*)', line):
            expected[str(number + 1)] = mark[1].split(' | ')
        elif mark := re.match(r'\s*! fails the test: (.*)', line):
            expected[re.match(r'\s*subroutine (\w+)', lines[number + 1])[1]] = mark[1].split(' | ')
    return expected


def reported_failures(report, source):
    """The same from the report: {line number, or name of a test: text}"""
    where = re.compile(rf'   (?:\S*{source.name}:(\d+)|{source.stem}_suite\.(\w+)): ', re.M)
    places = list(where.finditer(report))
    ends = [place.start() for place in places[1:]] + [len(report)]
    return {place[1] or place[2]: report[place.end():end] for place, end in zip(places, ends)}


def main(program, against):
    run = subprocess.run([program], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    problems = []
    if run.returncode != 1:
        problems.append(f'the exit status is {run.returncode}, not 1')
    last_line = run.stdout.rstrip('\n').rpartition('\n')[2]
    if against.endswith('.pf'):
        source = pathlib.Path(against)
        expected, reported = expected_failures(source), reported_failures(run.stdout, source)
        for place in sorted({*expected, *reported}):
            if place not in reported:
                problems.append(f'{against}:{place}: no failure reported')
            elif place not in expected:
                problems.append(f'{against}:{place}: a failure reported where none was due')
            else:
                problems += [f"{against}:{place}: the report lacks '{text}'"
                             for text in expected[place] if text not in reported[place]]
        tests = re.findall(rf'^{source.stem}_suite\.\w+: (ok|FAILED)$', run.stdout, re.M)
        summary = f'FAILED: {tests.count("FAILED")} of {len(tests)} tests failed, 0 suites without tests'
        if not expected:
            problems.append(f'{against} marks no failure')
    else:
        summary = against
    if last_line != summary:
        problems.append(f"the last line is '{last_line}', not '{summary}'")
    if problems:
        print(run.stdout, *problems, sep='\n')
        sys.exit(1)


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
