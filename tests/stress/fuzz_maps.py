"""Height maps that nobody would measure: mutated numbers, rows, columns, bytes and sizes, and what is no file.

Every one ends with a status and clean words. What is accepted is read a second time, here: size, extremes and rms must
be those that the log names."""
import functools
import os
import random
import re
import resource
import struct
import sys

from common import (SECONDS, as_bytes, check_all, complaints_about, files_below, memory_limits, result_complaints, run,
                    stripped, write)
from fuzz_decks import mutate_bytes, mutate_tokens

MEGABYTE = 1000000
ADDRESS_SPACE = 4000*MEGABYTE  # of a run [byte]
BINARY_ADDRESS_SPACE = 500*MEGABYTE  # the same, of a small binary map: no allocation follows its head alone
LARGE_SECONDS = 30.0  # limit for a map of a hundred megabytes, which takes 3 s on an idle machine
LARGEST = 1e90
LOG_TOLERANCE = 1e-5  # of the numbers of the log, which have six digits
# Errors of a file or of a map as a whole, which have no line.
WITHOUT_LINE = re.compile(r"there are no numbers|the file is empty|a map of \d+ x \d+ points|the heights over their mean"
                          r"|there is no such file|this is a (directory|pipe)|cannot be (opened|read)"
                          r"|there is not (?:the|enough) memory|this is no text|(\d+ of \d+|all) heights are missing|the grid of these points"
                          r"|by its name this is an? (compressed file|picture|file of|archive|spreadsheet)")
# More points would make a run long.
MOST_POINTS = 4096

NUMBERS = ["0", "-0", "1", "-1", "+1", "1e-12", "1e12", "1e90", "-1e90", "1.1e90", "1e300", "-1e308", "1e309", "1e-90",
           "1e-300", "1e400", "-1e400", "1e-400", "4.9e-324", "2e-310", "nan", "NaN", "-nan", "nan(1)", "inf", "-Infinity",
           "1d0", "1.D-3", ".5", "5.", ".", "1e", "1e+", "1+3", "0x10", "0x1p3", "1_8", "1,5", "-1,25", "1.0.0", "--1",
           "3*1", "(1,2)", "1/2", "", "*", "1e99999", "0." + "9"*80, "9"*99, "9"*101, "1"*400, "½", "１", "NA", "null",
           "'1'", '"1"', '"1', "#N/A", "1.#QNAN", "-1.#IND", "1\x0b", "1\x00", "\x1b[31m1", "x"]
GAPS = [" ", "  ", "\t", ",", ", ", '","', ";", " ; ", ",,", ";;", "\x0b", "\x0c", "\u00a0", "|", ":", "\x00", "#"]
REMARKS = ["#", "\n#\n", "# 1 2 3\n", "\n\n\n", "x y z\n", "\n ,\n", "! 1\n", "// 1\n", '"', "%"]
# Of heads of binary files.
HEAD_WORDS = [b"0", b"-1", b"-4", b"1", b"3", b"8193", b"65536", b"4294967296", b"99999999999999999999", b"1e9",
              b"1e999", b"nan", b"inf", b"4.5", b"'<f8'", b"'<i8'", b"'|O'", b"'<f16'", b"True", b"()", b"(4,)", b"(2, 2, 4)",
              b"{}", b"XRes", b"ZUnits", b"m", b"px", b"V", b"\xb5m", b"\x00"]
# NaN, quiet and signalling, infinities, the least and the largest, in both byte orders.
ODD_NUMBERS = [bytes.fromhex(word) for word in ("0000c07f", "0100807f", "0000807f", "000080ff", "01000000", "ffff7f7f",
                                                "7fc00000", "7f800001", "7ff00000", "0000f07f")]
LINE_ENDS = ["\r\n", "\r", "\n\n", "\n \n", "\n# remark\n", "\x0b\n", "\x85", "\u2028", ""]


def matrix(stream, columns, rows, gap=" "):
    """Heights, a row a line."""
    return "".join(gap.join(f"{stream.uniform(-1, 1):.6g}" for _ in range(columns)) + "\n" for _ in range(rows))


