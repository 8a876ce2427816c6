#!/usr/bin/env python3
"""Pressures of wavycon, tamaas and ASPHER on the same periodic height maps, point by point.

usage: map_peers.py --build DIRECTORY [--peers DIRECTORY] [--quick]

Run it with a Python that has numpy. First 16 kinds of maps of 32 x 32 points at seven loads, against a direct solver:
a dense matrix and the set of points in contact, changed until all conditions of contact hold. Then self-affine maps of
256 x 256 points, against wavycon. The programs solve to the tolerances below, each in its own measure. Differences are
the largest of a point, over the largest pressure.
"""
import argparse
import collections
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import numpy  # noqa: E402

import peer_install  # noqa: E402
import rough_runs  # noqa: E402
import rough_surface  # noqa: E402

POINTS, LOADS = 32, (1e-4, 1e-3, 0.01, 0.1, 0.3, 0.7, 0.95)   # loads: mean pressure over p*
ROUGH_POINTS, ROUGH_CUTOFFS, ROUGH_LOADS = 256, (16, 4), (0.001, 0.01, 0.1, 0.5, 0.9)
TOLERANCE = {rough_runs.OWN: 1e-12, "tamaas": 1e-12, "aspher": 1e-12}
ALIKE = 1e-6      # larger differences are counted
MOST_CHANGES = 400
LIMIT = 60.0      # processor time of a solution [s]


