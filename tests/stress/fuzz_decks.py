"""Mutated decks: bytes, words, groups and sizes. Every run must end with a status and printable messages."""
import random
import re
import sys

from common import (SECONDS, as_bytes, check_all, complaints_about, files_below, memory_limits, result_complaints, run,
                    write)

MEGABYTE = 1000000
ADDRESS_SPACE = 4000*MEGABYTE  # of a run [byte]: a deck of 10 MB must not need more

# Every group and kind of value, with little work. The cases that are run start from these.
SMALL = [
    "&scene title = 'a title', case = 'deck' /\n&material e1 = 210e9, nu1 = 0.3, e2 = 70e9, nu2 = 0.33 /\n"
    "&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3 /\n&load pbar_over_pstar = 0.05, 2*0.2, 0.9 /\n"
    "&method solver = 'beale', harmonics = 4, constraint_points = 9, symmetry = 'diagonal', edge_level = 0.05 /\n"
    "&output directory = 'results', lines = t, map = .true., contours = T, coefficients = .t., theory = true,\n"
    "   spectrum = t, spots = t, histograms = T, histogram_bins = 20,\n"
    "   line_points = 8, map_points = 8, 10, map_format = 'npy' /\n",
    "&surface kind = 'wave_1d' / ! remark\n&load\n   sweep_from = 1.0 ! down\n   sweep_to = 1e-3\n   sweep_steps = 5\n/\n"
    "&method\n   solver = 'auto'\n/\n&output lines = .true., line_points = 16 /\n",
    "&surface kind = 'crossed_1d', amplitude1 = 1, wavelength1 = 2.0d0, amplitude2 = 1, wavelength2 = 2 /\n"
    "&load mean_pressure = 0, 0.5, 3 /\n&material e_star = 2.64 /\n&method solver = 'beale' /\n",
    "&SURFACE KIND = \"wave_2d\" /\n&LOAD PBAR_OVER_PSTAR = 1.0 1.5 0 /\n&METHOD SOLVER = 'series' /\n"
    "&Output Contours = F, Theory = .TRUE. /\n",
    "&surface kind = 'wave_1d', amplitude = 0 /\n&load pbar_over_pstar = 3*0.5 /\n&output map = .true., map_points = 8 /\n",
    "&surface kind = 'wave_1d', amplitude = 2 /\n&material e_star = 3 /\n&load pbar_over_pstar = -0.01, 0.3, 0.9 /\n"
    "&interface friction = 0.4, tangential_over_normal = 0.1, 0.2, nu = 0.3, shear_direction = 'y', slip_loop = .true.,\n"
    "   slip_map = .true., resistivity1 = 1, resistivity2 = 2, work_of_adhesion = 0.1 /\n&method solver = 'auto' /\n"
    "&output map_points = 8 /\n",
    "&surface kind = 'wave_2d' /\n&material e1 = 210, nu1 = 0.3, e2 = 70, nu2 = 0.2 /\n&load pbar_over_pstar = 0.3, 1 /\n"
    "&interface friction = 0.4, tangential_load = 0, 0.01, slip_map = .true. /\n"
    "&method solver = 'beale', harmonics = 4, constraint_points = 9 /\n&output map_points = 8, map_format = 'npy' /\n",
]
# Also the other surfaces and kinds of load. The cases of --check start from these.
LARGE = SMALL + [
    "&surface kind = 'file', file = 'heights.dat', detrend = 'plane', fill_missing = 'harmonic', edges = 'window',\n"
    "   window_width = 0.25 /\n&load pbar_over_pstar = 0.3 /\n",
    "&surface kind = 'sum', length_x = 2, length_y = 3, amplitudes = 1, 0.5, -0.25, waves_x = 1, 2, 0,\n"
    "   waves_y = 0, 1, -2, phases = 0, 90, -45 /\n&load contact_area_fraction = 0.1, 0.5 /\n"
    "&method solver = 'grid', grid_points = 32, 16 /\n",
    "&surface kind = 'hexagonal', amplitude = 1, wavelength = 1 /\n&load mean_gap_over_amplitude = 0.5, 0.1 /\n"
    "&method solver = 'grid', accuracy = 1e-2 /\n",
    "&surface kind = 'file', file = 'heights.dat', file_format = 'matrix', height_scale = 1e-9, length_x = 1e-3 /\n"
    "&load mean_gap = 1e-10 /\n&method grid_points = 8 /\n",
    "&surface kind = 'self_affine', length_x = 1, length_y = 2, hurst = 0.5, rms_slope = 0.1, long_wavelength = 1.5,\n"
    "   rolloff_wavelength = 0.5, short_wavelength = 0.2, spectrum = 'random', seed = 3, points = 12, 24 /\n"
    "&load pbar_over_pstar = 0.1 /\n&method grid_points = 16, 32 /\n",
    "&surface kind = 'ball', radius_x = 1, radius_y = 2 /\n&load force = 0.001, 0.1 /\n&method accuracy = 0.1 /\n",
    "&surface kind = 'ball', radius = 1 /\n&load force = -1e-4, 1e-3 /\n&interface work_of_adhesion = 1e-4 /\n",
    "&surface kind = 'wave_1d' /\n&load approach = -0.05, 0.4 /\n&interface work_of_adhesion = 0.1 /\n",
    "&surface kind = 'wave_2d' /\n&load mean_gap = 1.1, 0.3 /\n&interface work_of_adhesion = 0.1 /\n&method accuracy = 1e-2 /\n",
    "&surface kind = 'hexagonal' /\n&load contact_area_fraction = 0.2, 0.8 /\n&interface work_of_adhesion = 0.1 /\n"
    "&method solver = 'grid', accuracy = 1e-2 /\n",
    "&surface kind = 'ball', radius = 1, length_x = 0.5, points = 16 /\n&load approach = 0.01 /\n&material hardness = 0.1 /\n",
    "&surface kind = 'self_affine', rms_slope = 0.1, points = 16, short_wavelength = 0.3, edges = 'free',\n"
    "   form_radius = 3 /\n&load contact_area = 0.1 /\n&stress nu = 0.3, section = 'x' /\n",
]
HEIGHTS = "".join(" ".join(str((3*i*i + 5*j + i*j) % 7) for i in range(8)) + "\n" for j in range(8))

