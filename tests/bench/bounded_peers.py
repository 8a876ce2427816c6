#!/usr/bin/env python3
"""wavycon beside other programs on rough surfaces with free edges, or with a hardness.

usage: bounded_peers.py free|hardness --build DIRECTORY --peers DIRECTORY --points N,... [--others N,...]
                        [--limit SECONDS]

free: a self-affine map on a ball, sixteen points to the shortest wave; loads are forces over E* and the square of the
side. hardness: a periodic self-affine map with a root mean square slope of 1, eight points to the shortest wave; loads
are mean pressures and hardnesses over E*.

Each row has the points a side, the load, and of each program: the processor time of the solution [s], with wavycon that
of the whole program, reading the map included; the largest difference of its pressures from wavycon's over the largest
pressure; and, with a hardness, the residual (C9) of src/core/contact/README.md, computed in the same way for all. The last
columns are the contact and, with a hardness, the area at it. All solve to a tolerance, each in its own measure. Grids
of --others are solved by wavycon and ASPHER alone. Run it with a Python that has numpy.
"""
import argparse
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import numpy  # noqa: E402

import peer_install  # noqa: E402

KINDS = {   # keys of the map beside its points, edges, loads, programs
    "free": ("rms_slope = 0.1, long_wavelength = 0.25, edges = 'free', form_radius = 5", 16, "free",
             [(force, math.inf) for force in (3e-5, 6e-4, 3e-3, 1.2e-2)], ("aspher", "tamaas", "contactmechanics")),
    "hardness": ("rms_slope = 1, long_wavelength = 0.25", 8, "periodic",
                 [(0.02, 0.3), (0.02, 0.1), (0.02, 0.04), (0.02, 0.022), (0.02, 0.0201), (0.2, 0.5), (0.2, 0.21)],
                 ("tamaas", "contactmechanics")),
}
# Of each program in its own measure; of the last two with free edges.
TOLERANCE, TOLERANCE_OF_FREE = 1e-8, 1e-10
ITERATION_LIMIT = 5000
AT_BOUND = 1e-9           # a pressure this close to zero or to the hardness, over the hardness, is at it


def by_aspher(heights, load, hardness):
    import aspher
    coarsest = len(heights)
    while coarsest % 2 == 0 and coarsest > 64:
        coarsest //= 2
    begin = time.process_time()
    result = aspher.solve_nested(grid_size=len(heights), gap=heights.max() - heights, p_nominal=load, E_star=1.0,
                                 coarsest=coarsest, tol=TOLERANCE, precision="float_then_double", backend="fft")
    return time.process_time() - begin, numpy.array(result.pressure)


def by_tamaas(heights, load, hardness):
    import tamaas
    tamaas.set_log_level(tamaas.LogLevel.error)
    tamaas.initialize(1)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(heights.shape))
    model.E, model.nu = 1.0, 0.0
    heights = numpy.ascontiguousarray(heights)
    if hardness < math.inf:
        solver = tamaas.KatoSaturated(model, heights, TOLERANCE, hardness)
    else:
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        in_pressures = tamaas.PolonskyKeerRey.pressure
        solver = tamaas.PolonskyKeerRey(model, heights, TOLERANCE_OF_FREE, primal_type=in_pressures,
                                        constraint_type=in_pressures)
        solver.setIntegralOperator("dcfft")
    solver.max_iter, solver.dump_freq = ITERATION_LIMIT, ITERATION_LIMIT + 1
    begin = time.process_time()
    solver.solve(load)
    return time.process_time() - begin, numpy.array(model.traction)


def by_contactmechanics(heights, load, hardness):
    from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
    from ContactMechanics.Optimization.ConstrainedConjugateGradients import constrained_conjugate_gradients
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography
    tolerance = TOLERANCE if hardness < math.inf else TOLERANCE_OF_FREE
    options = {"external_force": load, "maxiter": ITERATION_LIMIT, "pentol": tolerance*numpy.ptp(heights)}
    begin = time.process_time()
    if hardness < math.inf:
        result = constrained_conjugate_gradients(
            PeriodicFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0)), Topography(heights, (1.0, 1.0), periodic=True),
            hardness=hardness/heights.size, **options)
    else:
        half_space = FreeFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0), check_boundaries=False)
        result = NonSmoothContactSystem(half_space, Topography(heights, (1.0, 1.0))).minimize_proxy(**options)
    return time.process_time() - begin, result.jac[:heights.shape[0], :heights.shape[1]]*heights.size


