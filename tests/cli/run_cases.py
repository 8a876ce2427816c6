#!/usr/bin/env python3
"""Runs the program as a user would and compares output, files and exit status with those that a file of cases expects.

usage: run_cases.py --program WAVYCON CASES [--only WORDS]

CASES holds cases like this one:

   case: the deck is not there
   run:
      wavycon nowhere.nml
   status: 3
   stderr:
      nowhere.nml: there is no such file

Each case runs in a new empty folder. Lines of three blanks belong to the keyword above them; a single line may stand
behind it. Lines that start with '#' are remarks. The keywords are

   case: WORDS         starts a case
   file NAME:          a file to be there before the run
   deck NAME:          the same, a deck; behind its text stand `&surface kind = 'wave_2d' /` and
                       `&load pbar_over_pstar = 0.5 /` if it has no such group. `deck:` is `deck deck.nml:`
   bytes NAME:         a file with Python's escapes (\\t, \\r, \\xff) and nothing added behind the last character
   run:                what the user types: lines for sh, in which `wavycon` is the program and `columns TABLE NAME...`
                       prints columns of a table
   status: N           the exit status of the last line of `run`; 0 if not given
   stdout:, stderr:    lines that must be there, one right after the other in this order; a line '...' stands for any
                       number of lines. All lines must be given.
   makes:              every file that exists after the run and did not before; a.{x,y} is a.x and a.y
   refused:            in place of run, status and stderr: decks, each followed by the problems that are reported,
                       LINE:COLUMN: WORDS or, without a place, -: WORDS. One run of `wavycon` reads all of them
   as a user other than root:
                       if root runs the tests this case runs as nobody, and is skipped, visibly, if nobody cannot

Without these keywords nothing may be printed and no file made; but a case with status 0 or 2 and without stdout may
print anything there: the log.

Exit status: 0 if all cases pass, 77 if all were skipped, else 1.
"""
import argparse
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
NOBODY = 65534
TOOLS = pathlib.Path(__file__).resolve().parent/"tools"
SECONDS = 60  # time limit: no case takes more than a few, unless the program hangs


class Case:
    def __init__(self, name, line):
        self.name = name
        self.line = line
        self.files = {}
        self.expected = {}
        self.run = None
        self.status = 0
        self.unprivileged = False


def completed(deck):
    """A deck with a surface and a load, if it has none of its own."""
    for group in ("&surface kind = 'wave_2d' /", "&load pbar_over_pstar = 0.5 /"):
        if not re.search(group.split()[0] + r"\b", deck, re.IGNORECASE):
            deck += group + "\n"
    return deck


def refusals(case, lines):
    """Takes decks that are refused; gives what the program says of them."""
    decks, said = [], []
    for line in lines:
        problem = re.fullmatch(r"(?:(\d+):(\d+)|-): (.*)", line)
        if problem:
            decks[-1][1].append(problem.groups())
        elif decks and not decks[-1][1]:
            decks[-1][0].append(line)
        else:
            decks.append(([line], []))
    for number, (deck, problems) in enumerate(decks, 1):
        name = f"{number}.nml"
        text = completed("".join(line + "\n" for line in deck))
        case.files[name] = text.encode()
        for i, (line, column, words) in enumerate(problems, 1):
            said.append(f"{name}:{f'{line}:{column}:' if line else ''} error {i} of {len(problems)}: {words}")
            if line:
                said += [f"{line:>4} | {text.splitlines()[int(line) - 1]}", "     | " + " "*(int(column) - 1) + "^"]
    case.run, case.status = shlex.join(["wavycon", *case.files]) + "\n", 1
    return said


def expanded(name):
    """The names that a.{x,y} stands for."""
    match = re.fullmatch(r"(.*)\{(.*)\}", name)
    return [match[1] + ending for ending in match[2].split(",")] if match else [name]


