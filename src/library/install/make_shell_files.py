"""Writes what shells know of the program: a page for man, and the completion of its command line by bash and zsh.

usage: make_shell_files.py PROGRAM DATE FOLDER

PROGRAM: wavycon, whose --help has all options, groups and keys. DATE: of the release, for the page. FOLDER: where
wavycon.1, wavycon.bash and _wavycon are written. Needs nothing but Python.
"""
import re
import subprocess
import sys
from pathlib import Path

# Longest line of --help: widest_line of key_reference.f90.
WIDEST = 100
OPTION = re.compile(r"   (?P<name>--[\w-]+)(?P<short>, -\w)?( (?P<unit>[A-Z]\S*))?(?=\s|$)")
KEY = re.compile(r"   (?P<name>\w+)")

PAGE = r""".TH WAVYCON 1 {date} "{version}" "User Commands"
.SH NAME
wavycon \- elastic contact of wavy and rough surfaces
.SH SYNOPSIS
.B wavycon
{synopsis}
.SH DESCRIPTION
{what}
.PP
{notes}
.SH OPTIONS
{options}
.SH DECKS
{decks}
{groups}
"""

BASH = r"""# Completion of wavycon's command line by bash, made from `wavycon --help`.
_wavycon() {{
   local line=${{COMP_LINE:0:COMP_POINT}} word before words='' list
   word=${{line##*[[:blank:]]}}
   before=${{line%"$word"}}
   before=${{before%"${{before##*[![:blank:]]}}"}}
   before=${{before##*[[:blank:]]}}
   if [[ $word == --*=* ]]; then
      before=${{word%%=*}}
      word=${{word#*=}}
   fi
   COMPREPLY=()
   case $before in
      {settings})
         if [[ $word != *=* ]]; then
            compopt -o nospace 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -S = -W '{keys}' -- "$word")
            return
         fi
         case ${{word%%=*}} in
{values}
         esac
         word=${{word#*=}}
         list=${{word%"${{word##*,}}"}}
         mapfile -t COMPREPLY < <(compgen -P "$list" -W "$words" -- "${{word##*,}}")
         return ;;
      {folders}) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
      {files}) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
      {numbers}) ;;
      --help) mapfile -t COMPREPLY < <(compgen -W '{group_names}' -- "$word") ;;
      *)
         if [[ $word == -* ]]; then
            mapfile -t COMPREPLY < <(compgen -W '{options}' -- "$word")
         else
            mapfile -t COMPREPLY < <(compgen -f -X '!*.nml' -- "$word"; compgen -d -- "$word")
         fi ;;
   esac
   # So that a directory gets a slash.
   compopt -o filenames 2>/dev/null
}}
complete -F _wavycon wavycon
"""

ZSH = r"""#compdef wavycon
# Completion of wavycon's command line by zsh, made from `wavycon --help`.
_wavycon_setting() {{
   local -a choices
   if ! compset -P 1 '*='; then
      compadd -S = -- {keys}
      return
   fi
   case ${{${{IPREFIX%=}}##*=}} in
{values}
   esac
   compset -P '*,'
   compadd -- $choices
}}
_wavycon_deck() {{
   if (( ${{words[(I)--help]}} )); then
      compadd -- {group_names}
   else
      _files -g '*.nml(-.)'
   fi
}}
_arguments \
{arguments} \
   '*:DECK:_wavycon_deck'
"""


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
    names = match.groupdict()
    head = ", ".join(rf"\fB{roff(name)}\fR" for name in (names["name"], (names.get("short") or "").strip(", ")) if name)
    unit = rf" \fI{roff(names['unit'])}\fR" if names.get("unit") else ""
    return f".TP\n{head}{unit}\n" + "\n.br\n".join(map(roff, body))


def choices(body):
    """The words that a key takes; none for numbers and texts."""
    words = re.match(r"'\w+'(?:(?:, | or )'\w+')*|\.true\. or \.false\.", body[0])
    return re.findall(r"\.?\b(?!or\b)\w+\.?", words[0]) if words else []


def brief(body):
    """The first clause of a meaning, for zsh."""
    return re.sub(r"([][:\\])", r"\\\1", re.split(r"[;,:.] ", body[0])[0].replace("'", ""))


def cases(values, begin, set_words, indent):
    """The words of each key that has some, as cases of a shell."""
    return "\n".join(f"{' '*indent}{begin}{key}) {set_words.format(' '.join(words))} ;;"
                     for key, words in values.items() if words)


def main():
    program, date, folder = sys.argv[1:]
    version, text = (subprocess.run([program, option], stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout
                     for option in ("--version", "--help"))
    text, *groups = text.split("\n\n&")
    what, usage, options, *notes = text.split("\n\n")
    options = entries(options.splitlines(), OPTION)
    page, values = [], {}
    for group in groups:
        name, meaning = group.partition("\n   ")[0].split(None, 1)
        own = entries(group.splitlines(), KEY)
        page += [f".SS &{name}", roff(" ".join(meaning.split())), *(item(*key) for key in own)]
        values.update({f"{name}.{match['name']}": choices(body) for match, body in own})

    def takes(*units):
        """The options with a value of these units."""
        return [match["name"] for match, _ in options if any(re.match(unit, match["unit"] or "") for unit in units)]

    actions = {"GROUP": "_wavycon_setting", "DIR": "_files -/", "FILE": "_files"}
    arguments = []
    for match, body in options:
        name, unit = match["name"], match["unit"]
        again = "*" if f"[{name} {unit}]..." in " ".join(usage.split()) else ""
        value = f"=[{brief(body)}]:{unit}:{actions.get(unit.split('.')[0], ' ')}" if unit else f"[{brief(body)}]"
        arguments += [f"   '{again}{name}{value}'"] + [f"   '-h{value}'"]*bool(match["short"])
    names = {"keys": " ".join(values), "group_names": " ".join(group.split()[0] for group in groups),
             "options": " ".join(match["name"] for match, _ in options), "arguments": " \\\n".join(arguments)}
    *notes, decks = [roff(" ".join(note.split())) for note in notes]
    files = {
        "wavycon.1": PAGE.format(
            date=date, version=version.strip(), synopsis=roff(" ".join(usage.split()[2:])), what=roff(what.split(": ")[1].capitalize()),
            notes="\n.PP\n".join(notes), options="\n".join(item(*option) for option in options), decks=decks,
            groups="\n".join(page)),
        "wavycon.bash": BASH.format(
            settings=" | ".join(takes("GROUP")), folders=" | ".join(takes("DIR")), files=" | ".join(takes("FILE")),
            numbers=" | ".join(takes("N$")), values=cases(values, "", "words='{}'", 12), **names),
        "_wavycon": ZSH.format(values=cases(values, "*", "choices=({})", 6), **names)}
    for name, content in files.items():
        Path(folder, name).write_text(content, encoding="utf-8")


if __name__ == "__main__":
    main()
