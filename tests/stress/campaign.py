#!/usr/bin/env python3
"""The stress campaign: extreme, random and damaged input, and a table of what passed.

usage: campaign.py --program WAVYCON --programs FOLDER --results FOLDER [--quick] [--seed N] [--only PART ...]

scripts/stress builds the programs and calls it; scripts/stress --help says what the parts are. So many lines of the table
as there are processors are made at a time.

Exit status: 0 if every case passed, else 1.
"""
import argparse
import concurrent.futures
import copy
import os
import pathlib
import shutil
import sys
import tempfile
import time

import ball_adhesion
import builds
import contact_conditions
import extremes
import faults
import fuzz_decks
import fuzz_maps
import growing_loads
import guaranteed_bounds
import honest_estimates
import long_tests
import quadratic_programmes
import random_stresses
import rough_surfaces
import same_contact
import valgrind_runs
from common import Settings

# Of each part the procedures, each of which makes a line of the table: procedure(settings, folder for its files).
PARTS = {
    "tests": [long_tests.campaign],
    "qp": [quadratic_programmes.campaign],
    "loads": [quadratic_programmes.loads, extremes.campaign],
    "solvers": [contact_conditions.campaign, *honest_estimates.CAMPAIGNS, growing_loads.campaign,
                same_contact.order_and_symmetry, same_contact.alone_and_again, rough_surfaces.campaign,
                ball_adhesion.campaign],
    "bounds": [guaranteed_bounds.campaign],
    "stresses": [random_stresses.campaign],
    "decks": [fuzz_decks.fuzz_checks, fuzz_decks.fuzz_settings, fuzz_decks.fuzz_monsters, fuzz_decks.fuzz_runs,
              fuzz_maps.fuzz_checks, fuzz_maps.fuzz_binary, fuzz_maps.fuzz_runs, fuzz_maps.fuzz_monsters,
              fuzz_maps.odd_files],
    "faults": [faults.campaign],
    "builds": [builds.levels, builds.sanitizers],
    "valgrind": [valgrind_runs.campaign],
}


def part_of(procedure, settings):
    """Runs a procedure in a folder of its own. Returns the part, and the seconds that it took."""
    begun = time.monotonic()
    # With blanks in its name, as folders of users have, and without the name of the program.
    with tempfile.TemporaryDirectory(prefix="a stress case ") as folder:
        # Some faults run the program as another user, who must be able to enter.
        pathlib.Path(folder).chmod(0o755)
        part = procedure(settings, pathlib.Path(folder).resolve()/"work")
    return part, time.monotonic() - begun


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--programs", type=pathlib.Path, required=True)
    parser.add_argument("--results", type=pathlib.Path, required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", choices=PARTS, default=PARTS)
    settings = parser.parse_args(namespace=Settings())
    settings.program, settings.programs = settings.program.resolve(), settings.programs.resolve()
    results = settings.results.resolve()

    print(f"seed {settings.seed}{', the short form' if settings.quick else ''}")
    print(f'{"":40}{"tried":>8}{"passed":>8}{"failed":>8}{"seconds":>9}  worst', flush=True)
    failed = 0
    # A process each: the processor time of the programs that it ran is its own.
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        runs = []
        for name in [name for name in PARTS if name in settings.only]:
            settings.results = results/name
            shutil.rmtree(settings.results, ignore_errors=True)
            runs += [(settings.results, pool.submit(part_of, procedure, copy.copy(settings)))
                     for procedure in PARTS[name]]
        for kept_in, run in runs:
            part, seconds = run.result()
            part.show(seconds)
            if part.failures:
                print(f"   cases that failed: {kept_in}", flush=True)
            failed += len(part.failures)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
