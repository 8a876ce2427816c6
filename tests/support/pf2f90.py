#!/usr/bin/env python3
"""Translates a pFUnit test file (.pf) to a Fortran program for the stand-in.

usage: pf2f90.py IN.pf OUT.F90

Only directives are translated; the compiler sees the rest, and the operands of assertions, as they are, and names lines
of IN.pf. The driver has the macros of pFUnit's, PFUNIT_EXTRA_USE, .._INITIALIZE and .._FINALIZE, and like it points to
the procedures that they name: what pFUnit's cannot point to does not compile here either.
"""
import pathlib
import re
import sys

# Those without an expected value have that of the second word in its place.
ASSERTIONS = dict.fromkeys((
    "assertEqual", "assertRelativelyEqual", "assertLessThan", "assertLessThanOrEqual", "assertGreaterThan",
    "assertGreaterThanOrEqual", "assertIsFinite", "assertIsNaN", "assertFail"), "")
ASSERTIONS |= {"assertTrue": ".true., ", "assertFalse": ".false., "}
PROCEDURES = "test", "before", "after"


def translate(path):
    """The source of a program: the module of the file, and calls of its tests. ValueError: (line, what is wrong)."""
    module = path.stem
    output = [f'#line 1 "{path.resolve()}"']
    procedures = {kind: [] for kind in PROCEDURES}
    pending = ""
    for number, line in enumerate([*path.read_text(encoding="utf-8").splitlines(), ""], 1):
        if pending:
            below = re.fullmatch(r"\s*subroutine\s+(\w+)\s*(\(\s*\))?\s*", line)
            if not below:
                raise ValueError(number, f"@{pending} must stand directly above a subroutine without arguments or "
                                         "comment")
            procedures[pending].append(below[1])
            pending = ""
        directive = re.match(r"(\s*)@\s*(\w*)\s*(.*?)\s*$", line)
        if not directive:
            output.append(line)
            continue
        blank, name, rest = directive.groups()
        if name in PROCEDURES and not rest:
            output.append("")
            pending = name
        elif name in ASSERTIONS and re.fullmatch(r"\(.*\)", rest):
            output += [f"{blank}call funit_check('{name}', {ASSERTIONS[name]}&", f"{blank}{rest[1:-1]}, &",
                       f"   location=SourceLocation('{path}', &", f"   {number}))",
                       f"{blank}if (anyExceptions()) return", f'#line {number + 1} "{path.resolve()}"']
        else:
            raise ValueError(number, f"this is none of @{', @'.join(PROCEDURES)}, alone on its line, and "
                                     f"@{'(..), @'.join(ASSERTIONS)}(..), on one line")
    if not procedures["test"]:
        raise ValueError(1, "the file has no @test")
    if len(procedures["before"]) > 1 or len(procedures["after"]) > 1:
        raise ValueError(1, "the file has more than one @before or @after")
    fixtures = "".join(f", &\n      {argument}={name}" for kind, argument in
                       (("before", "set_up"), ("after", "tear_down")) for name in procedures[kind])
    return output + [
        "", f"program run_{module}", "   use PFUNIT_EXTRA_USE", "   use funit_runner, only: end_tests, run_test",
        *(f"   use {module}, only: {name}" for kind in PROCEDURES for name in procedures[kind]),
        "   implicit none (type, external)", "   procedure(), pointer :: extra_initialize, extra_finalize", "",
        "   extra_initialize => PFUNIT_EXTRA_INITIALIZE", "   extra_finalize => PFUNIT_EXTRA_FINALIZE",
        "   call extra_initialize()",
        *(f"   call run_test('{module}.{name}', &\n      {name}{fixtures})" for name in procedures["test"]),
        "   call extra_finalize()", "   call end_tests()", f"end program run_{module}"]


def main(source, target):
    try:
        pathlib.Path(target).write_text("\n".join(translate(pathlib.Path(source))) + "\n", encoding="utf-8")
    except ValueError as trouble:
        sys.exit("{}:{}: error: {}".format(source, *trouble.args))


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) == 3 else sys.exit(__doc__)