NUMBERS = ["0", "-0", "1", "-1", "+1", "1e-12", "1e12", "1e90", "1e91", "1e-90", "1e-91", "1e308", "1e309", "1e-400",
           "1e999", "-1e999", "nan", "NaN", "inf", "-Infinity", "1d0", "1.d-3", ".5", "5.", ".", "1e", "1e+", "1+3", "0x10", "1_8",
           "1,5", "1.0.0", "--1", "2147483647", "2147483648", "-2147483649", "9223372036854775808", "1e2147483648", "3*",
           "*3", "3*0.5", "0*1", "9999999*0.5", "99999999999*1", "1000000*1", "(1,2)", "1/2", "1e-320", "4.9e-324",
           "0." + "9"*80, "9"*101, "0."+"0"*300+"1", "1.0000000000000002", "0.99999999999999999", "½", "１"]
TEXTS = ["''", '""', "'", '"', "' '", "'wave_2d'", '"wave_1d"', "'it''s'", '"a""b"', "'a\"b'", "'x' 'y'", "'x''", "''x''",
         "'/'", "'&load'", "'!'", "'; touch CANARY'", "'$(touch CANARY)'", "'`touch CANARY`'", "'| touch CANARY'",
         "'a\nb'", "'a\tb'", "'a\x00b'", "'a\x1b[31mb'", "'../up'", "'/../up'", "'./.'", "'~'", "'a b'", "'-rf'", "'--help'",
         "'ä€𝄞'", "'\u202eabc'", "'\u00a0'", "'\x7f'", "'" + "x"*300 + "'", "'" + "é"*100 + "'", "'%s%n%d'", "'\\n'",
         "wave_2d", "'Grid'", "'auto '", "' auto'", "'auto'", "'none'", "'heights.dat'", "'.'", "'..'", "'/dev/full'", "'/dev/null'"]
LOGICALS = [".true.", ".false.", "t", "f", ".T.", "true", "1", "yes", ".true", ".tru e.", "'t'"]
SIGNS = ["/", "&", "=", ",", "'", '"', "!", "&end", "$load", "*", "(", ")", "%", ";", "\n", "\r", "\t", "\x00", "\ufeff",
         "&load", "//", "& load", ",,", "= =", "!&load"]
# What a mutated deck that is run must not change: the work would have no bound.
COSTLY = re.compile(r"harmonics|constraint_points|accuracy|sweep_steps|line_points|map_points|grid_points|solver"
                    r"|\d{3,}\s*\*|symmetry", re.IGNORECASE)


