#!/usr/bin/env python3
"""Writes a self-affine periodic rough surface, and prints the mean pressure for about a tenth of contact area.

usage: rough_surface.py POINTS FILE

FILE gets a matrix of heights of 17 digits on a cell of side 1, root mean square 1. The waves have from 1/8
of the cell to 8 points, amplitudes as the wave number to the power -1 - Hurst exponent and random phases;
the seed is fixed. Standard output: mean pressure over E*, by A/A0 = 2 p/(E* h'), h' the root mean square of
the slope. No symmetry is left.
"""
import sys

import numpy

HURST = 0.8
LONGEST, SHORTEST = 8, 8  # waves on the cell's side, points on a wave
SEED = 1985
CONTACT = 0.1


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.split('\n\n')[1])
    n = int(sys.argv[1])
    random = numpy.random.Generator(numpy.random.PCG64(SEED))
    x, y = numpy.fft.fftfreq(n, 1/n)[:, None], numpy.fft.rfftfreq(n, 1/n)
    waves = numpy.hypot(x, y)
    inside = (waves >= LONGEST) & (waves <= n/SHORTEST)
    amplitudes = numpy.where(inside, numpy.where(inside, waves, 1)**(-1 - HURST), 0)
    spectrum = amplitudes*numpy.exp(2j*numpy.pi*random.random(waves.shape))
    heights = numpy.fft.irfft2(spectrum, (n, n))
    scale = 1/heights.std()
    heights *= scale
    spectrum = numpy.fft.rfft2(heights)
    slopes = [numpy.fft.irfft2(2j*numpy.pi*q*spectrum, (n, n)) for q in (x, y)]
    slope = numpy.sqrt(sum((s**2).mean() for s in slopes))
    numpy.savetxt(sys.argv[2], heights, fmt='%.17g')
    print(f'{CONTACT*slope/2:.12g}')


if __name__ == '__main__':
    main()
