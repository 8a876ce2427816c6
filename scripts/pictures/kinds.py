"""How each kind of table is drawn.

Each function of DRAWN draws a Picture of its tables (one, unless runs are compared), with the tables of the same run as
far as COMPANIONS lists them, and raises CannotBeDrawn if there is nothing to be shown.
"""
from fields import edges, heights, lines, maps, series, spectra
from interfaces import adhesion, interface, partial_slip, slip_loops, slip_maps
from loading import bounds, details, histogram, spot_sizes, spots, summary, theory
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
# What --variable may name.
VARIABLES = {"map": ("regions",), "stress_section": tuple(SYMBOLS), "stress_planes": tuple(SYMBOLS)}


def check_variable(kind, name):
    """Raises CannotBeDrawn where a kind of table has no such variable."""
    there_are = VARIABLES.get(kind, ())
    if name not in there_are:
        raise CannotBeDrawn(f"--variable {name}: " + (f"there is no {'stress' if len(there_are) > 1 else 'variable'} "
                            f"'{name}'; there are {', '.join(there_are)}" if there_are else
                            "this kind of table has no variables to choose from; maps, sections and planes have"))