def points(stream, m, n, digits=6):
    """x, y and z, x or y running first, rising or falling, with or without empty lines."""
    sign, first, blocks = stream.choice((1, -1)), stream.random() < 0.5, stream.random() < 0.5
    step = stream.choice((1.0, 0.1, 1/3, 1e-6, 1e6))
    text = ""
    for j in range(n):
        for i in range(m):
            x, y = f"{sign*i*step:.{digits}e}", f"{3 + 2*j*step:.{digits}e}"
            text += f"{x if first else y} {y if first else x} {stream.uniform(-1, 1):.6g}\n"
        text += "\n" if blocks else ""
    return text


def fine_map(stream):
    """A map as an instrument may write it."""
    m, n = stream.choice(((4, 4), (5, 7), (8, 8), (9, 1), (13, 4), (16, 5), (31, 1)))
    if n > 1 and stream.random() < 0.5:
        return points(stream, m, n)
    return matrix(stream, m, n, stream.choice((" ", " ", "\t", ",", ";", ", ")))


def cells(text):
    return [line.split() for line in text.split("\n")]


def joined(rows):
    return "\n".join(" ".join(row) for row in rows)


def mutate_number(stream, text):
    """One number replaced."""
    places = list(re.finditer(r"[^\s,;]+", text))
    if not places:
        return stream.choice(NUMBERS)
    place = stream.choice(places)
    return text[:place.start()] + stream.choice(NUMBERS) + text[place.end():]


def mutate_column(stream, text):
    """A column removed, doubled or inserted."""
    rows = cells(text)
    column = stream.randrange(max(len(row) for row in rows) + 1)
    action, number = stream.randrange(3), stream.choice(NUMBERS)
    for row in rows:
        if not row:
            continue
        if action == 0:
            del row[column:column + 1]
        elif action == 1:
            row[column:column] = row[column:column + 1]
        else:
            row[column:column] = [number]
    return joined(rows)


def mutate_lines(stream, text):
    """Lines removed, doubled, swapped, sorted, reversed or cut short."""
    lines = text.split("\n")
    i, j = stream.randrange(len(lines)), stream.randrange(len(lines))
    action = stream.randrange(8)
    if action == 0:
        del lines[i:i + stream.randint(1, 4)]
    elif action == 1:
        lines[i:i] = lines[i:i + 1]*stream.randint(1, 4)
    elif action == 2:
        lines[i], lines[j] = lines[j], lines[i]
    elif action == 3:
        lines.sort()
    elif action == 4:
        stream.shuffle(lines)
    elif action == 5:
        lines.reverse()
    elif action == 6:
        lines = lines*stream.randint(2, 5)
    else:
        return text[:stream.randrange(len(text) + 1)]
    return "\n".join(lines)


def mutate_gaps(stream, text):
    """Other separators between numbers."""
    gap = stream.choice(GAPS)
    return re.sub(r"[ \t,;]+", lambda _: gap, text)


def mutate_words(stream, text):
    """Numbers and gaps removed, doubled or swapped, and numbers, gaps and remarks inserted."""
    return mutate_tokens(stream, text, stream.choice((NUMBERS, GAPS, REMARKS)))


def mutate_decimals(stream, text):
    """Decimal commas, and exponents as Fortran writes them."""
    return text.replace(*stream.choice(((".", ","), ("e", "d"), ("e", "D"), ("-", "−"), (".", ""))))


def mutate_steps(stream, text):
    """A column squared, scaled or shifted: coordinates that are not equidistant."""
    rows = cells(text)
    column, size = stream.randrange(3), 10.0**stream.choice((-100, -9, -3, -1, 3, 9, 100))
    action = stream.randrange(3)
    for row in rows:
        try:
            value = float(row[column])
        except (IndexError, ValueError):
            continue
        row[column] = repr((value*abs(value), value*size, value + size)[action])
    return joined(rows)


MUTATIONS = (mutate_number, mutate_number, mutate_number, mutate_words, mutate_words, mutate_words, mutate_column,
             mutate_lines, mutate_lines, mutate_gaps, mutate_decimals, mutate_steps)


