"""Surfaces as they are made and as they are measured. A made one is solved a second time from the heights that the
program writes, and on twice the points; a measured one is prepared by the program, checked here, and with mirror images
solved a second time on the whole cell. Spots and summary have the same area, contours about the same."""
import math

from common import rough_map
from npy import read_npy
from random_scenes import random_loads
from same_contact import LARGEST_RATIO, difference
from spot_areas import area_complaints
from summaries import solve

MOMENT = 1e-12  # relative error of the moment that was asked for
FIT = 1e-10  # of trends and filled holes, over the range of the heights
# Of the same surface solved in two ways: the residual; relative differences of the values, as the residual moves the edge
# of contact by its power 2/3; and what rounding adds [Delta].
RESIDUAL, SOLVED, ROUNDING = 1e-12, 1e-8, 1e-13
EXACT = f"solver = 'grid', residual = {RESIDUAL!r}"
TABLES = "&output height = t, spots = t, contours = t /\n"
SIZES = ((64, 64), (64, 128), (96, 80), (75, 54), (512, 1))
TRENDS = ("none", "mean", "plane", "quadratic")


def read_heights(path):
    """The rows of <case>.height.npy."""
    head, numbers = read_npy(path)
    columns = head["shape"][1]
    return [numbers[first:first + columns] for first in range(0, len(numbers), columns)]


def map_text(heights):
    """A matrix; None is a missing height."""
    return "".join(" ".join("nan" if value is None else repr(value) for value in row) + "\n" for row in heights)


def deck(surface, loads, method, hardness=None):
    material = f"e_star = 1.0, hardness = {hardness!r}" if hardness else "e_star = 1.0"
    return (f"&surface {surface} /\n&material {material} /\n&load mean_pressure = {', '.join(map(repr, loads))} /\n"
            f"&method {method} /\n")


def of_map(name, cell, more=""):
    return f"kind = 'file', file = '{name}', length_x = {cell[0]!r}, length_y = {cell[1]!r}{more}"


def made_surface(stream, sizes):
    """Keys of a random made surface, its cell, points, of some sizes, and the key and value of its roughness."""
    points = stream.choice(sizes)
    length = stream.uniform(0.5, 2.0)
    step = length/points[0]
    side = length if points[1] == 1 else stream.choice((1.0, 1.0, 1.5))*step*points[1]
    cell = length, side
    longest = stream.choice((1.0, 0.7))*min(cell)
    shortest = stream.choice((2.2, 4.0, 8.0))*max(step, 0.0 if points[1] == 1 else side/points[1])
    rolloff = max(shortest, longest*stream.choice((1.0, 0.5)))
    roughness = stream.choice(("rms_height", "rms_slope")), 10.0**stream.uniform(-3.0, -0.5)
    words = (f"kind = 'self_affine', length_x = {cell[0]!r}, length_y = {cell[1]!r}, points = {points[0]}, {points[1]},\n"
             f"   hurst = {stream.choice((0.0, 0.8, 1.0, stream.random()))!r}, {roughness[0]} = {roughness[1]!r},\n"
             f"   long_wavelength = {longest!r}, rolloff_wavelength = {rolloff!r}, short_wavelength = {shortest!r},\n"
             f"   spectrum = '{stream.choice(('ideal', 'random'))}', seed = {stream.randint(1, 2**31 - 1)}")
    return words, cell, points, roughness


def moment(results, name):
    """A moment of the surface, from the head of the summary."""
    return float((results/"deck.summary.dat").read_text().split(f" {name}[")[1].split(" = ")[1].split(",")[0].split()[0])


def pstar(results):
    return moment(results, "p*")


def status_complaints(rows):
    """On the points of a map a row is `unresolved` where an error is unknown or as large as its value, and only there."""
    complaints = []
    for row in rows:
        known = all(error < value for error, value in zip(row.errors, row.values))
        if row.status != ("converged" if known else "unresolved"):
            complaints.append(f"{row.status} at P = {row.load!r}")
    return complaints


def relative_difference(rows, others):
    """The largest of two runs of the same loads."""
    return max((max(abs(a - b) - ROUNDING, 0.0)/max(abs(a), abs(b)) for row, other in zip(rows, others)
                for a, b in zip(row.values, other.values) if a != b), default=0.0)


def made(settings, stream, name, work, part):
    """A surface from its spectrum."""
    surface, cell, points, (key, value) = made_surface(stream, SIZES)
    loads = random_loads(stream, 4)
    solve(settings.program, {"deck.nml": f"&surface {surface} /\n&load pbar_over_pstar = 0 /\n"}, work)
    scale = pstar(work/"results")
    loads = [scale*load for load in loads]
    files = {"deck.nml": deck(surface, loads, EXACT) + TABLES}
    rows, complaints = solve(settings.program, files, work)
    if rows:
        results = work/"results"
        off = abs(moment(results, key)/value - 1.0)
        part.limit("moments", off, MOMENT, complaints, f"{key} is off by {off:.1e}")
        complaints += area_complaints(results, cell, points[1] > 1)
        complaints += status_complaints(rows)
        heights = (results/"deck.height.npy").read_bytes()
    part.count(name, complaints, files)
    if rows:
        again = {"deck.nml": deck(of_map("height.npy", cell), loads, EXACT), "height.npy": heights}
        compare(settings, f"{name}, read", rows, again, work, part, "heights read", relative_difference, SOLVED)
        finer = ", ".join(str(2*n) for n in points if n > 1)
        again = {"deck.nml": deck(surface, loads, f"solver = 'grid', grid_points = {finer}")}
        compare(settings, f"{name}, finer", rows, again, work, part, "twice the points over both estimates", difference,
                LARGEST_RATIO)


