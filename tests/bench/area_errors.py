#!/usr/bin/env python3
"""True errors of the three contact areas of a grid: by counting points, corrected, and placed between the points.

usage: area_errors.py --program WAVYCON [--quick]

Surfaces whose area is known: the two-dimensional wave, by the solver 'fitted'; a sphere at light load, by Hertz, averaged over
places of its centre between the points; self-affine maps of 128 x 128 points, whose shortest wave has 16 to 2 of
them, by the finest grid, which has its own rows. Errors are root mean squares over the loads of a row, in percent of
the area or, from half contact on, of the open part, each with the mean in brackets; the last column is the root mean
square of the error estimate of the placed area in the same unit, NaN where one is unknown. `perimeter` is the number
of changes from contact to gap over the number of points in contact or, from half contact on, of open points.

Run it with a Python that has numpy.
"""
import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy

sys.dont_write_bytecode = True
import rough_surface  # noqa: E402

AREAS = ("contact_area_counted_fraction", "contact_area_corrected_fraction", "contact_area_fraction")
ERROR = "contact_area_fraction_error"
CHANGE = (math.pi - 1 + math.log(2))/24   # (C26) of src/core/contact/README.md
WAVE_POINTS = (32, 64, 128, 256, 512)
WAVE_LOADS = {"light": (0.01, 0.013, 0.017, 0.02, 0.025, 0.03, 0.04, 0.05),
              "medium": (0.1, 0.13, 0.17, 0.2, 0.35, 0.4, 0.5, 0.6), "heavy": (0.8, 0.83, 0.86, 0.9, 0.93, 0.95, 0.97)}
SPHERE_POINTS, SPHERE_RADII, SPHERE_PLACES = 256, (1.5, 2, 4, 8, 16), 12   # radii of contact in steps
ROUGH_POINTS, ROUGH_CUTOFFS, ROUGH_FINER = 128, (16, 8, 4, 2), 16
ROUGH_AREAS = (0.01, 0.05, 0.2, 0.5, 0.8, 0.95)


class Runs:
    """Runs decks and reads their summaries."""

    def __init__(self, program, folder):
        self.program, self.folder = pathlib.Path(program).resolve(), pathlib.Path(folder)

    def summary(self, surface, method, loads, heights=None):
        """{column: numbers} of a deck."""
        if heights is not None:
            numpy.savetxt(self.folder/"map.dat", heights, fmt="%.17g")
        (self.folder/"deck.nml").write_text(f"&surface {surface} /\n&load pbar_over_pstar = "
                                            f"{', '.join(map(repr, map(float, loads)))} /\n&method {method} /\n")
        done = subprocess.run([self.program, "deck.nml", "--quiet", "--output", "out"], cwd=self.folder, check=False)
        if done.returncode not in (0, 2):
            sys.exit("area_errors: a deck could not be run")
        rows = [line.split() for line in (self.folder/"out"/"deck.summary.dat").read_text().splitlines()
                if not line.startswith("#")]
        return {name: numpy.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])
                if name not in ("solver", "status")}


def row(name, points, load, found, truth):
    """A line of the table: errors of the three areas against the truth."""
    unit = numpy.where(truth < 0.5, truth, 1 - truth)
    counted = found[AREAS[0]]
    changes = (counted - found[AREAS[1]])/CHANGE/numpy.where(truth < 0.5, counted, numpy.maximum(1 - counted, 1e-300))
    words = [f"{name:<14} {points:>6} {load:<18} {changes.mean():>9.3f}"]
    for column in AREAS:
        error = 100*(found[column] - truth)/unit
        words.append(f"{math.sqrt((error**2).mean()):>9.3g} {f'({error.mean():+.2g})':<9}")
    words.append(f"{100*math.sqrt(((found[ERROR]/unit)**2).mean()):>9.3g}")
    print(" ".join(words), flush=True)


def wave(runs, quick):
    for name, loads in WAVE_LOADS.items():
        truth = runs.summary("kind = 'wave_2d'", "solver = 'fitted', accuracy = 1e-8", loads)
        if not (truth["status_code"] < 10).all():
            sys.exit("area_errors: a fitted solution is not accurate")
        for points in WAVE_POINTS[:3 if quick else None]:
            found = runs.summary("kind = 'wave_2d'", f"solver = 'grid', grid_points = {points}", loads)
            row("wave", points, name, found, truth["contact_area_fraction"])


def sphere(runs, quick):
    """Paraboloids of the curvature 1, with the step 1; the other spheres of the periodic cell are far away."""
    random = numpy.random.default_rng(1)
    along = numpy.arange(SPHERE_POINTS) - SPHERE_POINTS/2
    for radius in SPHERE_RADII:
        found = []
        for place in random.random((3 if quick else SPHERE_PLACES, 2)):
            x, y = numpy.meshgrid(along - place[0], along - place[1])
            heights = -(x**2 + y**2)/2
            # Load = 4 E* a^3/(3 R); p* follows from the depth of the pressures of full contact.
            full = rough_surface.full_contact_pressure(heights)*math.pi/SPHERE_POINTS
            load = 4*radius**3/3/SPHERE_POINTS**2
            size = f"length_x = {SPHERE_POINTS}, length_y = {SPHERE_POINTS}"
            surface = f"kind = 'file', file = 'map.dat', {size}"
            found.append(runs.summary(surface, "solver = 'grid'", [load/full], heights))
        together = {name: numpy.concatenate([one[name] for one in found]) for name in found[0]}
        truth = numpy.full(len(found), math.pi*radius**2/SPHERE_POINTS**2)
        row("sphere", SPHERE_POINTS, f"radius {radius:g} steps", together, truth)


def rough(runs, quick):
    for cutoff in ROUGH_CUTOFFS:
        # Two points to a wave are the Nyquist frequency, which has no phase of its own.
        heights = rough_surface.rough_surface(ROUGH_POINTS, min(ROUGH_POINTS/cutoff, ROUGH_POINTS//2 - 1))
        full = rough_surface.full_contact_pressure(heights)
        loads = [rough_surface.pressure_for_contact(heights, area)/full for area in ROUGH_AREAS]
        surface = "kind = 'file', file = 'map.dat', length_x = 1, length_y = 1"
        finest = ROUGH_POINTS*(ROUGH_FINER//2 if quick else ROUGH_FINER)
        truth = runs.summary(surface, f"solver = 'grid', grid_points = {finest}", loads, heights)
        area = truth["contact_area_fraction"]
        for points in (ROUGH_POINTS, 2*ROUGH_POINTS, finest):
            found = runs.summary(surface, f"solver = 'grid', grid_points = {points}", loads, heights)
            for k in range(len(loads)):
                one = {name: values[k:k + 1] for name, values in found.items()}
                row(f"rough, {cutoff} to 1", points, f"area {100*area[k]:.3g} %", one, area[k:k + 1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", 1)[0],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="wavycon")
    parser.add_argument("--quick", action="store_true", help="fewer and coarser grids")
    given = parser.parse_args()
    print("# " + __doc__.split("\n\n")[2].replace("\n", "\n# "))
    print(f"#{'surface':<13} {'points':>6} {'load':<18} {'perimeter':>9} {'counted[%]':>19} {'corrected[%]':>19} "
          f"{'placed[%]':>19} {'estimate':>9}")
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(given.program, folder)
        for part in (wave, sphere, rough):
            part(runs, given.quick)
            print("\n")


if __name__ == "__main__":
    main()
