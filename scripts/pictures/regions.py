"""Regions of a map: spots of contact, and the gap, by what percolates. The package wavycon and scripts/plot use this
file; numpy is all that it needs."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

# Kinds of regions: what each is called, with its colour, in the legend alone for spots, and the colours of spots.
KINDS = {"gap that percolates": "#d9e8f5", "closed gap": "#f0a830", "contact that percolates": "#33202a",
         "spots of contact": "#b0b0b0"}
SPOTS = ("#1f77b4", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#7f7f7f", "#17a398")
COLOURS = (*KINDS.values(), *SPOTS)


def connected(mask: Any, corners: bool) -> Any:
    """Numbers of the connected parts of a mask whose sides are joined, 0 outside. corners: whether points that touch at
    a corner are connected."""
    starts = mask & ~np.pad(mask, ((0, 0), (1, 0)))[:, :-1]
    numbers = np.where(mask, np.cumsum(starts).reshape(mask.shape), 0)   # of runs of points along rows
    many = starts.sum() + 1
    steps = [(0, 1), (1, 0), *[(1, 1), (1, -1)]*corners]
    neighbours = [(numbers*many + np.roll(numbers, step, (0, 1)))[mask & np.roll(mask, step, (0, 1))] for step in steps]
    pairs = np.divmod(np.unique(np.concatenate(neighbours)), many)   # runs that are connected
    joined = np.arange(many)   # the number that each number has become
    while True:
        one, other = joined[pairs[0]], joined[pairs[1]]
        if np.array_equal(one, other):
            return joined[numbers]
        np.minimum.at(joined, np.maximum(one, other), np.minimum(one, other))
        joined = joined[joined]


def regions(contact: Any, mirrored: bool) -> Any:
    """The place in COLOURS of each point of a map, shape (y, x): spots in turn have its last ones. On two by two cells
    a region that percolates is connected with its own copy; on a map that its mirror images continue it goes from
    border to border. contact: whether a point is in contact, shape (y, x)."""
    rows, columns = contact.shape
    colours = np.zeros((rows, columns), dtype=int)
    for is_contact in False, True:
        mask = contact == is_contact
        numbers = connected(np.pad(mask, (0, 1)) if mirrored else mask, is_contact)[:rows, :columns]
        if mirrored:
            through = np.append(*(np.intersect1d(*ends) for ends in (numbers[[0, -1]], numbers[:, [0, -1]].T)))
        else:
            cells = connected(np.tile(mask, (2, 2)), is_contact).reshape(2, rows, 2, columns).swapaxes(1, 2)
            through = numbers[mask & (cells.reshape(4, rows, columns)[1:] == cells[0, 0]).any(0)]
        spots = len(KINDS) + np.unique(numbers, return_inverse=True)[1].reshape(numbers.shape) % len(SPOTS)
        kinds = np.where(np.isin(numbers, through), 2*is_contact, spots if is_contact else 1)
        colours[mask] = kinds[mask]
    return colours


def legend(colours: Any, percolates: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Names and colours of the regions that there are. percolates: as columns of the table spots, such as
    contact_percolates_x; none if they are not known."""
    entries = []
    for kind, (name, colour) in enumerate(KINDS.items()):
        if (colours == kind).any() or (name == "spots of contact" and (colours > kind).any()):
            along = [axis for axis in "xy" if percolates.get(f"{name.split()[0]}_percolates_{axis}")]
            entries.append((f"{name} along {along[0]}" if len(along) == 1 else name, colour))
    return entries
