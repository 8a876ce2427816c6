"""Solving: loads of surfaces, of decks, one after the other; bounds."""
from __future__ import annotations

import ast
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import library
from .deck import NEAR, bare, dictionary, groups_of, scene_of, value_text
from .library import Handle, address, call, keys, one_number, reals
from .names import Load, OneLoad, Options, Settings, Unpack
from .progress import Watch
from .results import Facts, Result, Results, note_news
from .surfaces import SIDES, Surface


def solve(surface: Surface, *, keep_fields: bool = True, progress: bool = True, **options: Unpack[Options]) -> Results:
    """Solves loads of a surface.

    options: keys of decks without their groups, such as e_star, e1, nu1 [pressure], accuracy, length_unit; the loads, a
    number or a list, are one of pbar_over_pstar, mean_pressure [pressure], mean_gap [length], contact_area_fraction and
    so on; groups as dictionaries, such as stress={"nu": 0.3}. help(wavycon.Settings) and help(wavycon.Load) have all.
    The solver is 'auto' unless one is given. keep_fields: False for results without fields, contours and stresses,
    which are smaller. progress: whether what takes longer than a second shows a bar where tqdm is installed.

    A load that cannot be solved as requested has a status. What is wrong in the options is a ValueError. What a user
    should know of the surface and the results is a warning, Note, and in the results' notes. Ctrl-C ends a solve in the
    main thread.
    """
    return solve_deck(scene_of(surface, options, keep_fields), progress)


class Bounds(NamedTuple):
    """Guaranteed bounds of the contact of a surface, each (lower, upper); NaN where there is no bound."""

    energy: tuple[float, float]     # complementary energy [pressure*length^3, of a profile pressure*length^2]
    approach: tuple[float, float]   # [length]
    mean_gap: tuple[float, float]   # [length]


def certify(surface: Surface, pressure: npt.ArrayLike | Result, gap: npt.ArrayLike | None = None, *,
            mean_pressure: float | None = None, pbar_over_pstar: float | None = None, x: npt.ArrayLike | None = None,
            y: npt.ArrayLike | None = None, **options: Unpack[Settings]) -> Bounds:
    """Guaranteed bounds of the contact of a surface under a mean pressure, from any pressure and gap, also those of
    another code. They hold for the surface itself, not for its points, and whatever is given: the right answer makes
    them close, a wrong one makes them wide.

    pressure [pressure], gap [length]: of the shape (y, x) or, of a profile, (x,), at equal steps over the whole
    surface, of a height map at its own points or at more; or a Result in place of both, which has x, y and the mean
    pressure too and, if there are no options, the material. mean_pressure [pressure], pbar_over_pstar: one number, as
    of solve. x, y [length]: their places. The first one is at most a step from 0, on a map with edges="mirror" half a
    step; without x and y it is at 0, on such a map at half a step. Negative pressures count as 0, and so do negative
    gaps unless there is a hardness; the pressure is scaled to the mean. options: as of solve, such as e_star.

        one = wc.solve(surface, e_star=2e11, mean_pressure=1e7)[0]
        wc.certify(surface, one).mean_gap
    """
    fields: Any = pressure, gap
    settings: dict[str, Any] = {**options}
    if isinstance(pressure, Result):
        fields, x, y = (pressure.pressure, pressure.gap), pressure.x, pressure.y
        if not settings:
            (group,) = re.findall(r"^&material(.*?)^/", pressure._facts.deck, re.DOTALL | re.MULTILINE)
            settings["material"] = {key: ast.literal_eval(one) for key, one in re.findall(r"\n +(\w+) = (\S+)", group)}
        if mean_pressure is pbar_over_pstar is None:
            mean_pressure = pressure.mean_pressure
    elif gap is None:
        raise ValueError("give pressure and gap, or one load, such as results[0], in place of both")
    p, g = np.atleast_2d(*map(reals, fields))
    if p.ndim != 2 or p.shape != g.shape:
        raise ValueError(f"pressure and gap must have one shape, (y, x) or (x,), got {p.shape} and {g.shape}")
    if getattr(surface, "kind", None) == "ball":
        raise ValueError("bounds are known for periodic and mirrored surfaces only, and a ball has free edges")
    if pbar_over_pstar is None:
        mean_pressure = one_number("mean_pressure", mean_pressure)
    scene = scene_of(surface, {"mean_pressure": mean_pressure, "pbar_over_pstar": pbar_over_pstar, **settings}, False)
    if pbar_over_pstar is not None:
        mean_pressure = one_number("pbar_over_pstar", pbar_over_pstar)*library.number(scene, "p_star")
    library.tell(library.text(scene, "notes").splitlines())
    offset, bounds = np.zeros(2), np.empty((3, 2))
    for axis, (places, points) in enumerate(zip((x, y), p.shape[::-1])):
        if places is not None and points > 1:
            side = library.number(scene, SIDES[axis])
            steps = reals(places)*points/side
            if steps.shape != (points,) or abs(steps - steps[0] - np.arange(points)).max() > NEAR:
                raise ValueError(f"{'xy'[axis]} must be {points} places at equal steps over the whole side {side:g}")
            offset[axis] = steps[0]
    call("get_bounds", scene, mean_pressure, *p.shape[::-1], None if x is y is None else address(offset),
         *map(address, (p, g, bounds)))
    return Bounds(*((float(lower), float(upper)) for lower, upper in bounds))


