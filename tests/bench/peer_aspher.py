"""aspher: preconditioned conjugate gradients on nested grids, compiled, its engine for periodic surfaces.

Of its options those are taken that were fastest: nested grids, |q| by transforms as the preconditioner (its choice for
periodic surfaces), iterations in single precision as far as these go, finished in double. As it is installed, with
pocketfft and no processor's special instructions: FFTW and -march=native did not make it faster.
"""
import aspher
import numpy

COARSEST = 64        # points along a side of its first grid; 32 and 128 take the same time
FLOAT_FLOOR = 1e-6   # its tolerance in single precision: 2e-6, its own, is slower by up to 1.08; 3e-7 may stagnate


class Contact:
    """A rigid surface of heights [length of the cell's side] on a half-space; E* is 1/pi."""

    def __init__(self, heights, pressure, tolerance, iteration_limit):
        points = heights.shape[0]
        coarsest = points
        while coarsest % 2 == 0 and coarsest > COARSEST:
            coarsest //= 2
        self.gap = heights.max() - heights
        self.arguments = {'grid_size': points, 'p_nominal': pressure, 'E_star': 1/numpy.pi, 'backend': 'periodic',
                          'coarsest': coarsest, 'precision': 'float_then_double', 'float_floor': FLOAT_FLOOR,
                          'tol': tolerance, 'max_iter': iteration_limit}
        self.result = None

    def forget(self):
        """Does nothing: each solution starts from zero."""

    def solve(self):
        """Whether it converged."""
        self.result = aspher.solve_nested(gap=self.gap, **self.arguments)
        return self.result.converged

    def answer(self):
        """Pressures and gaps."""
        return numpy.array(self.result.pressure), numpy.array(self.result.gap)

    def effort(self):
        """Iterations on all grids, and transforms there and back in units of one on the last grid.

        Of the coarse grids it reports iterations and products; there is a preconditioning to each iteration.
        """
        stages = self.result.stage_stats
        last = self.arguments['grid_size']
        pairs = self.result.matvec_count + self.result.precond_count
        for stage in stages:
            if stage['name'].startswith('coarse:'):
                share = (int(stage['name'].split(':')[1])/last)**2
                pairs += share*(stage['matvec_count'] + stage['iterations'])
        return sum(stage['iterations'] for stage in stages), pairs
