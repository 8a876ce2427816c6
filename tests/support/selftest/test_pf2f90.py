#!/usr/bin/env python3
"""The preprocessor: what it must refuse, at which line and in which words."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
PROGRAM = pathlib.Path(__file__).resolve().parent.parent / 'pf2f90.py'
sys.path.insert(0, str(PROGRAM.parent))
from pf2f90 import BadTestFile, TestFile  # noqa: E402

SOUND = """\
module test_x
   use funit
   use, intrinsic :: iso_fortran_env, only: int64
   implicit none (type, external)

   integer :: spare = 0

contains

   @before
   subroutine prepare()
      spare = 1
   end subroutine prepare

   @test
   subroutine first()
      integer :: a, t
      a = 1
      @assertEqual(1, a, message='a(1), b')
   end subroutine first

end module test_x
""".splitlines()

# What is tried, {line of SOUND: replacement}, line of the error, words of the error.
REFUSED = [
    ('module name', {1: 'module test_y'}, 1, "must read 'module test_x'"),
    ('module comment', {1: 'module test_x ! why'}, 1, 'with no comment'),
    ('no module', {1: ''}, 1, 'a test file is one module'),
    ('two modules', {22: 'end module test_x\nmodule test_y\nend module test_y'},
     23, 'a test file is one module'),
    ('use absent', {2: ''}, 1, "must have 'use funit'"),
    ('use only', {2: '   use funit, only: assertEqual'}, 1, "must have 'use funit'"),
    ('private module', {6: '   private'}, 6, 'is not private'),
    ('forbidden variable', {6: '   integer :: spare(2, 2) = 0, not'}, 6, "cannot declare 'not'"),
    ('forbidden type', {6: '   type :: predicate\n      integer :: is\n   end type predicate'},
     6, "cannot declare 'predicate'"),
    ('forbidden interface', {6: '   interface every\n   end interface every'}, 6, "cannot declare 'every'"),
    ('forbidden subroutine', {16: '   subroutine run()'}, 16, "cannot declare 'run'"),
    ('forbidden function', {13: '   end subroutine prepare\n   pure integer function stub()'},
     14, "cannot declare 'stub'"),
    ('forbidden assertion', {16: '   subroutine assertNear()'}, 16, "cannot declare 'assertnear'"),
    ('forbidden variable of the suite', {6: '   integer :: t'}, 6, "cannot declare 't'"),
    ('forbidden local variable', {17: '      integer :: a, near'}, 17, "cannot declare 'near'"),
    ('forbidden dummy argument', {21: '   subroutine show(run)\n      real, intent(in) :: run\n   end subroutine'},
     22, "cannot declare 'run'"),
    ('forbidden in a continuation', {17: '      integer :: a, & ! why\n\n         & b, &\n         stub'},
     17, "cannot declare 'stub'"),
    ('no test', {15: ''}, 22, 'has no @test'),
    ('test above blank', {15: '   @test\n'}, 16, 'directly above a plain subroutine'),
    ('test above function', {16: '   function first()'}, 16, 'directly above a plain subroutine'),
    ('test with prefix', {16: '   pure subroutine first()'}, 16, 'directly above a plain subroutine'),
    ('test with dummy', {16: '   subroutine first(this)'}, 16, 'directly above a plain subroutine'),
    ('test at the end', {22: 'end module test_x\n@test'}, 23, 'directly above a plain subroutine'),
    ('test with arguments', {15: '   @test(npes=[1])'}, 15, '@test takes no arguments'),
    ('test twice', {21: '   @test\n   subroutine first()\n   end subroutine'}, 22, 'more than one directive'),
    ('before twice', {21: '   @before\n   subroutine again()\n   end subroutine'},
     22, 'more than one @before'),
    ('test that is set-up', {21: '   @test\n   subroutine prepare()\n   end subroutine'},
     22, 'more than one dir'),
    ('outside contains', {6: '   @assertTrue(.true.)'}, 6, "before the module's 'contains'"),
    ('unknown directive', {19: '      @assertAll([.true.])'},
     19, '@assertAll is not a directive of the subset'),
    ('parameterised case', {6: '   @testCase'}, 6, '@testCase is not a directive of the subset'),
    ('case of letters', {19: '      @assertequal(1, a)'}, 19, 'did you mean @assertEqual?'),
    ('commented out', {15: '   !@test\n   @test'}, 15, 'commented out'),
    ('commented assertion', {19: '      ! @assertEqual(1, a)'}, 19, 'commented out'),
    ('behind a statement', {19: '      a = 2; @assertEqual(1, a)'},
     19, 'nothing may stand before a directive'),
    ('behind a condition', {19: '      if (a > 0) @assertEqual(1, a)'},
     19, 'nothing may stand before a directive'),
    ('in a continuation', {18: '      a = &'}, 19, 'inside a continued statement'),
    ('continued', {19: '      @assertEqual(1, &\n         a)'}, 19, 'on one line, without continuation'),
    ('trailing comment', {19: '      @assertEqual(1, a) ! (why)'}, 19, 'nothing after it'),
    ('open parenthesis', {19: '      @assertEqual(1, (a)'}, 19, 'nothing after it'),
    ('no parenthesis', {19: '      @assertTrue .true.'}, 19, 'nothing after it'),
    ('too few operands', {19: '      @assertEqual(1)'}, 19, 'takes 2 arguments before keywords, found 1'),
    ('tolerance by place', {19: '      @assertEqual(1, a, 2)'}, 19, 'found 3; message= and tolerance='),
    ('message by place', {19: "      @assertTrue(a == 1, 'why')"}, 19, 'found 2; message= and tolerance='),
    ('empty operand', {19: '      @assertEqual(1, )'}, 19, 'none may be empty'),
    ('keyword first', {19: "      @assertEqual(message='why', 1, a)"}, 19, 'keyword arguments come last'),
    ('operand by keyword', {19: '      @assertEqual(1, actual=a)'},
     19, 'takes 2 arguments before keywords, found 1'),
    ('keyword twice', {19: "      @assertEqual(1, a, message='b', message='c')"}, 19, 'each once'),
    ('unknown keyword', {19: "      @assertEqual(1, a, whitespace=KEEP_ALL)"},
     19, 'takes the keywords message'),
    ('needless tolerance', {19: '      @assertLessThan(1, a, tolerance=2)'},
     19, 'takes the keywords message,'),
    ('lacking tolerance', {19: '      @assertRelativelyEqual(1, a)'}, 19, 'needs tolerance='),
    ('fail without message', {19: '      @assertFail()'}, 19, '@assertFail'),
    ('fail with too much', {19: "      @assertFail('b', message='c')"}, 19, '@assertFail'),
    ('long line', {18: '      a = 1 !'.ljust(120, '.')}, 18, 'the line has 120 columns'),
    ('preprocessor line', {6: '#ifdef X'}, 6, 'preprocessor lines'),
    ('comment of C', {18: "      a = index('x/*.f90', 'x')"}, 18, "'/*' begins a comment"),
]


class Preprocessor(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.source = pathlib.Path(directory.name, 'test_x.pf')
        self.output = pathlib.Path(directory.name, 'test_x.F90')

    def translate(self, lines):
        self.source.write_text('\n'.join(lines) + '\n', encoding='utf-8')
        return TestFile(self.source, 'test_x.pf').translate()

    def run_program(self, *arguments):
        command = [sys.executable, PROGRAM, *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_sound_file(self):
        self.translate(SOUND)
        run = self.run_program(self.source, self.output)
        self.assertEqual((run.returncode, run.stderr, self.output.exists()), (0, '', True))
        self.assertEqual(self.run_program('--check', self.source, self.source).returncode, 0)

    def test_names_that_are_not_the_modules_own(self):
        lines = SOUND.copy()
        lines[5] = '''\
   abstract interface
      real function f(t)
         real, intent(in) :: t
      end function f
   end interface
   type :: plain
      private
      integer :: is
   end type plain'''
        lines[16] = '''\
      integer, parameter :: near(2) = [1, 2]
      integer :: a = size([integer :: 1, not(2)]), b(not(-3))'''
        self.translate(lines)

    def test_longest_line(self):
        lines = SOUND.copy()
        lines[17] = '      a = 1 !'.ljust(119, '.')
        self.translate(lines)

    def test_refused(self):
        for what, changes, number, words in REFUSED:
            with self.subTest(what):
                with self.assertRaises(BadTestFile) as refusal:
                    self.translate([changes.get(place, line) for place, line in enumerate(SOUND, 1)])
                problems = refusal.exception.args[0]
                self.assertTrue(any(place == number and words in text for place, text in problems), problems)

    def test_every_problem_is_reported_and_nothing_written(self):
        lines = SOUND.copy()
        lines[0], lines[18] = 'module test_y', '      @assertAll(a)'
        with self.assertRaises(BadTestFile):
            self.translate(lines)
        for arguments in ((self.source, self.output), ('--check', self.source)):
            run = self.run_program(*arguments)
            self.assertEqual(run.returncode, 1)
            self.assertEqual([error.partition(': error: ')[0] for error in run.stderr.splitlines()],
                             [f'{self.source}:1', f'{self.source}:19'])
            self.assertFalse(self.output.exists())

    def test_missing_file(self):
        run = self.run_program(self.source, self.output)
        self.assertEqual(run.returncode, 1)
        self.assertIn(str(self.source), run.stderr)


if __name__ == '__main__':
    unittest.main()
