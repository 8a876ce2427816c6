"""Reads the tables that wavycon writes."""
import pathlib


class Table:
    """Column names as name[unit], and lines of words; `blocks` counts what gnuplot's `index` counts."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.columns, self.lines, self.blocks = [], [], 0
        blanks = 2
        for line in self.path.read_text().splitlines():
            if not line.strip():
                blanks += 1
            elif line.startswith("#"):
                # The names of the columns are above the first row; what names a load comes later.
                names = line[1:].split()
                if not self.lines and names and all(name.endswith("]") for name in names):
                    self.columns = names
            else:
                self.blocks += blanks >= 2
                blanks = 0
                self.lines.append(line)
        if not self.columns:
            raise ValueError(f"{path}: no line names the columns")

    def rows(self, step=1):
        """The words of each line, or of one line in so many."""
        rows = [line.split() for line in self.lines[::step]]
        for row in rows:
            if len(row) != len(self.columns):
                raise ValueError(f"{self.path}: a row of {len(row)} words below {len(self.columns)} column names")
        return rows
