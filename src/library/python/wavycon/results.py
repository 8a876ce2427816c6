"""Solving, and the results: numbers by the names of columns, fields, tables."""
import contextlib
import json
import os
import signal
import threading
from collections.abc import Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from . import library, pictures
from .deck import Surface, deck_text, sort_keys, value_text
from .files import written
from .library import address, call, keys, reals

FACTS = ("e_star", "p_star", "amplitude", "length_x", "length_y", "points_x", "points_y", "dimension")
WORDS = {"deck": "resolved_deck", **{name: name for name in ("method", "why_chosen", "pressure_unit", "length_unit")}}
FIELDS = ("x", "y", "pressure", "gap", "displacement")


def field(name, meaning) -> property:
    """A property of a result, an array: a field, or the places of its points along an axis."""
    return property(lambda result: result._fields[name], doc=meaning)


class Result:
    """One solved load. The columns of the summary table are its attributes, such as mean_pressure, mean_gap,
    contact_area_fraction, contact_area_fraction_error, status; outputs/README.md describes them."""

    def __init__(self, load, facts, tables, solution=None, scene=None):
        self._load, self._facts, self._tables, self._solution, self._scene = load, facts, tables, solution, scene

    def __getattr__(self, name):
        if name.startswith("_") or name not in (summary := self.table("summary")).dtype.names:
            raise AttributeError(f"a result has no '{name}'; the columns of its summary are in dir()")
        return summary[name][0].item()

    def __dir__(self):
        return [*super().__dir__(), *self.table("summary").dtype.names]

    def __repr__(self):
        return (f"Result(load {self.load}: mean_pressure={self.mean_pressure:.6g}, contact_area_fraction="
                f"{self.contact_area_fraction:.6g}, mean_gap={self.mean_gap:.6g}, status={self.status!r})")

    def table(self, name: str) -> np.ndarray:
        """A table of the program, as a structured array of shape (rows,): 'summary', that of a key of &output, such as
        'spots', 'contours', 'lines', 'map' or 'spectrum', or, with stress={...}, 'stress_largest', 'stress_line',
        'stress_section' or 'stress_planes', with interface={...} 'interface', 'partial_slip', 'slip_loop',
        'slip_map', 'adhesion', 'adhesion_lines', 'adhesion_map' or 'adhesion_contour'. Made when it is first asked
        for."""
        if name not in self._tables:
            self._tables[name], units = library.table(self._live(name), name, self._load)
            self._facts["units"].update(units)
            if name != "summary":
                note_news(self._scene, self._facts)
        return self._tables[name]

    def _live(self, what):
        if self._solution is None:
            raise ValueError(f"'{what}' was not saved")
        return self._solution

    @cached_property
    def _fields(self):
        solution = self._live("fields")
        points, offset = (np.array([library.number(solution, f"map_{kind}_{axis}") for axis in "xy"])
                          for kind in ("points", "offset"))
        columns, rows = map(int, points)
        fields = [np.empty((rows, columns)) for _ in FIELDS[2:]]
        call("get_grid", solution, columns, rows, address(offset), *map(address, fields))
        sides = self._facts["length_x"], self._facts["length_y"]
        places = [side*(np.arange(number) + first)/number for side, number, first in zip(sides, points, offset)]
        return dict(zip(FIELDS, [*places, *fields]))

    x = field("x", "Places of the columns of fields [length], shape (x,).")
    y = field("y", "Places of the rows of fields [length], shape (y,); one for a profile.")
    pressure = field("pressure", """Contact pressure [pressure], shape (y, x), 0 where there is no contact, at the points
        of the program's map: those of a grid that was given, of a height map its own, otherwise as
        output={"map_points": ...} says.""")
    gap = field("gap", "Gap between the deformed surfaces [length], shape (y, x); 0 in contact.")
    displacement = field("displacement", "Elastic displacement, the sum of both bodies, less its mean [length], "
                         "shape (y, x).")

    def fields_at(self, x, y) -> dict[str, np.ndarray]:
        """Pressure [pressure], gap and displacement [length] at points x, y [length], arrays of one shape."""
        solution, (x, y) = self._live("fields"), same_shape(x, y)
        fields = {name: np.empty(x.shape) for name in FIELDS[2:]}
        call("get_fields", solution, x.size, address(x), address(y), *map(address, fields.values()))
        return fields

    def stresses_at(self, x, y, depth, nu: float, lateral: str | None = None) -> dict[str, np.ndarray]:
        """Stresses [pressure] at points x, y, depth [length], arrays of one shape, in a body with Poisson's ratio nu.

        Depths are 0 or more and point into the body, tension is positive. lateral: as the key of &stress. The answer
        has stress, with six components xx, yy, zz, xy, xz, yz along a last axis, stress_error, the estimate of its
        largest error, von_mises, largest_shear, and principal, three along a last axis, the largest first."""
        solution, (x, y, depth) = self._live("stresses"), same_shape(x, y, depth)
        lateral = keys()["stress"]["lateral"]["default"].strip("'") if lateral is None else lateral
        components = {"stress": (6,), "stress_error": (), "von_mises": (), "largest_shear": (), "principal": (3,)}
        parts = {name: np.empty(x.shape + axis) for name, axis in components.items()}
        stress, error, *invariants = map(address, parts.values())
        places = map(address, (x, y, depth))
        call("get_stresses", solution, x.size, *places, nu, lateral.encode(), stress, error)
        call("get_invariants", x.size, stress, *invariants)
        return parts

    plot_map = pictures.plot_map
    plot_stress_section = pictures.plot_stress_section


