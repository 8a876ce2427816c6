"""Files of numpy's format, without numpy."""
import array
import ast
import struct
import sys


def read_npy(path):
    """The head, {'descr': .., 'fortran_order': .., 'shape': ..}, and all numbers in a row."""
    content = path.read_bytes()
    if content[:8] != b"\x93NUMPY\x01\x00":
        raise ValueError(f"{path}: this is no file of numpy's format, version 1")
    start = 10 + struct.unpack("<H", content[8:10])[0]
    head = ast.literal_eval(content[10:start].decode("ascii"))
    # All columns of a record have one kind.
    kind, = {kind for _, kind in head["descr"]} if isinstance(head["descr"], list) else {head["descr"]}
    values = array.array({"f8": "d", "f4": "f"}[kind[1:]], content[start:])
    if (kind[0] == "<") != (sys.byteorder == "little"):
        values.byteswap()
    return head, values.tolist()


def write_npy(path, heights, kind="f8", by_columns=False):
    """Rows of numbers, of double ('f8') or single precision ('f4'), row by row or column by column."""
    order = {"little": "<", "big": ">"}[sys.byteorder]
    words = (f"{{'descr': '{order}{kind}', 'fortran_order': {by_columns}, "
             f"'shape': ({len(heights)}, {len(heights[0])}), }}")
    words += " "*(-(10 + len(words) + 1) % 64) + "\n"
    lines = zip(*heights) if by_columns else heights
    values = array.array({"f8": "d", "f4": "f"}[kind], [value for line in lines for value in line])
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(words)) + words.encode() + values.tobytes())
