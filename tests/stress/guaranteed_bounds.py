"""The guaranteed bounds of energy, approach and mean gap of random surfaces, bodies, grids and units: against far more
accurate solutions, as judges of the solvers' own numbers, and from pressures and gaps with planted faults."""
import collections
import math
import sys
import warnings

from common import Table
from random_scenes import FITTED, KINDS, QUICK, random_loads, random_scene
from summaries import ROUNDING, solve

LARGEST_RATIO = 3.0  # of the solver's own distance from the bounds over its error estimate, as README states of one
CONVERSION = 1e-10  # of bounds of fields in the deck's units, over the energy and over Delta
MOST = 256  # points of a grid along each side
FINER = 4  # A grid that judges has so many times as many,
MOST_FINE = 512  # but on a surface at most so many.
AT_OWN_POINTS = ("profile", "sum", "file", "mirrored file")  # kinds without a solution on a quarter of the cell
BOUNDED = ("energy", "approach", "mean_gap")


def campaign(settings, work):
    """Scenes of each kind at one load each. Numbers: the largest distance of a solver's own energy from the bounds over
    its estimate, and the median and largest relative width of the energy. The notes tell judges, widths by kind, and
    how often a fault makes the bounds wider."""
    part = settings.part("guaranteed bounds")
    try:
        library = Library(settings.program.parent/"python")
    except ImportError as error:
        part.notes.append(f"left out: {error}")
        return part
    judges, widths, of_body, ratios = collections.Counter(), *(collections.defaultdict(list) for _ in range(3))
    for name, stream, kind in settings.cases("bounds", *settings.amount((KINDS, 77), (QUICK, 3))):
        case = Case(stream, kind, settings.program, work)
        judge, truth, complaints = case.truth(settings.program, work)
        answer, more = solved(settings.program, case.files(case.grid()), work)
        complaints += more
        if answer and truth:
            judges[judge] += 1
            widths[kind].append(answer.relative_width())
            of_body[case.body].append(answer.relative_width())
            complaints += outside("the program's bounds", answer.bounds, truth)
            for own, error, (lower, upper) in zip(answer.own, answer.errors, answer.bounds):
                # Where there is a hardness the own energy lacks that of the overlap.
                if "hardness" not in case.body:
                    part.limit("own numbers", max(lower - own, own - upper, 0.0)/max(error, ROUNDING), LARGEST_RATIO,
                               complaints, f"the solver's {own!r} is not in [{lower!r}, {upper!r}]")
            for fault, bounds in library.bounds(work, stream, answer.units):
                complaints += outside(fault, bounds, truth)
                if fault == "none":
                    right = bounds
                    if "hardness" not in case.body and kind in AT_OWN_POINTS and differ(bounds, answer.bounds):
                        complaints.append(f"the library has {bounds}, the table {answer.bounds}")
                ratios[fault].append((bounds[0][1] - bounds[0][0])/(right[0][1] - right[0][0]))
        part.count(name, complaints, case.files(case.grid()))
    part.notes.append(f"{sum(map(len, ratios.values()))} times bounds from fields; truth: "
                      + ", ".join(f"{judge} {number}" for judge, number in judges.items()))
    for what, numbers in (("width", widths), ("width", of_body), ("fault", ratios)):
        part.notes += [f"{what}, {name}: {len(some)} times, median {sorted(some)[len(some)//2]:.2g}, from "
                       f"{min(some):.2g} to {max(some):.2g}, above 1 "
                       f"{sum(one > 1.0 + CONVERSION for one in some)} times"
                       for name, some in sorted(numbers.items())]
    every = sorted(sum(widths.values(), []))
    part.numbers["width"], part.numbers["largest"] = every[len(every)//2], every[-1]
    return part


class Case:
    """A scene in random units, a load, the points of a grid, and a body."""

    def __init__(self, stream, kind, program, work):
        self.scene = random_scene(stream, kind, 10.0**stream.uniform(-9.0, 3.0), 10.0**stream.uniform(-9.0, 3.0))
        self.load, = random_loads(stream, 1)
        self.e_star = 10.0**stream.uniform(-3.0, 12.0)
        self.body = stream.choice(("half-space",)*4 + ("layer", "hardness", "layer and hardness"))
        # Solvers whose answers are as good as exact.
        self.exact = {"wave_1d": "auto", **dict.fromkeys(FITTED, "fitted")}.get(kind, "")
        if self.body != "half-space":
            self.exact = ""
        most = MOST if self.exact or self.scene.is_profile else MOST_FINE//FINER
        self.points = [2*stream.randint(8, most//2) for _ in range(1 if self.scene.is_profile else 2)]
        self.more = ""
        if "layer" in self.body:
            self.more = f", layer_thickness = {max(self.scene.cell)*10.0**stream.uniform(-2.0, 1.0)!r}, "
            self.more += stream.choice(("layer_base = 'smooth'",
                                        f"layer_base = 'bonded', layer_nu = {stream.uniform(0.0, 0.5)!r}"))
        if "hardness" in self.body:
            # From little above the mean pressure to somewhat above the peak.
            rows, _ = solve(program, self.files(self.grid()), work)
            mean, peak = (float(rows[0].words[name]) for name in ("mean_pressure", "peak_pressure"))
            self.more += f", hardness = {mean + stream.uniform(0.05, 1.2)*(peak - mean)!r}"

    def grid(self, finer=1):
        """Keys of &method."""
        return f"solver = 'grid', grid_points = {', '.join(str(finer*n) for n in self.points)}"

    def files(self, method):
        files = self.scene.files([self.load], method, self.e_star, self.more)
        files["deck.nml"] += "&output bounds = t /\n"
        return files

    def truth(self, program, work):
        """Who judges, intervals that contain energy, approach and mean gap, and what is wrong with the run."""
        if self.exact:
            # Close to merging there may be no fitted solution.
            answer, _ = solved(program, self.files(f"solver = '{self.exact}', accuracy = 1e-10"), work)
            if answer:
                return self.exact, [(own - max(error, ROUNDING), own + max(error, ROUNDING))
                                    for own, error in zip(answer.own, answer.errors)], []
        answer, complaints = solved(program, self.files(self.grid(FINER)), work)
        return f"grids {FINER} times as fine", answer and answer.bounds, complaints


class Answer:
    """The solver's own energy, approach and mean gap of the load of a deck in p* and Delta, and their bounds."""

    def __init__(self, work):
        (summary,), (bounds,) = (Table(work/"results"/f"deck.{name}.dat").records() for name in ("summary", "bounds"))
        elastic = "elastic_energy_over_pstar_amplitude"
        load, approach, gap, energy, error, energy_error = (float(summary[name]) for name in (
            "pbar_over_pstar", "approach_over_amplitude", "mean_gap_over_amplitude", elastic,
            "mean_gap_over_amplitude_error", f"{elastic}_error"))
        self.own = [load*approach - energy, approach, gap]
        # An error that is unknown may have any size.
        self.errors = [math.inf if math.isnan(it) else it for it in (load*error + energy_error, error, error)]
        # What energy, approach and mean gap are measured in.
        length = float(bounds["approach_lower"])/float(bounds["approach_lower_over_amplitude"])
        self.units = [float(bounds["energy_upper"])/float(bounds["energy_upper_over_pstar_amplitude"]), length, length]
        self.bounds = [[float(bounds[f"{name}_{end}_over_{unit}"]) for end in ("lower", "upper")]
                       for name, unit in zip(BOUNDED, ("pstar_amplitude", "amplitude", "amplitude"))]

    def relative_width(self):
        """Of the energy, which may be below 0 where waves rise above the highest point of a map."""
        (lower, upper), *_ = self.bounds
        return (upper - lower)/abs(upper)


def solved(program, files, work):
    """The answer of a deck, None without numbers, and what is wrong with the run."""
    rows, complaints = solve(program, files, work)
    if rows and rows[0].has_numbers:
        return Answer(work), complaints
    return None, complaints + ["no numbers"]


def outside(name, bounds, truth):
    """Complains if bounds do not contain what they should. Those of the mean gap and the upper one of the approach are
    NaN where there is a hardness."""
    return [f"{name}: {what} in [{lower!r}, {upper!r}], but it is in [{least!r}, {most!r}]"
            for what, (lower, upper), (least, most) in zip(BOUNDED, bounds, truth)
            if lower > upper or lower > most or upper < least or what == "energy" and math.isnan(upper - lower)]


def differ(some, others):
    """Whether bounds from fields in the deck's units differ from those of the table."""
    units = max(map(abs, some[0])), 1.0, 1.0
    return any(abs(a - b) > CONVERSION*unit for bounds, more, unit in zip(some, others, units)
               for a, b in zip(bounds, more))


class Library:
    """The library behind the Python package."""

    def __init__(self, package):
        sys.path.insert(0, str(package))
        import numpy as np
        import wavycon
        self.np, self.run, self.call, self.address = np, wavycon.run, wavycon.library.call, wavycon.library.address
        self.number = wavycon.library.number
        self.call("set_threads", 1)

    def bounds(self, work, stream, units):
        """Solves the deck; the names of faults, `none` first, and bounds from the fields with the fault."""
        np = self.np
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            one, = self.run(work/"deck.nml", progress=False)
        p, g = one.pressure, one.gap
        other = np.empty([2] + [n if n == 1 else stream.randint(17, MOST) for n in p.shape])
        offset = np.array([self.number(one._solution, f"map_offset_{axis}") for axis in "xy"])
        self.call("get_grid", one._solution, *other.shape[:0:-1], *map(self.address, (offset, *other)), None)
        random = np.random.default_rng(stream.getrandbits(32))
        # A contact may lie between other points.
        others = [("other points", other)]*bool(other[0].any())
        for fault, fields in [*self.faults(p, g, random), *others]:
            fields = [np.ascontiguousarray(field, float) for field in fields]
            bounds = np.empty(6)
            self.call("get_bounds", one._scene, one.mean_pressure, *fields[0].shape[::-1],
                      *map(self.address, (offset, *fields, bounds)))
            yield fault, [[float(end/unit) for end in ends] for ends, unit in zip(bounds.reshape(3, 2), units)]

    def faults(self, p, g, random):
        """Names of faults, and pressure and gap with the fault."""
        np = self.np
        highest, widest = (np.unravel_index(field.argmax(), p.shape) for field in (p, g))
        yield "none", (p, g)
        some = p.copy()
        some[:, :p.shape[1]//2] *= 1.01
        yield "a half 1.01 times as large", (some, g)
        some = g.copy()
        some[tuple(slice(max(at - n//16, 0), at + n//16 + 1) for at, n in zip(widest, g.shape))] = 0.0
        yield "a hole in the gap", (p, some)
        some = p.copy()
        some[highest], some[widest] = p[widest], p[highest]
        yield "a point moved", (some, g)
        yield "noise", (p*random.uniform(0.5, 1.5, p.shape), g + g.mean()*random.uniform(-0.1, 0.1, p.shape))
        yield "turned", (p[::-1, ::-1], g)
        yield "uniform", (np.ones(p.shape), 0.0*g)
        yield "random", (random.standard_normal(p.shape), g.max()*random.standard_normal(p.shape))
