#!/usr/bin/env python3
"""Solves one load of a height map with tamaas, contactmechanics, slippy or aspher, once and on one thread.

usage: rough_peer.py PEER HEIGHTS POINTS LOAD TOLERANCE PRESSURES

The arguments are those of bench_rough; TOLERANCE is the program's own, which differs from program to program. The line
of standard output, too: whether it converged, processor time [s] from the heights to the pressures, iterations on all
grids and transforms there and back, the last two NaN where the program does not tell.
"""
import importlib
import sys
import time

import numpy

ITERATION_LIMIT = 20000


def solve(peer, heights, load, tolerance):
    """Whether it converged, the processor time, and the contact."""
    before = time.process_time()
    contact = peer.Contact(heights, load, tolerance, ITERATION_LIMIT)
    good = contact.solve()
    return good, time.process_time() - before, contact


def main():
    if len(sys.argv) != 7:
        sys.exit(__doc__.split('\n\n')[1])
    peer = importlib.import_module('peer_' + sys.argv[1])
    points = int(sys.argv[3])
    heights = numpy.fromfile(sys.argv[2]).reshape(points, points)
    # What a first call imports and compiles is not timed.
    crest = numpy.cos(2*numpy.pi*numpy.arange(32)/32)/2
    solve(peer, crest[:, None] + crest, 0.5, 1e-4)
    good, seconds, contact = solve(peer, heights, float(sys.argv[4]), float(sys.argv[5]))
    contact.answer()[0].astype(float).tofile(sys.argv[6])
    iterations, pairs = contact.effort()
    print('T' if good else 'F', f'{seconds:.4f}', iterations, pairs)


if __name__ == '__main__':
    main()
