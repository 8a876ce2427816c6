#!/usr/bin/env python3
"""Times a program from start to finish.

usage: wall_time.py RUNS PROGRAM [ARGUMENT ...]

The program's standard output is thrown away. Its results go to a directory of their
own, given to it as --output, which is removed.
"""
import statistics
import subprocess
import sys
import tempfile
import time


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__.split('\n\n')[1])
    runs, command = int(sys.argv[1]), sys.argv[2:]
    times = []
    with tempfile.TemporaryDirectory() as directory:
        for _ in range(runs):
            before = time.perf_counter()
            subprocess.run([*command, '--output', directory], stdout=subprocess.DEVNULL, check=True)
            times.append(1000*(time.perf_counter() - before))
    median = statistics.median(times)
    print(f'# The program from start to finish, {runs} runs [ms]: name, median, least, largest')
    print(f'{chr(34) + "wavycon inputs/paper_2d_sweep.nml" + chr(34):42}'
          f'{median:10.2f}{min(times):10.2f}{max(times):10.2f}')


if __name__ == '__main__':
    main()