def read_cases(path):
    """The cases of a file. Unknown keywords are errors: a misspelt one would check nothing."""
    cases, block = [], None

    def close(block):
        if block is None:
            return
        case, keyword, lines, number = block
        while lines and not lines[-1].strip():
            lines.pop()
        text = "".join(line[3:] + "\n" for line in lines)
        if keyword.startswith("file "):
            case.files[keyword[5:]] = text.encode()
        elif keyword == "deck" or keyword.startswith("deck "):
            case.files[keyword[5:] or "deck.nml"] = completed(text).encode()
        elif keyword.startswith("bytes "):
            case.files[keyword[6:]] = text[:-1].encode().decode("unicode_escape").encode("latin-1")
        elif keyword == "run":
            case.run = text
        elif keyword in ("stdout", "stderr"):
            case.expected[keyword] = text.splitlines()
        elif keyword == "makes":
            case.expected[keyword] = [path for line in text.splitlines() for path in expanded(line)]
        elif keyword == "refused":
            try:
                case.expected["stderr"] = refusals(case, text.splitlines())
            except LookupError:
                raise SystemExit(f"{path}:{number}: expected in 'refused:' are decks and LINE:COLUMN: WORDS") from None
        else:
            raise SystemExit(f"{path}:{number}: no such keyword: {keyword}")

    for number, line in enumerate(path.read_text().splitlines(), 1):
        if line.startswith("   ") or not line.strip():
            if block:
                block[2].append(line)
            elif line.strip():
                raise SystemExit(f"{path}:{number}: this line belongs to no keyword")
            continue
        close(block)
        block = None
        if line.startswith("#"):
            continue
        match = re.fullmatch(r"([^:]+):\s*(.*)", line)
        if not match:
            raise SystemExit(f"{path}:{number}: expected 'keyword:', found: {line}")
        keyword, value = match.groups()
        if keyword == "case":
            cases.append(Case(value, number))
        elif not cases:
            raise SystemExit(f"{path}:{number}: '{keyword}' before the first case")
        elif keyword == "status":
            cases[-1].status = int(value)
        elif keyword == "as a user other than root":
            cases[-1].unprivileged = True
        else:
            block = (cases[-1], keyword, ["   " + value] if value else [], number)
    close(block)
    for case in cases:
        if not case.run:
            raise SystemExit(f"{path}:{case.line}: the case '{case.name}' runs nothing")
    return cases


def pattern_of(lines):
    """A regular expression for expected lines, in which '...' is any number of lines."""
    return "".join(r"(?:.*\n)*?" if line == "..." else re.escape(line) + r"\n" for line in lines)


def files_below(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir() or path.is_symlink()}


def differences(case, status, output, made):
    """Differences from what the case expects, as text."""
    words = []
    if status != case.status:
        words.append(f"exit status {status}, expected {case.status}")
    for stream in ("stdout", "stderr"):
        if stream == "stdout" and stream not in case.expected and case.status in (0, 2):
            continue
        expected = case.expected.get(stream, [])
        if not re.fullmatch(pattern_of(expected), output[stream]):
            words.append(f"{stream} is not as expected; expected:\n" + "".join(f"   {line}\n" for line in expected))
    expected = set(case.expected.get("makes", []))
    words += [f"was not made: {name}" for name in sorted(expected - made)]
    words += [f"was made, but is not expected: {name}" for name in sorted(made - expected)]
    return words


def become_nobody():
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)


def nobody_can_run(program):
    return subprocess.run([program, "--version"], preexec_fn=become_nobody, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, check=False).returncode == 0


def run_case(case, program, folder):
    """The differences of one case; None if it was skipped."""
    step_down = case.unprivileged and os.geteuid() == 0
    if step_down:
        try:
            if not nobody_can_run(program):
                return None
        except (OSError, subprocess.SubprocessError):
            return None
        os.chown(folder, NOBODY, NOBODY)
    for name, content in case.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        if step_down:
            os.chown(path, NOBODY, NOBODY)
    before = files_below(folder)
    environment = dict(os.environ, PATH=os.pathsep.join([str(program.parent), str(TOOLS), os.environ["PATH"]]))
    result = subprocess.run(["sh", "-c", case.run], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                            capture_output=True, timeout=SECONDS, check=False,
                            preexec_fn=become_nobody if step_down else None)
    output = {"stdout": result.stdout.decode(errors="backslashreplace"),
              "stderr": result.stderr.decode(errors="backslashreplace")}
    words = differences(case, result.returncode, output, files_below(folder) - before)
    if words:
        for stream, text in output.items():
            words.append(f"{stream} was:\n" + "".join(f"   {line}\n" for line in text.splitlines()))
    return words


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--only", default="", help="run the cases whose names hold these words")
    parser.add_argument("cases", type=pathlib.Path)
    arguments = parser.parse_args()

    program = arguments.program.resolve()
    if program.name != "wavycon" or not os.access(program, os.X_OK):
        raise SystemExit(f"{program} is no program called wavycon")
    cases = [case for case in read_cases(arguments.cases) if arguments.only in case.name]
    if not cases:
        raise SystemExit(f"{arguments.cases}: no cases")
    failed = skipped = 0
    for case in cases:
        # With a blank in its name, as folders of users have, and without the name of the program.
        folder = pathlib.Path(tempfile.mkdtemp(prefix="a case "))
        try:
            words = run_case(case, program, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        if words is None:
            skipped += 1
            print(f"SKIPPED {case.name}: no user other than root can run {program}")
        elif words:
            failed += 1
            print(f"FAILED {arguments.cases}:{case.line}: {case.name}")
            print("\n".join(words))
        else:
            print(f"passed {case.name}")
    print(f"{len(cases)} cases, {failed} failed, {skipped} skipped")
    if failed:
        sys.exit(1)
    if skipped == len(cases):
        sys.exit(SKIPPED)


if __name__ == "__main__":
    main()
