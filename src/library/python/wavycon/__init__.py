"""wavycon: elastic contact of wavy and rough surfaces.

    import wavycon as wc
    results = wc.solve(wc.wave_2d(amplitude=1e-6, wavelength=1e-3), e_star=2e11, mean_pressure=[1e7, 1e8])
    results.contact_area_fraction, results[1].pressure

A function for each kind of surface, such as wave_2d, hexagonal, wave_sum, self_affine and file, and heights for arrays,
read for files of instruments; solve, run and sweep; certify for the answers of any code; load for saved results; keys
for all that decks can say; Note, the warnings.
Lengths are in any one unit, pressures in any one unit.
"""
from . import library as _library
from .deck import KINDS_BY_NAME as _KINDS_BY_NAME
from .deck import Surface, heights, maker_of_kind
from .files import read
from .library import Note, keys
from .programs import sweep
from .results import Bounds, Result, Results, certify, load, run, solve

__version__ = _library.text(None, "version")
__all__ = ["Bounds", "Note", "Result", "Results", "Surface", "certify", "heights", "keys", "load", "read", "run",
           "set_threads", "solve", "sweep"]


def set_threads(number: int) -> None:
    """Sets the number of threads that work on large grids, 1 unless set."""
    _library.call("set_threads", number)


def __getattr__(name):
    return maker_of_kind(name)


def __dir__():
    return [*__all__, "__version__", *_KINDS_BY_NAME, *keys()["surface"]["kind"]["choices"]]
