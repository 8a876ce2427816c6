#!/usr/bin/env python3
"""Times one of tamaas, contactmechanics and slippy on one thread.

usage: time_error_peer.py PEER wave SECONDS LOAD...
       time_error_peer.py PEER rough FILE PRESSURE SECONDS

wave: the paper's wave on the smaller of its two cells, a square with one crest, on ever finer grids, while
the next is expected to end within SECONDS a load. Each line is a run: name, load, points along a side, time
[ms], solves behind that median, mean gap, contact area (points with pressure, counted), peak pressure (the
largest of the points).

rough: a matrix of heights on a cell of side 1, at a mean pressure over E*, to ever smaller tolerances. Each
line: name, tolerance, time [ms], solves, residual, mean gap over the depth of the mean plane below the
peak, contact area. The residual is the same for all: the root mean square of the violated conditions on the
gap, over its mean, of the pressures that the peer gives.

The time is that of the peer's solver alone: its model and the plans of its transforms are made before.
"""
import importlib
import statistics
import sys
import time

import numpy

GRIDS = 32, 64, 128, 256, 512, 1024
TOLERANCE = 1e-8  # of the wave: far below the error of the finest grid
FULL_LOAD, FULL_AGREEMENT = 1.2, 1e-6  # a load that closes the gap; far above the tolerance
ROUGH_TOLERANCES = 1e-4, 1e-8, 1e-11
ITERATION_LIMIT = 2000
REPEATS, REPEAT_SECONDS = 5, 1.0  # most solves of a run, and the time for those after the first
GROWTH = 6  # largest ratio of the times of two runs: four times the points, more iterations


def time_solves(contact):
    """Times [s]; None if it does not converge."""
    times = []
    while not times or (len(times) < REPEATS and (len(times) + 1)*min(times) < REPEAT_SECONDS):
        contact.forget()
        before = time.perf_counter()
        good = contact.solve()
        times.append(time.perf_counter() - before)
        if not good:
            return []
    return times


def residual_of(pressures, heights):
    """The residual, and the mean gap; E* is 1/pi, the cell's side 1."""
    rows, columns = heights.shape
    waves = numpy.hypot(numpy.fft.fftfreq(rows, 1/rows)[:, None], numpy.fft.rfftfreq(columns, 1/columns))
    waves[0, 0] = numpy.inf  # the mean displacement is part of the approach
    gaps = numpy.fft.irfft2(numpy.fft.rfft2(pressures)/waves, heights.shape) - heights
    contact = pressures > 0
    gaps -= gaps[contact].mean()
    violated = numpy.where(contact, gaps, numpy.minimum(gaps, 0))
    return numpy.sqrt((violated**2).mean())/gaps.mean(), gaps.mean()


def wave(n):
    crest = numpy.cos(2*numpy.pi*numpy.arange(n)/n)/2
    return crest[:, None] + crest


def check_units(peer):
    """In full contact the gap is zero and the pressure the load and the wave, p* high: equation (22)."""
    contact = peer.Contact(wave(32), FULL_LOAD, TOLERANCE, ITERATION_LIMIT)
    good = contact.solve()
    pressures, gaps = contact.answer()
    difference = max(abs(pressures - FULL_LOAD - wave(32)).max(), abs(gaps).max())
    if not good or difference > FULL_AGREEMENT:
        sys.exit(f'time_error_peer: differs from full contact by {difference}')


def climb(name, peer, load, seconds):
    check_units(peer)
    end = time.perf_counter() + seconds
    for n in GRIDS:
        contact = peer.Contact(wave(n), load, TOLERANCE, ITERATION_LIMIT)
        times = time_solves(contact)
        if not times:
            print(f'# {name} does not converge at P = {load} on {n} x {n} points', flush=True)
            return
        pressures, gaps = contact.answer()
        print(name, load, n, f'{1000*statistics.median(times):.4f}', len(times),
              f'{gaps.mean():.14e} {(pressures > 0).mean():.14e} {pressures.max():.14e}', flush=True)
        if time.perf_counter() + GROWTH*min(times) > end:
            return


def sharpen(name, peer, heights, pressure, seconds):
    end = time.perf_counter() + seconds
    heights = heights - heights.mean()
    # Heights are divided by the largest, and E* = 1/pi: the pressure over E* is multiplied accordingly.
    scaled = heights/heights.max()
    load = pressure/heights.max()/numpy.pi
    for tolerance in ROUGH_TOLERANCES:
        contact = peer.Contact(scaled, load, tolerance, ITERATION_LIMIT)
        times = time_solves(contact)
        if not times:
            print(f'# {name} does not converge to a tolerance of {tolerance}', flush=True)
            return
        pressures, _ = contact.answer()
        residual, gap = residual_of(pressures, scaled)
        print(name, tolerance, f'{1000*statistics.median(times):.4f}', len(times),
              f'{residual:.2e} {gap:.14e} {(pressures > 0).mean():.14e}', flush=True)
        if time.perf_counter() + 1.5*min(times) > end:
            return


def main():
    if len(sys.argv) < 5 or sys.argv[2] not in ('wave', 'rough'):
        sys.exit(__doc__.split('\n\n')[1])
    name, kind = sys.argv[1:3]
    peer = importlib.import_module('time_error_' + name)
    if kind == 'wave':
        for load in sys.argv[4:]:
            climb(name, peer, float(load), float(sys.argv[3]))
    else:
        sharpen(name, peer, numpy.loadtxt(sys.argv[3]), float(sys.argv[4]), float(sys.argv[5]))


if __name__ == '__main__':
    main()
