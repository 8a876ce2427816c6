"""Rough height maps for the tests."""
import math
import random


def rough_map(rows, columns, seed, longest=1, shortest=5, power=2.0):
    """Periodic heights, rows along x: waves of random heights and phases, from `longest` to `shortest` of them on a
    side, whose amplitudes fall with the power of their number."""
    stream = random.Random(seed)
    heights = [[0.0]*columns for _ in range(rows)]
    for k in range(shortest + 1):
        # The waves with k periods along x, as coefficients of a cosine and a sine in each row.
        waves = [(l, stream.gauss(0, 1)/math.hypot(k, l)**power, 2*math.pi*stream.random())
                 for l in range(-shortest if k else 1, shortest + 1) if longest <= math.hypot(k, l) <= shortest]
        along = [(math.cos(2*math.pi*k*i/columns), math.sin(2*math.pi*k*i/columns)) for i in range(columns)]
        for j, row in enumerate(heights):
            angles = [(a, 2*math.pi*l*j/rows + phase) for l, a, phase in waves]
            cosine, sine = sum(a*math.cos(x) for a, x in angles), sum(a*math.sin(x) for a, x in angles)
            row[:] = [height + cosine*c - sine*s for height, (c, s) in zip(row, along)]
    return heights


def text_of(heights):
    """The file of a map: a matrix."""
    return "".join(" ".join(map(repr, row)) + "\n" for row in heights)
