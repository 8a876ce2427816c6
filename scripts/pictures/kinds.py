"""How each kind of table is drawn.

Each function of DRAWN draws a Picture of its tables (one, unless runs are compared), with the tables of the same run as
far as COMPANIONS lists them, and raises CannotBeDrawn if there is nothing to be shown.
"""
from fields import edges, heights, lines, maps, series, spectra
from interfaces import adhesion, interface, partial_slip, slip_loops, slip_maps
from loading import bounds, column, details, histogram, spot_sizes, spots, summary, theory
from picture import CannotBeDrawn
from stresses import SYMBOLS, below_crest, largest, planes, section

COMPANIONS = {"lines": ("theory_lines",), "map": ("contour", "spots"), "theory": ("summary",),
              "stress_planes": ("contour",), "slip_map": ("partial_slip",), "slip_loop": ("partial_slip",)}
DRAWN = {"summary": summary, "lines": lines, "map": maps, "theory_lines": lines, "contour": edges,
         "coefficients": series, "theory": theory, "details": details, "spectrum": spectra, "height": heights,
         "spots": spots, "spot_sizes": spot_sizes, "histogram": histogram,
         "stress_largest": largest, "stress_line": below_crest, "stress_section": section, "stress_planes": planes,
         "interface": interface, "partial_slip": partial_slip, "slip_loop": slip_loops, "slip_map": slip_maps,
         "adhesion": adhesion, "bounds": bounds}
# What --variable may name; in tables with a row for each load, any column.
VARIABLES = {"map": ("regions",), "stress_section": tuple(SYMBOLS), "stress_planes": tuple(SYMBOLS)}
ROWS_OF_LOADS = ("summary", "details", "theory", "spots", "stress_largest", "interface", "bounds")


def function_for(kind, variable):
    """The function that draws a kind of table, of which --variable names one. Raises CannotBeDrawn where there is no
    such variable."""
    if variable and kind in ROWS_OF_LOADS:
        return column
    there_are = VARIABLES.get(kind, ())
    if variable and variable not in there_are:
        raise CannotBeDrawn(f"--variable {variable}: " + (
            f"there is no {'stress' if len(there_are) > 1 else 'variable'} '{variable}'; there are "
            f"{', '.join(there_are)}" if there_are else "this kind of table has no variables to choose from; maps, "
            "sections, planes and tables with a row for each load have"))
    return DRAWN[kind]
