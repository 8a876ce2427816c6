#!/usr/bin/env python3
"""Rough surfaces with a hardness, solved on the same grid by wavycon, tamaas and ContactMechanics.

usage: hardness_peers.py --program WAVYCON --points N

Run it with a Python that has numpy, tamaas and ContactMechanics. The surface is self-affine, with a root mean square slope
of 1; E* is 1. Each line is a solution: mean pressure, hardness, program, whether it says that it converged, its
iterations, user time on one thread [s], and what is computed from its pressures in the same way for all: the residual (C9)
of src/contact/README.md, the contact area and the area at the hardness.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
import numpy  # noqa: E402

TOLERANCE = 1e-8          # of each program, in its own measure
ITERATION_LIMIT = 3000
LOADS = [(0.02, 0.3), (0.02, 0.1), (0.02, 0.04), (0.02, 0.022), (0.02, 0.0201), (0.2, 0.5), (0.2, 0.21)]
AT_BOUND = 1e-9           # a pressure this close to zero or to the hardness, over the hardness, is at it


def wave_numbers(points):
    along = numpy.fft.fftfreq(points)*points
    return numpy.hypot(*numpy.meshgrid(along, along))


def rough_surface(points):
    """Heights with a spectrum from 4 to points/8 waves, Hurst exponent 0.8."""
    q = wave_numbers(points)
    q[0, 0] = 1.0
    amplitudes = numpy.where((q >= 4) & (q <= points/8), q**-1.8, 0.0)
    noise = numpy.fft.fft2(numpy.random.default_rng(1).standard_normal((points, points)))
    slopes = numpy.fft.ifft2(2*numpy.pi*q*noise*amplitudes).real
    return numpy.fft.ifft2(noise*amplitudes).real/numpy.sqrt((slopes**2).mean())


def judge(heights, pressure, hardness):
    """Residual, contact area and area at the hardness."""
    q = wave_numbers(len(heights))
    q[0, 0] = 1.0
    waves = numpy.fft.fft2(pressure)/(numpy.pi*q)
    waves[0, 0] = 0.0
    gap = numpy.fft.ifft2(waves).real - heights
    capped = pressure >= hardness*(1 - AT_BOUND)
    contact = pressure > hardness*AT_BOUND
    gap -= gap[contact & ~capped].mean()
    violation = numpy.where(contact, numpy.where(capped, numpy.maximum(gap, 0.0), gap), numpy.minimum(gap, 0.0))
    return numpy.sqrt((violation**2).mean())/abs(gap).mean(), contact.mean(), capped.mean()


def wavycon(program, heights, pressure, hardness):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        numpy.savetxt(folder/"heights.dat", heights, fmt="%.17g")
        (folder/"deck.nml").write_text(
            "&surface kind = 'file', file = 'heights.dat', file_format = 'matrix', length_x = 1, length_y = 1 /\n"
            f"&material e_star = 1, hardness = {hardness!r} /\n&load mean_pressure = {pressure!r} /\n"
            f"&method solver = 'grid', residual = {TOLERANCE!r} /\n"
            "&output directory = '.', map = t, map_format = 'npy' /\n", encoding="utf-8")
        before = os.times().children_user
        subprocess.run([program, "deck.nml", "--quiet"], cwd=folder, check=False)
        seconds = os.times().children_user - before
        rows = [line.split() for line in (folder/"deck.summary.dat").read_text().splitlines() if line[0] != "#"]
        summary = dict(zip(rows[0], rows[1]))
        found = numpy.load(folder/"deck.map.npy")["pressure"][0]
    return found, summary["status"] in ("converged", "unresolved"), summary["iterations"], seconds


def tamaas(heights, pressure, hardness):
    import tamaas as peer
    peer.set_log_level(peer.LogLevel.error)
    peer.initialize(1)
    model = peer.ModelFactory.createModel(peer.model_type.basic_2d, [1.0, 1.0], list(heights.shape))
    model.E, model.nu = 1.0, 0.0
    heights = numpy.ascontiguousarray(heights)
    solver = peer.KatoSaturated(model, heights, TOLERANCE, hardness)
    solver.max_iter, solver.dump_freq = ITERATION_LIMIT, ITERATION_LIMIT + 1
    before = time.process_time()
    error = solver.solve(pressure)
    return numpy.array(model.traction), error <= TOLERANCE, "-", time.process_time() - before


def contactmechanics(heights, pressure, hardness):
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from ContactMechanics.Optimization.ConstrainedConjugateGradients import constrained_conjugate_gradients
    from SurfaceTopography import Topography
    half_space = PeriodicFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0))
    before = time.process_time()
    result = constrained_conjugate_gradients(
        half_space, Topography(heights, (1.0, 1.0), periodic=True), hardness=hardness/heights.size,
        external_force=pressure, maxiter=ITERATION_LIMIT, pentol=TOLERANCE*abs(heights).max())
    return result.jac*heights.size, result.success, result.nit, time.process_time() - before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="wavycon as it was built")
    parser.add_argument("--points", type=int, required=True, help="of the grid each way")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    heights = rough_surface(arguments.points)
    print("mean_pressure hardness program converged iterations user_time[s] residual contact_area area_at_hardness")
    for pressure, hardness in LOADS:
        for name, solve in (("wavycon", lambda *case: wavycon(program, *case)), ("tamaas", tamaas),
                            ("ContactMechanics", contactmechanics)):
            found, good, iterations, seconds = solve(heights, pressure, hardness)
            residual, contact, capped = judge(heights, found, hardness)
            print(pressure, hardness, name, "yes" if good else "no", iterations, f"{seconds:.2f}", f"{residual:.1e}",
                  f"{contact:.4f} {capped:.4f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