def compare(settings, name, rows, again, work, part, what, off_by, most):
    """The same loads solved in another way."""
    others, complaints = solve(settings.program, again, work)
    off = off_by(rows, others)
    part.limit(what, off, most, complaints, f"{what}: {off:.1e} away")
    if len(others) != len(rows):
        complaints.append(f"{len(others)} loads in place of {len(rows)}")
    part.count(name, complaints, again)


def measured_heights(stream):
    """Heights of some waves, tilt, form and noise, with holes."""
    rows, columns = stream.choice(((48, 64), (64, 40), (33, 50), (80, 16)))
    waves = rough_map(rows, columns, stream.getrandbits(32), power=1.0)
    tilt = [stream.choice((0.0, 1.0, 100.0))*stream.gauss(0.0, 1.0) for _ in range(5)]
    noise = stream.choice((0.0, 1e-3, 0.1))
    heights = [[waves[i][j] + noise*stream.gauss(0.0, 1.0) + tilt[0] + tilt[1]*j + tilt[2]*i
                + (tilt[3]*j*j + tilt[4]*i*i)/rows for j in range(columns)] for i in range(rows)]
    for _ in range(stream.choice((0, 1, 3, 8))):
        i, j = stream.randrange(rows), stream.randrange(columns)
        for k in range(stream.randint(1, 4)):
            for l in range(stream.randint(1, 5)):
                heights[(i + k) % rows][(j + l) % columns] = None
    return heights


def preparation_errors(raw, prepared, detrend, edges):
    """Of a map without its trend and holes the largest errors of these over the range of the map."""
    rows, columns = len(raw), len(raw[0])
    there = [(i, j) for i in range(rows) for j in range(columns) if raw[i][j] is not None]
    size = max(abs(raw[i][j]) for i, j in there)
    terms = {"none": (), "mean": ((0, 0),), "plane": ((0, 0), (1, 0), (0, 1)),
             "quadratic": ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))}[detrend]
    # The program's heights are over the mean of all, holes included: (0, 0) is that of the heights that are there.
    mean = math.fsum(prepared[i][j] for i, j in there)/len(there)
    worst = {}
    for m, n in terms[1:]:
        product = math.fsum((prepared[i][j] - mean)*(2*j/columns - 1.0)**m*(2*i/rows - 1.0)**n for i, j in there)
        worst["trends"] = max(worst.get("trends", 0.0), abs(product)/(len(there)*size))
    for i in range(rows):
        for j in range(columns):
            if raw[i][j] is not None:
                continue
            near = [(i + k, j + l) for k, l in ((1, 0), (-1, 0), (0, 1), (0, -1))]
            if edges == "periodic":
                near = [(k % rows, l % columns) for k, l in near]
            near = [(k, l) for k, l in near if 0 <= k < rows and 0 <= l < columns]
            off = math.fsum(prepared[k][l] - prepared[i][j] for k, l in near)
            worst["holes"] = max(worst.get("holes", 0.0), abs(off)/size)
    return worst


def measured(settings, stream, name, work, part):
    """A map with holes and a trend."""
    raw = measured_heights(stream)
    rows, columns = len(raw), len(raw[0])
    step = stream.uniform(0.01, 1.0)
    cell = [step*columns, step*rows]  # equal steps along x and y, for the holes
    detrend, edges = stream.choice(TRENDS), stream.choice(("periodic", "mirror", "mirror"))
    surface = of_map("heights.dat", cell, f",\n   file_format = 'matrix', detrend = '{detrend}', "
                                          f"fill_missing = 'harmonic', edges = '{edges}'")
    files = {"deck.nml": f"&surface {surface} /\n&load pbar_over_pstar = 0 /\n", "heights.dat": map_text(raw)}
    solve(settings.program, files, work)
    scale = pstar(work/"results")
    loads = [scale*load for load in random_loads(stream, 4)]
    hardness = loads[-1]*(1.0 + 10.0**stream.uniform(-3.0, 1.0)) if stream.random() < 0.5 else None
    files["deck.nml"] = deck(surface, loads, EXACT, hardness) + TABLES
    answers, complaints = solve(settings.program, files, work)
    if answers:
        results = work/"results"
        prepared = read_heights(results/"deck.height.npy")
        for what, off in preparation_errors(raw, prepared, detrend, edges).items():
            part.limit(what, off, FIT, complaints, f"{what} are off by {off:.1e}")
        complaints += status_complaints(answers)
        complaints += area_complaints(results, cell, edges != "mirror")
    part.count(name, complaints, files)
    if answers:
        if edges == "mirror":
            prepared = [row + row[::-1] for row in prepared + prepared[::-1]]
            cell = [2.0*side for side in cell]
        again = {"deck.nml": deck(of_map("prepared.dat", cell), loads, EXACT, hardness),
                 "prepared.dat": map_text(prepared)}
        compare(settings, f"{name}, whole", answers, again, work, part, "whole cell", relative_difference, SOLVED)


def campaign(settings, work):
    part = settings.part("made and measured surfaces")
    for make in (made, measured):
        for name, stream, _ in settings.cases("rough", (make.__name__,), settings.amount(48, 8)):
            make(settings, stream, name, work, part)
    return part
