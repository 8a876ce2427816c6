"""Files of instruments, read by SurfaceTopography; files that are written."""
from __future__ import annotations

import argparse
import contextlib
import logging
import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, Any, cast

import numpy as np

from . import names
from .deck import deck_text, heights, scene_of
from .library import Array, Note, need, number, reals, tell
from .surfaces import SIDES, Surface, check_names, unit_name

# Of the files that are written, by the ends of their names.
BEGINNINGS = {".npy": b"\x93NUMPY", ".gsf": b"Gwyddion Simple Field 1."}
# The units of length that are converted, by powers of 10 m.
LENGTHS = {"Gm": 9, "Mm": 6, "km": 3, "m": 0, "cm": -2, "mm": -3, "um": -6, "nm": -9, "Å": -10, "A": -10, "pm": -12,
           "fm": -15}
REMEDY = "Gwyddion may open it and save it as .gsf"
LARGEST = 1e90   # the largest height of the program; some formats have the largest double where heights are missing


def read(file: str | os.PathLike[str], channel: str | int | None = None, *, length_unit: str | None = None,
         **keys_of_maps: names.Unpack[names.Map]) -> Surface:
    """A surface from a file of any format that SurfaceTopography opens, with the sides and the unit of the file.

    channel: name, or number in the file, from 0, of one of several; without it the first one of heights. Channels
    in degrees, volts and other units that are no lengths are refused. length_unit: to which the file's lengths are
    converted, or, if it names none, what theirs is called. keys_of_maps: those of a map, such as detrend,
    fill_missing and edges, and length_x, length_y [length] if the file does not have the sides; help(wavycon.file)
    has them all. missing_value is in the unit of the heights that are returned. Files .gsf and
    .npy need no SurfaceTopography; arrays in .npy have the shape (y, x) or (x,), as in wavycon.heights. Texts that
    it reads otherwise than the program, or without it all, are read as by wavycon.file.
    """
    check_names("read", keys_of_maps, [*names.Map.__annotations__, "length_unit", "channel"])
    opened = open_file(file, channel, length_unit)
    if not opened:
        if channel not in (None, 0):
            raise ValueError(f"there is no channel {channel!r}: such a file has one, which has no name")
        surface = Surface(names.file(file=os.path.abspath(file), **keys_of_maps).keys, None, length_unit)
        try:
            scene_of(surface, {}, keep_fields=False)   # an error if the program cannot read it
        except ValueError as error:
            # It sends files of instruments back to this package.
            if "wavycon-convert" not in str(error) or not (words := refusal(file)):
                raise
            raise ValueError(f"{file}: SurfaceTopography cannot read it: {words}; {REMEDY}") from None
        return surface
    x, z, sides, unit = opened
    z[np.isfinite(z) & (abs(z) > LARGEST)] = np.nan
    if (missing := keys_of_maps.pop("missing_value", None)) is not None:
        z[np.isin(z, [missing, float(np.float32(missing))])] = np.nan   # as the program has it
    for key in *sides, "file_format", "file2":
        if keys_of_maps.get(key) is not None:
            why = f"the file has {sides[key]:g} {unit or ''}" if key in sides else "it is for wavycon.file"
            raise ValueError(f"{file}: leave out {key}: {why}".rstrip())
    if unit and keys_of_maps.get("height_scale") is not None:
        tell([f"{file}: the file names the unit of its heights, and height_scale multiplies them as well"])
    try:
        sides = sides if x is None else {}
        return heights(z, x=x, length_unit=unit, **cast(names.Map, {**keys_of_maps, **sides}))
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def open_file(file: str | os.PathLike[str], channel: str | int | None,
              unit: str | None = None) -> tuple[Array | None, Array, dict[str, float], str | None] | None:
    """What a file holds, in a unit of length if one is given: the places of unequal steps (None: equal steps), the
    heights (y, x) or (x,), NaN where they are missing, the sides as keys, none where the file lacks them, and the unit
    (None: unknown). None for a file that the program reads, or tells best what is wrong with it. Errors: ValueError."""
    if not isinstance(file, (str, os.PathLike)):
        raise ValueError(f"the name of a file is needed, got {type(file).__name__}: wavycon.heights takes an array")
    if not os.path.isfile(file):
        raise FileNotFoundError(f"{file}: {'this is no file' if os.path.exists(file) else 'there is no such file'}")
    if not (start := first_bytes(file, 65536)):
        raise ValueError(f"{file}: the file is empty")
    if start.startswith(BEGINNINGS[".gsf"]):
        return None
    if start.startswith(BEGINNINGS[".npy"]):
        # SurfaceTopography takes the first index of an array for x, the program for y.
        try:
            return None, reals(np.load(file)), {}, unit
        except (MemoryError, ValueError) as error:
            raise ValueError(f"{file}: {error}") from None
    try:
        opened = need("SurfaceTopography", "files").open_topography
    except ImportError:
        if b"\0" in start:
            raise
        return None   # a text
    logging.getLogger("igor2").setLevel(logging.CRITICAL)   # with its errors it logs all bytes of the file
    try:
        with opened(os.fspath(file)) as reader:
            # The number of bytes alone makes the one format, a name the other: of pictures that it does not know.
            if (kind := reader.format()) == "hgt" != file_ending(file) or not reader.channels:
                return None
            if kind == "h5" and file_ending(file) == "nc":
                raise NoHeights("it is NetCDF in the format of HDF5, whose order of axes is not told: "
                                "wavycon.heights(xarray.open_dataarray(file)) reads it")
            info = choose(reader.channels, channel)
            known = info.physical_sizes is not None
            if kind == "asc" and known and not info.unit:
                return None   # a head of which the reader knows some lines, and the program perhaps all
            # Maps of one size, one below the other, have heads in words between them.
            are_blocks = len(points := [one.nb_grid_pts for one in reader.channels]) > 1 == len(set(points))
            topography = info.topography(**({} if known else {"physical_sizes": (1.0,)*info.dim}))
            own, unit = unit_name(topography.unit), unit_name(unit) or unit_of_sides(info)
            if unit and own and not {own, unit} <= LENGTHS.keys():
                raise NoHeights(f"{unit!r} is no unit to which {own!r} is converted: units are {', '.join(LENGTHS)}")
            factor = float(f"1e{LENGTHS[own] - LENGTHS[unit]}") if unit and own else 1.0
            z: Array = factor*np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan).T
            # NetCDF tells the order of the axes, of which the reader takes the first one for x.
            z = z.T if getattr(getattr(reader, "_heights_var", None), "dimensions", None) == ("y", "x") else z
            x = None if topography.is_uniform else factor*np.asarray(topography.positions())
            sides = [factor*float(side) for side in (topography.physical_sizes if known else ())]
    except Exception as error:
        # Its readers raise whatever their formats bring about.
        if type(error).__name__ == "CannotDetectFileFormat":
            return None
        words = f"SurfaceTopography cannot read it: {in_line(type(error), error)}; {REMEDY}"
        raise ValueError(f"{file}: {error if isinstance(error, NoHeights) else words}") from error
    # The readers of texts leave out lines that are no rows, in silence, take inf for missing, coordinates for heights.
    if kind in ("asc", "xyz") and not are_blocks and (x is not None or not agrees(file, z.size, known)):
        return None
    return x, z, dict(zip(SIDES, sides)), unit or own or None