class Results(Sequence):
    """The solved loads, in the order in which they were given. Columns of the summary table are arrays over the loads,
    such as results.contact_area_fraction. Facts of the scene: e_star, p_star [pressure], amplitude (Delta), length_x,
    length_y [length], points_x, points_y, dimension, method, why_chosen, pressure_unit, length_unit, deck, the text of
    the deck that the program runs to the same numbers, and notes, a list of what the program's log notes of the surface,
    the loads and the tables; each was also a warning, wavycon.Note."""

    def __init__(self, loads, facts):
        self._loads, self._facts = loads, facts

    def __len__(self):
        return len(self._loads)

    def __getitem__(self, load):
        return self._loads[load]

    def __getattr__(self, name):
        if not name.startswith("_") and name in self._facts:
            return self._facts[name]
        if name.startswith("_") or name not in (summary := self.table("summary")).dtype.names:
            raise AttributeError(f"results have no '{name}'")
        return summary[name]

    def __dir__(self):
        return [*super().__dir__(), *self._facts, *self.table("summary").dtype.names]

    def __repr__(self):
        return "\n".join([f"{len(self)} loads, {self.method}", *map(repr, self)])

    def table(self, name: str = "summary") -> np.ndarray:
        """The rows of a table of all loads, see Result.table."""
        return np.concatenate([load.table(name) for load in self])

    def to_dataframe(self, table: str = "summary"):
        """A table of all loads as a frame of pandas. The units of its columns are in frame.attrs['units']."""
        import pandas
        frame = pandas.DataFrame(self.table(table))
        frame.attrs["units"] = {column: self._facts["units"][column] for column in frame}
        return frame

    plot = pictures.plot

    def save(self, file, fields: bool = True) -> None:
        """Saves the summary, all tables that were asked for and, unless told not to, the fields to an .npz file. It appears
        whole or not at all, and replaces no other kind of file."""
        self.table("summary")
        arrays = {f"{load._load}/{name}": rows for load in self for name, rows in load._tables.items()}
        if fields:
            arrays |= {f"{load._load}/fields/{name}": values for load in self for name, values in load._fields.items()}
        if hasattr(file, "write"):
            place = contextlib.nullcontext(file)
        else:
            place = written(os.fspath(file) + ("" if os.fspath(file).endswith(".npz") else ".npz"), b"PK")
        with place as opened:
            np.savez(opened, facts=json.dumps(self._facts), **arrays)


def load(file) -> Results:
    """The results in a file of Results.save. What was not saved cannot be asked for."""
    with np.load(file, allow_pickle=False) as saved:
        facts, loads = json.loads(str(saved["facts"])), {}
        for name in saved.files[1:]:
            number, table, *field = name.split("/")
            one = loads.setdefault(int(number), Result(int(number), facts, {}))
            if field:
                one.__dict__.setdefault("_fields", {})[field[0]] = saved[name]
            else:
                one._tables[table] = saved[name]
    return Results([loads[number] for number in sorted(loads)], facts)


def solve(surface: Surface, *, keep_fields: bool = True, **options) -> Results:
    """Solves loads of a surface.

    options: keys of decks without their groups, such as e_star, e1, nu1 [pressure], accuracy, length_unit; the loads, a
    number or a list, are one of pbar_over_pstar, mean_pressure [pressure], mean_gap [length], contact_area_fraction and
    so on; groups as dictionaries, such as stress={"nu": 0.3}. wavycon.keys() has all. The solver is 'auto' unless one
    is given. keep_fields: False for results without fields, contours and stresses, which are smaller.

    A load that cannot be solved as requested has a status. What is wrong in the options is a ValueError. What a user
    should know of the surface and the results is a warning, Note, and in the results' notes. Ctrl-C ends a solve in the
    main thread.
    """
    return _solve_all(_scene_of(surface, options, keep_fields))


class Bounds(NamedTuple):
    """Guaranteed bounds of the contact of a surface, each (lower, upper); NaN where there is no bound."""

    energy: tuple[float, float]     # complementary energy [pressure*length^3, of a profile pressure*length^2]
    approach: tuple[float, float]   # [length]
    mean_gap: tuple[float, float]   # [length]


