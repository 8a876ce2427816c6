"""The pictures of the tables of &interface: stiffness, partial slip, adhesion."""
import dataclasses
import math
import sys

from axes import Axis, chosen, label_of_unit, step_of
from fields import cells, closed
from picture import APPROACH, AREA, MOST_CURVES, MOST_PANELS, P_BAR, RIGHT, SLIP, TRACTION, CannotBeDrawn, \
    Load, Quantity, entry, mean_pressure_axis, shown, wanted_places
from table import Block


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
    numbers = sorted(map(int, set(table.column("load"))))
    loads = [(numbers[place], table.of_rows("load", numbers[place]).columns)
             for place in shown(table, numbers, MOST_CURVES, picture.choice.loads, "loads")]
    picture.grid(227, 210, 2, gaps=(96, 0), room=(77, 13, 54, 36))
    for n, (name, found, label) in enumerate((("stick_area_fraction", stick, (AREA, "stick area")),
                                              ("displacement", slip, (SLIP, "displacement")))):
        curves = [picture.curve(f"linespoints ls {31 + k} dt solid", columns["tangential_over_limit"],
                                found.of(columns[name]), title=f"load {load}")
                  for k, (load, columns) in enumerate(loads)]
        picture.panel(n, x, found.axis(*label, may_be_wide=False), curves,
                      key="outside top right horizontal samplen 1.5"*n)


def slip_loops(picture):
    """Tangential load against displacement, a curve for each block."""
    tables = picture.tables
    slip, traction = Quantity(tables, "displacement", "Delta"), Quantity(tables, "tangential_load", "p*")
    curves = [picture.curve(f"lines ls {31 + k} dt solid", slip.of(load.columns["displacement"]),
                            traction.of(load.columns["tangential_load"]), title=load.name)
              for k, load in enumerate(tangential_loads(picture, MOST_CURVES))]
    picture.single(slip.axis(SLIP, "displacement", may_be_wide=False),
                   traction.axis(TRACTION, "tangential load", may_be_wide=False), curves, key=RIGHT, right=170)


def slip_maps(picture):
    """Where the contact sticks, slips and is open, a panel for each block."""
    table = picture.table
    if len(table.cell) < 2:
        raise CannotBeDrawn("the surface is a profile")
    loads = tangential_loads(picture, MOST_PANELS)
    drawn = [picture.image(*closed(table, load.place, lambda state: (state if state > 0 else math.nan,),
                                   ("slip_state",))) for load in loads]
    cells(picture, loads, [("", [[f"{image}:3 with image"] for image in drawn],
                            ["eval of_contact", "set cbrange [1:2.7]"], "")],
          key=[entry(f"points pt 5 ps 1.5*mark lc rgb '{colour}'", words)
               for colour, words in (("#a9d0ee", "slips"), ("#316496", "sticks"))])


def tangential_loads(picture, most):
    """The blocks to be shown, one for each load and tangential load: at most so many of the loads that are wanted,
    evenly spread. What is left out is said."""
    table, wanted, slip = picture.table, picture.choice.loads, picture.beside.get("partial_slip")
    numbers = [block.load for block in table.blocks]
    places = list(range(len(numbers))) if wanted is None else wanted_places(table, numbers, wanted, "loads")
    kept = [places[k] for k in chosen(len(places), most)]
    if len(kept) < len(places):
        print(f"plot: {table.path}: {len(kept)} of its {len(places)} loads and tangential loads are shown; choose "
              "loads with --loads", file=sys.stderr)
    part = {(row["load"], row["tangential"]): row["tangential_over_limit"]
            for row in (rows_of(slip.blocks[0]) if slip else ())}
    found = []
    for place in kept:
        block = table.blocks[place]
        limit = part.get((block.load, block.tangential))
        name = f"tangential {block.tangential}" if limit is None else f"{TRACTION}/({{/:Italic f p̄}}) = {limit:.3g}"
        found.append(Load(place, [block], f"load {block.load}, {name}", ""))
    return found


# How stretches of a curve with adhesion are drawn, by how their contacts are stable.
STABILITY = {"stable": ("solid", "stable"), "stable_by_approach": ("(6, 3)", "stable by approach"),
             "unstable": ("(1.5, 2.5)", "unstable")}
