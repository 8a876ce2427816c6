"""Writes the module names.py of the package: functions for the kinds of surfaces, types of keys, and columns.

usage: make_names.py LIBRARY PAGE NAMES

LIBRARY: wavycon's shared library, which has the keys of decks and the columns of the summary. PAGE: outputs/README.md,
which describes the columns. NAMES: the file to be written. Needs nothing but Python.
"""
import json
import re
import sys
import textwrap
from ctypes import CDLL, c_char_p, c_double, c_int, c_size_t, c_void_p, create_string_buffer
from keyword import iskeyword
from pathlib import Path

HEAD = '''"""Surfaces, keys of decks and columns, made by make_names.py from what the library tells."""
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Generic, Literal, TypedDict, TypeVar

from .surfaces import Surface, maker

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
else:
    Unpack = None   # of annotations, which are not evaluated

Number = TypeVar("Number")
Word = TypeVar("Word")

'''
# A kind whose own name is another function in Python.
FUNCTIONS = {"sum": "wave_sum"}
DECK = b"&surface kind = 'wave_2d' /"


def text(lib, thing, name):
    buffer = create_string_buffer(lib.wavycon_get_text(None, thing, name, None, 0))
    lib.wavycon_get_text(None, thing, name, buffer, len(buffer))
    return buffer.value.decode()


def ask(library):
    """All groups with their keys, and the columns of the summary with their units."""
    lib = CDLL(library)
    lib.wavycon_get_text.argtypes = [c_void_p, c_void_p, c_char_p, c_void_p, c_size_t]
    lib.wavycon_get_text.restype = c_size_t
    lib.wavycon_new_scene.argtypes = [c_void_p, c_char_p, c_char_p, c_int, c_int, c_int, c_void_p]
    lib.wavycon_solve.argtypes = [c_void_p, c_void_p, c_char_p, c_double]
    lib.wavycon_new_table.argtypes = [c_void_p, c_void_p, c_char_p]
    for function in lib.wavycon_new_scene, lib.wavycon_solve, lib.wavycon_new_table:
        function.restype = c_void_p
    scene = lib.wavycon_new_scene(None, DECK, b"", 0, 0, 0, None)
    summary = lib.wavycon_new_table(None, lib.wavycon_solve(None, scene, b"pbar_over_pstar", 0.0), b"summary")
    columns = dict(column.rstrip("]").split("[") for column in text(lib, summary, b"columns").splitlines())
    return json.loads(text(lib, None, b"keys")), columns


def meanings_of_columns(page):
    """What the page says of the columns, by their names."""
    table = re.search(r"\n## The summary\n.*?\n## ", page, re.DOTALL)[0]
    rows = [row.strip("|").split("|") for row in re.findall(r"^\|.*\|$", table, re.MULTILINE)]
    return {name: re.sub(r"\[([^]]*)\]\([^)]*\)|\\(?=\*)", r"\1", row[2]).strip() for row in rows
            for name in re.findall(r"`(\w+)`", row[0])}


def type_of(key):
    one = {"real": "float", "integer": "int", "logical": "bool", "text": "str"}.get(key["type"])
    if not one:
        return f"Literal[{', '.join(map(repr, key['choices']))}]"
    return one if key.get("most_values", 1) == 1 else f"{one} | Iterable[{one}]"


def python_name(key):
    """The name of a key; a word of Python, such as yield, has an underscore at its end."""
    return key["name"] + "_"*iskeyword(key["name"])


def describe(key):
    """A key in a line, for docstrings."""
    unit = f" [{key['unit']}]" if key["unit"] else ""
    choices = f" One of {', '.join(map(repr, key['choices']))}." if "choices" in key else ""
    default = {".true.": "True", ".false.": "False"}.get(key["default"], key["default"])
    default = f" Default: {default}." if default else ""
    meaning = re.sub("^Of [a-z0-9_, ]*: ", "", key["meaning"])
    return f"{python_name(key)}{unit}: {meaning}{choices}{default}"


def docstring(lines, indent):
    """A line for what it is, and one for each of its parts."""
    wrapped = [textwrap.fill(line, 116, initial_indent=indent, subsequent_indent=indent + "    "*(place > 0),
                             break_long_words=False, break_on_hyphens=False) for place, line in enumerate(lines)]
    body = "\n".join(wrapped[:1] + [""]*(len(lines) > 1) + wrapped[1:]).lstrip()
    return f'{indent}"""{body}' + (f"\n{indent}" if len(lines) > 1 or len(body) > 100 else "") + '"""\n'


