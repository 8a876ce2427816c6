"""What the pictures show, for each kind of table: the variables that scripts/pictures/*.gp want.

Each function of FACTS takes the tables to be drawn together (one, unless runs are compared), the tables of the same run
by kind as far as COMPANIONS lists them, the numbers of the loads to be shown or None, and the folder from which gnuplot
reads. It returns the name of the file of gnuplot commands, the size of the picture in points of 1/72 inch, and the
commands that set the variables. It raises CannotBeDrawn if there is nothing to be shown.
"""
from fields import edges, lines, maps, series
from loading import details, summary, theory

COMPANIONS = {"lines": ("theory_lines",), "map": ("contour",), "theory": ("summary",)}
FACTS = {"summary": summary, "lines": lines, "map": maps, "theory_lines": lines, "contour": edges,
         "coefficients": series, "theory": theory, "details": details}
