#!/usr/bin/env python3
"""Files of instruments through wavycon.read: their heights as they are solved, contact beside ContactMechanics.

usage: formats.py FILE... , in a Python that has wavycon, SurfaceTopography and ContactMechanics

Prints for each map of 32 or more points a side: format, points, unit, missing heights; the rms height that is solved
over that of the heights in the file, less 1; points in contact, by both programs, of the first part of 128 x 128 points
without missing heights, at 0.05 p*; and the time of each solve [s].
"""
import sys
import time
from pathlib import Path

import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from SurfaceTopography import Topography, open_topography

import wavycon as wc

SIDE, LOAD, TOLERANCE = 128, 0.05, 1e-10


def rms_height(surface):
    """Of the heights that the program solves: the gap at first touch."""
    return wc.solve(surface, pbar_over_pstar=0)[0].gap.std()


def whole_part(h):
    """The first part without missing heights, in units of its range; None if there is none."""
    for j in range(0, h.shape[0] - SIDE + 1, SIDE//4):
        for i in range(0, h.shape[1] - SIDE + 1, SIDE//4):
            part = h[j:j + SIDE, i:i + SIDE]
            if not np.isnan(part).any() and np.ptp(part) > 0:
                return (part - part.mean())/np.ptp(part)
    return None


def compare(part):
    """Points in contact and times by both programs."""
    started = time.perf_counter()
    one = wc.solve(wc.heights(part, length_x=1, length_y=1), pbar_over_pstar=LOAD, residual=TOLERANCE)[0]
    ours, solved = np.count_nonzero(one.pressure), time.perf_counter()
    half_space = PeriodicFFTElasticHalfSpace(part.shape, 1.0, (1.0, 1.0))
    system = NonSmoothContactSystem(half_space, Topography(part, (1.0, 1.0), periodic=True))
    found = system.minimize_proxy(external_force=one.mean_pressure, pentol=TOLERANCE, maxiter=5000)
    return f"{ours} {np.count_nonzero(found.jac)}  {solved - started:.2f} {time.perf_counter() - solved:.2f} s"


for file in map(Path, sys.argv[1:]):
    try:
        surface = wc.read(file)
        with open_topography(str(file)) as reader:
            name = reader.format()
    except ValueError:
        continue
    h = surface.in_memory   # as the file has them
    if h is None or min(h.shape) < 32:
        continue
    ratio = rms_height(wc.heights(h, fill_missing="harmonic"))/np.nanstd(h) - 1
    part = whole_part(h)
    print(f"{file.name:28} {name:9} {h.shape[1]} x {h.shape[0]} {surface.length_unit} {np.isnan(h).sum()}",
          f" {ratio:.0e}  ", "" if part is None else compare(part), flush=True)