def certify(surface: Surface, pressure, gap, *, mean_pressure: float, **options) -> Bounds:
    """Guaranteed bounds of the contact of a surface under a mean pressure, from any pressure and gap, also those of
    another code. They hold for the surface itself, not for its points, and whatever is given: the right answer makes
    them close, a wrong one makes them wide.

    pressure [pressure], gap [length]: of the shape (y, x) or, of a profile, (x,), at equal steps over the whole
    surface, of a height map at its own points or at more. The first point is at x = y = 0, that of a map with
    edges="mirror" half a step further. Negative pressures count as 0, and so do negative gaps unless there is a
    hardness; the pressure is scaled to the mean. options: as of solve, such as e_star.

        one = wc.solve(surface, e_star=2e11, mean_pressure=1e7)[0]
        wc.certify(surface, one.pressure, one.gap, e_star=2e11, mean_pressure=1e7).mean_gap
    """
    pressure, gap = np.atleast_2d(reals(pressure), reals(gap))
    if pressure.ndim != 2 or pressure.shape != gap.shape:
        raise ValueError(f"pressure and gap must have one shape, (y, x) or (x,), got {pressure.shape} and {gap.shape}")
    scene = _scene_of(surface, {"mean_pressure": mean_pressure, **options}, keep_fields=False)
    library.tell(library.text(scene, "notes").splitlines())
    bounds = np.empty((3, 2))
    call("get_bounds", scene, mean_pressure, *pressure.shape[::-1], *map(address, (pressure, gap, bounds)))
    return Bounds(*map(tuple, bounds.tolist()))


def _scene_of(surface, options, keep_fields):
    """The scene of a surface and of options as of solve."""
    if not isinstance(surface, Surface):
        raise ValueError(f"the first argument must be a surface, such as heights(h), got {type(surface).__name__}")
    groups = {"scene": {}, "surface": surface.keys, "method": {}, **sort_keys(options)}
    unit = groups["scene"].setdefault("length_unit", surface.length_unit)
    if surface.length_unit not in (None, unit):
        raise ValueError(f"the lengths of this surface are in {surface.length_unit}, and length_unit={unit!r} would only "
                         "rename them: leave it out, or give it to the function that made the surface")
    if not groups.get("load"):
        raise ValueError(f"there is no load: give one of {', '.join(keys()['load'])}")
    rows, columns = (0, 0) if surface.heights is None else surface.heights.shape
    heights = None if surface.heights is None else address(surface.heights)
    deck = deck_text(groups).encode()
    return call("new_scene", deck, b"wavycon.solve", keep_fields, columns, rows, heights)


def run(deck, set: Mapping = MappingProxyType({}), *, keep_fields: bool = True) -> Results:
    """Solves the loads of a deck file, without writing files.

    set: keys in place of those of the deck, such as {"surface.amplitude": 2e-6, "load.mean_pressure": [1e6, 1e7]}.
    """
    settings = "\n".join(f"{key}={value_text(value)}" for key, value in set.items())
    return _solve_all(call("read_scene", os.fsencode(deck), settings.encode(), keep_fields))


def _solve_all(scene):
    """Solves the loads of a scene in the order of the program, whose digits they have."""
    facts = {"units": {}, "notes": [], **{name: library.number(scene, name) for name in FACTS},
             **{name: library.text(scene, text) for name, text in WORDS.items()}}
    loads = {}
    with _stopped_by_ctrl_c(scene) as stopped:
        for number in map(int, library.text(scene, "order").split()):
            if not stopped:
                loads[number] = Result(number, facts, {}, call("solve_load", scene, number - 1), scene)
    note_news(scene, facts)
    return Results([loads[number] for number in sorted(loads)], facts)


def note_news(scene, facts):
    """Warns of what the library notes of a scene, and adds it to the notes, unless it is there."""
    news = [note for note in library.text(scene, "notes").splitlines() if note not in facts["notes"]]
    facts["notes"] += library.tell(news)


@contextlib.contextmanager
def _stopped_by_ctrl_c(scene):
    """Meanwhile Ctrl-C ends the load that is being solved; KeyboardInterrupt follows at the end. An exception cannot
    leave a callback, so the signal must not raise one there. Signals come to the main thread alone."""
    stopped: list = []
    if threading.current_thread() is not threading.main_thread() or not callable(signal.getsignal(signal.SIGINT)):
        yield stopped
        return
    ask = library.PROGRESS(lambda *_: bool(stopped))
    call("set_progress", scene, ask, None)
    before = signal.signal(signal.SIGINT, lambda *_: stopped.append(True))
    try:
        yield stopped
    finally:
        signal.signal(signal.SIGINT, before)
        call("set_progress", scene, library.PROGRESS(), None)
    if stopped:
        raise KeyboardInterrupt


def same_shape(*arrays):
    """Arrays of numbers of one shape, contiguous."""
    shape = np.broadcast_shapes(*map(np.shape, arrays))
    return [reals(array, shape=shape) for array in arrays]
