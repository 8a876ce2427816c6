#!/usr/bin/env python3
"""Makes the site from the pages of the tree.

usage: make_site.py --program WAVYCON --package FOLDER --output FOLDER [--browser CHROMIUM]

Stages all pages in FOLDER/source, where they keep their places, generates the reference of keys and columns and the
pages of the interfaces beside them, runs Sphinx with every warning as an error, and checks the links of what it made in
FOLDER/html, that the pages load nothing from a network, and, if there is a browser, that it draws each formula.
The package is the folder that PYTHONPATH needs for `import wavycon`, such as build/python.
"""
import argparse
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = pathlib.Path("packaging/site")
KINDS = "type|class|integer|real|logical|character|complex"
# Chapters and their pages; the first is what a reader sees first.
CHAPTERS = {
    "Start": ["README.md", SITE/"tutorial.md", SITE/"guide.md"],
    "Using the program": ["inputs/README.md", "inputs/surfaces.md", "reference/keys.md", "outputs/README.md",
                          "reference/columns.md", "outputs/gallery/README.md"],
    "Python, C, Fortran": ["src/library/python/README.md", "src/library/python/example.md",
                           "src/library/python/certify.md", "reference/python.md", "src/library/README.md",
                           "reference/c.md", "reference/fortran.md"],
    "Theory": ["src/paper/README.md", "src/core/fitted/README.md", "src/core/contact/README.md",
               "src/core/half_space/README.md", "src/core/map/README.md", "src/core/surface/README.md",
               "src/core/measure/README.md", "src/core/stress/README.md", "src/core/qp/README.md",
               "src/beyond/README.md", "src/program/parallel/README.md"],
    "Evidence": ["tests/evidence.md"],
    "Development": ["CONTRIBUTING.md", "src/README.md", "src/base/README.md", "src/base/system/README.md",
                    "src/core/README.md", "src/program/README.md", "tests/README.md", "tests/support/README.md",
                    "packaging/README.md", "CHANGELOG.md", ".github/CODE_OF_CONDUCT.md", ".github/SECURITY.md"],
}


def stage(source):
    """Copies the pages, and the pictures and files that they link to. The start page is index.md."""
    for page in [page for pages in CHAPTERS.values() for page in map(pathlib.Path, pages) if (ROOT/page).exists()]:
        text = (ROOT/page).read_text(encoding="utf-8")
        for target in set(re.findall(r"\]\(([^)#\s:]+)(?:#[^)\s]*)?\)", text)):
            file = pathlib.Path(os.path.normpath(page.parent/target))
            if file == pathlib.Path("README.md"):
                text = re.sub(rf"\]\({re.escape(target)}(?=[#)])", f"]({target[:-len('README.md')]}index.md", text)
            elif file.suffix != ".md" and (ROOT/file).is_file():
                (source/file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT/file, source/file)
        write(source/(page if page != pathlib.Path("README.md") else "index.md"), text)
    for name in ("conf.py", "site.css"):
        (source/SITE).mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT/SITE/name, source/(name if name == "conf.py" else SITE/name))


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")


def contents():
    """The tables of contents, for the end of the start page."""
    text = ""
    for chapter, names in CHAPTERS.items():
        own = "\n".join(str(name)[:-3] for name in names if name != "README.md")
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {chapter}\n\n{own}\n```\n"
    return text


def plain(text):
    """Text without mark-up."""
    return re.sub(r"([\\`*_<>|$#\[\]])", r"\\\1", text)


def keys_page(program, keys):
    """All keys, as --help has them."""
    words = subprocess.run([program, "--help"], check=True, capture_output=True, text=True).stdout
    page = "# All keys of decks\n\nMade from `wavycon --help`. [Decks](../inputs/README.md) shows how to use them.\n"
    for group, known in keys.items():
        head, body = re.search(rf"^&{group} +(.*)\n((?:   .*\n)+)", words, re.MULTILINE).groups()
        page += f"\n## &{group}\n\n{plain(head[0].upper() + head[1:])}.\n\n| Key | Values | Meaning |\n|---|---|---|\n"
        entries = re.split(r"^   (\w+) ", body, flags=re.MULTILINE)[1:]
        if entries[::2] != list(known):
            raise SystemExit(f"--help and the library have different keys of &{group}")
        for name, entry in zip(entries[::2], entries[1::2]):
            # The meaning begins on a line of its own; --help breaks lines at hyphens, too.
            lines, meaning = entry.splitlines(), known[name]["meaning"]
            start = next(line for line in range(len(lines))
                         if "".join(lines[line:]).replace(" ", "") == meaning.replace(" ", ""))
            page += f"| `{name}` | {plain(' '.join(' '.join(lines[:start]).split()))} | {plain(meaning)} |\n"
    return page


