"""Runs of the program, many at a time."""
from __future__ import annotations

import contextlib
import importlib.metadata
import itertools
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from numbers import Integral
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from .deck import deck_text, dictionary, groups_of, value_text
from .library import keys, need
from .names import Options, Unpack
from .progress import new_bar
from .surfaces import Surface, unknown


def program() -> str:
    """The path of the program that was installed with this package, otherwise of that in PATH."""
    with contextlib.suppress(importlib.metadata.PackageNotFoundError):
        for file in importlib.metadata.files("wavycon") or []:
            if file.name == "wavycon" and file.parent.name in ("bin", "Scripts"):
                return str(file.locate())
    if path := shutil.which("wavycon"):
        return path
    raise OSError("the program wavycon is neither installed with this package nor in PATH")


def sweep(what: str | os.PathLike[str] | Surface | Sequence[Surface] | Mapping[Any, Surface],
          values: Mapping[str, object] = MappingProxyType({}), jobs: int | None = None,
          directory: str | os.PathLike[str] | None = None, **options: Unpack[Options]) -> Any:
    """Solves a deck, or surfaces, once for each combination of values of keys, several at a time, each in a process.

    what: the file of a deck; or a surface, a list of surfaces, or a dictionary of them by names, with options as of
    solve. values: such as {"surface.seed": range(50), "load.mean_pressure": [1e6, 1e7]}; each value, a number, a text
    or a list, is set as by the program's --set; a number or a text in place of the values is the only one. jobs:
    processes at a time, 1 or more; as many as there are processors unless given. directory: where the runs write their
    tables, which are lost without it. Shows a bar where tqdm is installed.

    Returns a frame of pandas: a row for each run and load, with the name or number of the surface if there are several,
    the values, the columns of the summary, whose units are in frame.attrs["units"], and message, what the program
    notes of the run. A run that failed is a row with the status 'failed' and the message of the program; if all fail it
    is a ValueError. An unknown key is one before anything starts.
    """
    pandas = need("pandas", "frames")
    if jobs is not None and not (isinstance(jobs, Integral) and jobs >= 1):
        raise ValueError(f"jobs must be a whole number, 1 or more, got {jobs!r}")
    known = [f"{group}.{key}" for group, own in keys().items() for key in own]
    for key in dictionary("values", values):
        if str(key).lower() not in known:
            raise ValueError(unknown("key", key, known))
    points = [dict(zip(values, one)) for one in itertools.product(*itertools.starmap(values_of, values.items()))]
    units: dict[str, str] = {}
    started: list[subprocess.Popen[str]] = []
    with tempfile.TemporaryDirectory() as own:
        decks = list(decks_of(what, own, options))
        combinations = [(deck, title, point) for deck, title in decks for point in points]

        def run(number: int) -> Any:
            deck, title, settings = combinations[number]
            table = Path(own, f"{number}.csv")
            sets = [f"--set={key}={value_text(key, value)}" for key, value in settings.items()]
            # In a folder of its own a run needs no name with all its values, which may be too long for one.
            sets += ["--set=scene.case=run"]*(not directory and "scene.case" not in map(str.lower, settings))
            output = Path(directory or own, "" if directory else str(number))
            with subprocess.Popen([program(), deck, *sets, f"--output={output}", f"--table={table}"], text=True,
                                  errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE) as process:
                started.append(process)
                log, message = process.communicate()
                message = message.strip() or "\n".join(re.findall("^note: (.*)$", log, re.MULTILINE))
                message = message.replace(own + os.sep, "")   # the files of surfaces have names of this folder
            if table.exists():
                rows = pandas.read_csv(table, dtype=str, keep_default_na=False).loc[:, "load":].apply(numbers)
                heads = [head.rstrip("]").partition("[") for head in rows]
                units.update({column: unit or "-" for column, _, unit in heads})
                rows.columns = [column for column, *_ in heads]
            else:
                rows = pandas.DataFrame({"status": ["failed"]})
                message = message or f"the program ended with the status {process.returncode}"
            front = {key: [value]*len(rows) for key, value in {**title, **settings}.items()}
            return pandas.DataFrame(front, rows.index).join(rows).assign(message=message)

        with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
            try:
                runs = pool.map(run, range(len(combinations)))
                frames = list(new_bar(len(combinations), "run", runs) or runs)
            finally:
                # After an interruption: those that have ended are left alone.
                pool.shutdown(wait=False, cancel_futures=True)
                for process in started:
                    process.terminate()
    if not frames:
        raise ValueError("there are no values, so there is no run")
    frame = pandas.concat(frames, ignore_index=True)[max((frame.columns for frame in frames), key=len)]
    if (frame["status"] == "failed").all():
        raise ValueError(f"all runs failed; the first one: {frame['message'][0]}")
    frame.attrs["units"] = {column: units[column] for column in frame if column in units}
    return frame


def numbers(column: Any) -> Any:
    """A column of texts as numbers, if all are: as Python reads them, to the last digit."""
    for kind in int, float:
        with contextlib.suppress(ValueError):
            return column.map(kind)
    return column


def values_of(key: str, given: object) -> list[object]:
    """The values of a key of a sweep; a number or a text is the only one."""
    is_one = isinstance(given, (str, bytes, Mapping)) or getattr(given, "ndim", None) == 0
    values = [given] if is_one or not isinstance(given, Iterable) else list(given)
    for value in values:
        value_text(key, value)   # which is right, or an error
    return values


def decks_of(what: Any, folder: str, options: Mapping[str, Any]) -> Iterator[tuple[str, dict[str, object]]]:
    """The files of decks of a sweep, each with its part of a row. Those of surfaces are written to the folder."""
    if isinstance(what, (str, os.PathLike)):
        if options:
            raise ValueError(f"the deck has its own keys: give {', '.join(options)} in values, with the group, such as "
                             '{"surface.seed": [1, 2]}')
        yield os.fspath(what), {}
        return
    surfaces = what if isinstance(what, Mapping) else dict(enumerate(what if isinstance(what, Iterable) else [what]))
    for number, (name, surface) in enumerate(surfaces.items()):
        groups = groups_of(surface, options)
        if surface.in_memory is not None:
            place = os.path.join(folder, f"heights{number}.npy")
            np.save(place, surface.heights)
            groups["surface"] = {**groups["surface"], "file": place}
        deck = Path(folder, f"surface{number}.nml")
        deck.write_text(deck_text(groups), encoding="utf-8")
        yield str(deck), {"surface": name} if len(surfaces) > 1 else {}
