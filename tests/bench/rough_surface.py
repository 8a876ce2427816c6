"""Self-affine periodic rough surfaces, and the conditions of contact on them.

Everything here is numpy's alone, so that it judges all programs alike. Lengths are in units of the side of the cell,
heights are divided by the largest, pressures are those of E* = 1/pi: a wave of q waves on the cell then has the
pressure q u for a displacement u.
"""
import dataclasses
import math

import numpy

HURST = 0.8
LONGEST = 8  # waves on the cell's side of the longest wave
SEED = 1985


def wave_numbers(points):
    """Waves on the cell's side of each term of numpy's transform of real fields."""
    return numpy.hypot(numpy.fft.fftfreq(points, 1/points)[:, None], numpy.fft.rfftfreq(points, 1/points))


def rough_surface(points, most):
    """Heights, shape (points, points), whose waves have from 1/LONGEST to 1/most of the cell.

    Amplitudes fall as the wave number to the power -1 - Hurst exponent, phases are random. The same waves have the
    same phases on all grids. No symmetry is left.
    """
    random = numpy.random.Generator(numpy.random.PCG64(SEED))
    # From the longest waves to the shortest, so that those of a coarser grid come first.
    side = int(most)
    x, y = numpy.meshgrid(numpy.arange(-side, side + 1), numpy.arange(side + 1), indexing='ij')
    order = numpy.lexsort((x.ravel(), y.ravel(), numpy.maximum(abs(x), y).ravel()))
    x, y = x.ravel()[order], y.ravel()[order]
    waves = numpy.hypot(x, y)
    phases = 2*numpy.pi*random.random(x.size)
    # A wave and its opposite are one: of those with y = 0 half are kept.
    inside = (waves >= LONGEST) & (waves <= most) & ((y > 0) | (x > 0))
    x, y, waves, phases = (values[inside] for values in (x, y, waves, phases))
    spectrum = numpy.zeros((points, points//2 + 1), complex)
    spectrum[x, y] = waves**(-1 - HURST)*numpy.exp(1j*phases)
    spectrum[-x[y == 0], 0] = numpy.conj(spectrum[x[y == 0], 0])
    heights = numpy.fft.irfft2(spectrum, (points, points))
    return heights/heights.max()


def full_contact_pressure(heights):
    """p*: the mean pressure that just closes the gap everywhere."""
    points = heights.shape[0]
    return -numpy.fft.irfft2(wave_numbers(points)*numpy.fft.rfft2(heights), heights.shape).min()


def pressure_for_contact(heights, fraction):
    """Persson's estimate of the mean pressure for a fraction of the area in contact: fraction = erf(2^(1/2) p/(E* h')).

    h' is the root mean square of the slope.
    """
    points = heights.shape[0]
    size = abs(numpy.fft.rfft2(heights)*wave_numbers(points))**2
    size[:, 1:(points + 1)//2] *= 2  # each stands for its conjugate too
    slope = 2*numpy.pi*math.sqrt(size.sum())/points**2
    low, high = 0.0, 6.0
    while high - low > 1e-12:
        middle = (low + high)/2
        low, high = (middle, high) if math.erf(middle) < fraction else (low, middle)
    return low*slope/math.sqrt(2)/math.pi


@dataclasses.dataclass
class Judgement:
    """How well pressures meet the conditions of contact."""
    contact: float          # fraction of the points with pressure
    residual: float         # (C9) of src/core/contact/README.md; NaN if a pressure is negative or no number
    complementarity: float  # sum of p times the size of the gap, over sum p times mean gap
    load_error: float       # of the mean pressure, relative
    mean_gap: float


def judge(heights, pressures, load):
    """The conditions of contact (C1) for pressures whose mean should be `load`."""
    waves = wave_numbers(heights.shape[0])
    waves[0, 0] = math.inf  # the mean displacement is part of the approach
    contact = pressures > 0
    if not numpy.isfinite(pressures).all() or pressures.min() < 0 or not contact.any():
        return Judgement(contact.mean(), math.nan, math.nan, math.nan, math.nan)
    gaps = numpy.fft.irfft2(numpy.fft.rfft2(pressures)/waves, heights.shape) - heights
    gaps -= gaps[contact].mean()
    violated = numpy.where(contact, gaps, numpy.minimum(gaps, 0))
    mean = gaps.mean()
    return Judgement(contact.mean(), math.sqrt((violated**2).mean())/mean,
                     (pressures*abs(gaps)).sum()/(pressures.sum()*mean), pressures.mean()/load - 1, mean)