def file_ending(file: str | os.PathLike[str]) -> str:
    return Path(file).suffix[1:].lower()


def in_line(kind: type[Any], error: Exception) -> str:
    return " ".join(f"{kind.__name__}: {str(error).strip()}".splitlines()[0].split())


def refusal(file: str | os.PathLike[str]) -> str | None:
    """What the reader of SurfaceTopography for the ending of a file says of it; None without such a reader."""
    for reader in need("SurfaceTopography.IO", "files").readers:
        if file_ending(file) in (reader.format(), *reader.file_extensions()):
            try:
                reader(os.fspath(file))
            except Exception as error:
                return in_line(reader, error)
            return "it finds no heights"
    return None


def first_bytes(file: str | os.PathLike[str], number: int = 32) -> bytes:
    with open(file, "rb") as opened:
        return opened.read(number)


def agrees(file: str | os.PathLike[str], points: int, has_sides: bool) -> bool:
    """Whether the program reads so many heights from a text, and sides if it has them."""
    surface = Surface({"kind": "file", "file": os.path.abspath(file), "fill_missing": "harmonic"})
    try:
        scene = scene_of(surface, {}, keep_fields=False)
    except ValueError:
        return False
    return (number(scene, "points_x")*number(scene, "points_y"), number(scene, "has_sides")) == (points, has_sides)


class NoHeights(Exception):
    """There is no such channel, or it has no heights."""


def choose(channels: Sequence[Any], channel: str | int | None) -> Any:
    """One of the channels of a file, by its name or number; the first one of a name, and the first one of heights if
    none is given. Errors: NoHeights."""
    heights = {place: one for place, one in enumerate(channels) if has_heights(one)}
    named = {place: one for place, one in enumerate(channels) if channel in (None, place, one.name)}
    if chosen := [one for place, one in named.items() if place in heights]:
        return chosen[0]
    fault = f"there is no channel {'of heights' if channel is None else repr(channel)}"
    if named:
        words = ", ".join(f"the channel {place} {one.name!r} is in {unit_of(one)!r}" for place, one in named.items())
        fault = f"{words}, which is no length ({', '.join(LENGTHS)})"
    there_are = ", ".join(f"{place} {one.name!r}" for place, one in heights.items()) or "none"
    raise NoHeights(f"{fault}; channels of heights: {there_are}")


