"""A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa.

usage: consumer.py LIBRARY, such as PREFIX/lib/libwavycon.so. Arrays are numpy's if numpy is there, otherwise ctypes'.
"""
import sys
from ctypes import byref, c_double, c_void_p

from by_ctypes import Library

try:
    import numpy
except ImportError:
    numpy = None

WAVE = b"""&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3 /
&material e1 = 210e9, nu1 = 0.3 /
&method solver = 'auto', accuracy = 1e-4 /
&stress yield_stress = 1e9 /"""
ROUGH = b"""&surface kind = 'file', file = 'heights', length_x = 4e-3, length_y = 3e-3,
   detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror' /
&material e_star = 1e9 /
&method residual = 1e-10 /"""
lib = Library(sys.argv[1])


def field(rows, length):
    """A field of doubles and the pointer to it."""
    if numpy:
        array = numpy.empty((rows, length))
        return array, array.ctypes.data_as(c_void_p)
    array = (c_double*length*rows)()
    return array, byref(array)


def show(numbers, *words):
    print(*(f"{number:24.16e}" for number in numbers), *words)


def show_named(solution, *names):
    show([lib.number(solution, name) for name in names], lib.text(solution, "status"))


scene = lib.new_scene(WAVE, b"wave", 1, 0, 0, None)
for load in (0.9, 0.5, 0.2):
    solution = lib.solve(scene, b"pbar_over_pstar", load)
    show_named(solution, "pbar_over_pstar", "mean_gap", "contact_area_fraction", "peak_pressure",
               "peak_pressure_over_pstar_error")
    if load > 0.2:
        lib.delete(solution)
(pressure, to_pressure), (gap, to_gap) = field(32, 48), field(32, 48)
lib.get_grid(solution, 48, 32, None, to_pressure, to_gap, None)
show((max(max(row) for row in pressure), pressure[2][1], gap[2][23]),
     int(max(lib.table(solution, "contours")["curve"])))

# The stresses of this load below a crest, on a plane, and the largest ones.
nu, crest, depths = 0.3, (c_double*2)(0, 0), (c_double*2)(1e-4, 3e-4)
(stress, to_stress), (plane, to_plane), (principal, to_principal) = field(2, 6), field(32*48, 6), field(2, 3)
errors, von_mises, shear = (c_double*2)(), (c_double*2)(), (c_double*2)()
lib.get_stresses(solution, 2, crest, crest, depths, nu, b"constrained", to_stress, errors)
lib.get_invariants(2, to_stress, von_mises, shear, to_principal)
for i in range(2):
    show((*stress[i], errors[i], von_mises[i], shear[i], *principal[i]))
lib.get_stress_plane(solution, 48, 32, None, depths[0], nu, b"constrained", to_plane, None)
show(plane[4*48 + 7])
largest = lib.table(solution, "stress_largest")
show([largest[name][0] for name in ("largest_von_mises", "von_mises_x", "von_mises_y", "von_mises_depth",
                                    "largest_von_mises_over_pstar_error", "largest_shear")])

# The load at which steel yields, of a scene of its own, whose digits do not depend on other loads.
steel = lib.new_scene(WAVE, b"wave", 1, 0, 0, None)
yielding = lib.solve(steel, b"yield", 1)
show_named(yielding, "mean_pressure", "contact_area_fraction")

# A measured map with a tilt and a hole.
heights, to_heights = field(12, 16)
for j in range(12):
    for i in range(16):
        heights[j][i] = ((7*i*i + 3*j*j + i*j) % 11 + 0.25*i)/1048576
heights[2][5] = float("nan")
rough = lib.new_scene(ROUGH, b"rough", 1, 16, 12, to_heights)
pressed = lib.solve(rough, b"pbar_over_pstar", 0.2)
show_named(pressed, "mean_gap", "contact_area", "mean_pressure")
lib.delete(pressed, rough, yielding, steel, solution, scene, lib.error)
