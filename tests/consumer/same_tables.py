"""Compares the tables in memory with the files that the program wrote for the same deck of one load.

usage: same_tables.py LIBRARY DECK, the files being beside the deck. Prints the names of the tables that agree.
"""
import math
import pathlib
import sys

from by_ctypes import Library
from tables import Table

# Names whose files have others.
FILES = {"contours": "contour", "histograms": "histogram"}
TABLES = ["summary", "lines", "map", "contours", "spots", "spot_sizes", "histograms", "theory", "theory_lines",
          "details", "spectrum", "stress_largest", "stress_line", "stress_section", "stress_planes"]
lib, deck = Library(sys.argv[1]), pathlib.Path(sys.argv[2])
scene = lib.new_scene(deck.read_bytes(), str(deck).encode(), 1, 0, 0, None)
solution = lib.solve_load(scene, 0)
for name in TABLES:
    file, table = Table(deck.with_suffix(f".{FILES.get(name, name)}.dat")), lib.table(solution, name)
    assert list(table) == file.columns, (name, list(table), file.columns)
    for column in file.columns:
        for value, word in zip(table[column], file.column(column), strict=True):
            same = value == word if isinstance(value, str) else (
                math.isnan(value) and word == "NaN" or abs(float(word) - value) <= 1e-15*abs(value))
            assert same, (name, column, value, word)
    print(name)
