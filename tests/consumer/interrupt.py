"""Ends a load that takes long from its callback, and solves the next one. usage: interrupt.py LIBRARY"""
import sys
import time

from by_ctypes import PROGRESS, Library

DECK = b"""&surface kind = 'self_affine', points = 512, 512, hurst = 0.8, rms_height = 1e-6, length_x = 1e-3 /
&method solver = 'grid', residual = 1e-13 /"""
INTERRUPTED = 15
LONGEST = 1.0
lib, residuals, times = Library(sys.argv[1]), [], []


@PROGRESS
def stop_after_ten(_, iterations, residual):
    """Ends the load in the tenth call."""
    times.append(time.monotonic())
    residuals.append(residual)
    return len(residuals) >= 10 and iterations > 0


scene = lib.new_scene(DECK, b"rough", 0, 0, 0, None)
lib.set_progress(scene, stop_after_ten, None)
for quantity, value in ((b"pbar_over_pstar", 0.1), (b"contact_area_fraction", 0.3)):
    residuals.clear()
    ended = lib.solve(scene, quantity, value)
    assert time.monotonic() - times[-1] < LONGEST, "it went on for too long"
    assert lib.number(ended, "status_code") == INTERRUPTED and lib.text(ended, "status") == "interrupted"
    assert residuals[0] == 1 and all(0 < residual <= 1 for residual in residuals), residuals
# The next load has the digits of a scene that was never stopped.
lib.set_progress(scene, PROGRESS(), None)
areas = []
for one in (scene, lib.new_scene(DECK, b"rough", 0, 0, 0, None)):
    solution = lib.solve(one, b"pbar_over_pstar", 0.1)
    assert lib.number(solution, "status_code") < 10
    areas.append(lib.number(solution, "contact_area_fraction"))
assert areas[0] == areas[1] > 0, areas
print("stopped")
