"""What the pictures of the surface itself show: its heights and its power spectrum. See facts.py."""
import array
import math
import os

from axes import label_of_unit, quoted, step_of
from fields import MOST_PIXELS, cell_in_head
from variables import CannotBeDrawn, array_of, numbers_in, put_range, put_scale

# Densities this far below the largest are rounding of the heights, and not shown.
ROUNDING = 1e-12
# The columns of the directions; in the other one there is no number.
DENSITIES = {"radial": "spectrum_2d", "x": "spectrum_1d", "y": "spectrum_1d"}


def spectra(tables, beside, choice, folder):
    """Power spectra: the radial one, and those along x and y, both logarithmic."""
    table = tables[0]
    blocks = table.blocks
    names = ["radial", "x", "y"] if len(blocks) == 3 else ["x"]
    limits = {}
    for name, block in zip(names, blocks):
        column = DENSITIES[name]
        # Zeros, such as the mean, have no place on these axes.
        pairs = [(q, c) for q, c in zip(block.columns["wave_number"], block.columns[column]) if q > 0 and c > 0]
        least = ROUNDING*max((c for _, c in pairs), default=0.0)
        limits.setdefault(column, []).extend((q, c) for q, c in pairs if c > least)
    pairs = [pair for found in limits.values() for pair in found]
    if not pairs:
        raise CannotBeDrawn("there are no waves")
    low, high = min(q for q, _ in pairs)/1.5, max(q for q, _ in pairs)*1.5
    if math.floor(math.log10(low)) == math.floor(math.log10(high)):
        # An axis needs a power of ten to have a number.
        low, high = 10.0**math.floor(math.log10(low)), 10.0**math.ceil(math.log10(high))
    unit = label_of_unit(table.label("cell_x"))
    facts = [f"lines = {int(len(blocks) == 3)}", f"panels = {len(limits)}"]
    facts += [f"q_label = 'wave number {{/:Italic q}}'.{quoted(unit and f' [rad/{unit}]')}",
              f"q_low = {low!r}", f"q_high = {high!r}"]
    for column, power in (("spectrum_2d", 4), ("spectrum_1d", 3)):
        sizes = [c for _, c in limits.get(column, [])] or [1.0]
        label = "{/:Italic C}" + ("" if power == 4 else "_1")
        facts += [f"{column}_label = 'spectrum {label}'.{quoted(unit and f' [{unit}^{power}]')}",
                  f"{column}_low = {10.0**math.floor(math.log10(min(sizes)))!r}",
                  f"{column}_high = {10.0**math.ceil(math.log10(1.001*max(sizes)))!r}"]
    return "spectrum", (90 + 330*len(limits), 330), facts


def heights(tables, beside, choice, folder):
    """Heights over the mean as colours over one cell; of profiles a curve."""
    table = tables[0]
    columns, rows = table.points
    block = table.blocks[0].columns["height"]
    # Without a head the sides are numbers of points.
    sides = (cell_in_head(table) + [1.0])[:2] if table.numbers else [columns, rows]
    ends = [min(block), max(block)]
    height = numbers_in(tables, lambda table: ends, "Delta", "Delta")
    length = numbers_in(tables, lambda table: sides[:1 if rows == 1 else 2], "cell_x", "")
    facts = put_scale("height", height, quoted("height"))
    facts += put_range("height", [height[1][0]*end for end in ends], may_be_wide=False)
    facts += [f"height_most = {height[1][0]*max(map(abs, ends)) or 1.0!r}"]
    facts += put_scale("length", length, "x_symbol") + [f"y_label = {length[0].label('y_symbol')}"]
    cell = [length[1][0]*side for side in sides]
    facts += array_of("cell", [repr(side) for side in cell])
    step = max(1, math.ceil(max(columns, rows)/MOST_PIXELS))
    across, down = range(0, columns, step), range(0, rows, step)
    with open(os.path.join(folder, "heights"), "wb") as file:
        for j in down:
            numbers = array.array("d")
            for i in across:
                numbers.extend((cell[0]*i/columns, cell[1]*j/rows, height[1][0]*block[j*columns + i]))
            numbers.tofile(file)
    facts += [f"columns = {len(across)}", f"rows = {len(down)}"]
    if rows == 1:
        return "height_1d", (430, 250), facts + [f"length_step = {step_of(cell[0])!r}"]
    stretch = min(max(math.sqrt(cell[1]/cell[0]), 0.45), 2.2)
    wide, tall = 260/stretch, 260*stretch
    facts += [f"length_step = {step_of(max(1.5*min(cell), max(cell)))!r}",
              f"panel_wide = {wide!r}", f"panel_tall = {tall!r}"]
    return "height", (wide + 170, tall + 105), facts
