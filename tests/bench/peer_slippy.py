"""slippy: the conjugate gradients of Polonsky & Keer, with FFTW; what its steps take for a load.

Its other solver for periodic contact, Rey's, is slower where it converges, and does not near full contact.
"""
import itertools
import math

import numpy
import slippy

# One thread, no graphics card: both are read when the plans are made.
slippy.CORES = 1
slippy.CUDA = False
slippy.dtype = 'float64'

from slippy import core  # noqa: E402

NAMES = itertools.count()


class Contact:
    """A rigid surface of heights [length of the cell's side] on a half-space; E* is 1/pi."""

    def __init__(self, heights, pressure, tolerance, iteration_limit):
        self.gap = heights.max() - heights
        self.pressure, self.tolerance, self.iteration_limit = pressure, tolerance, iteration_limit
        self.spacing = 1/heights.shape[0]
        name = str(next(NAMES))   # materials need different ones
        material = core.elastic_material.Elastic(name, {'E': 1/numpy.pi, 'v': 0.0}, zero_frequency_value=0.0)
        influence = material.influence_matrix(['zz'], [self.spacing]*2, heights.shape)['zz']
        self.convolution = core.plan_convolve(self.gap, influence, None, circular=True)
        self.pairs = 0
        self.result = None

    def counted(self, *arguments, **options):
        """The displacements of pressures."""
        self.pairs += 1
        return self.convolution(*arguments, **options)

    def forget(self):
        """Does nothing: each solution starts from zero."""

    def solve(self):
        """Whether it converged."""
        failed, *self.result = core.polonsky_and_keer(
            self.counted, numpy.ones_like(self.gap), self.gap, self.pressure, self.spacing,
            self.tolerance, self.iteration_limit)
        return not failed

    def answer(self):
        """Pressures and gaps."""
        return tuple(self.result)

    def effort(self):
        """Iterations, which it does not tell, and transforms there and back."""
        return math.nan, self.pairs
