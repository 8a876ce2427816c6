"""Sphinx's configuration of the site; make_site.py stages the pages and runs Sphinx."""
import re

from docutils import nodes

project = "wavycon"
author = copyright = "The wavycon developers"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx-mathjax-offline"]
html_theme = "furo"
html_title = "wavycon"
html_static_path = ["packaging/site/site.css"]
html_css_files = ["site.css"]
html_copy_source = html_show_sourcelink = False
# Pages name their formulas by \tag, quote in plain ASCII, and have links as GitHub makes them.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
smartquotes = False
highlight_language = "none"
# Two columns of formulas in a table, or long displays, scroll in their own box (site.css).
mathjax3_config = {"chtml": {"displayAlign": "left", "displayIndent": "1em"}, "options": {"enableMenu": False}}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"


def keep_display(app, doctree):
    """Displays as they are: Sphinx would put those of several lines into `split`, which has no \\tag."""
    for block in doctree.findall(nodes.math_block):
        text = block.astext()
        block.children[:] = [nodes.Text(f"\\[{text}\\]")]
        block.rawsource, block["no-wrap"], block["nowrap"] = text, True, True


def plain_docstring(app, what, name, obj, options, lines):
    """Docstrings are plain text with `code`. Paragraphs of lines `name: meaning` become lists, indented ones code."""
    text = []
    for paragraph in re.split(r"\n\s*\n", "\n".join(lines)):
        rows = paragraph.splitlines()
        if all(row.startswith("    ") for row in rows):
            text += ["::", "", *rows, ""]
            continue
        is_list = len(rows) > 1 and all(re.match(r"\w+(?: \[[^]]*\])?: |\s", row) for row in rows)
        for row in rows:
            words = re.sub(r"([*|\\])|_(?!\w)", r"\\\g<0>", row.strip())
            words = re.sub(r"`([^`]*)`", r"``\1``", words)
            if is_list:
                words = "  " + words if row[0] == " " else re.sub(r"^\w+", r"* ``\g<0>``", words)
            text.append(words)
        text.append("")
    lines[:] = [] if lines[0].startswith("Alias for field number") else text


def setup(app):
    app.connect("doctree-read", keep_display)
    app.connect("autodoc-process-docstring", plain_docstring)
    return {"parallel_read_safe": True}