def unit_of(channel: Any) -> Any:
    """The unit of the values of a channel; None if the file does not tell it."""
    told = getattr(channel, "data_unit", None) or channel.unit
    # Some readers tell the units of places and values together.
    return told[-1] if isinstance(told, tuple) else told


def unit_of_sides(channel: Any) -> str | None:
    """The unit of length of the sides in a text or a file .sur, which the reader converts to that of the heights."""
    told = channel.info.get("raw_metadata")
    unit = unit_name(told.get("xunit") or told.get("delta_x_unit")) if isinstance(told, dict) else None
    return unit if unit in LENGTHS and unit_name(channel.unit) in LENGTHS else None


def has_heights(channel: Any) -> bool:
    """Whether the values of a channel, and its sides, are lengths as far as its file tells."""
    return all(not unit or unit_name(unit) in LENGTHS for unit in (unit_of(channel), channel.unit)) and bool(
        getattr(channel, "is_height_channel", True))


@contextlib.contextmanager
def written(path: str, begin: bytes = b"", *inputs: str) -> Iterator[IO[bytes]]:
    """A binary file that takes the place of `path` when it is complete. It replaces no input and nothing that is no
    file or begins in another way. Errors: OSError."""
    if os.path.exists(path) and (not os.path.isfile(path) or first_bytes(path, len(begin)) not in (begin, b"") or
                                 any(os.path.samefile(path, one) for one in inputs)):
        raise FileExistsError(f"{path}: this is another file than would be written; it is not replaced")
    folder, name = os.path.split(os.path.realpath(path))
    part = os.path.join(folder, f".{name}.{os.getpid()}.part")
    try:
        with open(part, "xb") as file:
            yield file
        os.replace(part, os.path.join(folder, name))
    except BaseException as error:
        if isinstance(error, OSError) and error.filename == part:
            error.filename = path
        with contextlib.suppress(FileNotFoundError):
            os.unlink(part)
        raise


def write_gsf(file: IO[bytes], z: Array, sides: dict[str, float], unit: str | None) -> None:
    """Gwyddion's simple field: a head, filled with 1 to 4 null characters to a multiple of 4 bytes, and float32. The
    heights are written over their mean, which may be so large that float32 does not tell them apart."""
    lines = {"XRes": z.shape[1], "YRes": z.shape[0], "XReal": sides.get("length_x"), "YReal": sides.get("length_y"),
             "XYUnits": unit, "ZUnits": unit}
    told = "".join(f"{name} = {value}\n" for name, value in lines.items() if value is not None)
    head = f"Gwyddion Simple Field 1.0\n{told}".encode()
    file.write(head + bytes(4 - len(head) % 4) + (z - np.nanmean(z)).astype("<f4").tobytes())


def convert(arguments: list[str] | None = None) -> None:
    """The command wavycon-convert."""
    parser = argparse.ArgumentParser(prog="wavycon-convert", description="Converts a file of an instrument for decks.")
    parser.add_argument("file", help="of any format that SurfaceTopography opens")
    parser.add_argument("map", help="to be written: .gsf with sides and units, heights over their mean in "
                        "single precision, .npy with all digits")
    parser.add_argument("--channel", help="name or number of one of several channels")
    parser.add_argument("--unit", help="of length, to which the file's lengths are converted, such as um")
    given = parser.parse_args(arguments)
    channel = int(given.channel) if given.channel and given.channel.isdecimal() else given.channel
    try:
        with warnings.catch_warnings(record=True) as notes:
            warnings.simplefilter("always")
            surface = read(given.file, channel, length_unit=given.unit, fill_missing="harmonic")
        sys.stderr.writelines(f"wavycon-convert: note: {note.message}\n" for note in notes
                              if issubclass(note.category, Note))
        if surface.in_memory is None:
            raise ValueError(f"{given.file}: decks read this file as it is")
        rows, unit, kind = surface.in_memory, surface.length_unit, Path(given.map).suffix
        sides = {key: surface.keys[key] for key in SIDES if key in surface.keys}
        if kind not in BEGINNINGS:
            raise ValueError(f"{given.map}: the name must end in .gsf or .npy")
        if kind == ".gsf" and not sides:
            raise ValueError(f"{given.file} does not have the sides, which a file .gsf needs: write a file .npy")
        with written(given.map, BEGINNINGS[kind], given.file) as file:
            if kind == ".npy":
                np.save(file, rows)
            else:
                write_gsf(file, rows, sides, unit)
    except (ImportError, OSError, ValueError) as error:
        sys.exit(f"wavycon-convert: {error}")
    print(deck_text({"scene": {"length_unit": unit}, "surface": {
        "kind": "file", "file": given.map, **(sides if kind == ".npy" else {})}}), end="")
