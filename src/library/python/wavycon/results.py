"""Results: numbers by the names of columns, fields, tables, saved files."""
from __future__ import annotations

import contextlib
import dataclasses
import html
import json
import os
import re
import zipfile
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import IO, TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from . import library, pictures
from .files import written
from .library import Array, Handle, Rows, address, call, locked, need, reals
from .names import Columns
from .surfaces import column, unknown

FIELDS = ("pressure", "gap", "displacement")
HDF5 = (".h5", ".hdf5")
# In a file loads have numbers from 1; this is that of the load that has the columns, where there are none.
MODEL = 0
# Tables that belong to no load.
OF_SURFACE = {"spectrum", "height"}
# The columns that notebooks show.
SHOWN = ("mean_pressure", "contact_area_fraction", "contact_area_fraction_error", "mean_gap", "mean_gap_error",
         "approach", "approach_error", "peak_pressure", "peak_pressure_error", "status")


class Units(dict[str, str]):
    """The units of columns by their names. An unknown name is an error that has the nearest one."""

    def __missing__(self, name: str) -> str:
        raise KeyError(unknown("column", name, self))


class Named:
    """An unknown attribute is an error that has the nearest name, or says that one load has it, or all loads have."""

    if not TYPE_CHECKING:   # otherwise checkers of types take every name for known
        def __getattr__(self, name: str) -> Any:
            for kind, owner in (Result, "one load has it, such as results[0]"), (Results, "results of solve have it"):
                if name[0] == "_":   # which other packages look for
                    raise AttributeError(f"there is no attribute {name!r}")
                if name in [*dir(kind), *getattr(kind, "__dataclass_fields__", ())]:
                    raise AttributeError(f"there is no attribute {name!r} here: {owner}")
            raise AttributeError(unknown("attribute", name, (one for one in dir(self) if not one.startswith("_"))))


@dataclasses.dataclass(eq=False, repr=False)
class Facts:
    """What holds for all loads; the library has it under these names."""

    e_star: float
    p_star: float
    amplitude: float
    length_x: float
    length_y: float
    points_x: int
    points_y: int
    dimension: int
    method: str
    why_chosen: str
    pressure_unit: str
    length_unit: str
    deck: str
    units: dict[str, str] = dataclasses.field(default_factory=Units)
    notes: list[str] = dataclasses.field(default_factory=list)

    @classmethod
    def of_scene(cls, scene: Handle) -> Facts:
        ask: dict[Any, Callable[[Handle, str], Any]] = {
            "str": library.text, "float": library.number, "int": lambda *one: int(library.number(*one))}
        facts = cls(**{one.name: ask[one.type](scene, "resolved_deck" if one.name == "deck" else one.name)
                       for one in dataclasses.fields(cls) if one.type in ask})
        facts.units |= {"pressure": facts.pressure_unit, **dict.fromkeys(("x", "y", *FIELDS[1:]), facts.length_unit)}
        return facts

    def unit(self, column: str) -> str:
        """The unit of a column of a table that was made, or of a field; '' if it has none."""
        return "" if (unit := self.units.get(column, "-")) in ("-", "word") else unit


