"""Runs of the program, many at a time."""
import contextlib
import csv
import importlib.metadata
import itertools
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .deck import value_text


def program() -> str:
    """The path of the program that was installed with this package, otherwise of that in PATH."""
    with contextlib.suppress(importlib.metadata.PackageNotFoundError):
        for file in importlib.metadata.files("wavycon") or []:
            if file.name == "wavycon" and file.parent.name in ("bin", "Scripts"):
                return str(file.locate())
    path = shutil.which("wavycon")
    if not path:
        raise OSError("the program wavycon is neither installed with this package nor in PATH")
    return path


def sweep(deck, values: Mapping[str, Iterable], jobs: int | None = None, directory=None):
    """Runs a deck once for each combination of values of its keys, several runs at a time, each a process.

    values: such as {"surface.seed": range(50), "load.mean_pressure": [1e6, 1e7]}; each value, a number, a text or a
    list, is set as by the program's --set. jobs: processes at a time; as many as there are processors unless given.
    directory: where the runs write their tables, which are lost without it. Shows a bar where tqdm is installed.

    Returns a frame of pandas: a row for each run and load, with the values, the columns of the summary, and message, what
    the program notes of the run. A run that failed is a row with the status 'failed' and the message of the program.
    """
    import pandas
    combinations = [dict(zip(values, one)) for one in itertools.product(*values.values())]
    command = [program(), os.fspath(deck)]
    started: list = []
    with tempfile.TemporaryDirectory() as own:
        # From version 3 on pandas reads numbers exactly by itself, and warns of the argument.
        exact = {"float_precision": "round_trip"} if int(pandas.__version__.split(".")[0]) < 3 else {}

        def run(number):
            settings, table = combinations[number], Path(own, f"{number}.dat")
            sets = [f"--set={key}={value_text(value)}" for key, value in settings.items()]
            output = Path(directory or own, "" if directory else str(number))
            with subprocess.Popen([*command, *sets, f"--output={output}", f"--table={table}"], text=True,
                                  errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE) as process:
                started.append(process)
                log, message = process.communicate()
                message = message.strip() or "\n".join(re.findall("^note: (.*)$", log, re.MULTILINE))
            if table.exists():
                # The head of a deck that did not fail: version, units.
                rows = pandas.read_csv(table, sep=r"\s+", skiprows=2, quoting=csv.QUOTE_NONE, **exact).loc[:, "load":]
            else:
                rows = pandas.DataFrame({"status": ["failed"]})
                message = message or f"the program ended with the status {process.returncode}"
            for place, (key, value) in enumerate(settings.items()):
                rows.insert(place, key, [value]*len(rows))
            return rows.assign(message=message)

        with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
            try:
                frames = list(progress(pool.map(run, range(len(combinations))), len(combinations)))
            finally:
                # After an interruption: those that have ended are left alone.
                pool.shutdown(wait=False, cancel_futures=True)
                for process in started:
                    process.terminate()
    if not frames:
        raise ValueError("there are no values, so there is no run")
    return pandas.concat(frames, ignore_index=True)[max((frame.columns for frame in frames), key=len)]


def progress(steps, number):
    """The steps, with a bar where tqdm is installed."""
    with contextlib.suppress(ImportError):
        from tqdm.auto import tqdm
        return tqdm(steps, total=number, unit="run")
    return steps
