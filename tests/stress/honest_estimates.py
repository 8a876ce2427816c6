"""Error estimates of random scenes against true errors, from a much finer solution, a closed form or a fitted one."""
import functools
import math

from common import Table
from random_scenes import FITTED, KINDS, QUICK, random_loads, random_scene
from rough_surfaces import deck, map_text
from summaries import ROUNDING, VALUES, solve

# As README states: the fraction of errors below the estimates, and the largest error over its estimate.
CONFIDENCE, LARGEST_RATIO = 0.95, 3.0
FEWEST = 100  # estimates of which the fraction is checked
# Finest accuracies for which the finer solution takes about a second: by kind, where a quarter of the cell is solved,
# and of other kinds.
FINEST = {"wave_1d": 1e-4, "profile": 1e-4, "sum": 1e-2, "file": 1e-2, "even file": 1e-2,
          "mirrored file": 1e-2}
FINEST_OF_OTHERS = 3e-3
COARSEST = 1e-1
# Lattices, and loads about those at which their spots merge, P.
LONG = "kind = 'wave_2d', wavelength_y = 1, wavelength ="
MERGING = {"wave_2d": ("kind = 'wave_2d'", 0.22, 0.24), "hexagonal": ("kind = 'hexagonal'", 0.28, 0.34),
           **{f"wave_2d {ratio} to 1": (f"{LONG} {ratio}", 0.15, 0.35) for ratio in (1.5, 2, 3)}}
# Maps with a hardness, and what they have besides VALUES.
LOAD_OVER_HARDNESS = (0.05, 0.95)
OF_HARDNESS = ("area_at_hardness_fraction", "load_at_hardness_fraction", "approach", "elastic_energy")
# Values of balls, of rough maps on balls, of patches and of punches, with free edges.
OF_FREE_EDGES = ("approach", "contact_area", "peak_pressure")
# Of the table of the interface, and their largest error over its estimate: next to merging derivatives have no bound.
OF_INTERFACE = ("contact_stiffness_normalised", "contact_area_slope", "mean_gap_curvature")
LARGEST_RATIO_OF_INTERFACE = 10.0
FITTED_ACCURACIES = (1e-10, 1e-3)
FINER, FITTED_FINER, FINEST_FITTED = 10.0, 100.0, 1e-12  # ratio of the accuracies of grids, of fitted solutions; finest


def random_case(stream, kind, solver):
    """The files of a random scene to solve, and those of the finer solution."""
    scene = random_scene(stream, kind)
    loads = random_loads(stream, 4)
    finest, coarsest = FITTED_ACCURACIES if solver == "fitted" else (FINEST.get(kind, FINEST_OF_OTHERS), COARSEST)
    accuracy = finest*(coarsest/finest)**stream.random()
    if solver == "fitted":
        truth = f"solver = 'fitted', accuracy = {max(accuracy/FITTED_FINER, FINEST_FITTED)!r}"
    else:
        truth = f"solver = 'auto', accuracy = {accuracy/FINER!r}"
    return scene.files(loads, f"solver = '{solver}', accuracy = {accuracy!r}"), scene.files(loads, truth)


def grid_case(stream, kind):
    return random_case(stream, kind, "grid")


def fitted_case(stream, kind):
    return random_case(stream, kind, "fitted")


def merging_case(stream, kind):
    """The files of a lattice next to the load at which its spots merge, on grids, and by 'fitted'."""
    accuracy = 10.0**stream.uniform(-4.0, -3.0)
    surface, *range_of_loads = MERGING[kind]
    loads = [stream.uniform(*range_of_loads) for _ in range(20)]
    return [{"deck.nml": f"&surface {surface} /\n&load pbar_over_pstar = {', '.join(map(repr, loads))} /\n"
                         f"&method {method} /\n"}
            for method in (f"solver = 'grid', accuracy = {accuracy!r}",
                           f"solver = 'fitted', accuracy = {accuracy/FITTED_FINER!r}")]