def solve(code, heights, load, hardness, target):
    """Solves here, in the program's own Python: time and pressures as numpy files."""
    seconds, pressures = globals()[f"by_{code}"](numpy.load(heights), float(load), float(hardness))
    numpy.savez(target, seconds=seconds, pressures=pressures)


def residual(heights, pressure, hardness):
    """(C9) of a periodic surface with a hardness, and the area at it."""
    q = numpy.hypot(*numpy.meshgrid(*[numpy.fft.fftfreq(len(heights))*len(heights)]*2))
    q[0, 0] = 1.0
    waves = numpy.fft.fft2(pressure)/(numpy.pi*q)
    waves[0, 0] = 0.0
    gap = numpy.fft.ifft2(waves).real - heights
    capped, contact = pressure >= hardness*(1 - AT_BOUND), pressure > hardness*AT_BOUND
    gap -= gap[contact & ~capped].mean()
    violation = numpy.where(contact, numpy.where(capped, numpy.maximum(gap, 0.0), gap), numpy.minimum(gap, 0.0))
    return numpy.sqrt((violation**2).mean())/abs(gap).mean(), capped.mean()


def run(program, folder, deck):
    """User and system time of wavycon with a deck."""
    (folder/"deck.nml").write_text(deck)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "--quiet", "deck.nml", "--output", "."], cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def row(kind, program, pythons, folder, points, load, hardness, codes, limit):
    """A line of the table."""
    keys, shortest, edges, _, peers = KINDS[kind]
    run(program, folder, f"&surface kind = 'self_affine', {keys}, points = {points}, short_wavelength = "
                         f"{shortest/points!r} /\n&load mean_pressure = 0 /\n&output height = .true. /\n")
    heights = (folder/"deck.height.npy").rename(folder/"map.npy")
    material = f"hardness = {hardness!r}" if hardness < math.inf else ""
    deck = (f"&surface kind = 'file', file = 'map.npy', edges = '{edges}', length_x = 1 /\n&load force = {load!r} /\n"
            f"&material {material} /\n&method solver = 'grid', residual = {TOLERANCE!r} /\n")
    seconds = {"wavycon": run(program, folder, deck)}
    run(program, folder, deck + f"&output map = .true., map_format = 'npy', map_points = {points} /\n")
    expected = numpy.load(folder/"deck.map.npy")["pressure"][0]
    words = f"{points:>6} {load:>8.1e} {hardness:>8.4g}"
    for code in ("wavycon", *peers):
        found = expected if code == "wavycon" else None
        if code in codes and pythons[code]:
            target = folder/"answer.npz"
            target.unlink(missing_ok=True)
            subprocess.run(["timeout", str(limit), pythons[code], __file__, "--solve", code, str(heights), repr(load),
                            repr(hardness), str(target)], check=False, capture_output=True)
            if target.exists():
                with numpy.load(target) as answer:
                    seconds[code], found = float(answer["seconds"]), answer["pressures"]
        words += f" {seconds.get(code, math.nan):>9.2f}"
        words += f" {math.nan if found is None else abs(found - expected).max()/expected.max():>8.1e}"
        if hardness < math.inf:
            words += f" {math.nan if found is None else residual(numpy.load(heights), found, hardness)[0]:>8.1e}"
    words += f" {100*numpy.mean(expected > 0):>8.3f}"
    return words + (f" {residual(numpy.load(heights), expected, hardness)[1]:.4f}" if hardness < math.inf else "")


def main():
    if sys.argv[1:2] == ["--solve"]:
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=list(KINDS))
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--peers", required=True)
    parser.add_argument("--points", required=True)
    parser.add_argument("--others", default="")
    parser.add_argument("--limit", type=float, default=300.0, help="of a solution [s]")
    given = parser.parse_args()
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    *_, loads, peers = KINDS[given.kind]
    pythons = {code: peer_install.python_with(code, given.peers) for code in peers}
    of_each = "  time[s]  differs residual" if given.kind == "hardness" else "  time[s]  differs"
    print(f"# Of each of wavycon, {', '.join(peers)}:{of_each}\n"
          f"#    N     load hardness{of_each*(1 + len(peers))}  contact")
    with tempfile.TemporaryDirectory() as folder:
        for sizes, codes in ((given.points, peers), (given.others, ("aspher",))):
            for points in filter(None, sizes.split(",")):
                for load, hardness in loads:
                    print(row(given.kind, given.build.resolve()/"wavycon", pythons, pathlib.Path(folder), int(points),
                              load, hardness, codes, given.limit), flush=True)
    return None


if __name__ == "__main__":
    main()
