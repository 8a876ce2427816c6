"""ContactMechanics: the conjugate gradients of Polonsky & Keer in numpy, its solver for a force.

Its other solvers, Bugnicourt's among them, take a given displacement only.
"""
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from SurfaceTopography import Topography
import numpy


class Contact:
    """A rigid surface of heights [length of the cell's side] on a half-space; E* is 1/pi."""

    def __init__(self, heights, pressure, tolerance, iteration_limit):
        half_space = PeriodicFFTElasticHalfSpace(heights.shape, 1/numpy.pi, (1.0, 1.0))
        self.system = NonSmoothContactSystem(
            half_space, Topography(heights, (1.0, 1.0), periodic=True))
        half_space.evaluate_disp(numpy.zeros(heights.shape))  # makes the plans of the transforms
        self.pairs = 0
        self.displacements, half_space.evaluate_disp = half_space.evaluate_disp, self.counted
        # The tolerance is a length; the program has other tolerances too.
        self.arguments = {'external_force': pressure, 'maxiter': iteration_limit,
                          'pentol': tolerance*heights.max()}
        self.result = None

    def counted(self, forces):
        """The displacements of forces."""
        self.pairs += 1
        return self.displacements(forces)

    def forget(self):
        """Does nothing: each solution starts from zero."""

    def solve(self):
        """Whether it converged."""
        self.result = self.system.minimize_proxy(**self.arguments)
        return self.result.success

    def answer(self):
        """Pressures and gaps."""
        gaps = self.system.compute_gap(self.result.x, self.result.offset)
        return self.result.jac*self.result.jac.size, gaps

    def effort(self):
        """Iterations, and transforms there and back."""
        return self.result.nit, self.pairs
