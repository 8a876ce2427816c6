"""The functions of the shared library, by ctypes, which lets other threads run meanwhile. wavycon.h documents them.

Errors are exceptions: ValueError for what is wrong in a call, OSError for files and memory, with the library's message.
"""
import functools
import importlib
import json
import re
import sys
import threading
import warnings
from ctypes import CDLL, CFUNCTYPE, byref, c_char_p, c_double, c_int, c_size_t, c_void_p, create_string_buffer
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
Rows: TypeAlias = npt.NDArray[Any]   # of tables: structured arrays

PROGRESS = CFUNCTYPE(c_int, c_void_p, c_int, c_double)
# Types of wavycon.h; all others are pointers, and functions that return pointers make objects.
TYPES = {"int": c_int, "double": c_double, "size_t": c_size_t, "const char *": c_char_p, "wavycon_progress": PROGRESS,
         "void": None}

folders = map(Path, sys.modules[__package__].__path__)
path = next(path for folder in folders for path in folder.glob("libwavycon.*"))
lib = CDLL(str(path))
header = path.with_name("wavycon.h").read_text(encoding="utf-8")
for _result, _name, _arguments in re.findall(r"^(\w+) (wavycon_\w+)\((?:void|([^)]+))\);", header, re.MULTILINE):
    _types = map(str.strip, re.findall(r"([^,]+?)\w+(?:,|$)", _arguments))   # of each argument, without its name
    getattr(lib, _name).restype = TYPES.get(_result, c_void_p)
    getattr(lib, _name).argtypes = [TYPES.get(one, c_void_p) for one in _types]


class Note(UserWarning):
    """What the program notes of a surface, a load or a table."""


class Handle:
    """An object of the library, which ends with this one."""

    def __init__(self, pointer: int | None) -> None:
        self._as_parameter_ = c_void_p(pointer)

    def __reduce__(self) -> str:
        raise TypeError("what the library holds in memory cannot be copied or pickled: make a problem in each process")

    def __del__(self, delete: Any = lib.wavycon_delete) -> None:
        delete(byref(self._as_parameter_))


_own = threading.local()   # each thread has an error object of its own


def call(name: str, *arguments: Any) -> Any:
    """Calls a function by its name without 'wavycon_', without its first argument."""
    if not hasattr(_own, "error"):
        _own.error = Handle(lib.wavycon_new_error())
    if cut := [one for one in arguments if isinstance(one, bytes) and b"\0" in one]:
        text = cut[0].decode(errors="replace")
        raise ValueError(f"a text must not have a null character, which ends it, got {text!r}")
    function = getattr(lib, f"wavycon_{name}")
    answer = function(_own.error, *arguments)
    code = lib.wavycon_get_code(_own.error)
    if code:
        message = create_string_buffer(lib.wavycon_get_message(_own.error, None, 0))
        lib.wavycon_get_message(_own.error, message, len(message))
        raise (ValueError if code == 1 else OSError)(message.value.decode())
    return Handle(answer) if function.restype is c_void_p else answer


def number(thing: Handle, name: str) -> float:
    value = c_double()
    call("get", thing, name.encode(), byref(value))
    return value.value


def text(thing: Handle | None, name: str) -> str:
    return copied("get_text", thing, name.encode())


def copied(function: str, *arguments: Any) -> str:
    """The text that a function copies to a buffer."""
    buffer = create_string_buffer(call(function, *arguments, None, 0))
    call(function, *arguments, buffer, len(buffer))
    return buffer.value.decode()


def tell(notes: list[str]) -> list[str]:
    """Warns of notes, at the line that called this package; returns them."""
    frame: Any = sys._getframe()
    level = 1
    while frame.f_globals.get("__name__", "").partition(".")[0] in (__package__, "functools") and frame.f_back:
        frame, level = frame.f_back, level + 1
    for note in notes:
        warnings.warn(note, Note, level)
    return notes


def table(solution: Handle, name: str, load: int) -> tuple[Rows, dict[str, str]]:
    """A table of a solution, the load of this number, as a structured array, and the units of its columns."""
    handle = call("new_table", solution, str(name).encode())
    words = np.array(text(handle, "words").splitlines() or [""])
    units = dict(column.rstrip("]").split("[") for column in text(handle, "columns").splitlines())
    kinds: list[Any] = [words.dtype if unit == "word" else int if column == "load" else float
                        for column, unit in units.items()]
    rows = np.empty(int(number(handle, "rows")), list(zip(units, kinds)))
    values = np.empty(len(rows))
    for column, unit in units.items():
        call("get_column", handle, column.encode(), len(rows), address(values))
        rows[column] = words[values.astype(int) - 1] if unit == "word" else \
            np.where(values > 0, load, 0) if column == "load" else values   # 0: rows that belong to no load
    return locked(rows), units


def reals(array: npt.ArrayLike) -> Array:
    """An array of real numbers, contiguous doubles, masked ones NaN. Errors: ValueError for anything else."""
    given: Any = np.ma.asanyarray(array)
    if given.dtype.kind not in "biuf":
        raise ValueError(f"an array of real numbers is needed, got {type(array).__name__} of the type {given.dtype}; "
                         "array.astype(float) may make one")
    filled: Array = np.ma.filled(given.astype(float), np.nan)   # a copy
    return np.asarray(filled, order="C")


def one_number(name: str, value: Any) -> float:
    """The value of this name. Errors: ValueError if it is not one number."""
    if value is None or isinstance(value, str) or np.ndim(value):
        raise ValueError(f"{name} must be one number, got {value!r}")
    return float(value)


def locked(array: Rows) -> Rows:
    """The array, which can be read alone: what a result has is not changed by chance."""
    array.flags.writeable = False
    return array


def need(name: str, extra: str) -> Any:
    """Another package. Errors: ImportError that says what to install."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.split(".")[0]
        is_absent = isinstance(error, ModuleNotFoundError) and error.name in (package, name)
        raise ImportError(f"this needs {package}: pip install 'wavycon[{extra}]'" if is_absent else
                          f"{package} is installed, but cannot be imported: {error}") from error


def address(array: Array | None) -> int | None:
    """Where the numbers of an array are; the array must outlive it. NULL for None."""
    return None if array is None else array.ctypes.data


@functools.cache
def keys() -> dict[str, dict[str, dict[str, Any]]]:
    """All keys of decks: keys()[group][key] has type, unit, default, bounds, choices and meaning."""
    return {group["name"]: {key["name"]: key for key in group["keys"]} for group in json.loads(text(None, "keys"))}
