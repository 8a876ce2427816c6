"""Height maps on which a search that follows the contact it has can miss some of it, or does not settle."""
from common import rough_map
from random_scenes import Scene

KINDS = ("spike", "plateaus", "equal crests", "nearly equal crests", "step", "checkerboard", "noise")
QUICK = ("spike", "plateaus", "checkerboard")  # for the short form
# Rows and columns: even, odd, of unlike sides, and profiles. The check sums over all pairs of points.
SIZES = ((48, 40), (37, 51), (32, 32), (33, 48), (16, 64), (1, 100), (1, 49))
NEXT_TO_NOTHING = (1e-9, 1e-6, 1.0 - 1e-6, 1.0 - 1e-9)


def hard_scene(stream, kind):
    """A random map of a kind."""
    rows, columns = stream.choice(SIZES)
    length = stream.uniform(0.5, 2.0)
    heights = MAPS[kind](stream, rows, columns)
    if rows > 1 and stream.random() < 0.5:
        heights = [list(column) for column in zip(*heights)]
    return Scene(kind, (length, length*stream.choice((0.5, 1.0, 1.5))), heights=heights)


def hard_loads(stream, count):
    """Loads of all sizes and one next to none or to full contact, in ascending order."""
    loads = [stream.choice((10.0**stream.uniform(-6.0, 0.0), stream.uniform(0.02, 0.98))) for _ in range(count)]
    return sorted(loads + [stream.choice(NEXT_TO_NOTHING)])


def waves(stream, rows, columns):
    """A smooth surface with few crests, of height 1 or so."""
    heights = rough_map(rows, columns, stream.getrandbits(32), shortest=2, power=1.0)
    return [[0.3*value for value in row] for row in heights]


def spike(stream, rows, columns):
    """Waves and spikes of one or a few points, in troughs: as high as the crests, lower or higher."""
    heights = waves(stream, rows, columns)
    values = [value for row in heights for value in row]
    low, high = min(values), max(values)
    for _ in range(stream.choice((1, 1, 3))):
        i, j = min(((stream.randrange(rows), stream.randrange(columns)) for _ in range(30)),
                   key=lambda place: heights[place[0]][place[1]])
        top = low + (high - low)*stream.choice((0.3, 0.9, 1.0, 1.0 + 1e-9, 1.1, 2.0))
        for k in range(min(stream.randint(1, 3), rows)):
            for l in range(stream.randint(1, 3)):
                heights[(i + k) % rows][(j + l) % columns] = top
    return heights


def plateaus(stream, rows, columns):
    """Terraces: points of exactly equal heights."""
    steps = stream.choice((1.0, 3.0, 10.0))
    heights = [[round(steps*value)/steps for value in row] for row in waves(stream, rows, columns)]
    heights[0][0] += 1.0/steps  # not a plane, whatever the waves
    return heights


def equal_crests(stream, rows, columns, apart=0.0):
    """The same wave in each of some tiles, raised or lowered by a part of its height."""
    m, n = stream.randint(2, 5), 1 if rows == 1 else stream.randint(2, 5)
    wide, tall = columns//m, max(rows//n, 1)
    tile = waves(stream, tall, wide)
    shifts = [[apart*stream.gauss(0.0, 1.0) for _ in range(m + 1)] for _ in range(n + 1)]
    # Points that no whole tile covers are a trough.
    return [[tile[i % tall][j % wide] + shifts[i//tall][j//wide] if j < m*wide and i < n*tall else -2.0
             for j in range(columns)] for i in range(rows)]


def nearly_equal_crests(stream, rows, columns):
    return equal_crests(stream, rows, columns, 10.0**-stream.uniform(6.0, 12.0))


def step(stream, rows, columns):
    """A plane with pits or blocks."""
    heights = [[0.0]*columns for _ in range(rows)]
    for _ in range(stream.randint(1, 3)):
        i, j = stream.randrange(rows), stream.randrange(columns)
        depth = stream.choice((-1.0, 1.0))*10.0**stream.uniform(-3.0, 0.0)
        for k in range(stream.randint(1, max(rows//2, 1))):
            for l in range(stream.randint(1, columns//2)):
                heights[(i + k) % rows][(j + l) % columns] = depth
    return heights


def checkerboard(stream, rows, columns):
    """Waves, and points that are high and low in turn, which the grid resolves barely."""
    part = 10.0**stream.uniform(-3.0, 0.5)
    return [[value + part*(-1)**(i + j) for j, value in enumerate(row)]
            for i, row in enumerate(waves(stream, rows, columns))]


def noise(stream, rows, columns):
    """Waves and a random height at each point."""
    part = 10.0**stream.uniform(-3.0, 0.5)
    return [[value + part*stream.gauss(0.0, 1.0) for value in row] for row in waves(stream, rows, columns)]


MAPS = {"spike": spike, "plateaus": plateaus, "equal crests": equal_crests, "nearly equal crests": nearly_equal_crests,
        "step": step, "checkerboard": checkerboard, "noise": noise}
