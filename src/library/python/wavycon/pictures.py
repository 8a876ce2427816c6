"""Pictures by matplotlib, on Axes that are given or made: methods of Result and Results. Pressures without a unit are
drawn over p*, gaps over Delta, the mean gap before load."""
from __future__ import annotations

import contextlib
import re
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import regions, surfaces
from .library import need
from .names import Column

if TYPE_CHECKING:
    from .results import Facts, Result, Results

UNRESOLVED = 4   # the status code; from 10 on loads were not solved as requested
THICK, THIN = 0.05, 0.02   # width of a colour bar over the height of its map, and least width over that of the map
PLACES = ("x", "y", "depth", "distance")


def axes(ax: Any) -> Any:
    return need("matplotlib.pyplot", "plot").subplots(layout="constrained")[1] if ax is None else ax


def scaled(facts: Facts, column: str) -> tuple[float, str]:
    """The factor by which a column is drawn, and its label. Pa and m get a prefix, by p*, Delta or the side."""
    unit, words = facts.unit(column), column.replace("_", " ").replace("mises", "Mises")
    if unit == "pressure" and facts.p_star > 0:
        return 1/facts.p_star, f"{words} [p*]"
    if unit == "length" and column not in PLACES and facts.amplitude > 0:
        return 1/facts.amplitude, f"{words} [\u0394]"
    size = facts.length_x if column in PLACES else facts.p_star if unit == facts.pressure_unit else facts.amplitude
    if unit in ("Pa", "m") and size > 0:
        power = 3*int(np.clip(np.floor(np.log10(size/3)/3), -8, 8))
        return 10.0**-power, f"{words} [{need('matplotlib.ticker', 'plot').EngFormatter.ENG_PREFIXES[power]}{unit}]"
    unit = re.sub(r"\bum\b", "\u00b5m", {"N*m": "J"}.get(unit, unit)).replace("^2", "\u00b2").replace("*", " ")
    return 1.0, f"{words} [{unit}]" if unit else words


def title(result: Result) -> str:
    """The load, and what is wrong with it."""
    factor, words = scaled(result._facts, "mean_pressure")
    status = "" if result.status_code < UNRESOLVED else f", {result.status.replace('_', ' ')}"
    return words.replace("[", f"{factor*result.mean_pressure:.4g} ").rstrip("]") + status


def plot(results: Results, y: Column = "contact_area_fraction", x: Column = "mean_pressure", ax: Any = None,
         **style: Any) -> Any:
    """Draws a column of the summary over another, with its error estimates, on matplotlib's Axes, made if not given,
    and returns these. Loads that are not resolved or not solved as requested are open symbols, those whose error is
    not known too. style: as of errorbar."""
    if not len(results):
        raise ValueError("there are no loads to draw")
    for column in x, y:
        if results[column].dtype.kind == "U":
            raise ValueError(f"the column {column!r} has words, not numbers")
    ax, rows = axes(ax), results.table()[np.argsort(results[x])]
    (factor_x, label_x), (factor_y, label_y) = scaled(results._facts, x), scaled(results._facts, y)
    across, values = factor_x*rows[x], factor_y*rows[y]
    error = factor_y*rows[f"{y}_error"] if f"{y}_error" in (rows.dtype.names or ()) else np.zeros(len(rows))
    line = ax.errorbar(across, values, np.nan_to_num(error), **{"marker": "o", "capsize": 2, **style})[0]
    is_open = (rows["status_code"] >= UNRESOLVED) | np.isnan(error)
    if is_open.any():
        ax.plot(across[is_open], values[is_open], "o", color=line.get_color(), markerfacecolor="white", zorder=3,
                label="not resolved")
        ax.legend()
    ax.set(xlabel=label_x, ylabel=label_y)
    return ax