class Result(Named, Columns[float, str]):
    """One solved load. The columns of the summary table are its attributes, such as mean_pressure, mean_gap,
    contact_area_fraction, contact_area_fraction_error, status; result["mean_gap"] is the same. A copy, also by pickle,
    has the tables and fields, but cannot make others."""

    def __init__(self, load: int, facts: Facts, solution: Handle | None = None, scene: Handle | None = None) -> None:
        self._load, self._facts, self._solution, self._scene = load, facts, solution, scene
        self._tables: dict[str, Rows] = {}
        self.p_star = facts.p_star   # [pressure] mean pressure that just closes the gap everywhere

    def _column(self, name: str) -> Any:
        return column(self.table("summary"), name)[0].item()

    __getitem__ = _column

    def __contains__(self, name: object) -> bool:
        return name in (self.table("summary").dtype.names or ())

    def __repr__(self) -> str:
        return (f"Result(load {self.load}: mean_pressure={self.mean_pressure:.6g}, contact_area_fraction="
                f"{self.contact_area_fraction:.6g}, mean_gap={self.mean_gap:.6g}, status={self.status!r})")

    def _asked_for(self) -> list[str]:
        return library.text(self._scene, "tables").split() if self._scene else []

    def _make(self, names: Iterable[str]) -> None:
        for name in names:
            with contextlib.suppress(ValueError):   # a copy, or without fields
                self.table(name)

    def __getstate__(self) -> dict[str, Any]:
        self._make(name for name in self._asked_for() if name not in OF_SURFACE)
        with contextlib.suppress(ValueError):   # without fields
            self._fields
        return {**self.__dict__, "_solution": None, "_scene": None}

    def table(self, name: str) -> Rows:
        """A table of the program, as a structured array of shape (rows,): 'summary', that of a key of &output, such as
        'spots', 'contours', 'lines', 'map' or 'spectrum', with percolates=... 'percolation', with stress={...}
        'stress_largest', 'stress_line', 'stress_section' or 'stress_planes', with interface={...} 'interface',
        'partial_slip', 'slip_loop', 'slip_map', 'adhesion', 'adhesion_lines', 'adhesion_map' or 'adhesion_contour',
        with both 'adhesion_stress_line', 'adhesion_stress_section' or 'adhesion_stress_planes'. Made when it is first
        asked for."""
        if name not in self._tables:
            self._tables[name], units = library.table(self._live(name), name, self._load)
            self._facts.units.update(units)
            if name != "summary":
                note_news(self._scene, self._facts)
        return self._tables[name]

    def _live(self, what: str) -> Handle:
        if self._solution is None:
            heights = "the heights to that which it names, " if "kind = 'file'" in self._facts.deck else ""
            raise ValueError(f"'{what}' was not saved: a copy or a file has no solver, but the tables that were asked "
                             "for before, and pressure, gap and displacement at x and y if fields were kept. For more "
                             f"write results.deck to a file, {heights}and solve it by wavycon.run")
        return self._solution

    @cached_property
    def _fields(self) -> dict[str, Array]:
        solution = self._live("fields")
        points, offset = (np.array([library.number(solution, f"map_{kind}_{axis}") for axis in "xy"])
                          for kind in ("points", "offset"))
        columns, rows = map(int, points)
        fields = [np.empty((rows, columns)) for _ in FIELDS]
        call("get_grid", solution, columns, rows, address(offset), *map(address, fields))
        sides = self._facts.length_x, self._facts.length_y
        places = [side*(np.arange(number) + first)/number for side, number, first in zip(sides, points, offset)]
        return {name: locked(values) for name, values in zip(("x", "y", *FIELDS), [*places, *fields])}

    @property
    def x(self) -> Array:
        """Places of the columns of fields [length], shape (x,)."""
        return self._fields["x"]

    @property
    def y(self) -> Array:
        """Places of the rows of fields [length], shape (y,); one for a profile."""
        return self._fields["y"]

    @property
    def pressure(self) -> Array:
        """Contact pressure [pressure], shape (y, x), 0 where there is no contact, at the points of the program's map:
        those of a grid that was given, of a height map its own, otherwise as output={"map_points": ...} says."""
        return self._fields["pressure"]

    @property
    def gap(self) -> Array:
        """Gap between the deformed surfaces [length], shape (y, x); 0 in contact."""
        return self._fields["gap"]

    @property
    def displacement(self) -> Array:
        """Elastic displacement, the sum of both bodies, less its mean [length], shape (y, x)."""
        return self._fields["displacement"]

    def fields_at(self, x: npt.ArrayLike, y: npt.ArrayLike) -> dict[str, Array]:
        """Pressure [pressure], gap and displacement [length] at points x, y [length], arrays of one shape. Beyond free
        edges the pressure is 0, and there is no surface: gap and displacement are NaN."""
        solution, (x, y) = self._live("fields_at"), same_shape(x, y)
        fields = {name: np.empty(x.shape) for name in FIELDS}
        call("get_fields", solution, x.size, address(x), address(y), *map(address, fields.values()))
        return fields

    def stresses_at(self, x: npt.ArrayLike, y: npt.ArrayLike, depth: npt.ArrayLike, nu: float | None = None,
                    lateral: str = "constrained") -> dict[str, Array]:
        """Stresses [pressure] at points x, y, depth [length], arrays of one shape, in a body with Poisson's ratio nu;
        without it nu of stress={...} in the solve, or nu1.

        Depths are 0 or more and point into the body, tension is positive. lateral: as the key of &stress. The answer
        has stress, with six components xx, yy, zz, xy, xz, yz along a last axis, stress_error, the estimate of its
        largest error, von_mises, largest_shear, and principal, three along a last axis, the largest first."""
        solution, places = self._live("stresses_at"), same_shape(x, y, depth)
        components = {"stress": [6], "stress_error": [], "von_mises": [], "largest_shear": [], "principal": [3]}
        parts = {name: np.empty([*places[0].shape, *axis]) for name, axis in components.items()}
        stress, error, *invariants = map(address, parts.values())
        if nu is None:
            if not (found := re.search(r"(?:&stress[^&]*\n +nu|\n +nu1) = (\S+)", self._facts.deck)):
                raise ValueError("give nu, Poisson's ratio of the body: this deck has neither nu1 nor nu of &stress")
            nu = float(found[1])
        call("get_stresses", solution, places[0].size, *map(address, places), library.one_number("nu", nu),
             str(lateral).encode(), stress, error)
        call("get_invariants", places[0].size, stress, *invariants)
        return parts

    plot_map = pictures.plot_map
    plot_stress_section = pictures.plot_stress_section