# The critical points of a curve with adhesion: their names, looks and titles.
CRITICAL = (("pull_off", 7, "pull-off"), ("jump_to_spots", 11, "jump to spots"),
            ("jump_to_pools", 9, "jump to pools"), ("jump_to_full_contact", 5, "jump into full contact"),
            ("pull_off_by_approach", 6, "pull-off by approach"), ("jump_by_approach", 4, "jump by approach"),
            ("end_of_branch", 2, "spots or pools touch"))


def adhesion(picture):
    """Contact area against the load with adhesion, and the load against the approach: the branches, their critical
    points and the contacts of the loads."""
    table = picture.table
    curve, critical, loads = (rows_of(block) for block in (table.blocks + [Block(table.names)]*2)[:3])
    free = not table.column("pbar_over_pstar")
    load, area = ("force", "contact_area") if free else ("mean_pressure", "contact_area_fraction")
    critical = [point for point in critical if math.isfinite(point[load])]   # the others were not found
    units = {load: "force" if free else "p*", area: "contact_area" if free else "", "approach": "Delta"}
    scales = {name: Quantity([table], name, unit) for name, unit in units.items()}
    # Towards full contact the tension grows without bound, and the load of a ball with its contact.
    seen = [point[load] for point in critical + loads if math.isfinite(point[load])] or [0.0]
    most = max(point[load] for point in curve) if free else max(seen)
    low, high = min(0.0, *seen) - 0.12*(most - min(seen)), most + 0.06*(most - min(seen))
    shown = [point for point in curve if low <= point[load] <= high] + critical + loads

    def on_axis(name, points):
        return scales[name].of(point[name] for point in points)

    of_load = Axis(*scales[load].of((low, high)), label=scales[load].label("force" if free else P_BAR))
    # Along x numbers of gnuplot's own steps have no room.
    along_x = dataclasses.replace(of_load, step=step_of(of_load.high - of_load.low))
    of_area = Axis.of(on_axis(area, shown), scales[area].label("contact area") if free else AREA, may_be_wide=False,
                      up_to=None if free else 1.0)
    closing = list(filter(math.isfinite, on_axis("approach", shown)))
    margin = 0.05*(max(closing) - min(closing))
    of_approach = Axis(min(closing) - margin, max(closing) + margin,
                       label=scales["approach"].label(APPROACH, "approach"))
    lines = [(f"lines lc rgb {colour} lw 1.5 dt {STABILITY[kind][0]}", points)
             for branch, colour in (("spots", "blue"), ("pools", "green"))
             for kind, points in stretches(curve + critical, branch, load).items()]
    marks = [(f"points pt {mark} ps 0.85*mark lc rgb red lw 1.2", [
        point for point in critical if point["point"] == name], title) for name, mark, title in CRITICAL]
    marks.append(("points pt 1 ps 1.1*mark lc rgb black lw 1.2", loads, "the loads"))
    both = {"spots", "pools"} <= {point["branch"] for point in curve}
    titles = [entry("lines ls 31", "separate spots"), entry("lines ls 33 dt solid", "separate pools")]*both
    titles += [entry(f"lines lc rgb black lw 1.3 dt {dash}", title) for dash, title in STABILITY.values()]
    titles += [entry(look, title) for look, points, title in marks if points]
    picture.grid(240, 250, 2, gaps=(88, 0), room=(84 if free else 72, 160, 62, 40))
    for n, (across, up, x, y) in enumerate(((load, area, along_x, of_area), ("approach", load, of_approach, of_load))):
        curves = [picture.curve(look, on_axis(across, points), on_axis(up, points))
                  for look, points, *_ in lines + marks]
        picture.panel(n, x, y, curves + titles*n, key=f"{RIGHT} spacing 1 font ',11'"*n)


def rows_of(block):
    """The rows of a block, each with its numbers and words by name."""
    columns = {**block.columns, **{name: words for name, words in block.words.items() if words}}
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def stretches(points, branch, load):
    """The points of a branch by their stability, in the order of the area, with NaN between stretches."""
    points = sorted((point for point in points if point["branch"] == branch and point["point"] != "end_of_branch"),
                    key=lambda point: point["contact_area"])
    found = {kind: [] for kind in STABILITY}
    for here, after in zip(points, points[1:]):
        kind = "stable" if after[load] > here[load] else \
            "stable_by_approach" if after["approach"] > here["approach"] else "unstable"
        if not found[kind] or found[kind][-1] is not here:
            found[kind] += [dict.fromkeys(here, math.nan), here]
        found[kind].append(after)
    return found