def plot_map(result: Result, field: Literal["pressure", "gap", "displacement", "regions"] = "pressure", ax: Any = None,
             **style: Any) -> Any:
    """Draws a field ('pressure', 'gap', 'displacement') on matplotlib's Axes, made if not given, and returns these;
    or 'regions': each spot of contact in a colour, and what percolates. style: options of pcolormesh, such as vmax in
    the units that are drawn, for a profile of plot."""
    if field == "regions":
        # Without p*, with free edges, nothing is repeated.
        fault = "is a profile" if len(result.y) == 1 else "has free edges" if np.isnan(result.pbar_over_pstar) else ""
        if fault:
            raise ValueError(f"regions are those of a surface that is repeated along x and y: this one {fault}")
        return plot_regions(result, axes(ax), style)
    if field not in result._fields or field in PLACES:
        raise ValueError(surfaces.unknown("field", field, ["pressure", "gap", "displacement", "regions"]))
    ax, facts = axes(ax), result._facts
    factor, words = scaled(facts, field)
    values, (by, x), y = factor*result._fields[field], scaled(facts, "x"), scaled(facts, "y")[1]
    if len(values) == 1:
        ax.plot(by*result.x, values[0], **style)
        ax.set(xlabel=x, ylabel=words, title=title(result))
        return ax
    if field != "displacement":
        values = np.ma.masked_equal(values, 0)   # where the bodies are apart, or touch, there is no colour
    return mesh(result, ax, by*result.x, by*result.y, values, words, style, xlabel=x, ylabel=y, aspect="equal")


def plot_regions(result: Result, ax: Any, style: dict[str, Any]) -> Any:
    """Draws spots in colours, and the gap by whether it percolates. The edge is that of the table spots, of the paper's
    series an isobar."""
    facts, isobar = result._facts, re.search(r"(?m)^ *edge_level = (\S+)", result._facts.deck)
    edge = facts.p_star*float(isobar[1]) if isobar else 0.0
    colours = regions.regions(result.pressure > edge, "edges = 'mirror'" in facts.deck)
    by = scaled(facts, "x")[0]
    paints = need("matplotlib.colors", "plot").ListedColormap(regions.COLOURS)
    ax.pcolormesh(by*result.x, by*result.y, colours, **{"shading": "nearest", "rasterized": True, "vmin": 0,
                  "vmax": len(regions.COLOURS) - 1, "cmap": paints, **style})
    said: dict[str, float] = {}
    with contextlib.suppress(ValueError):   # of saved results without the table
        table = result.table("spots")
        said = dict(zip(table.dtype.names or (), table[0]))
    for words, colour in regions.legend(colours, said):
        ax.plot([], [], "s", color=colour, label=words)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4, ncols=2, frameon=False)
    ax.set(title=title(result), aspect="equal", **{f"{axis}label": scaled(facts, axis)[1] for axis in "xy"})
    # A layout leaves place for title and legend where the one before has put them; the third one hardly moves them.
    for _ in range(2):
        ax.figure.canvas.figure.draw_without_rendering()
    return ax


def plot_stress_section(result: Result, column: str = "von_mises", ax: Any = None, **style: Any) -> Any:
    """Draws a column of the table 'stress_section', which needs stress={...} in the solve, on a vertical section
    through the crest, on matplotlib's Axes, and returns these. style: options of pcolormesh."""
    rows, facts = result.table("stress_section"), result._facts
    rows = rows[rows["body"] == 1]
    # Each place once, depths rising, in whatever order they were given.
    rows = rows[np.unique(rows[["depth", "distance"]], return_index=True)[1]]
    depth, distance = np.unique(rows["depth"]), np.unique(rows["distance"])
    (factor, words), (by, across) = scaled(facts, column), scaled(facts, "distance")
    values = factor*surfaces.column(rows, column).reshape(len(depth), len(distance))
    ax = mesh(result, axes(ax), by*distance, by*depth, values, words, {"shading": "gouraud", **style}, xlabel=across,
              ylabel=scaled(facts, "depth")[1])
    ax.yaxis.set_inverted(True)
    return ax


def mesh(result: Result, ax: Any, x: Any, y: Any, values: Any, words: str, style: dict[str, Any], **axis: Any) -> Any:
    picture = ax.pcolormesh(x, y, values, **{"shading": "nearest", "rasterized": True, **style})
    # A colour bar beside the map, as high as it; matplotlib's own stands beside the place of the map, which is larger.
    width = max(THIN, THICK*np.ptp(y)/np.ptp(x)) if axis.get("aspect") == "equal" else THICK
    ax.figure.colorbar(picture, cax=ax.inset_axes((1 + width, 0, width, 1)), label=words)
    ax.set(title=title(result), **axis)
    return ax
