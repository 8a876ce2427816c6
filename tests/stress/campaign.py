#!/usr/bin/env python3
"""The stress campaign: extreme, random and damaged input, and a table of what passed.

usage: campaign.py --program WAVYCON --programs FOLDER --results FOLDER [--quick] [--seed N] [--only PART ...]

scripts/stress builds the programs and calls it; scripts/stress --help says what the parts are.

Exit status: 0 if every case passed, else 1.
"""
import argparse
import contextlib
import pathlib
import shutil
import sys
import tempfile
import time

import builds as other_builds
import contact_conditions
import extremes
import faults as machine_faults
import fuzz_decks
import fuzz_maps
import honest_estimates
import long_tests
import quadratic_programmes
import random_scenes
import random_stresses
import rough_surfaces
import same_contact
import valgrind_runs

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST_SHOWN = 20  # failures of a part that are printed
PARTS = ("tests", "qp", "loads", "solvers", "stresses", "decks", "faults", "builds", "valgrind")


def tests(settings, results):
    yield long_tests.campaign(settings.programs.parents[1], results)


def qp(settings, results):
    part, table = quadratic_programmes.campaign(settings.programs, settings.seed, 400 if settings.quick else 10000,
                                                30 if settings.quick else 300, results)
    part.notes = table
    yield part


def loads(settings, results):
    yield quadratic_programmes.loads(settings.programs, settings.quick, results)
    with work_folder() as work:
        yield extremes.campaign(settings.program, settings.quick, work, results)


def solvers(settings, results):
    kinds = random_scenes.QUICK if settings.quick else random_scenes.KINDS
    for campaign, program, scenes in (
            (contact_conditions.campaign, settings.programs/"stress_scenes", 12),
            (honest_estimates.campaign, settings.program, 5),
            (same_contact.order_and_symmetry, settings.program, 4),
            (same_contact.alone_and_again, settings.program, 3),
            (rough_surfaces.campaign, settings.program, 6)):
        with work_folder() as work:
            yield campaign(program, settings.seed, kinds, 1 if settings.quick else scenes, work, results)


def stresses(settings, results):
    kinds = random_scenes.QUICK if settings.quick else random_scenes.KINDS
    with work_folder() as work:
        yield random_stresses.campaign(settings.program, settings.seed, kinds, 1 if settings.quick else 8, work, results)


def decks(settings, results):
    for fuzz, amount in ((fuzz_decks.fuzz_checks, 150 if settings.quick else 5000),
                         (fuzz_decks.fuzz_settings, 100 if settings.quick else 3000),
                         (fuzz_decks.fuzz_monsters, 100000 if settings.quick else 10000000),
                         (fuzz_decks.fuzz_runs, 30 if settings.quick else 500),
                         (fuzz_maps.fuzz_checks, 60 if settings.quick else 3000),
                         (fuzz_maps.fuzz_binary, 60 if settings.quick else 3000),
                         (fuzz_maps.fuzz_runs, 20 if settings.quick else 500),
                         (fuzz_maps.fuzz_monsters, 100000 if settings.quick else 10000000)):
        with work_folder() as work:
            yield fuzz(settings.program, settings.seed, amount, work, results)
    with work_folder() as work:
        yield fuzz_maps.odd_files(settings.program, work, results)


def faults(settings, results):
    with work_folder() as work:
        yield machine_faults.campaign(settings.program, settings.seed, settings.quick, work, results)


def builds(settings, results):
    with work_folder() as work:
        yield other_builds.levels(ROOT, ROOT/"build", work)
    with work_folder() as work:
        yield other_builds.sanitizers(ROOT, ROOT/"build", settings.seed, settings.quick, work, results)


def valgrind(settings, results):
    with work_folder() as work:
        program = settings.programs/"stress_program"
        yield valgrind_runs.campaign(program, settings.programs.parent, settings.quick, work, results)


@contextlib.contextmanager
def work_folder():
    """A new folder for the files of a part; removed afterwards."""
    # With blanks in its name, as folders of users have, and without the name of the program.
    folder = pathlib.Path(tempfile.mkdtemp(prefix="a stress case ")).resolve()
    try:
        # Some faults run the program as another user, who must be able to enter.
        folder.chmod(0o755)
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def show(part, seconds):
    """Prints the line of a part, its notes and its failures."""
    print(f"{part.name:32}{part.tried:8d}{part.passed:8d}{len(part.failures):8d}{seconds:9.0f}  {part.worst}")
    for line in part.notes:
        print(f"   {line}")
    for case, words in part.failures[:MOST_SHOWN]:
        print(f"   FAILED {case}: {words}")
    if len(part.failures) > MOST_SHOWN:
        print(f"   and {len(part.failures) - MOST_SHOWN} more")
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--programs", type=pathlib.Path, required=True)
    parser.add_argument("--results", type=pathlib.Path, required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", choices=PARTS, default=PARTS)
    settings = parser.parse_args()
    settings.program = settings.program.resolve()
    settings.programs = settings.programs.resolve()

    print(f"seed {settings.seed}{', the short form' if settings.quick else ''}")
    print(f'{"":32}{"tried":>8}{"passed":>8}{"failed":>8}{"seconds":>9}  worst', flush=True)
    failed = 0
    for name in PARTS:
        if name not in settings.only:
            continue
        results = settings.results.resolve()/name
        shutil.rmtree(results, ignore_errors=True)
        found = 0
        begun = time.monotonic()
        for part in globals()[name](settings, results):
            show(part, time.monotonic() - begun)
            found += len(part.failures)
            begun = time.monotonic()
        if found:
            print(f"   cases that failed: {results}", flush=True)
        failed += found
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
