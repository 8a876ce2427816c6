"""Surfaces, and what the functions that make them have in common."""
import dataclasses
import difflib
import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any, ParamSpec

import numpy as np
import numpy.typing as npt

FEW = 30   # names that a message lists
Parameters = ParamSpec("Parameters")


@dataclasses.dataclass(frozen=True, eq=False)
class Surface:
    """A surface: keys of &surface, heights in memory, and the unit of length of its file, if it names one."""

    keys: dict[str, Any]
    heights: npt.NDArray[np.float64] | None = None
    length_unit: str | None = None
    folder: object = None   # of a file that was made, which lives as long as the surface

    def __repr__(self) -> str:
        shape = "" if self.heights is None else f"array of shape {self.heights.shape}, "
        return f"Surface({shape}{', '.join(f'{key}={value!r}' for key, value in self.keys.items())})"


def maker(function: Callable[Parameters, Surface]) -> Callable[Parameters, Surface]:
    """The function of a kind: an unknown name is an error at once, and decks have the keys that are given."""
    known = inspect.signature(function).parameters

    @functools.wraps(function)
    def make(*none: Parameters.args, **given: Parameters.kwargs) -> Surface:
        for name in given:
            if name not in known:
                raise ValueError(f"{function.__name__}: {unknown('key', name, known)}")
        return Surface({**function(*none, **given).keys, **given})

    return make


def unknown(what: str, name: object, names: Iterable[object]) -> str:
    """That there is no such name, and the nearest one, or the shortest that has it in it, or all if they are few."""
    texts = list(map(str, names))
    near = difflib.get_close_matches(str(name), texts, 1) or sorted((one for one in texts if str(name) in one), key=len)
    few = f"; there are {', '.join(texts)}" if texts and len(texts) <= FEW else ""
    return f"there is no {what} {name!r}" + (f"; did you mean {near[0]!r}?" if near else few)
