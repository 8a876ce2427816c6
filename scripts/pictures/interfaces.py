"""The pictures of the tables of &interface: stiffness, partial slip, adhesion."""
import math

from axes import Axis, axis, label_of_unit
from fields import CELL, cell_in_head
from loading import curve_of_points
from picture import AREA, AREA_0, MOST_CURVES, P_BAR, P_STAR, SLIP, TRACTION, X, CannotBeDrawn, Picture, Quantity, \
    mean_pressure_axis

ROOM = None, None, None, 0.9   # gnuplot's margins below a title


def interface(tables, beside, choice, folder):
    """Contact stiffness against the mean pressure and, if the deck gives resistivities, the resistance."""
    table, columns = tables[0], tables[0].blocks[0].columns
    if not any(number > 0 for number in table.column("contact_stiffness")):
        raise CannotBeDrawn("it has no stiffness")
    units = [label_of_unit(unit) for unit in (table.label("p*"), table.label("Delta"))]
    load, x = mean_pressure_axis(tables)
    picture, loads = Picture(folder, (480, 300), tables), load.of(columns["mean_pressure"])
    axes = [Axis(*axis([number for number in table.column(f"contact_{name}") if number > 0] or [1.0]), label)
            for name, label in (("stiffness", "contact stiffness" + (" [{}/{}]".format(*units) if all(units) else "")),
                                ("resistance", "resistance"))]
    with_resistance = bool(table.column("contact_resistance"))
    curves = [curve_of_points(picture, "linespoints ls 31", zip(loads, columns["contact_stiffness"])) +
              (" title 'stiffness'" if with_resistance else "")]
    if with_resistance:
        curve = curve_of_points(picture, "linespoints ls 32", zip(loads, columns["contact_resistance"]))
        curves.append(curve.replace(" with ", " axes x1y2 with ") + " title 'resistance'")
    picture.panel(ROOM, x, axes[0], curves, *(["set border 11", *axes[1].commands("y2")] if with_resistance else []),
                  key="top center" if with_resistance else "")
    return picture


def partial_slip(tables, beside, choice, folder):
    """Stick area and displacement against the tangential load, a curve for each load."""
    table = tables[0]
    if not table.column("displacement"):
        raise CannotBeDrawn("the bodies slide under all its loads")
    slip = Quantity(tables, "displacement", "Delta")
    picture, x = Picture(folder, (640, 300), tables), Axis(0, 1, 0.2, label=f"{TRACTION} / ({{/:Italic f p̄}})")
    stick = Axis(*axis(table.column("stick_area_fraction"), may_be_wide=False), f"stick area {AREA}/{AREA_0}")
    for left, name, factor, y in ((0.12, "stick_area_fraction", 1.0, stick), (
            0.625, "displacement", slip.factors[0], slip.axis(SLIP, "displacement", may_be_wide=False))):
        curves = []
        for k, load in enumerate(sorted(set(table.column("load")))[:MOST_CURVES]):
            of_load = table.of_rows("load", load).blocks
            rows = [(at, factor*number) for block in of_load
                    for at, number in zip(block.columns["tangential_over_limit"], block.columns[name])]
            curves.append(picture.curve(f"linespoints ls {31 + k} dt solid", *zip(*rows), title=f"load {load:g}"))
        picture.panel((left, left + 0.355, 0.18, 0.88), x, y, curves,
                      key="outside top right horizontal samplen 1.5" if name == "displacement" else "")
    return picture


def slip_loops(tables, beside, choice, folder):
    """Tangential load against displacement, a curve for each block."""
    slip, traction = Quantity(tables, "displacement", "Delta"), Quantity(tables, "tangential_load", "p*")
    picture = Picture(folder, (480, 340), tables)
    picture.panel(ROOM, slip.axis(SLIP, "displacement", may_be_wide=False),
                  traction.axis(TRACTION, "tangential load", may_be_wide=False), [
        picture.curve(f"lines ls {31 + k} dt solid", slip.of(columns["displacement"]),
                      traction.of(columns["tangential_load"]))
        for k, columns in enumerate(block.columns for block in tables[0].blocks[:MOST_CURVES])])
    return picture


def slip_maps(tables, beside, choice, folder):
    """Where the contact sticks, slips and is open, a panel for each block."""
    table = tables[0]
    if table.points:
        raise CannotBeDrawn("maps of slip are drawn from texts: set map_format = 'text' in &output")
    if len(cell_in_head(table)) < 2:
        raise CannotBeDrawn("the surface is a profile")
    length = Quantity(tables, cell_in_head, "cell_x")
    x, y = (Axis(0, side, side/2, label=label, options="offset 0, 0.3") for side, label in zip(
        length.of(cell_in_head(table)), (length.label(X), "")))
    blocks = table.blocks[:4]
    picture, wide = Picture(folder, (80 + 190*len(blocks), 270), tables), (0.85 - 0.05*(len(blocks) - 1))/len(blocks)
    for n, columns in enumerate(block.columns for block in blocks):
        left = 0.12 + n*(wide + 0.05)
        picture.panel((left, left + wide, 0.24, 0.85), x, y.bare(n > 0), [
            picture.curve("image", length.of(columns["x"]), length.of(columns["y"]),
                          [state if state > 0 else math.nan for state in columns["slip_state"]])],
            *CELL, "eval of_contact", "set cbrange [1:2.7]", "unset colorbox")
    return picture


def adhesion(tables, beside, choice, folder):
    """Contact area against the load with adhesion: the curve, pull-off, jump, and the loads."""
    table = tables[0]
    free = not table.column("pbar_over_pstar")
    column, area, most = ("force", "contact_area", None) if free else ("pbar_over_pstar", "contact_area_fraction", 1.0)
    numbers = [number for number in table.column(column) if not free or number < 1.02*max(table.column(column))]
    least = min(numbers, default=0.0)
    if not free:
        # Towards full contact the tension grows without bound.
        stable = [row for block in table.blocks[1:] for row in block.columns[column]]
        least = min([-0.1] + [2*number for number in stable if number < 0])
    x = Axis(least, max(numbers, default=1.0), label="force" if free else f"{P_BAR}/{P_STAR}")
    y = Axis(*axis(table.column(area), may_be_wide=False, up_to=most), "contact area" if free else f"{AREA}/{AREA_0}")
    picture, curves = Picture(folder, (480, 340), tables), []
    for place, kind, look, title in (
            (0, None, "lines ls 4", "not reliable"), (0, "stable", "lines ls 31", "stable"),
            (0, "unstable", "lines ls 32", "unstable"), (1, "pull_off", "points ls 11", "pull-off"),
            (1, "jump_to_full_contact", "points ls 12", "jump into full contact"),
            (2, "stable", "points ls 13", "loads")):
        for block in table.blocks[place:place + 1]:
            # Where the release rate differs much along the edge the model fails.
            shown = [kind is None or one == kind and release < 1.3
                     for one, release in zip(block.words["point"], block.columns["most_release_over_w"])]
            curves.append(picture.curve(look, block.columns[column], [
                number if is_shown else math.nan for number, is_shown in zip(block.columns[area], shown)], title=title))
    picture.panel(ROOM, x, y, curves, key="bottom right")
    return picture
