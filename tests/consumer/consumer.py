"""A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa.

usage: consumer.py LIBRARY, such as PREFIX/lib/libwavycon.so. Arrays are numpy's if numpy is there, otherwise ctypes'.
"""
import ctypes
import sys
from ctypes import byref, c_char_p, c_double, c_int, c_void_p

try:
    import numpy
except ImportError:
    numpy = None

DOUBLES = ("pbar_over_pstar mean_gap_over_amplitude approach_over_amplitude contact_area_fraction "
           "peak_pressure_over_pstar min_pressure_over_pstar mean_gap_over_amplitude_error contact_area_fraction_error "
           "peak_pressure_over_pstar_error area_at_hardness_fraction load_at_hardness_fraction "
           "area_at_hardness_fraction_error load_at_hardness_fraction_error "
           "mean_pressure mean_gap approach contact_area peak_pressure residual").split()


class Measures(ctypes.Structure):
    _fields_ = ([(name, c_double) for name in DOUBLES]
                + [(name, c_int) for name in ("active_constraints", "iterations", "status_code")]
                + [(name, c_double) for name in ("contact_area_counted_fraction", "contact_area_corrected_fraction",
                                                 "linear_area_fraction")])


class LargestStress(ctypes.Structure):
    _fields_ = [(name, c_double) for name in (
        "largest_von_mises_over_pstar", "largest_von_mises_over_pstar_error", "largest_shear_over_pstar",
        "largest_shear_over_pstar_error", "largest_von_mises", "von_mises_x", "von_mises_y", "von_mises_depth",
        "largest_shear", "shear_x", "shear_y", "shear_depth")]


lib = ctypes.CDLL(sys.argv[1])
for name, arguments in {
        "new_error": [], "new_wave_2d": [c_void_p, c_double, c_double, c_double],
        "new_measured_heights": [c_void_p, c_int, c_int, c_void_p, c_double, c_double, c_char_p],
        "new_solver": [c_void_p, c_void_p, c_double, c_char_p, c_int],
        "solve": [c_void_p, c_void_p, c_char_p, c_double]}.items():
    getattr(lib, "wavycon_" + name).restype = c_void_p
    getattr(lib, "wavycon_" + name).argtypes = arguments
lib.wavycon_get_stress.argtypes = [c_void_p]*2 + [c_int] + [c_void_p]*3 + [c_double, c_char_p] + [c_void_p]*2
lib.wavycon_get_stress_plane.argtypes = ([c_void_p]*2 + [c_int]*2 + [c_void_p, c_double, c_double, c_char_p]
                                         + [c_void_p]*2)
lib.wavycon_get_largest_stress.argtypes = [c_void_p]*2 + [c_double, c_char_p, c_void_p]


def check():
    """Raises the error of the last call, if there is one."""
    if lib.wavycon_check_error(error) != 0:
        text = ctypes.create_string_buffer(1000)
        lib.wavycon_get_error_message(error, text, ctypes.c_size_t(len(text)))
        raise ValueError(text.value.decode())


def field(rows, columns):
    """A field of doubles and the pointer to it."""
    if numpy:
        array = numpy.empty((rows, columns))
        return array, array.ctypes.data_as(c_void_p)
    array = (c_double*columns*rows)()
    return array, byref(array)


error = c_void_p(lib.wavycon_new_error())
surface = c_void_p(lib.wavycon_new_wave_2d(error, 1e-6, 1e-3, 1e-3))
solver = c_void_p(lib.wavycon_new_solver(error, surface, 210e9/(1 - 0.3**2), b"solver = 'auto', accuracy = 1e-4", 1))
check()
for load in (0.9, 0.5, 0.2):
    solution = c_void_p(lib.wavycon_solve(error, solver, b"pbar_over_pstar", load))
    check()
    m, status, edges = Measures(), ctypes.create_string_buffer(40), c_int()
    lib.wavycon_get_measures(error, solution, byref(m))
    lib.wavycon_get_status(error, solution, status, ctypes.c_size_t(len(status)))
    print(*(f"{number:24.16e}" for number in (m.pbar_over_pstar, m.mean_gap, m.contact_area_fraction, m.peak_pressure,
                                              m.peak_pressure_over_pstar_error)), status.value.decode())
    if load > 0.2:
        lib.wavycon_delete(byref(solution))
