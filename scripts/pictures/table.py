"""Reads the tables of wavycon for scripts/plot: text with a row of names, maps and heights in numpy's format."""
import array
import ast
import copy
import math
import re
import sys

# A table is known by columns that no kind before it has.
MARKS = {"summary": ("pbar_over_pstar", "active_constraints", "mean_pressure", "status_code"),
         "lines": ("load", "line", "distance", "pbar_over_pstar", "pressure", "gap"),
         "theory_lines": ("load", "line", "distance", "pbar_over_pstar", "westergaard_pressure_over_pstar"),
         "map": ("x", "y", "pressure", "gap", "undeformed_gap"),
         "contour": ("load", "curve", "x", "y"),
         "spots": ("pbar_over_pstar", "spots", "closed_pools", "contact_percolates_x"),
         "spot_sizes": ("load", "rank", "area_fraction", "equivalent_radius", "percolates_x"),
         "histogram": ("load", "bin", "pressure_density", "gap_density"),
         "coefficients": ("load", "i", "j", "pressure_over_pstar"),
         "theory": ("pbar_over_pstar", "hertz_contact_area_fraction", "kuznetsov_mean_gap_over_amplitude"),
         "details": ("pbar_over_pstar", "trough_gap_over_amplitude", "elastic_energy_over_pstar_amplitude"),
         "spectrum": ("wave_number", "waves", "spectrum_2d", "spectrum_1d"),
         "height": ("height",),
         "stress_largest": ("pbar_over_pstar", "largest_von_mises_over_pstar", "von_mises_depth"),
         "stress_line": ("depth_over_cell_x", "stress_xx", "von_mises"),
         "stress_section": ("distance", "depth", "stress_xx", "von_mises"),
         "stress_planes": ("x", "y", "depth", "stress_xx", "von_mises"),
         "interface": ("contact_stiffness", "contact_area_slope"),
         "partial_slip": ("tangential_over_limit", "stick_area_fraction"),
         "slip_loop": ("branch", "tangential_load", "displacement"),
         "slip_map": ("x", "y", "traction", "slip_state"),
         "adhesion": ("contact_area_fraction", "approach", "branch", "point"),
         "percolation": ("last_before_over_pstar", "percolation_over_pstar"),
         "bounds": ("pbar_over_pstar", "energy_lower_over_pstar_amplitude", "energy_is_inside")}
# The labels of units if the deck gives none.
UNLABELLED = {"pressure", "length"}
# With adhesion loads below this part of the largest are 0 within their error.
ROUNDING = 1e-6
HEAD_NUMBER = re.compile(r"(Delta|p\*|e_star|cell_x|cell_y|edge_level)\[([^]]*)\] = ([^ ,]+)")
OF_SEVERAL_DECKS = "this is a table of several decks; draw their summaries, with --compare in one picture"
MAGIC = b"\x93NUMPY\x01\x00"


class NotATable(ValueError):
    """The file is no table of wavycon, or has no rows."""


class NoPicture(NotATable):
    """The table is one of those that have no picture."""


class Block:
    """The rows of a load, or of a whole table without blocks: `columns` holds arrays of numbers by name."""

    def __init__(self, names):
        self.load = None   # its number in the deck's order
        self.pbar_over_pstar = math.nan   # with free edges, where there is no p*, the mean pressure
        self.body = 1      # the number of the body whose stresses these are
        self.tangential = 1   # of partial slip, the number of the tangential load
        self.columns = {name: array.array("d") for name in names}
        self.words = {name: [] for name in names}   # of columns of words, whose numbers are NaN

    def add(self, words, names):
        if len(words) != len(names):
            raise NotATable(f"a row has {len(words)} entries below {len(names)} names")
        for name, word in zip(names, words):
            try:
                self.columns[name].append(float(word))
            except ValueError:
                self.columns[name].append(math.nan)
                self.words[name].append(word)