def map_case(stream, kind):
    """The files of a random map on its own points, `hard` with a hardness, and those of a grid that is four times as
    fine."""
    points = stream.choice((64, 64, 128, 256))
    longest = stream.choice((0.5, 1.0))
    surface = (f"kind = 'self_affine', length_x = 1, length_y = 1, points = {points}, {points}, rms_slope = 0.1,\n"
               f"   hurst = {stream.choice((0.3, 0.8, 1.0))!r}, spectrum = '{stream.choice(('ideal', 'random'))}',\n"
               f"   long_wavelength = {longest!r}, rolloff_wavelength = {stream.choice((0.5, 1.0))*longest!r},\n"
               f"   short_wavelength = {stream.choice((2.5, 4.0, 8.0, 16.0))/points!r}, seed = {stream.randint(1, 2**30)}")
    # p* is some 0.2 E* on such maps.
    load = 0.2*10.0**stream.uniform(-4.5, 0.2)
    hardness = load/stream.uniform(*LOAD_OVER_HARDNESS) if kind == "hard" else None
    return [{"deck.nml": deck(surface, [load], f"solver = 'grid', grid_points = {grid}", hardness)}
            for grid in (points, 4*points)]


def ridges_case(stream, kind):
    """The files of one wave at any angle on a given grid, at loads of contacts or pools that are 0.3 to 4 steps wide, and
    those of the 1-D wave."""
    waves = stream.randint(0, 7), stream.choice((-1, 1))*stream.randint(1, 7)
    grid = stream.choice((64, 96, 128, 192)), stream.choice((64, 96, 128))
    on_step = max(abs(number)/points for number, points in zip(waves, grid))
    loads = []
    for heavy in (False, True):
        part = min(0.3*(4/0.3)**stream.random()*on_step, 0.5)
        loads.append(math.sin(math.pi/2*(1.0 - part if heavy else part))**2)
    ridges = (f"kind = 'sum', length_y = {2.0**stream.uniform(-1.0, 1.0)!r}, amplitudes = 1, waves_x = {waves[0]},\n"
              f"   waves_y = {waves[1]}, phases = {stream.choice((0.0, stream.uniform(0.0, 360.0)))!r}")
    return [{"deck.nml": f"&surface {surface} /\n&load pbar_over_pstar = {', '.join(map(repr, loads))} /\n"
                         f"&method {method} /\n"}
            for surface, method in ((ridges, f"solver = 'grid', grid_points = {grid[0]}, {grid[1]}"),
                                    ("kind = 'wave_1d'", "solver = 'closed_form'"))]


def hard_profile_case(stream, kind):
    """The files of a sum of waves in 1-D with a hardness, one load nearly as large, on a grid whose steps are wider than
    many of its edges, and those of a grid that is far finer."""
    waves = range(stream.randint(1, 3))
    words = (f"{key} = {', '.join(repr(draw()) for _ in waves)}" for key, draw in (
        ("amplitudes", lambda: stream.uniform(0.001, 0.01)), ("waves_x", lambda: stream.randint(1, 4)),
        ("phases", lambda: stream.uniform(0.0, 360.0))))
    surface = f"kind = 'sum', {', '.join(words)}"
    hardness = 10.0**stream.uniform(-2.8, -0.8)
    loads = [hardness*ratio for ratio in (stream.uniform(*LOAD_OVER_HARDNESS), 1.0 - 10.0**stream.uniform(-4.0, -1.0))]
    methods = [stream.choice(("accuracy = 1e-2", "grid_points = 64", "grid_points = 100")), "grid_points = 8192"]
    return [{"deck.nml": deck(surface, loads, f"solver = 'grid', {method}", hardness)} for method in methods]


