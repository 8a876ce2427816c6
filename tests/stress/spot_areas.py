"""The areas of the spots and pools of a run, of its contours and of its summary."""
import math

from common import Table
from summaries import Row

OF_AREAS = 1e-11  # differences of areas, over the nominal area
LARGEST_RATIO = 3.0  # of the error estimate, for contours
POLYGON = 1e-3  # that of the 256 points of a fitted edge, over the area or the open part


def area_complaints(results, cell, with_contours):
    """Spots and summary must have the same area, contours within the error estimate; those that wind about the cell are
    left out, and all of profiles and of mirrored maps, where contours are not those of one cell."""
    complaints = []
    sizes = {}
    for row in Table(results/"deck.spot_sizes.dat").records():
        sizes.setdefault((row["load"], row["region"]), []).append(float(row["area_fraction"]))
    curves = {}
    for row in Table(results/"deck.contour.dat").records():
        curves.setdefault(row["load"], {}).setdefault(row["curve"], []).append((float(row["x"]), float(row["y"])))
    spots = {row["load"]: row for row in Table(results/"deck.spots.dat").records()}
    for row in Table(results/"deck.summary.dat").records():
        load, area = row["load"], float(row["contact_area_fraction"])
        spot_sizes, pool_sizes = sizes.get((load, "spot"), []), sizes.get((load, "pool"), [])
        areas = {}
        # Areas below zero are zero in the tables.
        if min(spot_sizes + pool_sizes) > 0.0:
            areas = {"the sum of all spots": float(spots[load]["spots_area_fraction"]),
                     "the table of spot sizes": math.fsum(spot_sizes),
                     "what the pools leave": 1.0 - math.fsum(pool_sizes)}
        ways = list(curves.get(load, {}).values())
        if with_contours and ways and all(math.dist(way[0], way[-1]) <= OF_AREAS*max(cell) for way in ways):
            inside = math.fsum((a[0] - b[0])*(a[1] + b[1])/2.0 for way in ways for a, b in zip(way, way[1:]))
            inside /= cell[0]*cell[1]
            # The area that curves enclose does not tell whether the rest of the cell is inside or outside.
            off = abs(math.remainder(inside - area, 1.0))
            if off > LARGEST_RATIO*Row(row).errors[1] + POLYGON*min(area, 1.0 - area):
                complaints.append(f"load {load}: area {area!r}, but contours enclose {inside!r}")
        for name, other in areas.items():
            if not abs(other - area) <= OF_AREAS:
                complaints.append(f"load {load}: area {area!r}, but {other!r} is {name}")
    return complaints
