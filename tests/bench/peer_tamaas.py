"""tamaas: the conjugate gradients of Polonsky & Keer with Rey's changes, in compiled C++.

Of its two formulations that in pressures is taken. That in gaps needs some hundred times longer for a load
that is given, and counts the points of the open gap that hold a rounding of pressure as contact.
"""
import math
import os
import tempfile

import numpy
import tamaas

tamaas.set_log_level(tamaas.LogLevel.info)
tamaas.initialize(1)


class Contact:
    """A rigid surface of heights [length of the cell's side] on a half-space; E* is 1/pi."""

    def __init__(self, heights, pressure, tolerance, iteration_limit):
        self.pressure, self.tolerance = pressure, tolerance
        self.heights = numpy.ascontiguousarray(heights)
        self.model = tamaas.ModelFactory.createModel(
            tamaas.model_type.basic_2d, [1.0, 1.0], list(heights.shape))
        self.model.E, self.model.nu = 1/numpy.pi, 0.0
        self.model.solveNeumann()  # makes the plans of the transforms
        in_pressures = tamaas.PolonskyKeerRey.pressure
        self.solver = tamaas.PolonskyKeerRey(
            self.model, self.heights, tolerance, primal_type=in_pressures, constraint_type=in_pressures)
        self.solver.max_iter = iteration_limit
        self.solver.dump_freq = iteration_limit + 1
        self.iterations = math.nan

    def forget(self):
        """Removes the solution, from which the solver would start."""
        self.model.traction[...] = 0.0
        self.model.displacement[...] = 0.0

    def solve(self):
        """Whether it converged."""
        # It tells its iterations on the standard error only: at the beginning of the last line.
        with tempfile.TemporaryFile() as log:
            kept = os.dup(2)
            os.dup2(log.fileno(), 2)
            try:
                error = self.solver.solve(self.pressure)
            finally:
                os.dup2(kept, 2)
                os.close(kept)
            log.seek(0)
            words = log.read().split(b'\n')[-2].split()
        self.iterations = int(words[0]) if words and words[0].isdigit() else math.nan
        return error <= self.tolerance

    def answer(self):
        """Pressures and gaps."""
        return numpy.array(self.model.traction), numpy.array(self.model['gap'])

    def effort(self):
        """Iterations, and transforms there and back, which it does not tell."""
        return self.iterations, math.nan