def mutated(stream, gently=False):
    """A map after one mutation or several."""
    text = fine_map(stream)
    for _ in range(stream.choice((0, 0, 1, 1, 2)) if gently else stream.choice((1, 1, 1, 2, 3, 6))):
        text = stream.choice(MUTATIONS)(stream, text) or "\n"
    if stream.random() < 0.1:
        text = text.replace("\n", stream.choice(LINE_ENDS))
    if stream.random() < 0.1:
        text = text.rstrip("\n")
    content = text.encode("utf-16", "surrogatepass") if stream.random() < 0.02 else as_bytes(text)
    if stream.random() < 0.05:
        content = b"\xef\xbb\xbf" + content
    if stream.random() < (0.05 if gently else 0.25):
        content = mutate_bytes(stream, content)
    return content


def deck(stream, name="heights.dat"):
    """A deck for a map."""
    scale = stream.choice(("", "", ", height_scale = 1e-9", ", height_scale = 1e85", ", height_scale = 1e-85"))
    form = stream.choice(("", "", ", file_format = 'matrix'", ", file_format = 'xyz'"))
    form += stream.choice(("", "", "", ", missing_value = 1"))
    length = ", length_x = 2" if "matrix" in form else ""   # refused beside coordinates
    prepared = stream.choice(("", "", ", edges = 'mirror'", ", detrend = 'mean'"))   # which the second reader need not know
    return (f"&surface kind = 'file', file = '{name}'{form}{scale}{length}{prepared} /\n"
            f"&load pbar_over_pstar = 0.05, 0.7, 1.2 /\n&output lines = t, line_points = 8 /\n")


def second_reading(content, form):
    """Points along x and y, lowest and highest height over their mean and rms of a map, None if it is no map to this
    reader, which is more lenient than the program."""
    text = content.decode(errors="replace").removeprefix("\ufeff").replace('"', " ")
    lines = [line.split("#")[0].strip(" \t,;") for line in re.split("\r\n|\r|\n", text)]
    # Between semicolons or tabs a comma is decimal.
    lines = [re.split(r"[ \t;]+", line.replace(",", ".")) if re.search("[;\t]", line) else re.split(r"[ ,]+", line)
             for line in lines]
    try:
        rows = [[float(word.lower().replace("d", "e")) for word in line] for line in lines if line != [""]]
    except ValueError:
        return None
    if not rows or len({len(row) for row in rows}) > 1:
        return None
    if any(not abs(value) <= LARGEST for row in rows for value in row):
        return None
    shape = len(rows[0]), len(rows)
    if form == "xyz":
        # In any order, and complete: the program fills no holes unasked.
        if len(rows[0]) != 3:
            return None
        shape = tuple(distinct([row[k] for row in rows]) for k in (0, 1))
        rows = [[row[2]] for row in rows]
    heights = [value for row in rows for value in row]
    mean = sum(heights)/len(heights)
    over = [value - mean for value in heights]
    return shape, min(over), max(over), (sum(value*value for value in over)/len(over))**0.5


def distinct(coordinates):
    """The number of coordinates that differ by more than rounding."""
    coordinates = sorted(coordinates)
    gaps = [after - before for before, after in zip(coordinates, coordinates[1:])]
    return 1 + sum(gap > 0.02*max(gaps) for gap in gaps)


def shape_words(columns, lines):
    return f"map: points_x[-] = {columns}, points_y[-] = {lines},"


