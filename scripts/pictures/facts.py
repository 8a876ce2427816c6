"""What the pictures show, for each kind of table: the variables that scripts/pictures/*.gp want.

Each function of FACTS takes the tables to be drawn together (one, unless runs are compared), the tables of the same run
by kind as far as COMPANIONS lists them, the Choice of what is to be shown, and the folder from which gnuplot reads. It
returns the name of the file of gnuplot commands, the size of the picture in points of 1/72 inch, and the commands that
set the variables. It raises CannotBeDrawn if there is nothing to be shown.
"""
from fields import edges, lines, maps, series
from interfaces import adhesion, interface, partial_slip, slip_loops, slip_maps
from loading import details, summary, theory
from spots import histogram, spot_sizes, spots
from stresses import below_crest, largest, planes, section
from surfaces import heights, spectra

COMPANIONS = {"lines": ("theory_lines",), "map": ("contour",), "theory": ("summary",), "stress_planes": ("contour",)}
FACTS = {"summary": summary, "lines": lines, "map": maps, "theory_lines": lines, "contour": edges,
         "coefficients": series, "theory": theory, "details": details, "spectrum": spectra, "height": heights,
         "spots": spots, "spot_sizes": spot_sizes, "histogram": histogram,
         "stress_largest": largest, "stress_line": below_crest, "stress_section": section, "stress_planes": planes,
         "interface": interface, "partial_slip": partial_slip, "slip_loop": slip_loops, "slip_map": slip_maps,
         "adhesion": adhesion}
