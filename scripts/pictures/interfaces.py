"""The pictures of the tables of &interface: stiffness, partial slip, adhesion."""
import math

from axes import Axis, label_of_unit
from fields import cells, closed
from picture import AREA, MOST_CURVES, MOST_PANELS, P_BAR, P_STAR, SLIP, TRACTION, CannotBeDrawn, Quantity, \
    mean_pressure_axis


def interface(picture):
    """Contact stiffness against the mean pressure and, if the deck gives resistivities, the resistance."""
    table, columns = picture.table, picture.table.columns
    if not any(number > 0 for number in table.column("contact_stiffness")):
        raise CannotBeDrawn("it has no stiffness")
    units = [label_of_unit(unit) for unit in (table.label("p*"), table.label("Delta"))]
    load, x = mean_pressure_axis([table])
    names = ["stiffness", "resistance"][:1 + bool(table.column("contact_resistance"))]
    labels = "contact stiffness" + (" [{}/{}]".format(*units) if all(units) else ""), "resistance"
    axes = [Axis.of([number for number in table.column(f"contact_{name}") if number > 0] or [1.0], label)
            for name, label in zip(names, labels)]
    both = len(names) > 1
    curves = [picture.curve(f"linespoints ls {31 + n}" + " axes x1y2"*n, load.of(columns["mean_pressure"]),
                            columns[f"contact_{name}"], title=name, joined=True) for n, name in enumerate(names)]
    picture.single(x, axes[0], curves, *(["set border 11", *axes[1].commands("y2")] if both else []),
                   key="top center" if both else "", right=78)


def partial_slip(picture):
    """Stick area and displacement against the tangential load, a curve for each load."""
    table = picture.table
    if not table.column("displacement"):
        raise CannotBeDrawn("the bodies slide under all its loads")
    slip, x = Quantity([table], "displacement", "Delta"), Axis(0, 1, 0.2, label=f"{TRACTION} / ({{/:Italic f p̄}})")
    stick = Quantity([table], "stick_area_fraction")
    loads = [(load, table.of_rows("load", load).columns)
             for load in sorted(set(table.column("load")))[:MOST_CURVES]]
    picture.grid(227, 210, 2, gaps=(96, 0), room=(77, 13, 54, 36))
    for n, (name, found, label) in enumerate((("stick_area_fraction", stick, (AREA, "stick area")),
                                              ("displacement", slip, (SLIP, "displacement")))):
        curves = [picture.curve(f"linespoints ls {31 + k} dt solid", columns["tangential_over_limit"],
                                found.of(columns[name]), title=f"load {load:g}")
                  for k, (load, columns) in enumerate(loads)]
        picture.panel(n, x, found.axis(*label, may_be_wide=False), curves,
                      key="outside top right horizontal samplen 1.5"*n)


def slip_loops(picture):
    """Tangential load against displacement, a curve for each block."""
    tables = picture.tables
    slip, traction = Quantity(tables, "displacement", "Delta"), Quantity(tables, "tangential_load", "p*")
    curves = [picture.curve(f"lines ls {31 + k} dt solid", slip.of(block.columns["displacement"]),
                            traction.of(block.columns["tangential_load"]))
              for k, block in enumerate(picture.table.blocks[:MOST_CURVES])]
    picture.single(slip.axis(SLIP, "displacement", may_be_wide=False),
                   traction.axis(TRACTION, "tangential load", may_be_wide=False), curves)


def slip_maps(picture):
    """Where the contact sticks, slips and is open, a panel for each block."""
    table = picture.table
    if table.points:
        raise CannotBeDrawn("maps of slip are drawn from texts: set map_format = 'text' in &output")
    if len(table.cell) < 2:
        raise CannotBeDrawn("the surface is a profile")
    drawn = [picture.image(*closed(table, place, lambda state: (state if state > 0 else math.nan,), ("slip_state",)))
             for place in range(len(table.blocks[:MOST_PANELS]))]
    cells(picture, None, [("", [[f"{image}:3 with image"] for image in drawn], ["eval of_contact",
                                                                              "set cbrange [1:2.7]"], "")])


def adhesion(picture):
    """Contact area against the load with adhesion: the curve, pull-off, jump, and the loads."""
    table = picture.table
    free = not table.column("pbar_over_pstar")
    column, area, most = ("force", "contact_area", None) if free else ("pbar_over_pstar", "contact_area_fraction", 1.0)
    numbers = [number for number in table.column(column) if not free or number < 1.02*max(table.column(column))]
    least = min(numbers, default=0.0)
    if not free:
        # Towards full contact the tension grows without bound.
        stable = [row for block in table.blocks[1:] for row in block.columns[column]]
        least = min([-0.1] + [2*number for number in stable if number < 0])
    x = Axis(least, max(numbers, default=1.0), label="force" if free else f"{P_BAR}/{P_STAR}")
    y = Axis.of(table.column(area), "contact area" if free else AREA, may_be_wide=False, up_to=most)
    curves = []
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
    picture.single(x, y, curves, key="bottom right")
