"""A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa.

usage: consumer.py LIBRARY, such as PREFIX/lib/libwavycon.so. Arrays are numpy's if numpy is there, otherwise ctypes'.
"""
import sys
from ctypes import CDLL, byref, c_char_p, c_double, c_int, c_size_t, c_void_p, create_string_buffer

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

lib = CDLL(sys.argv[1])
pointer, texts = c_void_p, [c_char_p, c_void_p, c_size_t]
for function, result, arguments in (
        ("new_error", pointer, []), ("get_message", c_size_t, [pointer, c_void_p, c_size_t]),
        ("new_scene", pointer, [pointer, c_char_p, c_char_p, c_int, c_int, c_int, pointer]),
        ("solve", pointer, [pointer, pointer, c_char_p, c_double]),
        ("get", c_int, [pointer, pointer, c_char_p, pointer]),
        ("get_text", c_size_t, [pointer, pointer] + texts), ("new_table", pointer, [pointer, pointer, c_char_p]),
        ("get_column", c_int, [pointer, pointer, c_char_p, c_int, pointer]),
        ("get_grid", c_int, [pointer, pointer, c_int, c_int] + [pointer]*4),
        ("get_stresses", c_int, [pointer, pointer, c_int] + [pointer]*3 + [c_double, c_char_p] + [pointer]*2),
        ("get_stress_plane", c_int,
         [pointer, pointer, c_int, c_int, pointer, c_double, c_double, c_char_p, pointer, pointer]),
        ("get_invariants", c_int, [pointer, c_int] + [pointer]*4)):
    getattr(lib, "wavycon_" + function).restype = result
    getattr(lib, "wavycon_" + function).argtypes = arguments
error = c_void_p(lib.wavycon_new_error())


def check():
    """Raises the error of the last call, if there is one."""
    if lib.wavycon_get_code(error) != 0:
        text = create_string_buffer(lib.wavycon_get_message(error, None, 0))
        lib.wavycon_get_message(error, text, len(text))
        raise ValueError(text.value.decode())


def made(handle):
    """The object of a handle."""
    check()
    return c_void_p(handle)


def get(thing, name):
    """A number of an object."""
    number = c_double()
    lib.wavycon_get(error, thing, name.encode(), byref(number))
    check()
    return number.value


def get_text(thing, name):
    """A text of an object."""
    text = create_string_buffer(lib.wavycon_get_text(error, thing, name.encode(), None, 0))
    check()
    lib.wavycon_get_text(error, thing, name.encode(), text, len(text))
    return text.value.decode()


def columns(solution, name):
    """A table as a dictionary of columns."""
    table = made(lib.wavycon_new_table(error, solution, name.encode()))
    rows, found = int(get(table, "rows")), {}
    for column in get_text(table, "columns").splitlines():
        values = (c_double*rows)()
        lib.wavycon_get_column(error, table, column.split("[")[0].encode(), rows, values)
        check()
        found[column.split("[")[0]] = list(values)
    lib.wavycon_delete(byref(table))
    return found


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
    show([get(solution, name) for name in names], get_text(solution, "status"))


scene = made(lib.wavycon_new_scene(error, WAVE, b"wave", 1, 0, 0, None))
for load in (0.9, 0.5, 0.2):
    solution = made(lib.wavycon_solve(error, scene, b"pbar_over_pstar", load))
    show_named(solution, "pbar_over_pstar", "mean_gap", "contact_area_fraction", "peak_pressure",
               "peak_pressure_over_pstar_error")
    if load > 0.2:
        lib.wavycon_delete(byref(solution))
(pressure, to_pressure), (gap, to_gap) = field(32, 48), field(32, 48)
lib.wavycon_get_grid(error, solution, 48, 32, None, to_pressure, to_gap, None)
check()
show((max(max(row) for row in pressure), pressure[2][1], gap[2][23]), int(max(columns(solution, "contours")["curve"])))

# The stresses of this load below a crest, on a plane, and the largest ones.
nu, crest, depths = 0.3, (c_double*2)(0, 0), (c_double*2)(1e-4, 3e-4)
(stress, to_stress), (plane, to_plane), (principal, to_principal) = field(2, 6), field(32*48, 6), field(2, 3)
errors, von_mises, shear = (c_double*2)(), (c_double*2)(), (c_double*2)()
lib.wavycon_get_stresses(error, solution, 2, crest, crest, depths, nu, b"constrained", to_stress, errors)
check()
lib.wavycon_get_invariants(error, 2, to_stress, von_mises, shear, to_principal)
check()
for i in range(2):
    show((*stress[i], errors[i], von_mises[i], shear[i], *principal[i]))
lib.wavycon_get_stress_plane(error, solution, 48, 32, None, depths[0], nu, b"constrained", to_plane, None)
check()
show(plane[4*48 + 7])
largest = columns(solution, "stress_largest")
show([largest[name][0] for name in ("largest_von_mises", "von_mises_x", "von_mises_y", "von_mises_depth",
                                    "largest_von_mises_over_pstar_error", "largest_shear")])

# The load at which steel yields, of a scene of its own, whose digits do not depend on other loads.
steel = made(lib.wavycon_new_scene(error, WAVE, b"wave", 1, 0, 0, None))
yielding = made(lib.wavycon_solve(error, steel, b"yield", 1))
show_named(yielding, "mean_pressure", "contact_area_fraction")

# A measured map with a tilt and a hole.
heights, to_heights = field(12, 16)
for j in range(12):
    for i in range(16):
        heights[j][i] = ((7*i*i + 3*j*j + i*j) % 11 + 0.25*i)/1048576
heights[2][5] = float("nan")
rough = made(lib.wavycon_new_scene(error, ROUGH, b"rough", 1, 16, 12, to_heights))
pressed = made(lib.wavycon_solve(error, rough, b"pbar_over_pstar", 0.2))
show_named(pressed, "mean_gap", "contact_area", "mean_pressure")
for handle in (pressed, rough, yielding, steel, solution, scene, error):
    lib.wavycon_delete(byref(handle))
