"""Ends a load that takes long from its callback, and solves the next one. usage: interrupt.py LIBRARY"""
import sys
import time
from ctypes import CDLL, CFUNCTYPE, byref, c_char_p, c_double, c_int, c_void_p

DECK = b"""&surface kind = 'self_affine', points = 1024, 1024, hurst = 0.8, rms_height = 1e-6, length_x = 1e-3 /
&method solver = 'grid', residual = 1e-13 /"""
LONGEST = 1.0

lib = CDLL(sys.argv[1])
CALLBACK = CFUNCTYPE(c_int, c_void_p, c_int, c_double)
for name, result, arguments in (
        ("new_error", c_void_p, []), ("new_scene", c_void_p, [c_void_p, c_char_p, c_char_p] + [c_int]*3 + [c_void_p]),
        ("set_progress", c_int, [c_void_p, c_void_p, CALLBACK, c_void_p]),
        ("solve", c_void_p, [c_void_p, c_void_p, c_char_p, c_double]),
        ("get", c_int, [c_void_p, c_void_p, c_char_p, c_void_p])):
    getattr(lib, "wavycon_" + name).restype = result
    getattr(lib, "wavycon_" + name).argtypes = arguments
error, residuals, stopped = c_void_p(lib.wavycon_new_error()), [], 0.0


@CALLBACK
def stop_after_ten(_, iterations, residual):
    """Ends the load in its tenth iteration on a grid."""
    global stopped
    stopped = time.monotonic()
    residuals.append(residual)
    return len(residuals) >= 10 and iterations > 0


def number(solution, name):
    value = c_double()
    assert lib.wavycon_get(error, solution, name, byref(value)) == 0, name
    return value.value


scene = lib.wavycon_new_scene(error, DECK, b"rough", 0, 0, 0, None)
assert scene, "the scene"
assert lib.wavycon_set_progress(error, scene, stop_after_ten, None) == 0
for quantity, value in ((b"pbar_over_pstar", 0.1), (b"contact_area_fraction", 0.3)):
    residuals.clear()
    ended = lib.wavycon_solve(error, scene, quantity, value)
    assert time.monotonic() - stopped < LONGEST, "it went on for too long"
    assert number(ended, b"status_code") == 15, "the status"
    assert residuals[0] == 1 and all(0 < residual <= 1 for residual in residuals), residuals
# The next load has the digits of a scene that was never stopped.
lib.wavycon_set_progress(error, scene, CALLBACK(), None)
fresh = lib.wavycon_new_scene(error, DECK, b"rough", 0, 0, 0, None)
areas = []
for one in (scene, fresh):
    solution = lib.wavycon_solve(error, one, b"pbar_over_pstar", 0.1)
    assert number(solution, b"status_code") < 10
    areas.append(number(solution, b"contact_area_fraction"))
assert areas[0] == areas[1] > 0, areas
print("stopped")
