"""Runs of wavycon and of other programs on rough surfaces, to equal residuals.

Each solution is a process of its own on one thread, which writes its pressures to a file. `judge` of rough_surface then
tells the residual, so that it is measured alike for all.
"""
import dataclasses
import math
import os
import resource
import signal
import statistics
import subprocess
import sys
import time

import numpy
import rough_surface

HERE = os.path.dirname(os.path.abspath(__file__))
OWN = 'wavycon'
START_UP = 15     # [s] of processor time that a program may take besides the solution
ATTEMPTS = 8      # most tolerances tried
REPEATS = 3       # solutions at the tolerance found, whose median time is told
MARGIN = 0.5      # of the residual wanted, aimed at by the next tolerance
LOOSE = 0.15      # of the residual wanted, below which a larger tolerance is tried
ROUNDING = 64*sys.float_info.epsilon  # over the mean gap, no residual is smaller: heights are of the order of 1
START = {OWN: 1.0, 'aspher': 1.0, 'tamaas': 1e-2, 'contactmechanics': 1.0, 'slippy': 1.0}  # tolerance over residual


@dataclasses.dataclass
class Run:
    """One solution. Status: 'good', 'unconverged' (its own word), 'limit' (of time) or 'failed'."""
    status: str
    seconds: float = math.nan      # processor time
    iterations: float = math.nan
    pairs: float = math.nan        # transforms there and back, in units of one on the last grid
    megabytes: float = math.nan    # most memory of the process
    process: tuple = (math.nan,)*3   # user, system and wall time of the whole process [s]
    tolerance: float = math.nan
    judgement: rough_surface.Judgement = None


class Case:
    """A load of a surface."""

    def __init__(self, heights, load, directory, limit):
        self.heights, self.load, self.limit = heights, load, limit   # limit of processor time [s]
        self.input = os.path.join(directory, 'heights.bin')
        self.output = os.path.join(directory, 'pressures.bin')

    def run(self, command, tolerance):
        """The solution of a program. The file of heights must be there."""
        def restrain():
            most = math.ceil(self.limit + START_UP)
            resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))

        numbers = [self.heights.shape[0], float(self.load), float(tolerance)]
        arguments = [self.input, *[repr(number) for number in numbers], self.output]
        environment = dict(os.environ, OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1', MKL_NUM_THREADS='1',
                           NUMBA_NUM_THREADS='1')
        before = time.perf_counter()
        with subprocess.Popen([*command, *arguments], env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, preexec_fn=restrain) as child:
            words = child.stdout.read().decode().splitlines()
            _, status, usage = os.wait4(child.pid, 0)
            process = usage.ru_utime, usage.ru_stime, time.perf_counter() - before
            child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode == -signal.SIGXCPU:
            return Run('limit', self.limit, tolerance=tolerance)
        if child.returncode or not words:
            return Run('failed', tolerance=tolerance)
        good, seconds, *effort = words[-1].split()
        if float(seconds) > self.limit:
            return Run('limit', self.limit, tolerance=tolerance)
        scale = 1024**2 if sys.platform == 'darwin' else 1024
        pressures = numpy.fromfile(self.output).reshape(self.heights.shape)
        return Run('good' if good == 'T' else 'unconverged', float(seconds), float(effort[0]), float(effort[-1]),
                   usage.ru_maxrss/scale, process, tolerance,
                   rough_surface.judge(self.heights, pressures, self.load))


def command_of(code, bench, pythons):
    if code == OWN:
        return [os.path.join(bench, 'bench_rough')]
    return [pythons[code], os.path.join(HERE, 'rough_peer.py'), code]


def attainable(run, residual):
    """The residual wanted, or that of rounding where it is larger: near full contact the mean gap is small."""
    return max(residual, ROUNDING/run.judgement.mean_gap)


def reaches(run, residual):
    """Whether a solution is accurate enough."""
    return run.judgement is not None and run.judgement.residual <= attainable(run, residual)


def solve_to(case, command, residual, tolerance, repeats=REPEATS):
    """The fastest solution of a program to a residual, over tolerances near a first one; see `search`.

    Its time is the median of repeated solutions, unless they take long.
    """
    best = search(lambda now: case.run(command, now), residual, tolerance)
    if reaches(best, residual):
        times = [best.seconds]
        while len(times) < repeats and sum(times) < case.limit/3:
            times.append(case.run(command, best.tolerance).seconds)
        best.seconds = statistics.median(times)
    return best


def search(solution, residual, tolerance):
    """The fastest run of solution(tolerance) to a residual; the most accurate if none reaches it."""
    best, misses, reached, missed = None, 0, 0.0, math.inf   # the largest and least such tolerances
    for _ in range(ATTEMPTS):
        run = solution(tolerance)
        if run.judgement is None or math.isnan(run.judgement.residual):
            return best or run
        if best is None or rank(run, residual) < rank(best, residual):
            best = run
        now, aim = run.judgement.residual, attainable(run, residual)
        if run.status != 'good' or LOOSE*aim <= now <= aim:
            break
        # The residual may stay the same over a range of tolerances: longer and longer steps, then between the two.
        if now > aim:
            misses, missed = misses + 1, min(missed, tolerance)
        else:
            reached = max(reached, tolerance)
        if reached > 0 and missed < math.inf:
            if missed < 3*reached:
                break
            tolerance = math.sqrt(reached*missed)
        else:
            tolerance *= min(max((MARGIN*aim/now)**max(misses, 1), 1e-4), 1e4)
    return best


def rank(run, residual):
    """Smaller is better: those that reach the residual by time, then the others by residual."""
    return (0, run.seconds) if reaches(run, residual) else (1, run.judgement.residual)


def load_for_contact(case, command, fraction):
    """The mean pressure at which a fraction of the points is in contact, to 1 %, by wavycon to a low accuracy."""
    def logit(value):
        return math.log(value/(1 - value))

    x = last_x = math.log(case.load)
    last_y = 0.0
    points = []
    for _ in range(8):
        case.load = math.exp(x)
        run = case.run(command, 1e-4)
        if run.judgement is None or not 0 < run.judgement.contact < 1:
            break
        y = logit(run.judgement.contact) - logit(fraction)
        points.append((abs(y), x))
        if abs(y) < 0.01:
            break
        # The contact grows at least as the pressure.
        slope = max((y - last_y)/(x - last_x), 0.5) if x != last_x else 1.1
        last_x, last_y = x, y
        x -= max(-1.0, min(1.0, y/slope))
    return math.exp(min(points)[1]) if points else case.load
