"""Surfaces, and what the functions that make them have in common."""
from __future__ import annotations

import contextlib
import dataclasses
import functools
import inspect
import unicodedata
from collections.abc import Callable, Iterable, Sequence
from typing import Any, ParamSpec

import numpy as np

from .library import Array, Rows, address, call, copied, keys, number, tell, text

FEW = 30   # names that a message lists
SIDES = "length_x", "length_y"
# Words for the sides of a map or the step of its points, in place of the names of the sides.
SIDE_WORDS = "dx dy extent lx ly pixel sampling sides size sizes spacing step width"
Parameters = ParamSpec("Parameters")


@dataclasses.dataclass(frozen=True, eq=False)
class Surface:
    """A surface: keys of &surface, heights, and the unit of length of its file, if it names one.

    Two surfaces of maps make one, which has the sum of their heights: first + second.flipped()."""

    keys: dict[str, Any]
    in_memory: Array | None = None   # heights
    length_unit: str | None = None   # with µ as u: of one name
    __array_ufunc__ = None   # array + surface is an error of __radd__, not of each number

    def __post_init__(self) -> None:
        object.__setattr__(self, "length_unit", unit_name(self.length_unit))

    def __repr__(self) -> str:
        shape = "" if self.in_memory is None else f"array of shape {self.in_memory.shape}, "
        return f"Surface({shape}{', '.join(f'{key}={value!r}' for key, value in self.keys.items())})"

    def __getattr__(self, name: str) -> Any:
        """A key that is given, such as length_x."""
        if name not in (own := self.__dict__.get("keys", ())):
            remedy = "; prepared() reads its file"*(self.__dict__.get("in_memory") is None and "file" in own)
            known = ", ".join(("heights", "length_unit", *own))
            raise AttributeError(f"this surface has no {name!r}; it has {known}{remedy}")
        return own[name]

    @functools.cached_property
    def heights(self) -> Array:
        """[length] The heights of a map, shape (y, x): those in memory, NaN where they are missing; of a file that the
        program reads those of prepared(). Errors: ValueError as of prepared."""
        return self.prepared().heights if self.in_memory is None else self.in_memory

    def prepared(self) -> Surface:
        """The map as it is solved, its heights in memory: read, without its trend, filled, filtered. Of its keys the
        sides and the edges remain. Errors: ValueError for a surface that is no map, and as of solve."""
        from .deck import scene_of   # which needs this module
        if self.keys.get("kind") != "file":
            raise ValueError("only maps are prepared, turned over and added; results.surface has the heights of others")
        own = {key: value for key, value in self.keys.items() if key in (*SIDES, "edges") and value != "window"}
        if self.in_memory is not None and len(own) == len(self.keys) - len(("kind", "file")):
            return self
        scene = scene_of(self, {}, keep_fields=False)
        tell(text(scene, "notes").splitlines())
        heights = np.zeros((int(number(scene, "points_y")), int(number(scene, "points_x"))))
        if number(scene, "p_star") > 0:   # otherwise it is flat
            table = call("new_table", call("solve", scene, b"mean_pressure", 0.0), b"height")
            call("get_column", table, b"height", heights.size, address(heights))
        # Sides that are assumed remain where they have a meaning: for cut-offs and radii.
        if number(scene, "has_sides") or any(key.startswith(("short_", "long_", "form_")) for key in self.keys):
            own |= {side: number(scene, side) for side in SIDES[:1 if len(heights) == 1 else 2]}
        unit = text(scene, "length_unit")
        return Surface({"kind": "file", "file": "heights", **own}, heights, None if unit == "length" else unit)

    def flipped(self) -> Surface:
        """The map turned over about the y axis, as that of the second body is when it is laid on the first one: the
        last point along x becomes the first. Its heights still rise out of their body. A file is prepared before."""
        whole = self if self.in_memory is not None else self.prepared()
        return dataclasses.replace(whole, in_memory=np.flip(whole.heights, 1).copy())

    def __add__(self, other: Surface) -> Surface:
        """The surface of two bodies: the sum of two maps, each prepared before by its own keys. Errors: ValueError for
        points, sides, edges and units that are not the same."""
        if not isinstance(other, Surface):
            raise TypeError(f"a surface and {type(other).__name__} cannot be added: wavycon.heights takes an array")
        maps = [one if one.in_memory is not None else one.prepared() for one in (self, other)]
        # A map without sides or unit has those of the other one. A file that has sides refuses others.
        for place, (one, more) in enumerate(zip((self, other), maps[::-1])):
            sides = {side: more.keys[side] for side in SIDES if side in more.keys}
            if one.in_memory is None and any(maps[place].keys.get(side) != sides[side] for side in sides):
                with contextlib.suppress(ValueError):
                    maps[place] = dataclasses.replace(one, keys={**sides, **one.keys}).prepared()
            own = maps[place]
            maps[place] = Surface({**sides, **own.keys}, own.heights, own.length_unit or more.length_unit).prepared()
        facts: list[dict[str, Any]] = [{"shape": one.heights.shape, "length_unit": one.length_unit,
                                        "edges": "periodic", **dict.fromkeys(SIDES), **one.keys} for one in maps]
        points = dict(zip(SIDES, maps[0].heights.shape[::-1]))
        convert = "; read(file, length_unit=...) converts a file, heights(factor*h, length_unit=...) an array"
        for name in "shape", "length_unit", *SIDES, "edges":
            own, others = (one[name] for one in facts)
            # Sides of instruments may differ by half a step.
            is_near = name in points and (None in (own, others) or 2*points[name]*abs(own - others) <= own)
            if own != others and not is_near:
                raise ValueError(f"two maps must have the same {name}, got {own!r} and {others!r}"
                                 + convert*(name == "length_unit"))
        return Surface({**maps[1].keys, **maps[0].keys}, maps[0].heights + maps[1].heights, maps[0].length_unit)

    __radd__ = __add__


