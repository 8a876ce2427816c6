"""Pictures by matplotlib, on Axes that are given or made: methods of Result and Results."""
import numpy as np


def axes(ax):
    if ax is None:
        import matplotlib.pyplot
        ax = matplotlib.pyplot.subplots(layout="constrained")[1]
    return ax


def label(facts, column):
    unit = facts["units"].get(column, "-")
    return column.replace("_", " ") + ("" if unit in ("-", "word") else f" [{unit}]")


def plot(results, y="contact_area_fraction", x="mean_pressure", ax=None, **style):
    """Draws a column of the summary over another, with its error estimates, on matplotlib's Axes, made if not given,
    and returns these. Loads that were not solved as requested are open symbols. style: as of errorbar."""
    ax, summary, facts = axes(ax), results.table("summary"), results._facts
    error = summary[f"{y}_error"] if f"{y}_error" in summary.dtype.names else None
    order = np.argsort(summary[x])
    line = ax.errorbar(summary[x][order], summary[y][order], None if error is None else np.nan_to_num(error[order]),
                       **{"marker": "o", "capsize": 2, **style})[0]
    bad = summary[summary["status_code"] >= 10]
    ax.plot(bad[x], bad[y], "o", color=line.get_color(), markerfacecolor="white", zorder=3)
    ax.set(xlabel=label(facts, x), ylabel=label(facts, y))
    return ax


def plot_map(result, field="pressure", ax=None, **style):
    """Draws a field ('pressure', 'gap', 'displacement') on matplotlib's Axes, made if not given, and returns these.
    style: options of pcolormesh, for a profile of plot."""
    ax, x, values = axes(ax), result.x, result._fields[field]
    result.table("summary")
    unit = result._facts["pressure_unit" if field == "pressure" else "length_unit"]
    length = f"[{result._facts['length_unit']}]"
    if len(values) == 1:
        ax.plot(x, values[0], **style)
        ax.set(xlabel=f"x {length}", ylabel=f"{field} [{unit}]")
        return ax
    if field == "pressure":
        values = np.ma.masked_equal(values, 0)   # no contact is no colour
    return mesh(ax, x, result.y, values, f"{field} [{unit}]", xlabel=f"x {length}", ylabel=f"y {length}",
                aspect="equal", style=style)


def plot_stress_section(result, column="von_mises", ax=None, **style):
    """Draws a column of the table 'stress_section', which needs stress={...} in the solve, on a vertical section
    through the crest, on matplotlib's Axes, and returns these. style: options of pcolormesh."""
    rows, facts = result.table("stress_section"), result._facts
    rows = rows[rows["body"] == 1]
    depth, distance = np.unique(rows["depth"]), np.unique(rows["distance"])
    values = rows[column].reshape(len(depth), len(distance))
    ax = mesh(axes(ax), distance, depth, values, label(facts, column), xlabel=label(facts, "distance"),
              ylabel=label(facts, "depth"), style=style)
    ax.yaxis.set_inverted(True)
    return ax


def mesh(ax, x, y, values, words, *, style, **axis):
    picture = ax.pcolormesh(x, y, values, **{"shading": "nearest", "rasterized": True, **style})
    ax.figure.colorbar(picture, ax=ax, label=words)
    ax.set(**axis)
    return ax
