"""wavycon: elastic contact of wavy and rough surfaces.

    import wavycon as wc
    results = wc.solve(wc.wave_2d(amplitude=1e-6, wavelength=1e-3), e_star=2e11, mean_pressure=[1e7, 1e8])
    results.contact_area_fraction, results[1].pressure

A function for each kind of surface, such as wave_2d, hexagonal, wave_sum, self_affine and file, and heights for arrays,
read for files of instruments; solve, run and sweep; problem for many loads one after the other; certify for the answers
of any code; load for saved results; Settings and Load, all keys of decks, and keys, the same as dictionaries; Note, the
warnings. Lengths are in any one unit, pressures in any one unit.
"""
import copy as _copy
import operator as _operator
from typing import Any as _Any

from . import library as _library
from . import names as _names
from .deck import heights
from .files import read
from .library import Note
from .names import *  # noqa: F403
from .programs import sweep
from .results import Result, Results, Roughness, load
from .solving import Bounds, Problem, certify, problem, run, solve
from .surfaces import Surface

__all__ = ["Bounds", "Note", "Problem", "Result", "Results", "Roughness", "Surface", "certify", "get_include",
           "heights", "keys", "load", "problem", "read", "run", "set_threads", "solve", "sweep"]
__all__ += _names.__all__
__version__ = _library.text(None, "version")


def get_include() -> str:
    """The folder of wavycon.h, and of the library libwavycon, for programs in C."""
    return str(_library.path.parent)


def keys() -> dict[str, dict[str, dict[str, _Any]]]:
    """All keys of decks: keys()[group][key] has type, unit, default, bounds, choices and meaning."""
    return _copy.deepcopy(_library.keys())


def set_threads(number: int) -> None:
    """Sets the number of threads that work on large grids, 1 unless set."""
    _library.call("set_threads", _operator.index(number))
