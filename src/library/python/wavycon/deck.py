"""Surfaces, and decks in memory. Groups, keys and kinds are those of the library."""
import dataclasses
import difflib
import inspect
import re
from collections.abc import Iterable, Mapping
from numbers import Integral, Real

import numpy as np

from .library import keys, reals

# Names of functions for kinds whose own name says too little in Python.
KINDS_BY_NAME = {"wave_sum": "sum"}


@dataclasses.dataclass(frozen=True, eq=False)
class Surface:
    """A surface: keys of &surface, heights in memory, and the unit of length of its file, if it names one."""

    keys: dict
    heights: np.ndarray | None = None
    length_unit: str | None = None
    folder: object = None   # of a file that was made, which lives as long as the surface

    def __repr__(self):
        shape = "" if self.heights is None else f"array of shape {self.heights.shape}, "
        return f"Surface({shape}{', '.join(f'{key}={value!r}' for key, value in self.keys.items())})"


def heights(h, *, length_unit: str | None = None, **keys_of_maps) -> Surface:
    """A surface of heights in memory.

    h: heights [length] upwards to the other body, shape (y, x) or, of a profile, (x,). NaN and masked values are
    missing heights. length_unit: the unit of all lengths, a label. keys_of_maps: those of a map, such as length_x,
    length_y [length], height_scale, detrend, fill_missing and edges; help(wavycon.file) has them all.
    """
    h = reals(h)
    if h.ndim not in (1, 2) or h.size == 0:
        raise ValueError(f"heights must have the shape (y, x) or (x,), got {h.shape}")
    return Surface({"kind": "file", "file": "heights", **keys_of_maps}, np.atleast_2d(h), length_unit)


def maker_of_kind(name):
    """The function that makes surfaces of a kind, described by the library; AttributeError if there is no such kind."""
    kind = KINDS_BY_NAME.get(name, name)
    of_surface = keys()["surface"]
    if kind not in of_surface["kind"]["choices"]:
        raise AttributeError(f"module 'wavycon' has no attribute '{name}'")
    own = [key for key in of_surface.values() if kind in key.get("read_by", ())]

    def make(**given) -> Surface:
        return Surface({"kind": kind, **given})

    meaning = re.search(rf"'{kind}': (.*?)\.(?= '|$)", of_surface["kind"]["meaning"])
    make.__doc__ = (meaning[1] if meaning else kind) + ".\n\n" + "\n".join(describe(key) for key in own)
    make.__name__ = make.__qualname__ = name
    make.__signature__ = inspect.Signature(
        [inspect.Parameter(key["name"], inspect.Parameter.KEYWORD_ONLY, default=Default(key["default"]))
         for key in own], return_annotation=Surface)
    return make


class Default(str):
    """A default as a deck would give it, for signatures."""

    __repr__ = str.__str__


def describe(key):
    """A key in a line, for docstrings."""
    unit = f" [{key['unit']}]" if key["unit"] else ""
    choices = f" One of {', '.join(map(repr, key['choices']))}." if "choices" in key else ""
    default = f" Default: {key['default']}." if key["default"] else ""
    return f"{key['name']}{unit}: {key['meaning']}{choices}{default}"


def sort_keys(given: Mapping) -> dict:
    """Keys by groups: a mapping under the name of a group has keys of it; others belong to the group that has them."""
    groups: dict = {}
    others = {group: known for group, known in keys().items() if group != "surface"}
    for name, value in given.items():
        if isinstance(value, Mapping) and name in others:
            groups.setdefault(name, {}).update(value)
            continue
        owners = [group for group, known in others.items() if name in known]
        if len(owners) != 1:
            raise ValueError(f"several groups have a key '{name}': give one of {', '.join(owners)}={{...}}" if owners
                             else unknown("key", name, [key for known in others.values() for key in known]))
        if value is not None:
            groups.setdefault(owners[0], {})[name] = value
    return groups


def unknown(what, name, names):
    near = difflib.get_close_matches(name, names, 1)
    return f"there is no {what} '{name}'" + (f"; did you mean '{near[0]}'?" if near else "")


def deck_text(groups: Mapping) -> str:
    """The text of a deck. Keys that are None are left out, and groups of nothing else."""
    lines = []
    for group, given in groups.items():
        values = [f"  {key} = {value_text(value)}" for key, value in given.items() if value is not None]
        if values or not given:
            lines += [f"&{group}", *values, "/"]
    return "\n".join(lines) + "\n"


def value_text(value, in_list=False) -> str:
    """A value as a deck has it."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, str):
        if not value.isprintable():
            raise ValueError(f"a text must not have control characters, got {value!r}")
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool):
        return f".{value}.".lower()
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    if isinstance(value, Iterable) and not isinstance(value, (bytes, Mapping)) and not in_list:
        return ", ".join(value_text(one, in_list=True) for one in value)
    raise ValueError(f"a value must be a number, a text, a truth value or a list of these, got {value!r}")