def tokens_of(text):
    """Words, signs and the blanks between them."""
    return re.findall(r"'[^'\n]*'|\"[^\"\n]*\"|&?\w[\w.+-]*|\s+|.", text, re.DOTALL)


def mutate_value(stream, text):
    """One value replaced."""
    tokens = tokens_of(text)
    places = [i for i, token in enumerate(tokens) if re.match(r"['\"\d.+-]", token) and token.strip()]
    if places:
        tokens[stream.choice(places)] = stream.choice(stream.choice((NUMBERS, NUMBERS, TEXTS, LOGICALS)))
    return "".join(tokens)


def mutate_key(stream, text):
    """One key replaced, misspelt or added."""
    keys = sorted(set(re.findall(r"(\w+)\s*=", "".join(LARGE))))
    places = list(re.finditer(r"(\w+)(\s*=)", text))
    if not places:
        return text
    place = stream.choice(places)
    key = place.group(1)
    new = stream.choice([stream.choice(keys), key.upper(), key[:-1], key + key, key + "(2)", key + "%x", "é" + key, "",
                         key[::-1], key + " = 1, " + stream.choice(keys)])
    return text[:place.start()] + new + place.group(2) + text[place.end():]


def mutate_tokens(stream, text, signs=SIGNS):
    """Words removed, doubled or swapped, or signs inserted."""
    tokens = tokens_of(text)
    for _ in range(stream.randint(1, 4)):
        i, j = stream.randrange(len(tokens)), stream.randrange(len(tokens))
        action = stream.randrange(4)
        if action == 0:
            tokens[i] = ""
        elif action == 1:
            tokens[i] += tokens[i]
        elif action == 2:
            tokens[i], tokens[j] = tokens[j], tokens[i]
        else:
            tokens.insert(i, stream.choice(signs))
    return "".join(tokens)


def mutate_structure(stream, text):
    """Groups doubled, reordered, removed, nested or cut short."""
    groups = re.split(r"(?=&)", text)
    action = stream.randrange(7)
    if action == 0:
        groups.append(stream.choice(groups))
    elif action == 1:
        stream.shuffle(groups)
    elif action == 2:
        del groups[stream.randrange(len(groups))]
    elif action == 3:
        groups = groups*stream.randint(2, 50)
    elif action == 4:
        return text.replace("/", "", stream.randint(1, 3))
    elif action == 5:
        return text[:stream.randrange(len(text))]
    else:
        return stream.choice(LARGE) + text
    return "".join(groups)


def mutate_nesting(stream, text):
    """Quotes in quotes in comments."""
    depth = stream.randint(1, 400)
    nest = "".join(stream.choice(["'", '"', "!", "''", '""', "\n", "&", "/", "a"]) for _ in range(depth))
    place = stream.randrange(len(text) + 1)
    return text[:place] + nest + text[place:]


def mutate_characters(stream, text):
    """Characters from all of Unicode."""
    for _ in range(stream.randint(1, 5)):
        place = stream.randrange(len(text) + 1)
        code = stream.choice([stream.randrange(32), stream.randrange(0x80, 0x250), stream.randrange(0x2000, 0x2070),
                              stream.randrange(0x1F600, 0x1F650), 0xFEFF, 0xFFFD, 0x10FFFF])
        text = text[:place] + chr(code) + text[place:]
    return text


def mutate_bytes(stream, content):
    """Bytes changed, inserted, removed or repeated."""
    content = bytearray(content)
    for _ in range(stream.choice((1, 1, 2, 5, 30))):
        place = stream.randrange(len(content) + 1)
        action = stream.randrange(5)
        if action == 0 and place < len(content):
            content[place] = stream.randrange(256)
        elif action == 1:
            content[place:place] = bytes([stream.randrange(256)])
        elif action == 2:
            del content[place:place + stream.randint(1, 8)]
        elif action == 3:
            content[place:place] = content[place:place + stream.randint(1, 40)]*stream.randint(1, 20)
        elif place < len(content):
            content[place] ^= 1 << stream.randrange(8)
    return bytes(content)


MUTATIONS = (mutate_value, mutate_value, mutate_value, mutate_key, mutate_tokens, mutate_tokens, mutate_structure,
             mutate_nesting, mutate_characters)


