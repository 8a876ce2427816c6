"""Reads the tables that wavycon writes."""
import pathlib


class Table:
    """Names and units of the columns, and lines of words; `blocks` counts what gnuplot's `index` counts, and `starts` are
    the numbers of their first lines.

    The last line of '#' above the first row of names holds the units. In a table of blocks the row of names is repeated
    at the head of each block.
    """

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.columns, self.units, self.lines, self.starts = [], [], [], []
        blanks = 2
        for line in self.path.read_text(encoding="utf-8").splitlines():
            words = line.split()
            if not words:
                blanks += 1
            elif line.startswith("#"):
                if not self.columns and words[1:] and all(word[0] + word[-1] == "[]" for word in words[1:]):
                    self.units = [word[1:-1] for word in words[1:]]
            else:
                self.columns = self.columns or words
                if (blanks >= 2) != (words == self.columns):
                    raise ValueError(f"{self.path}: names of columns must stand above each block, and there alone")
                if blanks >= 2:
                    self.starts.append(len(self.lines))
                else:
                    self.lines.append(line)
                blanks = 0
        if not self.columns or len(self.columns) != len(self.units) or len(set(self.columns)) != len(self.columns):
            raise ValueError(f"{self.path}: each column must have a name and a unit")

    @property
    def blocks(self):
        return len(self.starts)

    def rows(self, step=1):
        """The words of each line, or of one line in so many."""
        rows = [line.split() for line in self.lines[::step]]
        for row in rows:
            if len(row) != len(self.columns):
                raise ValueError(f"{self.path}: a row of {len(row)} words below {len(self.columns)} column names")
        return rows

    def column(self, name):
        """The words of a column."""
        place = self.columns.index(name)
        return [row[place] for row in self.rows()]

    def records(self):
        """The words of each line, by the names of the columns."""
        return [dict(zip(self.columns, row)) for row in self.rows()]
