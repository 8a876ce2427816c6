#!/usr/bin/env python3
"""Translates a pFUnit test file (.pf) to Fortran for the stand-in, or, with --check, only checks it.

usage: pf2f90.py IN.pf OUT.F90
       pf2f90.py --check IN.pf ...

It accepts a subset of what pFUnit accepts and refuses the rest, every problem with its file and line.
"""

import difflib
import pathlib
import re
import sys

LINE_LIMIT = 120   # a generated call must stay within Fortran's 132 columns
OPERANDS = {       # operands before the keywords, keywords besides message=
    'assertEqual': (2, {'tolerance'}),
    'assertRelativelyEqual': (2, {'tolerance'}),
    'assertLessThan': (2, set()),
    'assertLessThanOrEqual': (2, set()),
    'assertGreaterThan': (2, set()),
    'assertGreaterThanOrEqual': (2, set()),
    'assertTrue': (1, set()),
    'assertFalse': (1, set()),
    'assertIsFinite': (1, set()),
    'assertIsNaN': (1, set()),
    'assertFail': (1, set()),
}
NEEDS_TOLERANCE = 'assertRelativelyEqual'
PROCEDURES = ('test', 'before', 'after')
# What pFUnit 4.14 makes visible by `use funit` besides assert*. A test module that declares such a name does not
# compile there. Nor does one whose procedure has a local variable of such a name and passes it on before it sets it:
# gfortran 12 then takes it for pFUnit's generic or type. And what pFUnit declares in its suite functions, which use the
# whole test module: suite and t, of which a local variable may be called t.
FORBIDDEN = set("""
    abstractmatcher abstracttestparameter all_of allof any_of anyexceptions anyof array_with_size
    basetestrunner catch catchnext contains_string debuglistener disable empty_array ends_with equal_to
    every every_item expectation false fhamcrest finalize funit generic_run get_context ignore_all
    ignore_differences initialize is isarraywithsize isequal isnear isnot iso_fortran_env isrelativelynear
    istrueorfalse keep_all listenerpointer loadtests_interface matchable matcherdescription namefilter
    near not output_unit parallelcontext parameterizedtestcase predicate relatively_near remoterunner
    resultprinter robustrunner run serialcontext sourcelocation starts_with stringcontains
    stringdescription stringendswith stringstartswith stub subject taplistener test testannotation
    suite t testcase testlistener testlistenervector testmethod testresult testrunner testsuite throw
    timeoutannotation trim_all true wascalled wascalledonce wasnotcalled whitespaceoptions xmlprinter
""".split())

PLAIN_SUBROUTINE = re.compile(r'\s*subroutine\s+(\w+)\s*(\(\s*\))?\s*$')
PROCEDURE = re.compile(r'(?!\s*end\b)(?:[\w()=*,: ]+\s|\s*)(?:subroutine|function)\s+(\w+)', re.I)
BLOCK = re.compile(r'\s*(?:type\s*(?:,[^:!]*)?(?:::\s*|\s)\s*(\w+)\s*$|(?:abstract\s+)?interface\b\s*(\w*))', re.I)
END_OF_BLOCK = re.compile(r'\s*end\s*(?:type|interface)\b', re.I)
DIRECTIVE = re.compile(r'\s*@\s*(\w*)\s*(.*?)\s*$')


class BadTestFile(Exception):
    """Every problem of a file: a list of (line number, text)."""


def code_of(line):
    """The line with strings blanked and the comment removed, column for column."""
    code, quote = [], None
    for char in line:
        if quote:
            quote = None if char == quote else quote
            code.append(' ')
        elif char in '\'"':
            quote = char
            code.append(' ')
        elif char == '!':
            break
        else:
            code.append(char)
    return ''.join(code).rstrip()


def split_arguments(text):
    """'(a, b(1, 2))' -> ['a', 'b(1, 2)']; None unless the first parenthesis closes at the very end."""
    blanked = code_of(text)
    if not blanked.startswith('(') or len(blanked) != len(text.rstrip()):
        return None
    arguments, start, depth = [], 1, 0
    for place, char in enumerate(blanked):
        if char in '([':
            depth += 1
        elif char in ')]':
            depth -= 1
            if depth == 0 and place != len(blanked) - 1:
                return None
        if (char == ',' and depth == 1) or (char == ')' and depth == 0):
            arguments.append(text[start:place].strip())
            start = place + 1
    if depth != 0:
        return None
    return [] if arguments == [''] else arguments


def declared_names(code):
    """The names that a declaration declares; none if the statement has no '::' outside of parentheses."""
    outside, depth = '', 0
    for char in code:
        depth += (char in '([') - (char in ')]')
        if depth == 0 and char not in ')]':
            outside += char
    if re.match(r'\s*use\b', code, re.I):
        return []
    names = outside.partition('::')[2].split(',')
    return [name.partition('=')[0].strip().lower() for name in names if name.strip()]