class Table:
    """A table: kind, names of columns, `blocks`, and what the head says.

    `numbers` holds Delta, p*, cell_x, cell_y and edge_level as far as the head gives them, `units` their units;
    `title` is the deck's, '' if it has none; `method` is the first word of its line; `mirrored` says whether the cell
    is a map that its mirror images continue; `adhesive` whether these are fields with adhesion, and `family` is then
    "adhesion_", what stands before the kind in the file's name, otherwise ""; `beside_adhesion` whether the run has
    contacts with adhesion and these are not they. The rest of a line that begins a block is not needed.
    """

    def __init__(self, path):
        self.path = str(path)
        self.names, self.blocks = [], []
        self.numbers, self.units, self.method, self.title, self.mirrored = {}, {}, "", "", False
        self.adhesive = self.beside_adhesion = False
        self.column_units = {}   # by the names of columns
        self.summary = None   # that of the same run, if there is one
        self.points = None    # of a map in numpy's format
        with open(path, "rb") as file:
            binary = file.read(len(MAGIC)) == MAGIC
        if binary:
            self._read_npy()
        else:
            self._read_text()
        self.kind = next((kind for kind, mark in MARKS.items() if set(mark) <= set(self.names)), None)
        if self.kind is None:
            raise NotATable("this is not a table of this version of wavycon: none has these columns")
        if self.kind == "percolation":
            raise NoPicture("this table has no picture: it is one load and its error")
        self.family = "adhesion_" if self._bare_name.endswith(f".adhesion_{self.kind}") else ""
        self.adhesive = self.adhesive or bool(self.family)   # a map in numpy's format has its name alone
        if not any(len(next(iter(block.columns.values()))) for block in self.blocks):
            raise NotATable("the table has no rows")
        largest = max(abs(block.pbar_over_pstar) for block in self.blocks)
        for block in self.blocks:
            if block.columns.get("body"):
                block.body = int(block.columns["body"][0])
            if block.columns.get("tangential"):
                block.load, block.tangential = (int(block.columns[name][0]) for name in ("load", "tangential"))
            if self.adhesive and abs(block.pbar_over_pstar) < ROUNDING*largest:
                block.pbar_over_pstar = 0.0

    def _read_text(self):
        load, words_of_load, units = None, "", []
        try:
            with open(self.path, encoding="utf-8") as file:
                for line in file:
                    if line.startswith("#"):
                        self._read_head(line)
                        if re.fullmatch(r"#(\s+\[\S*\])+\s*", line):
                            units = [word[1:-1] for word in line[1:].split()]
                        begun = re.match(r"# load (\d+): (?:pbar/p\*|mean pressure) = ([^ ,]+)", line)
                        if begun:
                            load, words_of_load = int(begun[1]), begun[2]
                        continue
                    words = line.split()
                    if not words:
                        continue
                    if not self.names:
                        if {"deck", "case"} <= set(re.findall(r"\w+", line)):
                            raise NotATable(OF_SEVERAL_DECKS)
                        if re.match(r"[A-Za-z]\w*(\[[^],]*\])?,", line):
                            raise NotATable("this table has commas, for spreadsheets; draw the .dat of the same run")
                        if not all(re.fullmatch(r"[A-Za-z]\w*", word) for word in words):
                            raise NotATable("this is not a table of wavycon: its first row holds no names of columns")
                        self.names = words
                        self.column_units = dict(zip(words, units))
                    if words == self.names:
                        self.blocks.append(Block(words))
                        if load is not None:
                            self.blocks[-1].load, self.blocks[-1].pbar_over_pstar = load, float(words_of_load)
                    else:
                        self.blocks[-1].add(words, self.names)
        except UnicodeDecodeError:
            raise NotATable("this is not a table of wavycon: it is not a text") from None

    def _read_head(self, line):
        for name, unit, number in HEAD_NUMBER.findall(line):
            self.numbers[name], self.units[name] = float(number), unit
        name, _, words = line.removeprefix("# ").strip().partition(": ")
        if name == "title":
            self.title = words
        elif name == "surface":
            self.mirrored = words.endswith(", mirrored")
        elif name == "adhesion":
            self.adhesive = words.startswith("the contacts are those with it;")
            self.beside_adhesion = not self.adhesive
        elif name == "method":
            self.method = words.split(",")[0]

    def _read_npy(self):
        with open(self.path, "rb") as file:
            data = file.read()
        try:
            skip = 10 + int.from_bytes(data[8:10], "little")
            header = ast.literal_eval(data[10:skip].decode("latin-1").strip())
            form = header["descr"]
            fields = [("height", form)] if isinstance(form, str) else form   # heights are no records
            self.names = [name for name, form in fields if form[1:] == "f8"]
            endian = "little" if fields[0][1][0] == "<" else "big"
            # within: of stresses, bodies and depths; of slip, tangential loads. Heights have no loads.
            loads, *within, rows, columns = (1, *header["shape"]) if isinstance(form, str) else header["shape"]
        except (ValueError, SyntaxError, TypeError, KeyError, IndexError, UnicodeDecodeError):
            raise NotATable("this array is not a map of wavycon: its records have other fields") from None
        self.points = (columns, rows)
        size = len(self.names)*rows*columns
        for place in range(loads*math.prod(within)):
            numbers = array.array("d", data[skip + 8*place*size:skip + 8*(place + 1)*size])
            if len(numbers) != size:
                raise NotATable("the file is cut short")
            if endian != sys.byteorder:
                numbers.byteswap()
            block = Block([])
            block.load = place//math.prod(within) + 1
            block.tangential = place % math.prod(within) + 1
            if len(within) == 2:
                block.body = place//within[1] % within[0] + 1
            block.columns = {name: numbers[i::len(self.names)] for i, name in enumerate(self.names)}
            if self.names == ["height"]:
                block.columns.update(x=list(range(columns))*rows, y=[j for j in range(rows) for _ in range(columns)])
            self.blocks.append(block)

    @property
    def _bare_name(self):
        return self.path.removesuffix(".dat").removesuffix(".npy")

    @property
    def stem(self):
        """The name of the file without kind and ending."""
        return self._bare_name.removesuffix(f".{self.family}{self.kind}")

    def is_contact(self, pressure, gap):
        """Whether there is contact, of numbers or of arrays: with adhesion, which bears tension, where there is no gap;
        otherwise where the pressure is above 0, of the paper's series above a part of p*."""
        if self.adhesive:
            return gap <= 0
        return pressure > self.numbers.get("edge_level", 0.0)*self.numbers.get("p*", 1.0)

    def take_head(self, summary):
        """Takes what the summary of the same run says: a map in numpy's format has no head."""
        for name in ("numbers", "units", "method", "title", "mirrored"):
            setattr(self, name, getattr(summary, name))
        self.beside_adhesion = summary.beside_adhesion and not self.adhesive
        of_load = summary.column("pbar_over_pstar" if "p*" in summary.numbers else "mean_pressure")
        for block in self.blocks:
            if self.kind == "height":
                # Places are numbers of points until the cell is known.
                for name, count in zip("xy", self.points):
                    step = self.numbers.get(f"cell_{name}", count)/count
                    block.columns[name] = [step*number for number in block.columns[name]]
            elif block.load <= len(of_load):
                block.pbar_over_pstar = of_load[block.load - 1]

    def size_of(self, name):
        """The size of a quantity that decides on its unit in all pictures of a run, None if it is not known.

        name: "cell_x" for places, "Delta" for heights and gaps, "p*" for pressures and stresses: of these the size lies
        between the load in the middle and the largest pressure of the summary. A third of it: rather 2000 MPa than
        0.1 GPa.
        """
        if name == "p*":
            loads, peaks = (sorted(p for p in self.summary.column(one) if p > 0) if self.summary else []
                            for one in ("mean_pressure", "peak_pressure"))
            return math.sqrt(loads[len(loads)//2]*peaks[-1])/3 if loads and peaks else None
        return self.numbers.get(name, 0.0)/(3 if name == "cell_x" else 1) or None

    @property
    def columns(self):
        """The columns of a table that is no series of blocks, or of its first block."""
        return self.blocks[0].columns

    @property
    def cell(self):
        """The sides of the cell, one of a profile: as in the head, otherwise from the points, of which the last is not
        written."""
        sides = [self.numbers[name] for name in ("cell_x", "cell_y") if name in self.numbers]
        for name in () if sides else "xy":
            places = sorted(set(self.blocks[0].columns[name]))
            sides.append(len(places)*(places[1] - places[0]) if len(places) > 1 else 0.0)
        return [side for side in sides if side > 0]

    def with_blocks(self, blocks):
        """The same table with some of its blocks alone."""
        part = copy.copy(self)
        part.blocks = blocks
        return part

    def of_rows(self, name, number):
        """The same table with the rows alone in which a column has a number."""
        blocks = []
        for block in self.blocks:
            blocks.append(copy.copy(block))
            places = [k for k, one in enumerate(block.columns[name]) if one == number]
            blocks[-1].columns = {key: [column[k] for k in places] for key, column in block.columns.items()}
        return self.with_blocks(blocks)

    def label(self, name):
        """The unit of a number of the head, or of a column, '' if the deck gives it no label."""
        # With free edges there is no p*.
        unit = self.units.get(name, self.units.get("e_star", "") if name == "p*" else self.column_units.get(name, ""))
        return unit if UNLABELLED.isdisjoint(re.findall("[a-z]+", unit)) else ""

    def column(self, name, blocks=None):
        """All finite numbers of a column, of all blocks or of those given by their places."""
        if name not in self.names:
            return []
        chosen = self.blocks if blocks is None else [self.blocks[i] for i in blocks]
        return [number for block in chosen for number in block.columns[name] if math.isfinite(number)]