class Roughness(Named):
    """The surface that was solved: its heights, root mean squares, and the table 'spectrum'. Errors: ValueError for
    what follows from the spectrum with free edges."""

    def __init__(self, model: Result) -> None:
        self._model = model

    @property
    def spectrum(self) -> Rows:
        """The table 'spectrum'."""
        rows = self._model.table("spectrum")
        if not rows.size:
            raise ValueError("a surface with free edges has no spectrum, and no roughness by it: nothing repeats it")
        return rows

    def _of_all_waves(self, name: str) -> float:
        rows = self.spectrum
        return float(rows[rows["direction"] == rows["direction"][0]][-1][f"rms_{name}_up_to"])

    @property
    def rms_height(self) -> float:
        """[length] Root mean square height over the mean."""
        return self._of_all_waves("height")

    @property
    def rms_slope(self) -> float:
        """Root mean square of the size of the gradient."""
        return self._of_all_waves("slope")

    @property
    def rms_curvature(self) -> float:
        """[1/length] Root mean square of half the Laplacian."""
        return self._of_all_waves("curvature")

    @cached_property
    def heights(self) -> Array:
        """[length] Heights over their mean that were solved, of two maps their sum, shape (y, x): of a map at its own
        points, of other surfaces at those of pressure. A saved result has them if they were asked for before."""
        rows = self._model.table("height")
        return locked(rows["height"].reshape(-1, np.count_nonzero(rows["y"] == rows["y"][0])).copy())

    def __repr__(self) -> str:
        names = "rms_height", "rms_slope", "rms_curvature"
        with contextlib.suppress(ValueError):
            return f"Roughness({', '.join(f'{name}={getattr(self, name):g}' for name in names)})"
        return "Roughness(no spectrum)"