def columns_page():
    """All columns by name, from the sections on tables, which a test compares with the program's own lists."""
    places = {}
    page = (ROOT/"outputs/README.md").read_text(encoding="utf-8")
    for title, text in re.findall(r"^## ([^\n]*)\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL):
        rows = "".join(re.findall(r"^\| Column.*\n\|-.*\n((?:\|.*\n)+)", text, re.MULTILINE))
        for names, unit in re.findall(r"^\| (`[^|]*?) \|([^|]*)\|", rows, re.MULTILINE):
            for name in re.findall(r"`(\w+)`", names):
                link = f"[{title}](../outputs/README.md#{title.lower().replace(' ', '-')})"
                places.setdefault((name, unit), []).append(link)
    rows = "".join(f"| `{name}` |{unit}| {', '.join(links)} |\n" for (name, unit), links in sorted(places.items()))
    return ("# All columns of tables\n\nThe links lead to their meaning.\n\n"
            f"| Column | Unit | Tables |\n|---|---|---|\n{rows}")


def python_page(package):
    """The names of the package by its docstrings."""
    # The function of kind 'sum' is wave_sum.
    kinds = ["wave_sum" if kind == "sum" else kind for kind in package.keys()["surface"]["kind"]["choices"]]
    others = [name for name in package.__all__ if name not in kinds]
    page = "# The Python package, name by name\n\n[wavycon in Python](../src/library/python/README.md) has examples.\n"
    for title, names in (("Functions and classes", others), ("Surfaces", kinds)):
        page += f"\n## {title}\n"
        for name in names:
            kind = "autoclass" if isinstance(getattr(package, name), type) else "autofunction"
            options = ":members:\n" if kind == "autoclass" else ""
            page += f"\n```{{eval-rst}}\n.. {kind}:: wavycon.{name}\n   " + options + "\n```\n"
    return page


def c_page():
    """The functions of wavycon.h: each with the comment above it."""
    text = (ROOT/"src/library/wavycon.h").read_text(encoding="utf-8")
    page = "# The C interface\n\nMade from `wavycon.h`. [The library](../src/library/README.md) has examples.\n"
    comments = re.split(r"^/\* (.*?) \*/\n", text[:text.rindex("#ifdef __cplusplus")], flags=re.MULTILINE | re.DOTALL)
    for comment, code in zip(comments[1::2], comments[2::2]):
        code = re.sub(r"^#.*\n|^extern .*\n", "", code, flags=re.MULTILINE).strip()
        name = re.search(r"\b(wavycon_\w+)\(|\(\*(wavycon_\w+)\)", code)
        page += f"\n## {name[1] or name[2]}\n" if name else ""
        page += f"\n```c\n{code}\n```\n\n{paragraphs(comment)}\n"
    return page


def paragraphs(comment):
    """The text of a comment; its `names` stay code."""
    parts = [plain(" ".join(part.split())) for part in re.split(r"\n\s*\n", comment)]
    return re.sub(r"\\`([^`]*)\\`", lambda code: "`" + code[1].replace("\\", "") + "`", "\n\n".join(parts))


def fortran_page():
    """What the module `wavycon` makes public: the comment and the declarations of each name."""
    umbrella = re.sub(r"&\n\s*", "", (ROOT/"src/library/wavycon.f90").read_text(encoding="utf-8"))
    files = {file.stem: file for file in (ROOT/"src").rglob("*.f90")}
    page = ("# The Fortran module\n\nWhat `use wavycon` makes public, by the file that has it. "
            "[The library](../src/library/README.md) has examples.\n")
    for module, names in re.findall(r"^ +use wavycon_(\w+)(?:, only: (.*))?$", umbrella, re.MULTILINE):
        if module not in files:
            continue
        text = files[module].read_text(encoding="utf-8")
        head = re.match(r"(?:!>.*\n)*", text)[0]
        page += f"\n## {module}\n\n{fortran_comment(head)}\n"
        constants = re.findall(r"(?:^ *!>.*\n)*^ *(?:integer|real).*, parameter, public ::.*\n", text, re.MULTILINE)
        page += fortran_code("".join(constants)) if constants and not names else ""
        for name in re.findall(r"\w+", names or " ".join(re.findall(r"^   public :: (.*)$", text, re.MULTILINE))):
            entry = fortran_entry(text, name, "###")
            page += entry if entry not in page else ""   # constants of one declaration stand together
    return page


def fortran_comment(lines):
    return paragraphs(re.sub(r"^ *!>", "", lines, flags=re.MULTILINE))


def fortran_code(lines):
    return f"\n```fortran\n{textwrap.dedent(lines)}```\n"


def fortran_entry(text, name, level, called=None):
    """A constant, a procedure with its arguments, or a type with its public components and procedures, below its
    comment. called: the name by which a type has the procedure; None for its own."""
    found = re.search(r"((?:^ *!>.*\n)*)(^ *(?:[\w()]+ )*"
                      rf"(?:function|subroutine|type(?:, [\w()]+)* ::) {name}\b(?:.*&\n)*.*\n)((?:.*\n)*?)"
                      r"^ *end (type|function|subroutine)", text, re.MULTILINE)
    if not found:
        constants = re.search(r"((?:^ *!>.*\n)*)(^ *[^\n!]*, parameter, public ::(?:[^\n]*&\n)*[^\n]*"
                              rf"\b{name}(?:\(\*\))? *=(?:.*&\n)*.*\n)", text, re.MULTILINE)
        if not constants:
            return ""
        names = ", ".join(re.findall(r"(\w+)(?:\(\*\))? = ", constants[2]))
        return f"\n{level} {names}\n\n{fortran_comment(constants[1])}\n" + fortran_code(constants[2])
    comment, head, body, kind = found.groups()
    shown, bound = "", []
    components, _, procedures = body.partition("   contains\n")
    if kind == "type":
        shown = "".join(line for line in components.splitlines(True) if "private" not in line)
        lists = re.findall(r"^ *procedure(?:\((\w+)\))?(?:, (?!private)\w+)* :: (.*)", procedures, re.MULTILINE)
        bound = [(end or start or first, first) for start, names in lists
                 for first, end in re.findall(r"(\w+)(?: => (\w+))?", names)]
    else:
        for line in body.splitlines(True):
            if re.match(rf"\s*(?:!|(?:{KINDS}|procedure)\b.*(?:intent|::))", line):
                shown += line
            elif (shown or line.strip()) and not re.match(r"\s*(?:use|implicit|import)\b", line):
                break
    page = f"\n{level} {called or name}\n\n{fortran_comment(comment)}\n" + fortran_code(head + shown)
    return page + "".join(fortran_entry(text, *one) for one in ((of, "####", name) for of, name in bound))


def faults_of(folder):
    """Links of the site that lead nowhere, and what it would load from a network."""
    texts = {file: file.read_text(encoding="utf-8") for file in folder.rglob("*.html")}
    anchors = {file: set(re.findall(r'\b(?:id|name)="([^"]+)"', text)) for file, text in texts.items()}
    faults = []
    for file, text in texts.items():
        for tag, target in re.findall(r'<(\w+)\b[^>]*?\b(?:href|src)="([^"]*)"', text):
            target = urllib.parse.unquote(html.unescape(target))
            if re.match(r"[a-z]+:|//", target):
                if tag in ("script", "img", "link") and not target.startswith("data:"):
                    faults.append(f"{file}: loads {target}")
                continue
            place, _, anchor = target.partition("#")
            there = (file.parent/place.partition("?")[0]).resolve() if place else file
            if not there.is_file() or (anchor and there.suffix == ".html" and anchor not in anchors[there]):
                faults.append(f"{file}: no {target}")
    return faults


def faults_of_formulas(folder, browser):
    """Formulas that the browser's MathJax does not draw, page by page."""
    faults = []
    for file in sorted(folder.rglob("*.html")):
        there = len(re.findall(r'class="math ', file.read_text(encoding="utf-8")))
        if not there:
            continue
        drawn = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=60000",
                                "--dump-dom", file.resolve().as_uri()], capture_output=True, text=True, check=True,
                               timeout=300).stdout
        done, wrong = drawn.count("<mjx-container"), re.findall(r'data-mjx-error="([^"]*)"', drawn)
        if done < there or wrong:
            faults.append(f"{file}: {done} of {there} formulas drawn {wrong}")
        print(f"{file.relative_to(folder)}: {done} formulas drawn", file=sys.stderr)
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "package", "output"):
        parser.add_argument(f"--{name}", required=True, type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("--browser")
    options = parser.parse_args()
    sys.path.insert(0, str(options.package))
    import wavycon

    source, made = options.output/"source", options.output/"html"
    for folder in (source, made):
        shutil.rmtree(folder, ignore_errors=True)
    stage(source)
    write(source/"reference/keys.md", keys_page(options.program, wavycon.keys()))
    write(source/"reference/columns.md", columns_page())
    write(source/"reference/python.md", python_page(wavycon))
    write(source/"reference/c.md", c_page())
    write(source/"reference/fortran.md", fortran_page())
    with open(source/"index.md", "a", encoding="utf-8") as file:
        file.write(contents())
    subprocess.run([sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-d", options.output/"trees", source,
                    made], check=True, env=dict(os.environ, PYTHONPATH=str(options.package)))
    faults = faults_of(made)
    if options.browser:
        faults += faults_of_formulas(made, options.browser)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{made/'index.html'}: {len(list(made.rglob('*.html')))} pages, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except subprocess.CalledProcessError as error:
        sys.exit(f"make_site.py: {error}")