def mutated(stream, decks):
    """A deck after one to six mutations."""
    text = stream.choice(decks)
    for _ in range(stream.choice((1, 1, 1, 2, 3, 6))):
        text = stream.choice(MUTATIONS)(stream, text) or "\n"
    content = as_bytes(text)
    if stream.random() < 0.25:
        content = mutate_bytes(stream, content)
    if stream.random() < 0.1:
        content = content.replace(b"\n", stream.choice((b"\r\n", b"\r", b"\n\n", b"")))
    if stream.random() < 0.05:
        content = b"\xef\xbb\xbf" + content
    return content


def gently_mutated(stream):
    """A deck after mild mutations, most often still valid."""
    text = stream.choice(SMALL)
    values = re.findall(r"[=\s,]((?:\d+\*)?\d[\d.ed+-]*|\.?[tTfF]\w*\.?)(?=[\s,])", text)
    for _ in range(stream.randint(1, 3)):
        value = stream.choice(values)
        if value[0] in ".tTfF":
            new = stream.choice([".true.", ".false.", "T", "f"])
        else:
            new = stream.choice(["0", "1", "0.5", "2*0.3", "1e-12", "1e-9", "1e-5", "0.999999", "0.999999999999",
                                 "1.0000001", "1e6", "1e12", "1e-90", "1e90", f"{stream.random():.17g}", f"{10**stream.uniform(-12, 12):.6e}"])
        text = re.sub(r"(?<=[=\s,])" + re.escape(value) + r"(?=[\s,])", new, text, count=1)
    if stream.random() < 0.5:
        text = stream.choice((mutate_value, mutate_tokens, mutate_structure, mutate_characters))(stream, text)
    return text or "\n"