class Problem:
    """A surface that is solved for many loads, one after the other: heights, grids and plans stay.

        with wc.problem(wc.wave_2d(), e_star=2e11) as p:
            areas = p.solve(mean_pressure=[1e7, 1e8]).contact_area_fraction
            needed = p.find(contact_area_fraction=0.3).mean_pressure
            sealed = p.find(percolates="gap").mean_pressure

    settings: as of solve, without loads. The end of `with` lets go of the solver; results stay.
    """

    def __init__(self, surface: Surface, *, keep_fields: bool = True, **settings: Unpack[Settings]) -> None:
        if "load" in groups_of(surface, settings):
            raise ValueError("loads belong to the solve of a problem")
        self._scene: Handle | None = scene_of(surface, settings, keep_fields)
        self._facts = Facts.of_scene(self._scene)
        self.p_star = self._facts.p_star   # [pressure] mean pressure that just closes the gap everywhere

    def __enter__(self) -> Problem:
        return self

    def __exit__(self, *_: object) -> None:
        self._scene = None

    def solve(self, *, progress: bool = True, **load: Unpack[Load]) -> Results:
        """Solves loads, a number or a list of one key of &load, such as mean_pressure=[1e6, 1e7], or its word, such as
        percolates="gap". A solver may start from the load before, so that last digits depend on it."""
        if self._scene is None:
            raise ValueError("this problem has ended with its `with`")
        if len(load) != 1 or "sweep_" in next(iter(load)):
            known = [key for key in keys()["load"] if not key.startswith("sweep_")]
            settings = ", ".join(name for name in load if name not in keys()["load"])
            raise ValueError(f"give the loads by one of {', '.join(known)}"
                             + f", and {settings} to wavycon.problem"*bool(settings))
        given: Any
        ((name, given),) = ((bare(name), given) for name, given in load.items())
        if isinstance(given, str):
            name, given = f"{name}={given}", 0.0
        values = np.atleast_1d(list(given) if isinstance(given, (Iterator, Set)) else given)
        if name == "percolates" or values.dtype.kind not in "iuf" or values.ndim != 1 or not values.size:
            words = "one word, such as 'gap'" if name == "percolates" else "a number or a list of numbers"
            raise ValueError(f"{name} must be {words}, got {given!r}")
        values = reals(values)
        # From high to low loads, as the program solves them.
        order = np.argsort(values if name.startswith("mean_gap") else -values, kind="stable") + 1
        return solve_all(self._scene, self._facts, order.tolist(), progress,
                         lambda scene, load: call("solve", scene, name.encode(), values[load - 1]))

    def find(self, *, progress: bool = True, **load: Unpack[OneLoad]) -> Result:
        """The load at which a quantity of &load has this value, such as contact_area_fraction=0.3, or percolates: its
        table "percolation" has the error of the load. solve of the same value gives Results, which can be saved.
        progress: as of solve."""
        values: Any = load.values()
        if any(np.size(value) != 1 or isinstance(value, (Iterator, Set)) for value in values):
            raise ValueError("find needs one value, not a list; solve takes lists")
        return self.solve(progress=progress, **load)[0]


problem = Problem


def run(deck: str | os.PathLike[str], set: Mapping[str, object] = MappingProxyType({}), *, keep_fields: bool = True,
        progress: bool = True) -> Results:
    """Solves the loads of a deck file, without writing files.

    set: keys in place of those of the deck, such as {"surface.amplitude": 2e-6, "load.mean_pressure": [1e6, 1e7]}.
    """
    settings = "\n".join(f"{key}={value_text(key, value)}" for key, value in dictionary("set", set).items())
    return solve_deck(call("read_scene", os.fsencode(deck), settings.encode(), bool(keep_fields)), progress)


def solve_deck(scene: Handle, progress: bool) -> Results:
    """Solves the loads of a deck in the order of the program, whose digits they have. Errors: ValueError for none."""
    order = [int(number) for number in library.text(scene, "order").split()]
    if not order:
        raise ValueError(f"there is no load: give one of {', '.join(keys()['load'])}")
    return solve_all(scene, Facts.of_scene(scene), order, progress,
                     lambda scene, load: call("solve_load", scene, load - 1))


def solve_all(scene: Handle, facts: Facts, order: Sequence[int], progress: bool,
              solve_one: Callable[[Handle, int], Handle]) -> Results:
    """Solves loads, numbered from 1, in this order."""
    loads = {}
    with Watch(scene, len(order) if progress else 0) as watch:
        for number in order:
            if not watch.is_stopped:
                loads[number] = Result(number, facts, solve_one(scene, number), scene)
                watch.solved += 1
    for one in loads.values():
        one.table("summary")   # which tells the units
    note_news(scene, facts)
    return Results([loads[number] for number in sorted(loads)], facts, one)