def statements(codes):
    """(number of the first line, text) of every statement, with continued lines joined."""
    first, text = 0, ''
    for number, code in enumerate(codes, 1):
        first = first or number
        text += code.strip().lstrip('&') if text else code
        if text.endswith('&'):
            text = text[:-1]
        elif code or not text:
            yield first, text
            first, text = 0, ''


class TestFile:
    """One .pf file, checked line by line and translated."""

    def __init__(self, path, shown_path):
        self.path = pathlib.Path(path)
        self.shown_path = shown_path
        self.stem = self.path.stem
        self.problems = []
        self.tests = []
        self.fixtures = {}
        self.output = []

    def refuse(self, number, text):
        self.problems.append((number, text))

    def translate(self):
        """The generated source; raises BadTestFile."""
        lines = self.path.read_text(encoding='utf-8').splitlines()
        self.check_module(lines)
        pending, continued, after_contains = None, False, False
        self.output = [f'#line 1 "{self.path.resolve()}"']
        for number, line in enumerate([*lines, ''], 1):
            if number <= len(lines):
                self.check_line(number, line)
            if pending:
                self.procedure_below(min(number, len(lines)), line, pending)
                pending = None
            if line.lstrip().startswith('@'):
                if continued:
                    self.refuse(number, 'a directive cannot stand inside a continued statement')
                pending = self.directive(number, line, after_contains)
                continue
            code = code_of(line)
            continued = code.endswith('&') or (continued and not code)
            after_contains = after_contains or code.strip().lower() == 'contains'
            self.output.append(line)
        if not self.tests:
            self.refuse(len(lines), 'the file has no @test: zero tests is a failure')
        if self.problems:
            raise BadTestFile(sorted(self.problems))
        return '\n'.join(self.output + self.suite_function()) + '\n'

    def check_module(self, lines):
        """The module statement and what the module declares for all to see."""
        codes = [code_of(line) for line in lines]
        modules = [number for number, code in enumerate(codes, 1)
                   if re.match(r'\s*module\s+(?!procedure\b)\w+\s*$', code, re.I)]
        if len(modules) != 1:
            self.refuse(modules[1] if modules else 1, f'a test file is one module, named {self.stem}')
        elif lines[modules[0] - 1].rstrip() != f'module {self.stem}':
            self.refuse(modules[0], f"this must read 'module {self.stem}' (the file's name), with no comment")
        uses = [code for code in codes if re.match(r'\s*use\s+funit\b', code, re.I)]
        if [use.strip() for use in uses] != ['use funit']:
            self.refuse(modules[0] if modules else 1, "the module must have 'use funit', once and whole")

        in_block = in_procedures = False  # a block: a type definition or an interface
        for number, code in statements(codes):
            names, block = declared_names(code), BLOCK.match(code)
            in_block = in_block and not END_OF_BLOCK.match(code)
            if in_block or END_OF_BLOCK.match(code):
                continue
            in_block = bool(block)
            if block:
                names = [(block[1] or block[2]).lower()]
            elif match := PROCEDURE.match(code):
                names = [match[1].lower()]
            elif code.strip().lower() == 'contains':
                in_procedures = True
            elif in_procedures:
                # Of local names, the variables alone: a named constant compiles.
                names = [] if re.match(r'[^:]*,\s*parameter\b', code, re.I) else [name for name in names if name != 't']
            elif re.match(r'\s*private\b', code, re.I):
                self.refuse(number, 'a test module is not private: its suite function lies outside')
            for name in names:
                if name in FORBIDDEN or name.startswith('assert'):
                    self.refuse(number, f"a test module cannot declare '{name}': pFUnit has that name, and gfortran "
                                        'mixes them up')

    def check_line(self, number, line):
        if len(line) >= LINE_LIMIT:
            self.refuse(number, f'the line has {len(line)} columns; it must have fewer than {LINE_LIMIT}')
        if line.startswith('#'):
            self.refuse(number, 'preprocessor lines are not supported')
        if '/*' in line:
            self.refuse(number, "'/*' begins a comment of the C preprocessor, even in a string")
        if re.match(r'\s*!+\s*@\s*\w', line):
            self.refuse(number, 'a directive that is commented out: delete it or let it run')
        if '@' in code_of(line) and not line.lstrip().startswith('@'):
            self.refuse(number, 'nothing may stand before a directive on its line')

    def directive(self, number, line, after_contains):
        """Translates an assertion; returns the name if it is one that announces a procedure."""
        name, rest = DIRECTIVE.match(line).groups()
        if not after_contains:
            self.refuse(number, f"@{name} stands before the module's 'contains'")
        if name in PROCEDURES:
            if rest:
                self.refuse(number, f"@{name} takes no arguments or comment here, found '{rest}'")
            self.output.append('')
            return name
        if name in OPERANDS:
            self.assertion(number, line, name, rest)
            return None
        known = {known.lower(): known for known in [*OPERANDS, *PROCEDURES]}
        nearest = difflib.get_close_matches(name.lower(), known, n=1, cutoff=0.85)
        hint = f' (did you mean @{known[nearest[0]]}?)' if nearest else ''
        self.refuse(number, f'@{name} is not a directive of the subset of pFUnit used here{hint}')
        return None

    def assertion(self, number, line, name, rest):
        if code_of(rest).endswith('&'):
            self.refuse(number, f'@{name} must stand on one line, without continuation')
            return
        arguments = split_arguments(rest)
        if arguments is None:
            self.refuse(number, f"@{name} must be followed by '(...)' and by nothing after it")
            return
        named = [re.match(r'(\w+)\s*=(?!=)', text) for text in arguments]
        keywords = [match[1].lower() for match in named if match]
        positional = arguments[:len(arguments) - len(keywords)]
        operands, more = OPERANDS[name]
        allowed = {'message'} | more if name != 'assertFail' else set()
        if any(named[:len(positional)]) or '' in arguments:
            self.refuse(number, f'@{name}: keyword arguments come last and none may be empty')
        elif len(positional) != operands:
            self.refuse(number, f'@{name} takes {operands} arguments before keywords, found {len(positional)}; '
                                'message= and tolerance= are given by keyword, but not to @assertFail')
        elif len(set(keywords)) != len(keywords) or not set(keywords) <= allowed:
            self.refuse(number, f'@{name} takes the keywords {" and ".join(sorted(allowed))}, each once; '
                                f'found {", ".join(keywords)}')
        elif name == NEEDS_TOLERANCE and 'tolerance' not in keywords:
            self.refuse(number, f'@{name} needs tolerance=')
        blank = line[:len(line) - len(line.lstrip())]
        constant = {'assertTrue': '.true., ', 'assertFalse': '.false., '}.get(name, '')
        self.output += [f'{blank}call funit_fail( &' if name == 'assertFail' else
                        f"{blank}call funit_check('{name}', {constant}&",
                        f'{blank}{", ".join(arguments)}, &',
                        '   location=SourceLocation( &',
                        f"   '{self.shown_path}', &",
                        f'   {number}))',
                        f'{blank}if (anyExceptions()) return',
                        f'#line {number + 1} "{self.path.resolve()}"']

    def procedure_below(self, number, line, directive):
        match = PLAIN_SUBROUTINE.match(line)
        if not match:
            self.refuse(number, f'@{directive} must stand directly above a plain subroutine: '
                                'no prefix, no dummy arguments, no comment, lower case')
            return
        name = match[1]
        if name in [*self.tests, *self.fixtures.values()]:
            self.refuse(number, f'{name} stands below more than one directive')
        if directive == 'test':
            self.tests.append(name)
        elif directive in self.fixtures:
            self.refuse(number, f'there is more than one @{directive}')
        else:
            self.fixtures[directive] = name

    def suite_function(self):
        fixtures = ''.join(f', &\n      {argument}={self.fixtures[directive]}'
                           for directive, argument in (('before', 'set_up'), ('after', 'tear_down'))
                           if directive in self.fixtures)
        procedures = [*self.tests, *self.fixtures.values()]
        return ['',
                f'function {self.stem}_suite() result(suite)',
                '   use funit, only: TestSuite',
                *(f'   use {self.stem}, only: {name}' for name in procedures),
                '   implicit none (type, external)',
                '   type(TestSuite) :: suite',
                '',
                f"   suite%name = '{self.stem}_suite'",
                *(f"   call suite%add('{name}', {name}{fixtures})" for name in self.tests),
                f'end function {self.stem}_suite']


def main(arguments):
    check_only = arguments[:1] == ['--check']
    if not (len(arguments) >= 2 if check_only else len(arguments) == 2):
        sys.exit(__doc__)
    sound = True
    for path in arguments[1:] if check_only else arguments[:1]:
        try:
            source = TestFile(path, path).translate()
            if not check_only:
                pathlib.Path(arguments[1]).write_text(source, encoding='utf-8')
        except BadTestFile as problems:
            sound = False
            for number, text in problems.args[0]:
                print(f'{path}:{number}: error: {text}', file=sys.stderr)
        except (OSError, UnicodeDecodeError) as trouble:
            sound = False
            print(f'{path}: error: {trouble}', file=sys.stderr)
    sys.exit(0 if sound else 1)


if __name__ == '__main__':
    main(sys.argv[1:])
