"""wavycon by its shared library: loads solved again and again from nothing, with their times."""
import pathlib
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT/"tests"/"consumer"), str(ROOT/"tests"/"support")]
from by_ctypes import Library  # noqa: E402
from tables import Table  # noqa: E402

REPEATS, REPEAT_TIME = 5, 1.0   # most runs behind a median, and the time for those after the first [s]
VALUES = "mean_gap_over_amplitude", "contact_area_fraction", "peak_pressure_over_pstar"


def reference_loads():
    """The loads of the reference table."""
    return [float(word) for word in Table(ROOT/"inputs"/"reference_2d.dat").column("pbar_over_pstar")]


def repeated(prepare, run, repeats=REPEATS):
    """The answer of the last run(prepare()), and the processor times of the runs alone [ms]."""
    times = []
    while not times or (len(times) < repeats and (len(times) + 1)*min(times) < 1000*REPEAT_TIME):
        prepared = prepare()
        before = time.process_time()
        answer = run(prepared)
        times.append(1000*(time.process_time() - before))
    return answer, times


class Own:
    """Solves loads, given by P, of decks without &load. Solutions live until the next one."""

    def __init__(self, build):
        self.library = Library(pathlib.Path(build)/"src"/f"libwavycon.{'dylib' if sys.platform == 'darwin' else 'so'}")
        self.alive = []

    def scene(self, surface, method, more="", fields=False):
        """A scene; all objects before it are deleted."""
        self.library.delete(*self.alive)
        deck = f"&surface {surface} / &method {method} / {more}"
        self.alive = [self.library.new_scene(deck.encode(), b"bench", fields, 0, 0, None)]
        return self.alive[0]

    def load(self, scene, load):
        """A solution."""
        self.alive.append(self.library.solve(scene, b"pbar_over_pstar", load))
        return self.alive[-1]

    def solved(self, surface, method, load, repeats=REPEATS, **options):
        """A solution and the times [ms] of loads that are solved from nothing."""
        return repeated(lambda: self.scene(surface, method, **options), lambda scene: self.load(scene, load), repeats)

    def numbers(self, solution, *names):
        return [self.library.number(solution, name) for name in names]

    def values(self, solution):
        """Mean gap, contact area and peak pressure, and their error estimates."""
        return self.numbers(solution, *VALUES), self.numbers(solution, *(name + "_error" for name in VALUES))


def middle_and_least(times):
    return f"{statistics.median(times):10.3f}{min(times):10.3f}"