def monsters(stream, size):
    """Decks of some size, each large in another way."""
    good = LARGE[0].encode()
    load = b"&surface kind = 'wave_2d' /\n&load pbar_over_pstar = "
    yield "comment", good + b"!" + b"x"*size
    yield "comments", b"! remark\n"*(size//9) + good
    yield "blanks", b" "*size + good
    yield "lines", b"\n"*size + good
    yield "carriage returns", b"\r"*size + good
    yield "ampersands", b"&"*size
    yield "slashes", b"/"*size
    yield "equals", b"="*size
    yield "commas", load + b","*size + b" /"
    yield "single quotes", b"'"*size
    yield "double quotes", b'"'*size
    yield "quotes in turns", b"'\""*(size//2)
    yield "doubled quotes", b"&scene title = '" + b"''"*(size//2) + b"' /\n" + good
    yield "long text", b"&scene title = '" + b"x"*size + b"' /"
    yield "long key", b"&scene " + b"k"*size + b" = 1 /"
    yield "long group", b"&" + b"g"*size + b" /"
    yield "long number", load + b"1"*size + b" /"
    yield "long exponent", load + b"1e" + b"9"*size + b" /"
    yield "many keys", b"&scene" + b" k = 1"*(size//6) + b" /"
    yield "same key", b"&scene" + b" title = 'x'"*(size//12) + b" /"
    yield "many groups", b"&load /\n"*(size//8)
    yield "unknown groups", b"".join(b"&g%d /\n" % i for i in range(size//10))
    yield "many loads", load + b"0.5 "*100000 + b" /"
    yield "too many loads", load + b"0.5 "*(size//4) + b" /"
    yield "repeated loads", load + b"100000*0.5 /"
    yield "repeats of repeats", load + b"9999999*0.5 "*(size//12) + b" /"
    yield "bad loads", load + b"x "*(size//2) + b" /"
    yield "open quotes", b"&scene title = 'x\n"*(size//18)
    yield "nulls", b"\x00"*size
    yield "noise", bytes(stream.randrange(256) for _ in range(min(size, MEGABYTE)))*max(1, size//MEGABYTE)
    yield "program", open(sys.executable, "rb").read(size)
    yield "unicode", "𝄞é€".encode()*(size//9)


def fuzz_checks(settings, work, count=None):
    """Mutated decks with --check."""
    cases = ((name, {"deck.nml": mutated(stream, LARGE), "heights.dat": HEIGHTS}, (), message_complaints)
             for name, stream, _ in settings.cases("check", ("deck",), count or settings.amount(5000, 150)))
    return check_all(settings.part("mutated decks, --check"), settings.program, cases, work)


def message_complaints(outcome):
    """What is wrong with the message of a refused deck: the file, and line and column if there is one."""
    if outcome.status not in (1, 3) or not outcome.stderr:
        return []
    first = outcome.stderr.decode(errors="replace").splitlines()[0]
    if re.match(r"deck\.nml(:\d+:\d+|: --set .*)?: error 1 of (at least )?\d+: \S", first):
        return []
    if re.match(r"(wavycon: )?(deck\.nml|[^:]+)(:\d+)?: \S", first):
        return []
    return [f"no file is named: {first[:80]}"]


def random_setting(stream):
    """The word behind --set: most often a group, a key and a value that could be."""
    groups = [group for text in LARGE for group in re.findall(r"&(\w+)([^&]*)", text)]
    pairs = sorted({(group.lower(), key.lower()) for group, body in groups for key in re.findall(r"(\w+)\s*=", body)})
    group, key = stream.choice(pairs)
    if stream.random() < 0.2:
        group = stream.choice(["surface", "surfac", "LOAD", "&load", "x", ""])
    if stream.random() < 0.1:
        key = stream.choice([key[:-1], key.upper(), "x", "a b", ""])
    value = stream.choice(["1", "0.5", "2", "64", "1, 2", "auto", "grid", "hexagonal", "t", ""])
    if stream.random() < 0.5:
        value = stream.choice(stream.choice((NUMBERS, TEXTS, LOGICALS, [value + ",", "=", "/", "&load", "!", "a b"])))
    return (group + stream.choice("........ =") + key + stream.choice("========.") + value).replace("\x00", "")


def fuzz_settings(settings, work):
    """Decks with keys that the command line sets, with --check."""
    def cases():
        for name, stream, _ in settings.cases("set", ("deck",), settings.amount(3000, 100)):
            text = stream.choice(LARGE)
            words = [random_setting(stream) for _ in range(stream.choice((1, 1, 2, 4)))]
            yield (name, {"deck.nml": text, "heights.dat": HEIGHTS, "settings": "\n".join(words)},
                   [option for word in words for option in ("--set", word)], message_complaints)

    return check_all(settings.part("keys that are set, --check"), settings.program, cases(), work)


def fuzz_monsters(settings, work):
    """Large decks with --check, with limits of memory and time."""
    def judge(outcome):
        too_long = [f"says {len(outcome.stderr)} bytes"] if len(outcome.stderr) > MEGABYTE else []
        return message_complaints(outcome) + too_long

    size = settings.amount(10*MEGABYTE, MEGABYTE//10)
    part = settings.part(f"decks of {size/MEGABYTE:g} MB, --check")
    cases = ((f"monster-{name}", {"deck.nml": content}, (), judge)
             for name, content in monsters(random.Random(f"{settings.seed} monsters"), size))
    return check_all(part, settings.program, cases, work, memory_limits(settings.program, part, ADDRESS_SPACE))


def fuzz_runs(settings, work, count=None, seconds=SECONDS):
    """Runs mildly mutated decks that need little work, and checks their results."""
    part = settings.part("mutated decks, run")
    slowest, unsolved = 0.0, 0
    count = count or settings.amount(500, 30)
    for name, stream, _ in settings.cases("run", ("deck",), 100*count):
        if part.tried == count:
            break
        content = gently_mutated(stream)
        costly = [sorted(COSTLY.findall(text)) for text in (content, *SMALL)]
        if costly[0] not in costly[1:] and costly[0]:
            continue
        folder = work/"outer"/"inner"
        write({"outer/inner/deck.nml": content}, work)
        checked = run([settings.program, "--check", "deck.nml"], folder)
        if checked.status != 0 and stream.random() < 0.9:
            continue
        before = files_below(work)
        outcome = run([settings.program, "deck.nml"], folder)
        complaints = complaints_about(outcome, seconds=seconds)
        made = files_below(work) - before
        if checked.status == 0 and outcome.status == 1:
            complaints.append("--check found the deck fine, the run does not")
        if outcome.status == 1 and made:
            complaints.append(f"bad input, but makes {sorted(made)[0]}")
        match = re.search(rb"^results: (.*)/[^/]*$", outcome.stdout, re.MULTILINE)
        if match:
            place = (folder/match.group(1).decode()).resolve()
            strangers = [name for name in made if (work/name).resolve().parent != place]
            if strangers:
                complaints.append(f"makes {strangers[0]}, which is not in its output directory")
        complaints += result_complaints(work, made)
        unsolved += outcome.status == 2
        slowest = max(slowest, outcome.seconds)
        part.count(name, complaints, {"deck.nml": content})
    part.worst = f"{unsolved} with status 2, {slowest:.2f} s"
    return part
