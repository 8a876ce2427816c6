#!/usr/bin/env python3
"""Times one of tamaas, contactmechanics, slippy and aspher on one thread, for the paper's wave.

usage: time_error_peer.py PEER SECONDS LOAD...

The wave is solved on the smaller of its two cells, a square with one crest, on ever finer grids, while the next is
expected to end within SECONDS a load. Each line is a run: name, load, points along a side, processor time [ms], solves
behind that median, mean gap, contact area (points with pressure, counted), peak pressure (the largest of the points).

The tolerance is the one with which the program is fastest to the residual of wavycon's grids, computed alike for all.
The time is that of the peer's solver alone: its model and the plans of its transforms are made before, where it keeps
them. aspher makes them in each solution.
"""
import importlib
import statistics
import sys
import time

import numpy
import rough_runs
import rough_surface

GRIDS = 32, 64, 128, 256, 512, 1024
FULL_TOLERANCE = 1e-8
FULL_LOAD, FULL_AGREEMENT = 1.2, 1e-6  # a load that closes the gap; far above the tolerance
ITERATION_LIMIT = 2000
REPEATS, REPEAT_SECONDS = 5, 1.0  # most solves of a run, and the time for those after the first
GROWTH = 6  # largest ratio of the times of two runs: four times the points, more iterations


def time_solves(contact):
    """Times [s]."""
    times = []
    while not times or (len(times) < REPEATS and (len(times) + 1)*min(times) < REPEAT_SECONDS):
        contact.forget()
        before = time.process_time()
        contact.solve()
        times.append(time.process_time() - before)
    return times


def wave(n):
    crest = numpy.cos(2*numpy.pi*numpy.arange(n)/n)/2
    return crest[:, None] + crest


def check_units(peer):
    """In full contact the gap is zero and the pressure the load and the wave, p* high: equation (22)."""
    contact = peer.Contact(wave(32), FULL_LOAD, FULL_TOLERANCE, ITERATION_LIMIT)
    good = contact.solve()
    pressures, gaps = contact.answer()
    difference = max(abs(pressures - FULL_LOAD - wave(32)).max(), abs(gaps).max())
    if not good or difference > FULL_AGREEMENT:
        sys.exit(f'time_error_peer: differs from full contact by {difference}')


def residual_of_wavycon(points, load):
    """(C10) of src/core/contact/README.md."""
    return 1e-3*points**-1.5*load**(1/3)


def judged(peer, points, load, tolerance):
    """A solution as a run of rough_runs."""
    contact = peer.Contact(wave(points), load, tolerance, ITERATION_LIMIT)
    before = time.process_time()
    good = contact.solve()
    seconds = time.process_time() - before
    return rough_runs.Run('good' if good else 'unconverged', seconds, tolerance=tolerance,
                          judgement=rough_surface.judge(wave(points), contact.answer()[0], load))


def climb(name, peer, load, seconds):
    check_units(peer)
    ratio = rough_runs.START[name]
    for n in GRIDS:
        residual = residual_of_wavycon(n, load)
        best = rough_runs.search(lambda tolerance: judged(peer, n, load, tolerance), residual, ratio*residual)
        if not rough_runs.reaches(best, residual):
            print(f'# {name} does not reach the residual at P = {load} on {n} x {n} points', flush=True)
            return
        ratio = best.tolerance/residual
        contact = peer.Contact(wave(n), load, best.tolerance, ITERATION_LIMIT)
        times = time_solves(contact)
        pressures, gaps = contact.answer()
        print(name, load, n, f'{1000*statistics.median(times):.4f}', len(times),
              f'{gaps.mean():.14e} {(pressures > 0).mean():.14e} {pressures.max():.14e}', flush=True)
        seconds -= sum(times)
        if GROWTH*min(times) > seconds:
            return


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__.split('\n\n')[1])
    name = sys.argv[1]
    peer = importlib.import_module('peer_' + name)
    for load in sys.argv[3:]:
        climb(name, peer, float(load), float(sys.argv[2]))


if __name__ == '__main__':
    main()
