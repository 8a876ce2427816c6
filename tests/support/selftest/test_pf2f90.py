#!/usr/bin/env python3
"""The preprocessor: what it must refuse, and at which line. What passes and what fails is in the .pf files here."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parent.parent/"pf2f90.py"
SOUND = """\
module test_x
   use funit
contains
   @before
   subroutine prepare()
   end subroutine prepare

   @test
   subroutine first()
      @assertEqual(1, 2)
   end subroutine first
end module test_x
""".splitlines()

# {line of SOUND: replacement}, line of the error, words of the error.
REFUSED = [
    ({8: ""}, 1, "has no @test"),
    ({8: "   @test\n"}, 9, "directly above a subroutine"),
    ({9: "   function first()"}, 9, "directly above a subroutine"),
    ({9: "   subroutine first(this)"}, 9, "directly above a subroutine"),
    ({12: "end module test_x\n@test"}, 14, "directly above a subroutine"),
    ({8: "   @test(npes=[1])"}, 8, "this is none of @test, "),
    ({7: "   @before\n   subroutine again()\n   end subroutine again"}, 1, "more than one @before"),
    ({10: "      @assertAll([.true.])"}, 10, "this is none of @test, "),
    ({10: "      @assertequal(1, a)"}, 10, "this is none of @test, "),
    ({10: "      @assertEqual(1, &\n         a)"}, 10, "on one line"),
    ({10: "      @assertEqual(1, a) ! why"}, 10, "on one line"),
    ({10: "      @assertTrue .true."}, 10, "on one line"),
]


class Preprocessor(unittest.TestCase):
    def test_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            source, target = pathlib.Path(folder, "test_x.pf"), pathlib.Path(folder, "test_x.F90")
            for changes, number, words in [({}, 0, ""), *REFUSED]:
                with self.subTest(changes):
                    source.write_text("\n".join(changes.get(place, line) for place, line in enumerate(SOUND, 1)) + "\n")
                    target.unlink(missing_ok=True)
                    run = subprocess.run([sys.executable, PROGRAM, source, target], capture_output=True, text=True,
                                         check=False)
                    self.assertEqual((bool(changes), not changes), (run.returncode == 1, target.exists()))
                    if changes:
                        self.assertEqual(f"{source}:{number}", run.stderr.partition(": error: ")[0])
                        self.assertIn(words, run.stderr)

    def test_driver(self):
        """Like pFUnit's it points to the procedures that run first and last: compilers refuse what they cannot be."""
        with tempfile.TemporaryDirectory() as folder:
            source, target = pathlib.Path(folder, "test_x.pf"), pathlib.Path(folder, "test_x.F90")
            source.write_text("\n".join(SOUND) + "\n")
            subprocess.run([sys.executable, PROGRAM, source, target], check=True)
            driver = [line.strip() for line in target.read_text().partition("\nprogram ")[2].splitlines()]
        places = [driver.index(line) for line in (
            "use PFUNIT_EXTRA_USE", "procedure(), pointer :: extra_initialize, extra_finalize",
            "extra_initialize => PFUNIT_EXTRA_INITIALIZE", "extra_finalize => PFUNIT_EXTRA_FINALIZE",
            "call extra_initialize()", "call run_test('test_x.first', &", "call extra_finalize()", "call end_tests()")]
        self.assertEqual(sorted(places), places)


if __name__ == "__main__":
    unittest.main()