def maker(function: Callable[Parameters, Surface]) -> Callable[Parameters, Surface]:
    """The function of a kind: an unknown name is an error at once, and decks have the keys that are given."""
    known = inspect.signature(function).parameters

    @functools.wraps(function)
    def make(*none: Parameters.args, **given: Parameters.kwargs) -> Surface:
        check_names(function.__name__, given, known)
        return Surface({**function(*none, **given).keys, **{key: one for key, one in given.items() if one is not None}})

    return make


def unit_name(unit: Any) -> Any:
    """The one name of a unit that has several: µ, the sign and the Greek letter, is u, also where its two bytes were
    taken for two letters; the angstrom is a letter."""
    return unicodedata.normalize("NFKC", unit).replace("\u00c2", "").replace("\u03bc", "u") \
        if isinstance(unit, str) else unit


def check_names(function: str, given: Iterable[str], known: Iterable[str]) -> None:
    """That a function of surfaces has all these names. Errors: ValueError."""
    own = list(known)
    for name in given:
        if name not in own:
            raise ValueError(f"{function}: {unknown_key(name, own)}")


def unknown_key(name: str, own: Sequence[str]) -> str:
    """That a surface has no such key, and what may be meant, of its own or, if that is nearer, of solve."""
    others = [key for group, known in keys().items() if group != "surface" for key in known]
    if name in others:
        return f"there is no key {name!r}: it is an option of solve"
    if SIDES[0] in own and not set(name.lower().split("_")).isdisjoint(SIDE_WORDS.split()):
        return f"there is no key {name!r}; did you mean {SIDES[0]!r} and {SIDES[1]!r}, the sides of the whole cell?"
    near = nearest(name, [*own, *others])
    if near and near[0] not in own:
        return f"there is no key {name!r}; did you mean {near[0]!r}, an option of solve?"
    return unknown("key", name, own)


def nearest(name: object, names: Sequence[str]) -> list[str]:
    """The names that may be meant, also by what keys of these names mean."""
    meanings = {key: told["meaning"] for group in keys().values() for key, told in group.items()}
    lines = "\n".join(names), "\n".join(meanings.get(one, "-") for one in names)
    return copied("get_near_names", *(one.encode() for one in (str(name), *lines))).splitlines()


def unknown(what: str, name: object, names: Iterable[object]) -> str:
    """That there is no such name, and what may be meant, or all names if they are few."""
    texts = list(map(str, names))
    near = list(map(repr, nearest(name, texts)))
    few = f"; there are {', '.join(texts)}" if texts and len(texts) <= FEW else ""
    return f"there is no {what} {name!r}" + (
        f"; did you mean {', '.join(near[:-1])}{' or '*(len(near) > 1)}{near[-1]}?" if near else few)


def column(rows: Rows, name: str) -> Rows:
    """A column of a table. Errors: KeyError."""
    if name not in (rows.dtype.names or ()):
        raise KeyError(unknown("column", name, rows.dtype.names or ()))
    return rows[name]
