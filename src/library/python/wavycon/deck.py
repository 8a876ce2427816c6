"""Decks in memory. Groups and keys are those of the library."""
from __future__ import annotations

import keyword
import os
import tempfile
from collections.abc import Iterable, Mapping
from numbers import Integral, Real
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from . import names
from .library import Handle, address, call, keys, reals
from .surfaces import SIDES, Surface, check_names, unit_name, unknown

NEAR = 1e-3   # steps by which places of points may be off, which may have been computed in single precision


def heights(h: npt.ArrayLike, *, x: npt.ArrayLike | None = None, length_unit: str | None = None,
            **keys_of_maps: names.Unpack[names.Map]) -> Surface:
    """A surface of heights in memory.

    h: heights [length] upwards to the other body, shape (y, x) or, of a profile, (x,); of xarray's axes the names x and
    y tell which is which, and coordinates of these names have the sides, a step for each point, unless sides are given.
    NaN and masked values are missing heights. x [length]: the places of a profile's points, which give its side; it is
    resampled if they are not at equal steps. length_unit: the unit of all lengths, a label.
    keys_of_maps: those of a map, such as length_x, length_y [length], height_scale, detrend, fill_missing and edges;
    help(wavycon.file) has them all.
    """
    check_names("heights", keys_of_maps, [*names.Map.__annotations__, "x", "length_unit"])
    if isinstance(h, (str, os.PathLike)):
        raise ValueError(f"heights takes an array, got {h!r}: wavycon.read takes a file")
    given: dict[str, Any] = {**keys_of_maps}
    axes, coordinates = getattr(h, "dims", ()), getattr(h, "coords", {})
    for side, axis in zip(SIDES, sorted(axis for axis, points in zip(axes, np.shape(h)) if points > 1)):
        if axis in ("x", "y") and axis in coordinates and given.get(side) is None:
            steps = np.diff(reals(coordinates[axis]))
            if not np.ptp(steps) <= NEAR*abs(steps[0]):
                raise ValueError(f"the coordinates {axis} do not have equal steps: interpolate, or give length_{axis}")
            given[side] = float(abs(steps.mean())*(steps.size + 1))
    h = reals(h).T.copy() if axes == ("x", "y") else reals(h)
    if h.ndim not in (1, 2) or h.size == 0:
        raise ValueError(f"heights must have the shape (y, x) or (x,), got {h.shape}")
    h = h if h.ndim == 2 and h.shape[1] > 1 else h.reshape(1, -1)   # a column is a profile
    if x is not None:
        if len(h) > 1 or np.shape(x) != (h.size,):
            raise ValueError(f"x must have the places of all points of a profile, got {np.shape(x)} for {h.shape}")
        with tempfile.TemporaryDirectory(prefix="wavycon-") as folder:
            profile = os.path.join(folder, "profile.txt")
            np.savetxt(profile, np.column_stack([reals(x), h[0]]), fmt="%.17g")
            try:
                return Surface(names.file(file=profile, **cast(names.Map, given)).keys, None, length_unit).prepared()
            except ValueError as error:
                raise ValueError(str(error).replace(profile, "x")) from None
    return Surface(names.file(file="heights", **cast(names.Map, given)).keys, h, length_unit)


def sort_keys(given: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Keys by groups: a mapping under the name of a group has keys of it; others belong to the group that has them."""
    groups: dict[str, dict[str, Any]] = {}
    others = {group: known for group, known in keys().items() if group != "surface"}
    for name, value in ((bare(name), value) for name, value in given.items()):
        if name in others:
            groups.setdefault(name, {}).update(dictionary(f"{name} is a group: it", value))
            continue
        owners = [group for group, known in others.items() if name in known]
        if len(owners) != 1:
            known_keys = [key for known in others.values() for key in known]
            if name in keys()["surface"]:
                raise ValueError(f"{name!r} is a key of surfaces: give it to the function that makes the surface")
            if not owners:
                raise ValueError(unknown("key", name, known_keys))
            near = "".join(f", or {key}" for key in known_keys if key[:-1] == name)
            raise ValueError(f"several groups have a key '{name}': give one of {', '.join(owners)}={{...}}{near}")
        if value is not None:
            groups.setdefault(owners[0], {})[name] = value
    return groups


def bare(name: str) -> str:
    """The name of a key that is a word of Python, without the underscore behind it: yield of yield_."""
    return name[:-1] if keyword.iskeyword(name[:-1]) else name


def dictionary(name: str, given: Any) -> Mapping[str, Any]:
    """The keys that are given as a dictionary. Errors: ValueError for anything else."""
    if not isinstance(given, Mapping):
        raise ValueError(f"{name} must be a dictionary of keys and their values, got {given!r}")
    return given


def groups_of(surface: Surface, options: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The groups of a deck of a surface and of options as of solve."""
    if not isinstance(surface, Surface):
        raise ValueError(f"the first argument must be a surface, such as heights(h), got {type(surface).__name__}"
                         + "; run takes the file of a deck, read one of heights"*isinstance(surface, str))
    groups = {"scene": {}, "surface": surface.keys, "method": {}, **sort_keys(options)}
    unit = groups["scene"].setdefault("length_unit", surface.length_unit)
    if surface.length_unit not in (None, unit_name(unit)):
        raise ValueError(f"the lengths of this surface are in {surface.length_unit}, and length_unit={unit!r} would "
                         "only rename them: leave it out; read(file, length_unit=...) converts lengths")
    return groups


def scene_of(surface: Surface, options: Mapping[str, Any], keep_fields: bool) -> Handle:
    """The scene of a surface and of options as of solve."""
    deck, h = deck_text(groups_of(surface, options)).encode(), surface.in_memory
    rows, columns = (0, 0) if h is None else h.shape
    scene: Handle = call("new_scene", deck, b"wavycon.solve", bool(keep_fields), columns, rows, address(h))
    return scene


def deck_text(groups: Mapping[str, Mapping[str, Any]]) -> str:
    """The text of a deck. Keys that are None are left out, and groups of nothing else."""
    lines = []
    for group, given in groups.items():
        values = [f"  {key} = {value_text(key, value)}" for key, value in given.items() if value is not None]
        if values or not given:
            lines += [f"&{group}", *values, "/"]
    return "\n".join(lines) + "\n"


def value_text(key: str, value: object, in_list: bool = False) -> str:
    """The value of a key as a deck has it."""
    if hasattr(value, "__array__"):   # of numpy, pandas, xarray
        value = np.ma.asanyarray(value).tolist()
    if isinstance(value, str):
        if not value.isprintable():
            raise ValueError(f"{key} must not have control characters, got {value!r}")
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool):
        return f".{value}.".lower()
    if isinstance(value, Real):
        return repr(int(value) if isinstance(value, Integral) else float(value))
    if isinstance(value, Iterable) and not isinstance(value, (bytes, Mapping)) and not in_list:
        return ", ".join(value_text(key, one, in_list=True) for one in value)
    raise ValueError(f"{key} must be a number, a text, a truth value or a list of these, got {value!r}"
                     + " in a list"*in_list)