(pressure, to_pressure), (gap, to_gap) = field(32, 48), field(32, 48)
lib.wavycon_get_map(error, solution, 48, 32, None, to_pressure, to_gap, None)
check()
lib.wavycon_get_number_of_edges(error, solution, byref(edges))
print(*(f"{number:24.16e}" for number in (max(max(row) for row in pressure), pressure[2][1], gap[2][23])), edges.value)

# The stresses of this load below a crest, on a plane, the largest ones, and the load at which steel yields.
nu, crest, depths = 0.3, (c_double*2)(0, 0), (c_double*2)(1e-4, 3e-4)
(stress, to_stress), (plane, to_plane), (principal, to_principal) = field(2, 6), field(32*48, 6), field(2, 3)
errors, von_mises, shear, largest = (c_double*2)(), (c_double*2)(), (c_double*2)(), LargestStress()
lib.wavycon_get_stress(error, solution, 2, crest, crest, depths, nu, b"constrained", to_stress, errors)
check()
lib.wavycon_get_invariants(error, 2, to_stress, von_mises, shear, to_principal)
check()
for i in range(2):
    print(*(f"{number:24.16e}" for number in (*stress[i], errors[i], von_mises[i], shear[i], *principal[i])))
lib.wavycon_get_stress_plane(error, solution, 48, 32, None, depths[0], nu, b"constrained", to_plane, None)
check()
print(*(f"{number:24.16e}" for number in plane[4*48 + 7]))
lib.wavycon_get_largest_stress(error, solution, nu, b"constrained", byref(largest))
check()
print(*(f"{number:24.16e}" for number in (
    largest.largest_von_mises, largest.von_mises_x, largest.von_mises_y, largest.von_mises_depth,
    largest.largest_von_mises_over_pstar_error, largest.largest_shear)))
steel = c_void_p(lib.wavycon_new_solver(error, surface, 210e9/(1 - 0.3**2), b"solver = 'auto', accuracy = 1e-4", 1))
lib.wavycon_set_stress(error, steel, b"nu = 0.3, yield_stress = 1e9")
yielding = c_void_p(lib.wavycon_solve(error, steel, b"yield", 1))
check()
lib.wavycon_get_measures(error, yielding, byref(m))
lib.wavycon_get_status(error, yielding, status, ctypes.c_size_t(len(status)))
print(f"{m.mean_pressure:24.16e} {m.contact_area_fraction:24.16e}", status.value.decode())

# A measured map with a tilt and a hole.
heights, to_heights = field(12, 16)
for j in range(12):
    for i in range(16):
        heights[j][i] = ((7*i*i + 3*j*j + i*j) % 11 + 0.25*i)/1048576
heights[2][5] = float("nan")
rough = c_void_p(lib.wavycon_new_measured_heights(
    error, 16, 12, to_heights, 4e-3, 3e-3, b"detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror'"))
flat = c_void_p(lib.wavycon_new_solver(error, rough, 1e9, b"residual = 1e-10", 1))
pressed = c_void_p(lib.wavycon_solve(error, flat, b"pbar_over_pstar", 0.2))
check()
lib.wavycon_get_measures(error, pressed, byref(m))
lib.wavycon_get_status(error, pressed, status, ctypes.c_size_t(len(status)))
print(*(f"{number:24.16e}" for number in (m.mean_gap, m.contact_area, m.mean_pressure)), status.value.decode())
for handle in (pressed, flat, rough, yielding, steel, solution, solver, surface, error):
    lib.wavycon_delete(byref(handle))