class Results(Named, Facts, Columns[Array, npt.NDArray[np.str_]], Sequence[Result]):
    """The solved loads, in the order in which they were given. Columns of the summary table are arrays over the loads,
    such as results.contact_area_fraction or results["contact_area_fraction"]; slices, lists of numbers and masks, such
    as results[results.mean_gap > 0], choose Results. Facts of the scene: e_star, p_star [pressure], amplitude (Delta),
    length_x, length_y [length], points_x, points_y, dimension, method, why_chosen, pressure_unit, length_unit, deck,
    the text of the deck that the program runs to the same numbers (heights in memory must be written to a file first),
    units, those of the columns, and notes, a list of what the program's log notes of the surface, the loads and the
    tables; each was also a warning, wavycon.Note. A copy, also by pickle, has the tables that were asked for and the
    fields."""

    def __init__(self, loads: Sequence[Result], facts: Facts, model: Result) -> None:
        """model: a load that has the columns of the tables, where there is none here, and the tables of the surface."""
        super().__init__(**vars(facts))
        for one in loads[:1]:
            one._tables.update({name: model._tables[name] for name in OF_SURFACE if name in model._tables})
        self._loads, self._facts, self._model = loads, facts, loads[0] if loads else model

    def __len__(self) -> int:
        return len(self._loads)

    @overload
    def __getitem__(self, load: int) -> Result: ...
    @overload
    def __getitem__(self, load: slice | list[int] | list[bool] | npt.NDArray[Any]) -> Results: ...
    @overload
    def __getitem__(self, load: str) -> Rows: ...

    def __getitem__(self, load: Any) -> Any:
        if isinstance(load, str):
            return column(self.table(), load)
        if isinstance(load, slice):
            return Results(self._loads[load], self._facts, self._model)
        if np.ndim(load):
            if np.asarray(load).dtype.kind == "U":
                raise IndexError(f"one name gives a column, got {load!r}: to_dataframe() takes lists of names")
            # Masks and numbers, as numpy takes them.
            chosen = np.arange(len(self))[np.asarray(load, dtype=None if np.size(load) else int)]
            return Results([self._loads[place] for place in chosen], self._facts, self._model)
        return self._loads[load]

    def __contains__(self, one: object) -> bool:
        """Whether there is a column of this name, or this load."""
        return one in (self.table().dtype.names or ()) if isinstance(one, str) else one in self._loads

    def _column(self, name: str) -> Any:
        return self.table()[name]

    def __repr__(self) -> str:
        return "\n".join([f"loads: {len(self)}, {self.method}", *map(repr, self)])

    def _repr_html_(self) -> str:
        """A table for notebooks; loads that were not solved as requested are red."""
        units = [f" [{unit}]" if (unit := self.unit(name)) else "" for name in SHOWN]
        heads = [f"<th>{name.replace('_', ' ')}{html.escape(unit)}</th>" for name, unit in zip(SHOWN, units)]
        rows = [f"<tr{' style=color:red' if one.status_code >= 10 else ''}>" +
                "".join(f"<td>{value if isinstance(value, str) else f'{value:.5g}'}</td>"
                        for value in map(one.__getitem__, SHOWN)) + "</tr>" for one in self]
        return f"<p>{html.escape(self.method)}</p><table><tr>{''.join(heads)}</tr>{''.join(rows)}</table>"

    def table(self, name: str = "summary") -> Rows:
        """The rows of a table of all loads, see Result.table. Those that belong to no load stand once: 'height',
        'spectrum', and the curve of 'adhesion', whose load is 0."""
        first = self._model.table(name)
        if "load" not in (first.dtype.names or ()):
            return first
        tables = [load.table(name) for load in self]
        return locked(np.concatenate([first[first["load"] == 0], *(rows[rows["load"] > 0] for rows in tables)]))

    @cached_property
    def surface(self) -> Roughness:
        """The surface that was solved: heights, rms_height, rms_slope, rms_curvature, spectrum."""
        return Roughness(self._model)

    def __getstate__(self) -> dict[str, Any]:
        self._model._make({"spectrum", *self._model._asked_for()} & OF_SURFACE)   # the first one for `surface`
        for one in self:
            one.__getstate__()   # all tables, whose units the facts have
        return self.__dict__

    def to_dataframe(self, table: str = "summary", units: bool = False) -> Any:
        """A table of all loads as a frame of pandas. The units of its columns are in frame.attrs['units']. units: True
        for names of columns with their units, such as 'mean_gap [m]', which to_dataframe(units=True).to_csv(file)
        writes too."""
        frame = need("pandas", "frames").DataFrame(self.table(table))
        if units:
            frame.columns = [f"{name} [{unit}]" if (unit := self.unit(name)) else name for name in frame]
        frame.attrs["units"] = dict(zip(frame, map(self.units.__getitem__, self.table(table).dtype.names or ())))
        return frame

    def to_xarray(self) -> Any:
        """The summary over loads and, if they were kept, the fields over loads, y and x, as a Dataset of xarray."""
        xarray, rows = need("xarray", "frames"), self.table()
        data: dict[str, Any] = {name: ("load", rows[name], {"units": self.unit(name)})
                                for name in rows.dtype.names or ()}
        with contextlib.suppress(ValueError):   # without fields
            fields = self._model._fields
            shape = len(self), *fields["pressure"].shape
            data |= {name: (("load", "y", "x"), np.reshape([load._fields[name] for load in self], shape),
                            {"units": self.unit(name)}) for name in FIELDS}
            data |= {axis: (axis, fields[axis], {"units": self.length_unit}) for axis in "xy"}
        return xarray.Dataset(data, attrs={"method": self.method, "deck": self.deck})

    plot = pictures.plot

    def save(self, file: str | os.PathLike[str] | IO[bytes], fields: bool = True) -> None:
        """Saves the summary, all tables that were asked for and, unless told not to, the fields to a file .npz or, with
        h5py, .h5 or .hdf5. It appears whole or not at all, and replaces no other kind of file. Tables with commas are
        those of to_dataframe(units=True).to_csv."""
        self.__getstate__()   # makes what `surface` needs
        content: dict[str, Any] = {"facts": json.dumps(vars(self._facts))}
        # Without loads the file has the columns of the model.
        for number, one in [*enumerate(self, 1)] or [(MODEL, self._model)]:
            content |= {f"{number}/{name}": rows for name, rows in one._tables.items()}
            content |= {f"{number}/fields/{name}": values for name, values in one.__dict__.get("_fields", {}).items()
                        if fields}
        if hasattr(file, "write"):
            np.savez(file, **content)
            return
        path = os.fspath(file)
        if os.path.isdir(path):
            raise IsADirectoryError(f"{path}: this is a directory, not a file")
        if not path.endswith((".npz", *HDF5)):
            if (ending := os.path.splitext(path)[1]) and not ending[1:].isdigit():
                raise ValueError(f"{path}: the name must end in .npz or .h5, not in {ending}; "
                                 "to_dataframe(units=True).to_csv() writes tables with commas")
            path += ".npz"
        with written(path, b"\x89HDF" if path.endswith(HDF5) else b"PK") as opened:
            if path.endswith(HDF5):
                with need("h5py", "h5").File(opened.name, "w") as saved:
                    saved.update({name: retyped(values, "<U", "|S") for name, values in content.items()})
            else:
                np.savez(opened, **content)


