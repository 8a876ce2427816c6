"""Random surfaces and loads, as decks; and the same surfaces shifted, mirrored, rotated and in other units."""
import math

from common import rough_map

KINDS = ("wave_1d", "wave_2d", "wave_2d of two lengths", "wave_2d alike", "crossed_1d", "crossed_1d alike",
         "hexagonal", "profile", "sum", "even sum", "file", "even file", "mirrored file")
FITTED = ("wave_2d", "wave_2d alike", "crossed_1d alike", "hexagonal")  # kinds that solver = 'fitted' can solve
QUICK = ("wave_1d", "wave_2d", "profile", "even file")  # for the short form: one kind for each type of solution
MERGING = 0.2286  # load at which the spots of the paper's wave merge
HEIGHTS = "heights.dat"


class Scene:
    """A surface. All but height maps are also given as sums of waves, which can be shifted and rotated."""

    def __init__(self, kind, cell, waves=(), words="", heights=None, edges="periodic"):
        self.kind = kind
        self.cell = cell        # sides [length]
        self.waves = waves      # (amplitude [length], waves along x, along y, phase [turn]) of each
        self.words = words      # keys of &surface, in place of those of the sum
        self.heights = heights  # rows of a height map [length]
        self.edges = edges      # of a height map

    def surface(self):
        """Keys of &surface."""
        if self.words:
            return self.words
        cell = f"length_x = {self.cell[0]!r}, length_y = {self.cell[1]!r}"
        if self.heights:
            return f"kind = 'file', file = '{HEIGHTS}', file_format = 'matrix', edges = '{self.edges}', {cell}"
        columns = list(zip(*self.waves))
        keys = (("amplitudes", columns[0]), ("waves_x", columns[1]), ("waves_y", columns[2]),
                ("phases", [360.0*math.remainder(phase, 1.0) for phase in columns[3]]))
        return f"kind = 'sum', {cell}" + "".join(f",\n   {name} = {', '.join(map(repr, values))}"
                                                 for name, values in keys)

    def files(self, loads, method, e_star=1.0, more=""):
        """The deck and its height map, {file name: text}. `more`: further keys of &material."""
        deck = (f"&surface {self.surface()} /\n&material e_star = {e_star!r}{more} /\n"
                f"&load pbar_over_pstar = {', '.join(map(repr, loads))} /\n&method {method} /\n")
        files = {"deck.nml": deck}
        if self.heights:
            files[HEIGHTS] = "".join(" ".join(map(repr, row)) + "\n" for row in self.heights)
        return files

    def moved(self, x, y):
        """Shifted by fractions of the cell; a map by the nearest number of points, a mirrored map by its whole sides, as
        that leaves its borders where they are."""
        if self.edges == "mirror":
            return self.with_heights([row[::-1] for row in self.heights[::-1]])
        if self.heights:
            rows = round(y*len(self.heights))
            columns = round(x*len(self.heights[0]))
            return self.with_heights([row[columns:] + row[:columns]
                                      for row in self.heights[rows:] + self.heights[:rows]])
        return Scene(self.kind, self.cell, [(a, m, n, phase + m*x + n*y) for a, m, n, phase in self.waves])

    def mirrored(self):
        if self.heights:
            return self.with_heights([row[::-1] for row in self.heights])
        return Scene(self.kind, self.cell, [(a, -m, n, phase) for a, m, n, phase in self.waves])

    def turned(self):
        """Rotated by a right angle; not for a profile."""
        cell = self.cell[::-1]
        if self.heights:
            return self.with_heights([list(column)[::-1] for column in zip(*self.heights)], cell)
        return Scene(self.kind, cell, [(a, -n, m, phase) for a, m, n, phase in self.waves])

    def scaled(self, length, height):
        """In other units of lengths and of heights."""
        cell = [length*side for side in self.cell]
        if self.heights:
            return self.with_heights([[height*value for value in row] for row in self.heights], cell)
        return Scene(self.kind, cell, [(height*a, m, n, phase) for a, m, n, phase in self.waves])

    def with_heights(self, heights, cell=None):
        """A map like this one with other heights."""
        return Scene(self.kind, cell or self.cell, heights=heights, edges=self.edges)

    @property
    def is_profile(self):
        return not self.heights and all(n == 0 for _, _, n, _ in self.waves)


