"""Writes what shells know of the program: a page for man, and the completion of its command line by bash and zsh.

usage: make_shell_files.py PROGRAM DATE FOLDER

PROGRAM: wavycon, whose --help has all options, groups and keys. DATE: of the release, for the page. FOLDER: where
wavycon.1, wavycon.bash and _wavycon are written, from the files of these names and `.in` beside this one, in which
@WORD@ stands for what is made here. Needs nothing but Python.
"""
import re
import subprocess
import sys
from pathlib import Path

# Longest line of --help: widest_line of key_reference.f90.
WIDEST = 100
OPTION = re.compile(r"   (?P<name>--[\w-]+)(?P<short>, -\w)?( (?P<unit>[A-Z]\S*))?(?=\s|$)")
KEY = re.compile(r"   (?P<name>\w+)")


def paragraphs(lines):
    """The paragraphs of filled lines: one ends where the next word would have fitted."""
    whole, length = [], 0
    for line in lines:
        if whole and length + 1 + len(line.split()[0]) > WIDEST:
            whole[-1] += " " + line.strip()
        else:
            whole.append(line.strip())
        length = len(line)
    return [paragraph for paragraph in whole if paragraph]


def entries(lines, begin):
    """The options or keys of some lines: the match of each one's begin, and its paragraphs."""
    found = []
    for line in lines:
        match = begin.match(line)
        if match:
            found.append((match, []))
            line = " "*match.end() + line[match.end():]
        if found and line.strip():
            found[-1][1].append(line)
    return [(match, paragraphs(own)) for match, own in found]


def roff(text):
    """A text for man."""
    for letter, name in ("\\", "\\e"), ("-", "\\-"), ("'", "\\(aq"), ("^", "\\(ha"), ("~", "\\(ti"), ("`", "\\(ga"):
        text = text.replace(letter, name)
    return "\\&" + text if text.startswith(".") else text


def item(match, body):
    """An option or key with its paragraphs, for man."""
    names_in_bold = re.sub(r"--[\w-]+|-\w\b|^\w+", r"\\fB\g<0>\\fR", match[0].strip())
    return ".TP\n" + names_in_bold.replace("-", "\\-") + "\n" + "\n.br\n".join(map(roff, body))


def cases(values, case):
    """The words of each key that takes words, as cases of a shell."""
    return "\n".join(case.format(key, " ".join(words)) for key, words in values.items() if words)


def main():
    program, date, folder = sys.argv[1:]
    version, text = (subprocess.check_output([program, option], universal_newlines=True)
                     for option in ("--version", "--help"))
    text, *groups = text.split("\n\n&")
    what, usage, options, *notes = text.split("\n\n")
    options = entries(options.splitlines(), OPTION)
    page, values = [], {}
    for group in groups:
        name, meaning = group.partition("\n   ")[0].split(None, 1)
        own = entries(group.splitlines(), KEY)
        page += [f".SS &{name}", roff(" ".join(meaning.split())), *(item(*key) for key in own)]
        for match, body in own:
            words = re.match(r"'\w+'(?:(?:, | or )'\w+')*|\.true\. or \.false\.", body[0])
            values[f"{name}.{match['name']}"] = re.findall(r"\.?\b(?!or\b)\w+\.?", words[0]) if words else []
    # What the value of an option is, by the first word of its unit, for zsh; and the options with such a value.
    actions = {"GROUP": "_wavycon_setting", "DIR": "_files -/", "FILE": "_files", "N": " "}
    having = {unit: [] for unit in actions}
    arguments = []
    for match, body in options:
        name, unit = match["name"], match["unit"] or ""
        again = "*" if f"[{name} {unit}]..." in " ".join(usage.split()) else ""
        first_clause = re.split(r"[;,:.] ", body[0])[0].replace("'", "")
        if unit:
            having[unit.split(".")[0]].append(name)
            arguments.append(f"   '{again}{name}=[{first_clause}]:{unit}:{actions[unit.split('.')[0]]}'")
        else:
            arguments += [f"   '{one}[{first_clause}]'" for one in re.findall(r"-+[\w-]+", match[0])]
    *notes, decks = [roff(" ".join(note.split())) for note in notes]
    made = {
        "date": date, "version": version.strip(), "synopsis": roff(" ".join(usage.split()[2:])), "decks": decks,
        "what": roff(what.split(": ")[1].capitalize()), "notes": "\n.PP\n".join(notes), "groups": "\n".join(page),
        "options": "\n".join(item(*option) for option in options), "arguments": " \\\n".join(arguments),
        "option_names": " ".join(match["name"] for match, _ in options), "keys": " ".join(values),
        "group_names": " ".join(group.split()[0] for group in groups),
        "bash_values": cases(values, "            {}) words='{}' ;;"),
        "zsh_values": cases(values, "      *{}) choices=({}) ;;"),
        **{unit: " | ".join(names) for unit, names in having.items()}}
    for name in "wavycon.1", "wavycon.bash", "_wavycon":
        template = Path(__file__).with_name(name + ".in").read_text(encoding="utf-8")
        Path(folder, name).write_text(re.sub(r"@(\w+)@", lambda word: made[word[1]], template), encoding="utf-8")


if __name__ == "__main__":
    main()