def load(file: str | os.PathLike[str] | IO[bytes]) -> Results:
    """The results in a file of Results.save, whose ending .npz may be left out. What was not saved cannot be asked
    for."""
    content: dict[str, Any] = {}
    if not hasattr(file, "read") and not os.path.exists(file) and os.path.exists(f"{os.fspath(file)}.npz"):
        file = f"{os.fspath(file)}.npz"
    try:
        if not hasattr(file, "read") and os.fspath(file).endswith(HDF5):
            with need("h5py", "h5").File(file, "r") as saved:
                saved.visititems(lambda name, one: content.update({name: one[()]} if hasattr(one, "dtype") else {}))
        else:
            with np.load(file, allow_pickle=False) as saved:
                content = dict(saved)
    except (AttributeError, EOFError, OSError, TypeError, ValueError, zipfile.BadZipFile) as error:
        if getattr(error, "errno", None):   # of the system
            raise
    if "facts" not in content:
        raise ValueError(f"{file}: this is no file that Results.save has written")
    told = json.loads(np.asarray(content.pop("facts")).item())   # a text, of HDF5 bytes
    facts, loads = Facts(**{**told, "units": Units(told["units"])}), dict[int, Result]()
    for name, values in content.items():
        number, table, *field = name.split("/")
        one = loads.setdefault(int(number), Result(int(number), facts))
        if field:
            one.__dict__.setdefault("_fields", {})[field[0]] = locked(values)
        else:
            one._tables[table] = locked(retyped(values, "|S", "<U"))
    return Results([loads[number] for number in sorted(loads) if number != MODEL], facts, one)


def retyped(rows: Any, old: str, new: str) -> Any:
    """A table with its words of another kind: HDF5 has bytes alone. What is no table stays."""
    names = getattr(getattr(rows, "dtype", None), "names", None)
    return rows.astype([(name, rows.dtype[name].str.replace(old, new)) for name in names]) if names else rows


def note_news(scene: Handle | None, facts: Facts) -> None:
    """Warns of what the library notes of a scene, and adds it to the notes, unless it is there."""
    notes = library.text(scene, "notes").splitlines() if scene else []
    facts.notes += library.tell([note for note in notes if note not in facts.notes])


def same_shape(*arrays: npt.ArrayLike) -> list[Array]:
    """Arrays of numbers of one shape, contiguous."""
    return [array.copy() for array in np.broadcast_arrays(*map(reals, arrays))]