def random_scene(stream, kind, unit_of_heights=1.0, unit_of_lengths=1.0):
    a, length = unit_of_heights*stream.uniform(0.1, 2.0), unit_of_lengths*stream.uniform(0.5, 2.0)
    if kind == "wave_1d":
        return Scene(kind, (length, length), [(a, 1, 0, 0.0)],
                     f"kind = 'wave_1d', amplitude = {a!r}, wavelength = {length!r}")
    if kind == "wave_2d":
        return Scene(kind, (length, length), [(a/2, 1, 1, 0.0), (a/2, 1, -1, 0.0)],
                     f"kind = 'wave_2d', amplitude = {a!r}, wavelength = {length!r}")
    if kind in ("wave_2d of two lengths", "wave_2d alike"):
        # 'fitted' solves lengths of up to 3 to 1.
        other = length*(4.0 if kind == "wave_2d of two lengths" else 3.0)**stream.uniform(-1.0, 1.0)
        return Scene(kind, (length, other), [(a/2, 1, 1, 0.0), (a/2, 1, -1, 0.0)],
                     f"kind = 'wave_2d', amplitude = {a!r}, wavelength = {length!r}, wavelength_y = {other!r}")
    if kind in ("crossed_1d", "crossed_1d alike"):
        # 'fitted' solves sides of up to 3 to 1 and curvatures of the crests of up to 50 to 1.
        unlike, long = (8.0, 4.0) if kind == "crossed_1d" else (2.0, 2.0)
        b, other = a*unlike**stream.uniform(-1.0, 1.0), length*long**stream.uniform(-1.0, 1.0)
        return Scene(kind, (length, other), [(a, 1, 0, 0.0), (b, 0, 1, 0.0)],
                     f"kind = 'crossed_1d', amplitude1 = {a!r}, wavelength1 = {length!r}, amplitude2 = {b!r}, "
                     f"wavelength2 = {other!r}")
    if kind == "hexagonal":
        return Scene(kind, (2.0/math.sqrt(3.0)*length, 2.0*length),
                     [(a/3, 0, 2, 0.0), (a/3, 1, 1, 0.0), (a/3, 1, -1, 0.0)],
                     f"kind = 'hexagonal', amplitude = {a!r}, wavelength = {length!r}")
    if kind in ("file", "even file", "mirrored file"):
        cell = (length, length*stream.choice((0.5, 1.0, 1.5)))
        scene = Scene(kind, cell, heights=random_map(stream, kind == "even file"),
                      edges="mirror" if kind == "mirrored file" else "periodic")
        return scene.scaled(1.0, unit_of_heights)
    even = kind == "even sum"
    waves = []
    for _ in range(stream.randint(1, 4)):
        m, n = stream.randint(1, 3), 0 if kind == "profile" else stream.randint(-3, 3)
        phase = stream.choice((0.0, 0.5)) if even else stream.uniform(-0.5, 0.5)
        waves.append((unit_of_heights*stream.uniform(-1.2, 1.2), m, n, phase))
    if kind != "profile" and all(n == 0 for _, _, n, _ in waves):
        waves.append((unit_of_heights*stream.uniform(0.2, 1.2), 0, 1, 0.0 if even else stream.uniform(-0.5, 0.5)))
    if even:
        # The sum of a wave and its mirror image is even.
        waves = [(a, m, sign*n, phase) for a, m, n, phase in waves for sign in (1, -1)]
    return Scene(kind, (length, length if kind == "profile" else length*stream.uniform(0.5, 2.0)), waves)


def random_map(stream, even):
    """Heights of waves whose amplitudes fall as a power of their number, of random directions and phases."""
    rows, columns = stream.choice((8, 12, 16)), stream.choice((8, 16))
    heights = rough_map(rows, columns, stream.getrandbits(32), shortest=stream.randint(2, min(rows, columns)//2),
                        power=stream.uniform(1.0, 2.5))
    if even:
        # With its mirror images, to the last bit.
        heights = [[math.fsum(heights[k][l] for k in (i, -i) for l in (j, -j)) for j in range(columns)]
                   for i in range(rows)]
    return heights


def random_loads(stream, count):
    """Light, heavy and medium loads and loads about merging, in ascending order."""
    loads = set()
    while len(loads) < count:
        loads.add(stream.choice((10.0**stream.uniform(-4.0, 0.0), 1.0 - 10.0**stream.uniform(-4.0, 0.0),
                                 stream.uniform(0.02, 0.98), MERGING*1.2**stream.uniform(-1.0, 1.0))))
    return sorted(loads)