def reading_complaints(outcome, content, text):
    """What is wrong with the log of an accepted map: its numbers must be those of a second reader."""
    match = re.search(r"^map: points_x\[-\] = (\d+), points_y\[-\] = (\d+), lowest\S* = ([^,]+), highest\S* = ([^,]+), "
                      r"rms_height\S* = ([^,]+), format = (\w+)",
                      outcome.stdout.decode(errors="replace"), re.MULTILINE)
    if not match:
        return ["the log does not name the map"]
    found = second_reading(content, match.group(6))
    if not found:
        return ["a second reader finds no map here"]
    scale = re.search(r"height_scale = ([\d.e-]+)", text)
    scale = float(scale.group(1)) if scale else 1.0
    points = int(match.group(1)), int(match.group(2))
    # A column is a profile.
    if points != found[0] and (points[1] != 1 or points[::-1] != found[0]):
        return [f"a second reader finds {found[0][0]} x {found[0][1]} points"]
    size = scale*max(abs(found[1]), abs(found[2]))
    for word, value in zip(match.groups()[2:5], found[1:]):
        if abs(float(word) - scale*value) > LOG_TOLERANCE*size:
            return [f"the log says {word}, a second reader {scale*value:.6g}"]
    return []


def message_complaints(outcome, content=b""):
    """What is said of a map that is refused names it, or the deck, and the line where the trouble is in one."""
    if outcome.status not in (1, 3):
        return []
    words = outcome.stderr.decode(errors="replace").splitlines()
    if words and re.match(r"deck\.nml:\d+:\d+: error 1 of", words[0]):
        return []
    line = words[0] if len(words) == 1 else ""
    match = re.fullmatch(r"([^:]*)(?::(\d+))?: (.+) \(the height map of deck\.nml\)", line)
    if not match:
        return [f"no map is named: {' '.join(words)[:80]}"]
    if match.group(2) is None and not WITHOUT_LINE.match(match.group(3)):
        return [f"no line is named: {words[0][:80]}"]
    if match.group(2) is not None and not 1 <= int(match.group(2)) <= 1 + content.count(b"\n") + content.count(b"\r"):
        return [f"there is no line {match.group(2)}"]
    return []


def fuzz_checks(settings, work, count=None):
    """Mutated maps with --check."""
    def cases():
        for name, stream, _ in settings.cases("map-check", ("text",), count or settings.amount(3000, 60)):
            content, text = mutated(stream), deck(stream)
            yield (name, {"deck.nml": text, "heights.dat": content}, (),
                   functools.partial(message_complaints, content=content))

    return check_all(settings.part("mutated height maps, --check"), settings.program, cases(), work)


def npy_file(stream, columns, rows):
    """A file of numpy."""
    order, letter = stream.choice("<>"), stream.choice("fd")
    words = (f"{{'descr': '{order}f{struct.calcsize(letter)}', 'fortran_order': {stream.choice((True, False))}, "
             f"'shape': ({rows}, {columns}), }}").encode()
    version = stream.choice((1, 1, 2, 3))
    words += b" "*stream.randrange(64) + b"\n"
    head = b"\x93NUMPY" + bytes((version, 0)) + struct.pack("<H" if version == 1 else "<I", len(words)) + words
    return head, struct.pack(f"{order}{columns*rows}{letter}", *(stream.uniform(-1, 1) for _ in range(columns*rows)))


def gsf_file(stream, columns, rows):
    """A file of Gwyddion."""
    lines = [f"XRes = {columns}", f"YRes = {rows}"] + stream.sample(
        ["XReal = 1e-3", "YReal = 0.5e-3", "XYUnits = m", "ZUnits = m", "ZUnits = nm", "Title = a = b", "Colour = 7"],
        stream.randrange(6))
    stream.shuffle(lines)
    head = "".join(line + "\n" for line in ["Gwyddion Simple Field 1.0", *lines]).encode()
    head += b"\0"*(4 - len(head) % 4)
    return head, struct.pack(f"<{columns*rows}f", *(stream.uniform(-1, 1) for _ in range(columns*rows)))


def mutate_head(stream, head):
    """A number or a word of a head replaced, bytes changed, or the head cut."""
    action = stream.randrange(6)
    if action == 0:
        return head[:stream.randrange(len(head) + 1)]
    if action == 1:
        return mutate_bytes(stream, head)
    if action == 2:
        return head.replace(b"\n", stream.choice((b"", b"\r\n", b"\0", b"\n\n")))
    places = list(re.finditer(rb"-?\d+(\.\d+)?(e-?\d+)?|[A-Za-z]+|'[^']*'", head))
    if not places:
        return mutate_bytes(stream, head)
    place = stream.choice(places)
    word = stream.choice(HEAD_WORDS + [place.group()*2, b""])
    return head[:place.start()] + word + head[place.end():]