def patch(stream, points):
    """The heights of a smooth patch, whose contact reaches the border at heavy loads, or of a punch."""
    inner = [(k + 0.5)/points for k in range(points)]
    if stream.random() < 0.5:
        low, high = ([stream.randint(1, points//3), stream.randint(1, points//3)] for _ in range(2))
        depth = 10.0**stream.uniform(-3.0, 2.0)
        return [[0.0 if low[0] <= i < points - high[0] and low[1] <= j < points - high[1] else -depth
                 for i in range(points)] for j in range(points)]
    waves = [(stream.randint(0, 3), stream.randint(0, 3), stream.gauss(0.0, 1.0), stream.uniform(0.0, 6.0))
             for _ in range(4)]
    tilt, dome = (stream.gauss(0.0, 1.0), stream.gauss(0.0, 1.0)), stream.choice((0.0, 4.0, -3.0))
    return [[sum(a*math.cos(3.0*(m*x + n*y) + phase) for m, n, a, phase in waves) + tilt[0]*x + tilt[1]*y
             - dome*((x - 0.5)**2 + (y - 0.5)**2) for x in inner] for y in inner]


def free_case(stream, kind):
    """The files of a ball to a random accuracy, of a rough map on a ball or, of the kind `patch`, of a map that may
    touch up to its border, on its own points, and those of a much finer solution."""
    if kind == "patch":
        points = stream.choice((32, 48, 64))
        surface = "kind = 'file', file = 'map.dat', edges = 'free', height_scale = 0.01"
        heights = map_text(patch(stream, points))
        loads = [10.0**(power + stream.uniform(0.0, 0.8)) for power in (-6, -4, -3, -2, -1)]
        return [{"map.dat": heights,
                 "deck.nml": f"&surface {surface} /\n&load force = {', '.join(map(repr, loads))} /\n"
                             f"&method solver = 'grid', grid_points = {grid} /\n"} for grid in (points, 4*points)]
    radius = 10.0**stream.uniform(-0.5, 1.5)
    if stream.random() < 0.5:
        accuracy = 10.0**stream.uniform(-3.5, -1.5)
        surface = f"kind = 'ball', radius_x = {radius!r}, radius_y = {radius*10.0**stream.uniform(-1.0, 1.0)!r}"
        # A load that moves the edge between the points of its grids.
        loads = [force*10.0**stream.uniform(0.0, 0.5) for force in (1e-6, 1e-5, 1e-4)]
        methods = [f"accuracy = {each!r}" for each in (accuracy, accuracy/FINER)]
    else:
        points = stream.choice((64, 99, 128, 255))
        surface = (f"kind = 'self_affine', edges = 'free', points = {points}, rms_slope = {10.0**stream.uniform(-3, -1)!r},\n"
                   f"   form_radius = {radius!r}, hurst = {stream.choice((0.3, 0.8, 1.0))!r},\n"
                   f"   long_wavelength = {stream.choice((0.25, 1.0))!r},\n"
                   f"   short_wavelength = {stream.choice((4.0, 8.0, 16.0))/points!r}, seed = {stream.randint(1, 2**30)}")
        loads = [10.0**stream.uniform(-5.0, -1.5)/radius for _ in range(3)]
        methods = [f"grid_points = {grid}" for grid in (points, 4*points)]
    return [{"deck.nml": f"&surface {surface} /\n&load force = {', '.join(map(repr, loads))} /\n"
                         f"&method solver = 'grid', {method} /\n"} for method in methods]


def interface_case(stream, kind):
    """The files of a lattice on a grid and by 'fitted', or of a random map on its own points and on four times as many,
    with derivatives."""
    points = stream.choice((64, 90, 128, 256)) if kind != "self_affine" else stream.choice((48, 64))
    surface, truth = f"kind = '{kind}'", "solver = 'fitted', accuracy = 1e-10"
    if kind == "self_affine":
        surface += (f", points = {points}, length_x = 1, rms_slope = 0.1, long_wavelength = 0.5, hurst = 0.8,\n"
                    f"   short_wavelength = {stream.choice((4.0, 8.0))/points!r}, seed = {stream.randint(1, 2**30)}")
        truth = f"solver = 'grid', grid_points = {4*points}"
    loads = [1.0/(1.0 + math.exp(-stream.uniform(-6.9, 6.9))) for _ in range(4)]
    return [{"deck.nml": f"&surface {surface} /\n&material e_star = 1 /\n"
                         f"&load pbar_over_pstar = {', '.join(map(repr, loads))} /\n&interface /\n"
                         f"&method {method} /\n"} for method in (f"solver = 'grid', grid_points = {points}", truth)]


def layer_case(stream, kind):
    """The files of a wave or of a random map on a layer, on a grid and on one that is four times as fine."""
    points = stream.choice((64, 96, 128, 256))
    surface = f"kind = '{stream.choice(('wave_1d', 'wave_2d', 'hexagonal'))}'"
    if stream.random() < 0.6:
        surface = (f"kind = 'self_affine', points = {points}, length_x = 1, rms_slope = 0.1, long_wavelength = 0.5,\n"
                   f"   hurst = {stream.choice((0.3, 0.8))!r},\n"
                   f"   short_wavelength = {stream.choice((4.0, 8.0, 16.0))/points!r},\n"
                   f"   seed = {stream.randint(1, 2**30)}")
    layer = f"layer_thickness = {10.0**stream.uniform(-2.5, 0.3)!r}, "
    layer += stream.choice(("layer_base = 'smooth'", f"layer_nu = {stream.choice((0.0, 0.3, 0.45, 0.5))!r}",
                            f"layer_nu = {stream.choice((0.0, 0.3, 0.5))!r}, base_nu = 0.3,\n"
                            f"   base_e = {10.0**stream.uniform(-1.0, 2.0)!r}"))
    loads = [1.0/(1.0 + math.exp(-stream.uniform(-6.0, 5.0))) for _ in range(3)]
    return [{"deck.nml": f"&surface {surface} /\n&material {layer} /\n"
                         f"&load pbar_over_pstar = {', '.join(map(repr, loads))} /\n"
                         f"&method solver = 'grid', grid_points = {grid} /\n"} for grid in (points, 4*points)]


def solve_with_interface(program, files, work):
    """The rows of the summary with the words of the table of the interface, if there is one."""
    rows, complaints = solve(program, files, work)
    table = work/"results"/"deck.interface.dat"
    for row, more in zip(rows, Table(table).records() if table.is_file() else ()):
        row.words.update(more)
    return rows, complaints


def ratios_of(row, truth, names):
    """Of each value its error beyond that of the truth over its estimate, None if one is unknown, and the estimate."""
    for name in names:
        value, true = float(row.words[name]), float(truth.words[name])
        allowed, own = (max(float(each.words[f"{name}_error"]), ROUNDING) for each in (row, truth))
        known = not math.isnan(allowed + own)
        yield name, max(abs(value - true) - own, 0.0)/allowed if known else None, allowed


# Of each kind of solution the procedure that makes a case, the kinds of surfaces, how many cases of each, also with
# --quick, and the values.
FEW, MANY = (5, 1), (300, 6)
SOLUTIONS = {
    "grid": (grid_case, KINDS, FEW, VALUES),
    "fitted": (fitted_case, FITTED, FEW, VALUES),
    "grid next to merging": (merging_case, tuple(MERGING), FEW, VALUES),
    "grid of a map's points": (map_case, ("elastic",), MANY, VALUES),
    "grid of parallel ridges": (ridges_case, ("ridges",), MANY, VALUES),
    "grid with a hardness": (map_case, ("hard",), MANY, VALUES + OF_HARDNESS),
    "grid with a hardness in 1-D": (hard_profile_case, ("hard profile",), MANY, VALUES + OF_HARDNESS),
    "grid with free edges": (free_case, ("free edges", "patch"), MANY, OF_FREE_EDGES),
    "grid on a layer": (layer_case, ("layer",), MANY, VALUES),
    "derivatives on grids": (interface_case, ("wave_2d", "hexagonal", "self_affine"), MANY, OF_INTERFACE)}


def estimates_of(solution, settings, work):
    """Cases of one kind of solution."""
    part = settings.part(f"error estimates, {solution}")
    case, kinds, numbers, values = SOLUTIONS[solution]
    if settings.quick and case in (grid_case, fitted_case):
        kinds = [kind for kind in kinds if kind in QUICK]
    largest = LARGEST_RATIO_OF_INTERFACE if values is OF_INTERFACE else LARGEST_RATIO
    ratios, unknown = [], 0
    for name, stream, kind in settings.cases(f"estimates-{solution}", kinds, settings.amount(*numbers)):
        files, finer = case(stream, kind)
        rows, complaints = solve_with_interface(settings.program, files, work)
        truths, more = solve_with_interface(settings.program, finer, work)
        # Where spots have merged there are no numbers.
        for row, truth in [pair for pair in zip(rows, truths) if pair[0].has_numbers and pair[1].has_numbers]:
            for value, ratio, allowed in ratios_of(row, truth, values):
                if ratio is None:
                    unknown += 1
                    continue
                ratios.append(ratio)
                if ratio > largest:
                    complaints.append(f"{value} of load {row.words['load']} is off by {ratio:.1f} times its "
                                      f"estimate, {allowed:.1e}")
        part.count(name, complaints + more, files)
    held = sum(ratio <= 1.0 for ratio in ratios)/max(len(ratios), 1)
    if len(ratios) >= FEWEST:
        part.count(f"estimates of {solution}", [] if held >= CONFIDENCE else [f"only {100*held:.1f} % hold"])
    part.worst = (f"{max(ratios, default=0.0):.2f} times, {100*held:.1f} % of {len(ratios)} hold, "
                  f"{unknown} are unknown")
    return part


# Scenes of each kind with each solver for it, lattices next to merging, maps, layers, and surfaces with free edges.
CAMPAIGNS = [functools.partial(estimates_of, solution) for solution in SOLUTIONS]