def maps():
    """{kind: heights of 32 x 32 points}."""
    n = POINTS
    x, y = numpy.meshgrid((numpy.arange(n) - n/2 + 0.3)/n, (numpy.arange(n) - n/2 - 0.2)/n, indexing="ij")
    random = numpy.random.Generator(numpy.random.PCG64(1985))
    waves = numpy.cos(2*numpy.pi*x)*numpy.cos(2*numpy.pi*y) + 0.3*numpy.cos(2*numpy.pi*(2*x + y))
    tile = numpy.tile(waves[::2, ::2], (2, 2))
    shifts = numpy.kron(random.standard_normal((2, 2)), numpy.ones((n//2, n//2)))

    def flat(depth, *blocks):
        heights = numpy.zeros((n, n))
        for i, j, wide, long in blocks:
            heights[i:i + wide, j:j + long] = depth
        return heights

    return {"waves": waves, "sphere": -x**2 - y**2, "cone": -numpy.hypot(x, y), "roof": -abs(x), "bowl": x**2 + y**2,
            "equal crests": tile, "nearly equal crests": tile + 1e-9*shifts, "terraces": numpy.round(5*waves)/5,
            "step": flat(-0.5, (0, 0, 16, 32)), "pit": flat(-0.5, (5, 7, 6, 4)),
            "pits": flat(-0.1, (3, 4, 5, 6), (20, 8, 2, 9), (12, 24, 7, 3)), "block": flat(0.5, (5, 7, 6, 4)),
            "checkerboard": waves + 0.5*(-1.0)**numpy.add.outer(numpy.arange(n), numpy.arange(n)),
            "noise": random.standard_normal((n, n)), "rough, 8 to 1": rough(n, 8), "rough, 4 to 1": rough(n, 4)}


def rough(points, cutoff):
    """A self-affine map whose waves have from 1/LONGEST of the cell, or all of a small one, to so many points."""
    kept, rough_surface.LONGEST = rough_surface.LONGEST, min(rough_surface.LONGEST, points/32)
    heights = rough_surface.rough_surface(points, points/cutoff)
    rough_surface.LONGEST = kept
    return heights


def direct(heights, load):
    """Pressures with E* = 1/pi and the mean `load`, exact to rounding, and whether all conditions hold."""
    n = heights.shape[0]
    waves = rough_surface.wave_numbers(n)
    waves[0, 0] = numpy.inf
    kernel = numpy.fft.irfft2(1/waves, (n, n))
    places = numpy.arange(n**2)
    i, j = places//n, places % n
    matrix = kernel[(i[:, None] - i) % n, (j[:, None] - j) % n]
    gap = heights.max() - heights.ravel()
    inside, fewest, patience = numpy.ones(n**2, bool), n**2 + 1, 10
    scale = heights.max() - heights.min()
    for _ in range(MOST_CHANGES):
        k = numpy.flatnonzero(inside)
        system = numpy.zeros((k.size + 1, k.size + 1))
        system[:-1, :-1], system[:-1, -1], system[-1, :-1] = matrix[numpy.ix_(k, k)], -1, 1
        found = numpy.linalg.solve(system, numpy.append(-gap[k], load*n**2))
        pressures = numpy.zeros(n**2)
        pressures[k] = found[:-1]
        gaps = gap + matrix[:, k] @ found[:-1] - found[-1]
        wrong = (inside & (pressures < 0)) | (~inside & (gaps < -1e-13*scale))
        if not wrong.any():
            return pressures.reshape(n, n), True
        # All at once while their number falls, otherwise the last alone: this ends (Judice & Pires 1994).
        if wrong.sum() < fewest:
            fewest, patience = wrong.sum(), 10
        else:
            patience -= 1
        if patience < 0:
            wrong[:numpy.flatnonzero(wrong)[-1]] = False
        inside ^= wrong
        if not inside.any():
            inside[gap.argmin()] = True
    return pressures.reshape(n, n), False


class Programs:
    """Solves a load with each program that there is."""

    def __init__(self, build, peers, folder):
        self.folder = folder
        self.commands, self.missing = {}, []
        pythons = {}
        for code in TOLERANCE:
            if code != rough_runs.OWN:
                pythons[code] = peer_install.python_with(code, peers)
            if code == rough_runs.OWN or pythons[code]:
                self.commands[code] = rough_runs.command_of(code, os.path.join(build, "tests", "bench"), pythons)
            else:
                self.missing.append(code)

    def pressures(self, code, heights, load):
        """Pressures, None without any; the status; the residual (C9)."""
        case = rough_runs.Case(heights, load, self.folder, LIMIT)
        heights.astype(float).tofile(case.input)
        run = case.run(self.commands[code], TOLERANCE[code])
        if run.judgement is None:
            return None, run.status, numpy.nan
        return numpy.fromfile(case.output).reshape(heights.shape), run.status, run.judgement.residual


def compare(programs, heights, load, expected):
    """{code: largest difference over the largest pressure}, of a solution that there is not NaN; and words."""
    words, differences = [], {}
    for code in programs.commands:
        found, status, residual = programs.pressures(code, heights, load)
        differences[code] = numpy.nan
        if found is not None:
            differences[code] = abs(found - expected).max()/expected.max()
        words.append(f"{differences[code]:>10.1e} {residual:>8.1e} {status:<11}")
    return differences, " ".join(words).rstrip()


def small_maps(programs, quick):
    """The table of the 32 x 32 maps."""
    print(f"#{'kind':<20} {'P':>8} {'contact':>8}  difference, residual and status of {', '.join(programs.commands)}")
    every = {code: [] for code in programs.commands}
    for kind, heights in maps().items():
        heights = heights - heights.mean()
        full = rough_surface.full_contact_pressure(heights)
        for load in LOADS[1:4] if quick else LOADS:
            expected, holds = direct(heights, load*full)
            if not holds:
                print(f"{kind:<21} {load:>8g}  the direct solver has no answer")
                continue
            differences, words = compare(programs, heights, load*full, expected)
            for code, difference in differences.items():
                every[code].append((difference, kind))
            print(f"{kind:<21} {load:>8g} {(expected > 0).mean():>8.4f} {words}", flush=True)
    for code, found in every.items():
        far = [(difference, kind) for difference, kind in found if not difference <= ALIKE]
        near = max(difference for difference, _ in found if difference <= ALIKE)
        kinds = collections.Counter(kind for _, kind in far)
        print(f"# {code}: {len(found) - len(far)} of {len(found)} loads within {near:.1e}; farther: {len(far)}"
              + "".join(f", {kind} {times} times" for kind, times in kinds.items())
              + (f", by {min(far)[0]:.1e} to {max(far)[0]:.1e}" if far else ""))


def large_maps(programs, quick):
    """The table of the self-affine maps."""
    points = ROUGH_POINTS//2 if quick else ROUGH_POINTS
    print(f"\n\n#{'shortest wave':<20} {'P':>8} {'contact':>8}  difference from {rough_runs.OWN}, residual and status "
          f"of {', '.join(programs.commands)}; {points} points a side")
    for cutoff in ROUGH_CUTOFFS:
        heights = rough_surface.rough_surface(points, points/cutoff)
        full = rough_surface.full_contact_pressure(heights)
        for load in ROUGH_LOADS:
            expected, _, _ = programs.pressures(rough_runs.OWN, heights, load*full)
            print(f"{cutoff:<21} {load:>8g} {(expected > 0).mean():>8.4f} "
                  f"{compare(programs, heights, load*full, expected)[1]}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", 1)[0])
    parser.add_argument("--build", required=True, help="where wavycon is built, its target bench too")
    parser.add_argument("--peers", help="where the other programs are or will be installed (BUILD/peers)")
    parser.add_argument("--quick", action="store_true", help="fewer loads and smaller maps")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(given.build, given.peers or str(pathlib.Path(given.build)/"peers"), folder)
        for code in programs.missing:
            print(f"# {code}: SKIPPED, it could not be installed")
        small_maps(programs, given.quick)
        large_maps(programs, given.quick)


if __name__ == "__main__":
    main()