def binary_case(stream):
    """Name, content and deck of a binary map, and what its log must say if nothing of it was changed, else None."""
    make, ending = stream.choice(((npy_file, "npy"), (gsf_file, "gsf")))
    columns, lines = stream.choice(((4, 4), (5, 7), (16, 9), (31, 1)))
    head, numbers = make(stream, columns, lines)
    is_good = stream.random() < 0.1
    if not is_good:
        head = mutate_head(stream, head) if stream.random() < 0.7 else head
        if stream.random() < 0.3:
            numbers = mutate_bytes(stream, numbers)
        if stream.random() < 0.3:
            numbers = stream.choice((numbers[:stream.randrange(len(numbers))], numbers*2, numbers + b"\n", b""))
        if stream.random() < 0.2:
            place = 4*stream.randrange(len(numbers)//4 + 1)
            numbers = numbers[:place] + stream.choice(ODD_NUMBERS) + numbers[place + 4:]
    name = f"heights.{stream.choice((ending, ending, 'dat'))}"
    form = stream.choice(("", "", "", *(f", file_format = '{word}'" for word in ("npy", "gsf"))))
    text = f"&surface kind = 'file', file = '{name}'{'' if is_good else form} /\n&load pbar_over_pstar = 0.05 /\n"
    return name, head + numbers, text, shape_words(columns, lines).encode() if is_good else None


def binary_complaints(outcome, name, words):
    # A cell that is too long is a mistake of the deck, which names the map.
    unlike = b": error 1 of 1: the cell is " in outcome.stderr and f"sides in {name} in".encode() in outcome.stderr
    complaints = []
    if outcome.status in (1, 3) and not unlike and not outcome.stderr.startswith(name.encode() + b":"):
        complaints.append(f"no map is named: {outcome.stderr.decode(errors='replace')[:80]}")
    if words and not unlike and (outcome.status != 0 or words not in outcome.stdout):
        complaints.append("a good map is not read as it is")
    return complaints


def fuzz_binary(settings, work, count=None):
    """Binary maps with mutated heads, numbers and lengths, with --check and limits of memory."""
    def cases():
        for case, stream, _ in settings.cases("map-check", ("binary",), count or settings.amount(3000, 60)):
            name, content, text, words = binary_case(stream)
            yield (case, {"deck.nml": text, name: content}, (),
                   functools.partial(binary_complaints, name=name, words=words))

    part = settings.part("mutated binary height maps, --check")
    return check_all(part, settings.program, cases(), work,
                     memory_limits(settings.program, part, BINARY_ADDRESS_SPACE))


def fuzz_runs(settings, work, count=None):
    """Solves mildly mutated maps; the resolved deck must give the same summary."""
    part = settings.part("mutated height maps, run")
    slowest, unsolved, refused = 0.0, 0, 0
    count = count or settings.amount(500, 20)
    for name, stream, _ in settings.cases("map-run", ("text",), 100*count):
        if part.tried == count:
            break
        content, text = mutated(stream, gently=True), deck(stream)
        if len(content) > 20*MOST_POINTS:
            continue
        files = {"deck.nml": text, "heights.dat": content}
        write(files, work)
        checked = run([settings.program, "--check", "deck.nml"], work)
        if checked.status != 0 and stream.random() < 0.9:
            continue
        outcome = run([settings.program, "deck.nml"], work)
        complaints = complaints_about(outcome) + message_complaints(outcome, content)
        if checked.status != outcome.status and {checked.status, outcome.status} != {0, 2}:
            complaints.append(f"--check ends with status {checked.status}, the run with {outcome.status}")
        made = files_below(work) - set(files)
        if outcome.status in (1, 3) and made:
            complaints.append(f"refused, but makes {sorted(made)[0]}")
        complaints += result_complaints(work, made)
        if outcome.status in (0, 2):
            complaints += reading_complaints(outcome, content, text)
            again = run([settings.program, "outputs/deck/deck.resolved.nml", "--output", "again"], work)
            if again.status != outcome.status:
                complaints.append(f"the resolved deck ends with status {again.status}")
            elif stripped(work/"again"/"deck.summary.dat") != stripped(work/"outputs"/"deck"/"deck.summary.dat"):
                complaints.append("the resolved deck gives another summary")
        unsolved += outcome.status == 2
        refused += outcome.status in (1, 3)
        slowest = max(slowest, outcome.seconds)
        part.count(name, complaints, files)
    part.worst = f"{refused} refused, {unsolved} with status 2, {slowest:.2f} s"
    return part


def monsters(stream, size):
    """Maps of some size, each large in another way, and the status they must have; None if either."""
    row = matrix(stream, 64, 1).encode()
    square = matrix(stream, 32, 32).encode()
    yield "one long row", b"1 2 "*(size//4), None
    yield "one long column", b"1\n2\n"*(size//4), None
    yield "long rows", (b"0.5 -1 "*(4096) + b"\n")*max(4, size//28673), None
    yield "many rows", row*(size//len(row)), None
    yield "remarks", b"# remark\n"*(size//9) + square, 0
    yield "a long remark", b"#" + b"x"*size + b"\n" + square, 0
    yield "blanks", b" "*size + square, 0
    yield "lines", b"\n"*size + square, 0
    yield "carriage returns", b"\r"*size + square, 0
    yield "commas", b","*size + square, 1
    yield "commas in lines", b",\n"*(size//2) + square, 0
    yield "long number", b"1"*size + square, 1
    yield "long fraction", b"0." + b"3"*size + square, 1
    yield "long exponent", b"1e" + b"9"*size + square, 1
    yield "long word", b"x"*size, 1
    yield "ragged", b"1 2 3 4\n1 2 3\n"*(size//14), 1
    yield "one bad number at the end", b"1 2 3 4\n"*(size//8) + b"1 2 x 4\n", 1
    yield "the same point", b"0 0 1\n"*(size//6), 1
    yield "points on a line", b"".join(b"%d 0 1\n" % i for i in range(size//8)), None
    yield "decimal commas", b"1,5 2,5\n"*(size//8), 1
    yield "nulls", b"\x00"*size, 1
    yield "noise", bytes(stream.randrange(256) for _ in range(min(size, MEGABYTE)))*max(1, size//MEGABYTE), 1
    yield "program", open(sys.executable, "rb").read(size), 1
    yield "two bytes a character", square.decode().encode("utf-16")*(size//(2*len(square))), 1


def fuzz_monsters(settings, work):
    """Large maps with --check, with limits of memory and time."""
    size = settings.amount(10*MEGABYTE, MEGABYTE//10)
    part = settings.part(f"height maps of {size/MEGABYTE:g} MB, --check")
    limits = memory_limits(settings.program, part, ADDRESS_SPACE)
    deck_of_all = {"deck.nml": "&surface kind = 'file', file = 'heights.dat' /\n&load pbar_over_pstar = 0.5 /\n"}

    def check(name, content, status, seconds=SECONDS, limits=limits):
        files = dict(deck_of_all, **{"heights.dat": content})
        write(files, work)
        if name == "a file of 3 GB":
            os.truncate(work/"heights.dat", 3000*MEGABYTE)  # sparse
        outcome = run([settings.program, "--check", "deck.nml"], work, patience=2*LARGE_SECONDS, limits=limits)
        complaints = complaints_about(outcome, (0, 1, 3) if status is None else (status,), seconds)
        if len(outcome.stderr) > 1000:
            complaints.append(f"says {len(outcome.stderr)} bytes")
        complaints += message_complaints(outcome, b"\n"*size)
        part.limit("time of one [s]", outcome.seconds, LARGE_SECONDS, [], "")
        part.count(name, complaints, files)

    for name, content, status in monsters(random.Random(f"{settings.seed} large maps"), size):
        check(name, content, status)
    # A valid map of ten times the size.
    large = (b"0.125 -3.5e-3 "*1024 + b"\n")*max(4, 10*size//14337)
    check("a map of ten times the size", large, 0, LARGE_SECONDS)
    if not settings.quick and limits:
        # The lower limits are too small for the map.
        for bound in range(80, 300, 20):
            check(f"a map of ten times the size in {bound} MB", large, None, LARGE_SECONDS,
                  [(resource.RLIMIT_AS, bound*MEGABYTE)])
    check("a file of 3 GB", b"", 1)
    return part


def odd_files(settings, work):
    """What is no map, and maps of odd sizes: the status and the words that each must give. There is more of what is no
    map in tests/unit/test_map_file.pf."""
    part = settings.part("odd height maps")
    good = matrix(random.Random("odd"), 8, 8)

    def attempt(name, content, status, words, map_name="heights.dat", make=None):
        text = (f"&surface kind = 'file', file = '{map_name.replace(chr(39), chr(39)*2)}' /\n"
                f"&load pbar_over_pstar = 0.1, 0.6 /\n&output map = t, map_points = 8 /\n")
        files = {"deck.nml": text, **({} if content is None else {map_name: content})}
        write(files, work)
        if make:
            make(work/map_name)
        before = files_below(work)
        outcome = run([settings.program, "deck.nml"], work)
        complaints = complaints_about(outcome, (status,)) + message_complaints(outcome, as_bytes(content or text))
        if words not in (outcome.stdout + outcome.stderr).decode(errors="replace"):
            complaints.append(f"does not say '{words}'")
        complaints += result_complaints(work, files_below(work) - before)
        part.count(name, complaints, files)

    attempt("1048577 columns", "1 "*1048577 + "\n", 1, "a map of 1048577 x 1 points")
    attempt("two bytes, no mark", good.encode("utf-16-le"), 1, "heights.dat: this is no text")
    attempt("the deck itself", None, 1, "deck.nml: there are no numbers in this file", "deck.nml")
    attempt("a program", open(sys.executable, "rb").read(100000), 1, "heights.dat: this is no text")
    attempt("points without a grid", "".join(f"{i*i} {i} 1\n" for i in range(9)), 1,
            "the grid of these points has 65 x")
    attempt("too small", "1e-200 2e-200 1e-200 0\n", 1, "times height_scale, are up to 1e-200 [length]")
    for height in ("0", "0.1", "-1e90", "1e-90", "4.9e-324"):
        for side in (4, 7, 11, 16):
            attempt(f"flat {height} {side}", (" ".join([height]*side) + "\n")*side, 1, "the surface is flat")
    for columns, lines in ((5, 5), (7, 11), (13, 4), (16, 16), (17, 31), (61, 1), (64, 4), (101, 5)):
        stream = random.Random(columns)
        attempt(f"{columns} x {lines}", matrix(stream, columns, lines), 0, shape_words(columns, lines))
        if lines > 1:
            attempt(f"{columns} x {lines} points", points(stream, columns, lines), 0, "format = xyz")
    for name, words, make in (("a directory", "this is a directory", lambda path: path.mkdir()),
                              ("a pipe", "this is a pipe or a device", os.mkfifo),
                              ("a link to itself", "cannot be opened: ", lambda path: path.symlink_to(path.name)),
                              ("a link to nothing", "there is no such file", lambda path: path.symlink_to("nothing"))):
        attempt(name, None, 3, words, make=make)
    for name, words in (("/dev/zero", "this is a pipe or a device"), ("/dev/full", "this is a pipe or a device"),
                        ("/dev/tty", "this is a pipe or a device"), ("deck.nml/map.dat", "there is no such file"),
                        ("x"*900, "cannot be opened: ")):
        attempt(name[:20].replace("/", "-"), None, 3, words, map_name=name)
    for name in ("it's", 'a "map"', "a map", "$(touch CANARY)", "ä€𝄞", "-rf", "a\\nb", "100%s"):
        attempt(f"name {name}", good, 0, shape_words(8, 8), map_name=name)
    return part
