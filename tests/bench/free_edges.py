#!/usr/bin/env python3
"""Times of wavycon, ASPHER, tamaas and ContactMechanics for a rough ball with free edges, and their pressures compared.

usage: free_edges.py --build DIRECTORY --peers DIRECTORY [--points N,...] [--others N,...] [--limit SECONDS]

The surface is a self-affine map on a ball, sixteen points to the shortest wave. Each row has a number of points a side
and a force: the contact, and of each program the processor time of the solution [s], with wavycon that of the whole
program, reading the map included; the time over wavycon's; and the largest difference of its pressures from wavycon's,
over the largest pressure. All solve to TOLERANCE, each in its own measure. Grids of --others are solved by wavycon and
ASPHER alone. Run it with a Python that has numpy.
"""
import argparse
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

PEERS = ("aspher", "tamaas", "contactmechanics")
FORCES = (3e-5, 6e-4, 3e-3, 1.2e-2)   # over E* and the square of the side
TOLERANCE = {"wavycon": 1e-8, "aspher": 1e-8, "tamaas": 1e-10, "contactmechanics": 1e-10}
ROUGH = "kind = 'self_affine', rms_slope = 0.1, long_wavelength = 0.25, edges = 'free', form_radius = 5"


def by_aspher(heights, force):
    import aspher
    coarsest = len(heights)
    while coarsest % 2 == 0 and coarsest > 64:
        coarsest //= 2
    begin = time.process_time()
    result = aspher.solve_nested(grid_size=len(heights), gap=heights.max() - heights, p_nominal=force, E_star=1.0,
                                 coarsest=coarsest, tol=TOLERANCE["aspher"], precision="float_then_double", backend="fft")
    return time.process_time() - begin, numpy.array(result.pressure)


def by_tamaas(heights, force):
    import tamaas
    tamaas.set_log_level(tamaas.LogLevel.error)
    tamaas.initialize(1)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(heights.shape))
    model.E, model.nu = 1.0, 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
    in_pressures = tamaas.PolonskyKeerRey.pressure
    solver = tamaas.PolonskyKeerRey(model, numpy.ascontiguousarray(heights), TOLERANCE["tamaas"],
                                    primal_type=in_pressures, constraint_type=in_pressures)
    solver.setIntegralOperator("dcfft")
    solver.max_iter = 5000
    begin = time.process_time()
    solver.solve(force)
    return time.process_time() - begin, numpy.array(model.traction)


def by_contactmechanics(heights, force):
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography
    half_space = FreeFFTElasticHalfSpace(heights.shape, 1.0, (1.0, 1.0), check_boundaries=False)
    system = NonSmoothContactSystem(half_space, Topography(heights, (1.0, 1.0)))
    begin = time.process_time()
    result = system.minimize_proxy(external_force=force, maxiter=5000,
                                   pentol=TOLERANCE["contactmechanics"]*numpy.ptp(heights))
    forces = result.jac[:heights.shape[0], :heights.shape[1]]
    return time.process_time() - begin, forces*heights.size


def solve(code, heights, force, target):
    """Solves here, in the program's own Python: time and pressures as numpy files."""
    seconds, pressures = globals()[f"by_{code}"](numpy.load(heights), float(force))
    numpy.savez(target, seconds=seconds, pressures=pressures)


def run(program, folder, deck):
    """User and system time of wavycon with a deck."""
    (folder/"deck.nml").write_text(deck)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "--quiet", "deck.nml", "--output", "."], cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def row(program, pythons, folder, points, force, codes, limit):
    """A line of the table."""
    heights = folder/"deck.height.npy"
    run(program, folder, f"&surface {ROUGH}, points = {points}, short_wavelength = {16/points!r} /\n"
                         "&load force = 0 /\n&output height = .true. /\n")
    heights = heights.rename(folder/"map.npy")
    deck = (f"&surface kind = 'file', file = 'map.npy', edges = 'free', length_x = 1 /\n&load force = {force!r} /\n"
            f"&method solver = 'grid', residual = {TOLERANCE['wavycon']!r} /\n")
    own = run(program, folder, deck)
    run(program, folder, deck + f"&output map = .true., map_format = 'npy', map_points = {points} /\n")
    expected = numpy.load(folder/"deck.map.npy")["pressure"][0]
    words = f"{points:>6} {force:>8.1e} {100*numpy.mean(expected > 0):>8.3f} {own:>8.2f}"
    for code in PEERS:
        seconds = difference = numpy.nan
        if code in codes and pythons[code]:
            target = folder/"answer.npz"
            target.unlink(missing_ok=True)
            subprocess.run(["timeout", str(limit), pythons[code], __file__, "--solve", code, str(folder/"map.npy"),
                            repr(force), str(target)], check=False, capture_output=True)
            if target.exists():
                with numpy.load(target) as answer:
                    seconds = float(answer["seconds"])
                    difference = abs(answer["pressures"] - expected).max()/expected.max()
        words += f" {seconds:>8.2f} {seconds/own:>7.1f} {difference:>8.1e}"
    return words


def main():
    if sys.argv[1:2] == ["--solve"]:
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--peers", required=True)
    parser.add_argument("--points", default="512,1024")
    parser.add_argument("--others", default="2048")
    parser.add_argument("--limit", type=float, default=300.0, help="of a solution [s]")
    arguments = parser.parse_args()
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    pythons = {code: peer_install.python_with(code, arguments.peers) for code in PEERS}
    print(f"#    N    force  contact  wavycon   {'   '.join(f'{code[:9]:>9}   ratio   diff' for code in PEERS)}")
    with tempfile.TemporaryDirectory() as folder:
        for sizes, codes in ((arguments.points, PEERS), (arguments.others, PEERS[:1])):
            for points in filter(None, sizes.split(",")):
                for force in FORCES:
                    print(row(arguments.build.resolve()/"wavycon", pythons, pathlib.Path(folder), int(points), force,
                              codes, arguments.limit), flush=True)
    return None


if __name__ == "__main__":
    main()
