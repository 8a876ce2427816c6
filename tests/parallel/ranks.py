#!/usr/bin/env python3
"""Runs programs of MPI.

usage: ranks.py --mpiexec MPIEXEC --ranks N[,N...] PROGRAM [ARGUMENT ...]

Runs a program on each of these numbers of ranks. Exit status: 0 if that of every run is 0, else 1.
"""
import os
import re
import signal
import subprocess
import sys
import time
import unittest

from program import take_options

PATIENCE = 120.0  # a run that takes longer is ended and counts as hanging [s]

# More ranks than processors, as root too, which containers need, by the variables of Open MPI 4 and of 5, whose launcher
# is PRRTE. Other libraries permit both. Waiting ranks leave the processor to others.
ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "PRTE_ALLOW_RUN_AS_ROOT": "1", "PRTE_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "OMPI_MCA_hwloc_base_binding_policy": "none", "PRTE_MCA_hwloc_default_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    # Containers may forbid one process to read the memory of another one, of which Open MPI 4 would warn.
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


# What the launcher says of ranks that ended with a status or by a signal: blocks between lines of '-' or '='.
LAUNCHER_WORDS = re.compile(r"^(-{40,}|={40,})\n.*?^\1\n", re.MULTILINE | re.DOTALL)


class Outcome:
    """How a run ended: status, None if it had to be ended; the program's words, without the launcher's."""

    def __init__(self, status, stdout, stderr, seconds):
        self.status, self.seconds = status, seconds
        # Open MPI gives the program a terminal, where it writes lines of progress over each other.
        lines = stdout.decode(errors="replace").replace("\r\n", "\n").split("\n")
        self.stdout = "\n".join(line.split("\r")[-1] for line in lines)
        words = stderr.decode(errors="replace")
        self.stderr = LAUNCHER_WORDS.sub("", words)
        if status and not self.stderr:   # the launcher's words are all that a test which fails can show
            print(f"exit status {status}:\n{words}", file=sys.stderr)


def start(mpiexec, ranks, arguments, folder=None):
    """Starts a program on so many ranks."""
    return subprocess.Popen([mpiexec, "-n", str(ranks), *map(str, arguments)], cwd=folder,
                            env=dict(os.environ, **ENVIRONMENT), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, start_new_session=True)


def finish(process, patience=PATIENCE):
    """Waits for the end of a run, which it may have to end."""
    begun = time.monotonic()
    status = None
    try:
        stdout, stderr = process.communicate(timeout=patience)
        status = process.returncode
    except subprocess.TimeoutExpired:
        # MPI's launcher ends the ranks.
        process.terminate()
        try:
            stdout, stderr = process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            stdout, stderr = process.communicate()
    return Outcome(status, stdout, stderr, time.monotonic() - begun)


def run(mpiexec, ranks, arguments, folder=None, patience=PATIENCE):
    return finish(start(mpiexec, ranks, arguments, folder), patience)


def numbers(text):
    """The numbers of ranks of the option --ranks."""
    return tuple(map(int, text.split(",")))


def main(test):
    """Runs a test with the programs and the numbers of ranks of the command line, in folders of its class."""
    given = take_options("mpiexec", "ranks", "program", "parallel")
    test.mpiexec, test.program, test.parallel = given.mpiexec, given.program, given.parallel
    test.ranks = numbers(given.ranks)
    unittest.main(verbosity=2)


def run_program(words):
    if len(words) < 5 or words[0] != "--mpiexec" or words[2] != "--ranks":
        print(__doc__, file=sys.stderr)
        return 1
    failed = 0
    for ranks in numbers(words[3]):
        outcome = run(words[1], ranks, words[4:])
        print(f"{ranks} ranks:", "hangs" if outcome.status is None else f"exit status {outcome.status}")
        print(outcome.stdout, end="", flush=True)
        print(outcome.stderr, end="", file=sys.stderr, flush=True)
        failed += outcome.status != 0
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(run_program(sys.argv[1:]))
