"""Surfaces, and what the functions that make them have in common."""
from __future__ import annotations

import dataclasses
import difflib
import functools
import inspect
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, ParamSpec

import numpy as np
import numpy.typing as npt

from .library import keys

FEW = 30          # names that a message lists
MOST = 3          # names that a message proposes
CLOSE = 0.75      # least similarity of names, by difflib, that differ by slips
SHORTEST = 3, 4   # letters of a part of a name, and of a word of a meaning, that is looked for
# Keys that each of two maps has for itself: the key of the second one, and its value if none is given.
OF_SECOND = {"height_scale": ("file2_scale", 1.0), "detrend": ("file2_detrend", "none")}
Parameters = ParamSpec("Parameters")


@dataclasses.dataclass(frozen=True, eq=False)
class Surface:
    """A surface: keys of &surface, heights in memory, and the unit of length of its file, if it names one.

    Two surfaces of heights in memory make one, which has the sum of their heights: first + second.flipped()."""

    keys: dict[str, Any]
    heights: npt.NDArray[np.float64] | None = None
    length_unit: str | None = None
    folder: object = None   # of files that were made, which live as long as the surface

    def __repr__(self) -> str:
        shape = "" if self.heights is None else f"array of shape {self.heights.shape}, "
        return f"Surface({shape}{', '.join(f'{key}={value!r}' for key, value in self.keys.items())})"

    def flipped(self) -> Surface:
        """The map turned over about the y axis, as that of the second body is when it is laid on the first one: the
        last point along x becomes the first. Its heights still rise out of their body. Errors: ValueError for a surface
        without heights in memory."""
        if self.heights is None:
            raise ValueError("only heights in memory can be turned over: wavycon.file(file=..., file2=...) turns the "
                             "map of a second file")
        along_x = self.heights.ndim - 1 if self.heights.shape[-1] > 1 else 0   # a column is a profile
        return dataclasses.replace(self, heights=np.flip(self.heights, along_x).copy())

    def __add__(self, other: Surface) -> Surface:
        """The surface of two bodies: the sum of two maps, each prepared before they are added, with its own detrend
        and height_scale. Errors: ValueError for a surface without heights in memory, and for other keys, points and
        units that are not the same."""
        if not isinstance(other, Surface):
            return NotImplemented
        if self.heights is None or other.heights is None:
            raise ValueError("only two surfaces of heights in memory can be added: wavycon.file(file=..., file2=...) "
                             "adds the maps of two files")
        if self.heights.shape != other.heights.shape:
            raise ValueError("two maps must have the same points, got the shapes "
                             f"{self.heights.shape} and {other.heights.shape}")
        first, second = ({name: value for name, value in {"length_unit": surface.length_unit, **surface.keys}.items()
                          if value is not None} for surface in (self, other))
        points = dict(zip(("length_y", "length_x"), self.heights.shape))
        for name in {**first, **second}:
            one: Any = first.get(name)
            two: Any = second.get(name)
            # A map without sides or unit has those of the other one. Sides of instruments may differ by half a step.
            if one == two or name in OF_SECOND or (name.startswith("length_") and None in (one, two)) or (
                    name in points and 2*points[name]*abs(one - two) <= one):
                continue
            raise ValueError(f"two maps must have the same {name}, got {one!r} and {two!r}")
        own = {key: second.get(name, default) for name, (key, default) in OF_SECOND.items()
               if name in {**first, **second}}
        folder = tempfile.TemporaryDirectory(prefix="wavycon-")
        files = {name: os.path.join(folder.name, f"{name}.npy") for name in ("file", "file2")}
        for file, heights in zip(files.values(), (self.heights, other.heights)):
            np.save(file, heights)
        both = {**{name: value for name, value in second.items() if name not in OF_SECOND}, **first, **files,
                "file2_flip": False, **own}
        return Surface(both, None, both.pop("length_unit", None), folder)


def maker(function: Callable[Parameters, Surface]) -> Callable[Parameters, Surface]:
    """The function of a kind: an unknown name is an error at once, and decks have the keys that are given."""
    known = inspect.signature(function).parameters

    @functools.wraps(function)
    def make(*none: Parameters.args, **given: Parameters.kwargs) -> Surface:
        for name in given:
            if name not in known:
                raise ValueError(f"{function.__name__}: {unknown_key(name, list(known))}")
        return Surface({**function(*none, **given).keys, **given})

    return make


def unknown_key(name: str, own: Sequence[str]) -> str:
    """That a surface has no such key, and the nearest one, of its own or, if none of them is near, of solve."""
    others = [key for group, known in keys().items() if group != "surface" for key in known]
    if name in others:
        return f"there is no key {name!r}: it is an option of solve"
    if not slips(name, own) and (near := slips(name, others)):
        return f"there is no key {name!r}; did you mean {near[0]!r}, an option of solve?"
    return unknown("key", name, own, meanings(["surface"]))


def meanings(groups: Iterable[str]) -> dict[str, str]:
    """What the keys of these groups mean."""
    return {name: key["meaning"] for group in groups for name, key in keys()[group].items()}


def unknown(what: str, name: object, names: Iterable[object],
            meanings: Mapping[str, str] = MappingProxyType({})) -> str:
    """That there is no such name, and what may be meant, or all names if they are few. meanings: of names, in which
    other words for a quantity are looked for."""
    texts = list(map(str, names))
    near = list(map(repr, nearest(str(name), texts, meanings)))
    few = f"; there are {', '.join(texts)}" if texts and len(texts) <= FEW else ""
    return f"there is no {what} {name!r}" + (
        f"; did you mean {', '.join(near[:-1])}{' or '*(len(near) > 1)}{near[-1]}?" if near else few)


def nearest(name: str, names: Sequence[str], meanings: Mapping[str, str]) -> list[str]:
    """The names that may be meant, by the first of these that finds one: that which has all words of the name, best at
    its end; those that differ by slips; that whose words differ by slips; that which has the name in it, best at its
    beginning; those whose meanings have its rarest word."""
    low = name.lower()
    words = [word for word in low.split("_") if word]
    if not words:
        return []

    def with_words(is_same: Callable[[str, str], bool]) -> list[str]:
        split = {one: one.lower().split("_") for one in names}
        have = [one for one, parts in split.items()
                if all(any(is_same(word, part) for part in parts) for word in words)]
        return sorted(have, key=lambda one: (not is_same(words[-1], split[one][-1]), len(one)))[:1]

    is_long = len(low) >= SHORTEST[0]
    if near := (with_words(str.__eq__) if is_long else []) or slips(name, names)[:1] or with_words(
            lambda word, part: bool(slips(word, [part]))):
        return near[:MOST]
    if is_long and (parts := [one for one in names if low in one.lower()]):
        return [min(parts, key=lambda one: (not one.lower().startswith(low), len(one)))]
    meant = [[one for one in names if word in meanings.get(one, "").lower().replace("'", "")]
             for word in words if len(word) >= SHORTEST[1]]
    rarest = min(filter(None, meant), key=len, default=[])
    return rarest[:MOST] if len(rarest) <= 2*MOST else []


def slips(name: str, names: Iterable[str]) -> list[str]:
    """The names, nearest first, of which few letters are wrong or swapped."""
    low = {one.lower(): one for one in names}
    return [low[one] for one in difflib.get_close_matches(name.lower(), low, MOST, CLOSE)]
