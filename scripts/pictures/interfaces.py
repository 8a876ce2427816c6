"""What the pictures of the tables of &interface show: stiffness, partial slip, adhesion. See facts.py."""
from axes import label_of_unit, quoted
from fields import cell_in_head
from variables import MOST_CURVES, CannotBeDrawn, array_of, mean_pressure_axis, numbers_in, of_column, put_range, \
   put_scale, scaled


def axis_of(table, name, column, over, symbol, words, **kind):
    """Label, factor and range of an axis; name, over: as of `numbers_in`."""
    found = numbers_in([table], of_column(column), over, "", may_be_wide=kind.get("may_be_wide", False))
    return put_scale(name, found, symbol, words) + put_range(name, scaled([table], found[1], column), **kind)


def interface(tables, beside, choice, folder):
    """Contact stiffness against the mean pressure and, if the deck gives resistivities, the resistance."""
    table = tables[0]
    if not any(number > 0 for number in table.column("contact_stiffness")):
        raise CannotBeDrawn("it has no stiffness")
    units = [label_of_unit(unit) for unit in (table.label("p*"), table.label("Delta"))]
    facts, _ = mean_pressure_axis(tables)
    facts += [f"stiffness_label = 'contact stiffness'.{quoted(' [{}/{}]'.format(*units) if all(units) else '')}"]
    facts += [f"with_resistance = {int(bool(table.column('contact_resistance')))}"]
    for name in "stiffness", "resistance":
        facts += put_range(name, [number for number in table.column(f"contact_{name}") if number > 0] or [1.0])
    return "interface", (480, 300), facts


def partial_slip(tables, beside, choice, folder):
    """Stick area and displacement against the tangential load, a curve for each load."""
    table = tables[0]
    loads = sorted(set(table.column("load")))
    if not table.column("displacement"):
        raise CannotBeDrawn("the bodies slide under all its loads")
    facts = axis_of(table, "slip", "displacement", "Delta", quoted("{/:Italic s}"), "displacement", may_be_wide=False)
    facts += put_range("stick", table.column("stick_area_fraction"), may_be_wide=False)
    facts += array_of("load_number", [repr(int(load)) for load in loads[:MOST_CURVES]])
    return "partial_slip", (640, 300), facts


def slip_loops(tables, beside, choice, folder):
    """Tangential load against displacement, a curve for each block."""
    table = tables[0]
    facts = axis_of(table, "slip", "displacement", "Delta", quoted("{/:Italic s}"), "displacement", may_be_wide=False)
    facts += axis_of(table, "traction", "tangential_load", "p*", quoted("{/:Italic Q}"), "tangential load",
                     may_be_wide=False)
    return "slip_loop", (480, 340), facts + [f"blocks = {min(len(table.blocks), MOST_CURVES)}"]


def slip_maps(tables, beside, choice, folder):
    """Where the contact sticks, slips and is open, a panel for each block."""
    table = tables[0]
    if table.points:
        raise CannotBeDrawn("maps of slip are drawn from texts: set map_format = 'text' in &output")
    sides = cell_in_head(table)
    if len(sides) < 2:
        raise CannotBeDrawn("the surface is a profile")
    length = numbers_in([table], lambda table: sides, "cell_x", "")
    facts = put_scale("length", length, "x_symbol") + array_of("cell", [repr(length[1][0]*side) for side in sides])
    panels = min(len(table.blocks), 4)
    return "slip_map", (80 + 190*panels, 270), facts + [f"panels = {panels}"]


def adhesion(tables, beside, choice, folder):
    """Contact area against the load with adhesion: the curve, pull-off, jump, and the loads."""
    table = tables[0]
    free = not table.column("pbar_over_pstar")
    column, most = ("force", None) if free else ("pbar_over_pstar", 1.0)
    numbers = [number for number in table.column(column) if not free or number < 1.02*max(table.column(column))]
    least = min(numbers, default=0.0)
    if not free:
        # Towards full contact the tension grows without bound.
        stable = [row for block in table.blocks[1:] for row in block.columns[column]]
        least = min([-0.1] + [2*number for number in stable if number < 0])
    label = "'force'" if free else "load"
    area = "contact_area" if free else "contact_area_fraction"
    facts = put_range("area", table.column(area), may_be_wide=False, up_to=most)
    return "adhesion", (480, 340), facts + [
       f"load_column = {quoted(column)}", f"area_column = {quoted(area)}", f"load_label = {label}",
       f"area_label = {quoted('contact area') if free else 'area.' + quoted('/') + '.area_0'}",
       f"load_least = {least!r}", f"load_most = {max(numbers, default=1.0)!r}"]
