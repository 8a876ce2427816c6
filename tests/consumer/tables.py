"""Compares the tables in memory with the files that the program wrote for the same deck of one load.

usage: tables.py LIBRARY DECK, the files being beside the deck. Prints the names of the tables that agree.
"""
import math
import pathlib
import sys

from by_ctypes import Library

# Names whose files have others.
FILES = {"contours": "contour", "histograms": "histogram"}
TABLES = ["summary", "lines", "map", "contours", "spots", "spot_sizes", "histograms", "theory", "theory_lines",
          "details", "spectrum", "stress_largest", "stress_line", "stress_section", "stress_planes"]
lib, deck = Library(sys.argv[1]), pathlib.Path(sys.argv[2])
scene = lib.new_scene(deck.read_bytes(), str(deck).encode(), 1, 0, 0, None)
solution = lib.solve_load(scene, 0)
for name in TABLES:
    lines = deck.with_suffix(f".{FILES.get(name, name)}.dat").read_text().splitlines()
    rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    names, table = rows[0], lib.table(solution, name)
    rows = [row for row in rows if row != names]
    assert list(table) == names, (name, list(table), names)
    for k, column in enumerate(names):
        for value, row in zip(table[column], rows, strict=True):
            same = value == row[k] if isinstance(value, str) else (
                math.isnan(value) and row[k] == "NaN" or abs(float(row[k]) - value) <= 1e-15*abs(value))
            assert same, (name, column, value, row[k])
    print(name)