def parameter(key):
    """A key as a parameter, with its default if that is a value."""
    default = key["default"].replace("'", '"').replace(".true.", "true").replace(".false.", "false")
    try:
        default = repr(json.loads(default))
    except ValueError:
        default = "None"
    return f"{key['name']}: {type_of(key)} | None = {default}"


def make_surface(kind, keys):
    own = [key for key in keys if kind in key.get("read_by", ())]
    if kind == "ball":   # whose cell is as large as its contacts need
        own = [{**key, "default": ""} if "length" in key["name"] else key for key in own]
    meaning = re.search(rf"'{kind}': (.*?)\.(?= '|$)", next(key for key in keys if key["name"] == "kind")["meaning"])[1]
    name = FUNCTIONS.get(kind, kind)
    begin = f"def {name}(*, "
    parameters = (",\n" + " "*(len(begin) - 3)).join(map(parameter, own))
    doc = docstring([f"{meaning}.", *map(describe, own)], "    ")
    return f'@maker\n{begin}{parameters}) -> Surface:\n{doc}    return Surface({{"kind": {kind!r}}})\n\n\n'


def make_keys(name, meaning, keys, bases="TypedDict", groups=()):
    """A type of dictionaries with some of these keys."""
    fields = [f"    {python_name(key)}: {type_of(key)} | None" for key in keys]
    fields += [f"    {group}: {group.capitalize()}" for group in groups]
    doc = docstring([meaning, *map(describe, keys)], "    ")
    return f"class {name}({bases}, total=False):\n{doc}\n" + "\n".join(fields) + "\n\n\n"


def make_columns(columns, meanings):
    yield ('class Columns(Generic[Number, Word]):\n    """The columns of the summary: numbers and words, or arrays of '
           'these."""\n\n    def _column(self, name: str) -> Any:\n        raise NotImplementedError\n\n')
    for column, unit in columns.items():
        kind = "Word" if unit == "word" else "Number"
        label = "" if unit in ("word", "-") else f"[{unit}] "
        yield (f"    @property\n    def {column}(self) -> {kind}:\n{docstring([label + meanings[column]], ' '*8)}"
               f"        value: {kind} = self._column({column!r})\n        return value\n\n")


def main():
    library, page, names = sys.argv[1:]
    groups, columns = ask(library)
    keys = {group["name"]: group["keys"] for group in groups}
    kinds = next(key["choices"] for key in keys["surface"] if key["name"] == "kind")
    meanings = meanings_of_columns(Path(page).read_text(encoding="utf-8"))
    others = {group: own for group, own in keys.items() if group != "surface"}
    known = [key["name"] for own in others.values() for key in own]
    alone = {group: [key for key in own if known.count(key["name"]) == 1] for group, own in others.items()}
    # What is solved in memory has no directory.
    settings = [key for group, own in alone.items() if group != "load" for key in own if key["name"] != "directory"]
    with open(names, "w", encoding="utf-8") as file:
        file.write(HEAD + "\n")
        file.writelines(make_surface(kind, keys["surface"]) for kind in kinds)
        file.writelines(make_keys(group.capitalize(), f"Keys of &{group}.", own) for group, own in others.items())
        file.write(make_keys("Map", "Keys of height maps.", [key for key in keys["surface"] if key["name"] != "file"
                                                             and "file" in key.get("read_by", ())]))
        file.write(make_keys("OneLoad", "A load: a key of &load with one value.",
                             [{**key, "most_values": 1} for key in keys["load"]]))
        file.write(make_keys("Settings", "Keys of all groups but &surface and &load, and these groups.", settings,
                             groups=[group for group in others if group != "load"]))
        file.write(make_keys("Options", "Settings and loads: the options of solve.", [], "Settings, Load", ["load"]))
        file.write(f"Column = Literal[{', '.join(map(repr, columns))}]\n\n\n")
        file.writelines(make_columns(columns, meanings))
        public = [*(FUNCTIONS.get(kind, kind) for kind in kinds), "Load", "Options", "Settings"]
        file.write(f"\n__all__ = {public}\n")


if __name__ == "__main__":
    main()
