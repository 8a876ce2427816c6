"""Pictures in a machine's poorest choice of faces, DejaVu, and whether one of them is cut off at its border."""
import os
import pathlib
import struct
import subprocess

# What Debian installs with gnuplot: no italic face of Serif, which is slanted then.
FACES = "DejaVuSans", "DejaVuSans-Bold", "DejaVuSansMono", "DejaVuSansMono-Bold", "DejaVuSerif", "DejaVuSerif-Bold"
BORDER = 3   # pixels; the pictures leave three times as many and more


def dejavu_alone(folder):
    """The variables of a machine that has these faces alone, described in a folder; None if it does not have them."""
    folder = pathlib.Path(folder, "fonts")
    try:
        found = subprocess.run(["fc-match", "--format=%{file}", "DejaVu Serif:style=Book"], capture_output=True,
                               text=True, check=True).stdout
    except OSError:
        return None
    faces = [path for path in (pathlib.Path(found).with_name(f"{name}.ttf") for name in FACES) if path.is_file()]
    if not any(path.stem == "DejaVuSerif" for path in faces):
        return None
    folder.mkdir()
    for path in faces:
        (folder/path.name).symlink_to(path)
    settings = folder/"fonts.conf"
    settings.write_text(f'<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "urn:fontconfig:fonts.dtd">\n<fontconfig>'
                        f'<dir>{folder}</dir><cachedir>{folder}/cache</cachedir>'
                        '<include ignore_missing="yes">/etc/fonts/conf.d</include></fontconfig>\n')
    return {**os.environ, "FONTCONFIG_FILE": str(settings)}


def inked_borders(picture):
    """The borders, of left, right, top and bottom, on which a PNG is not white. gnuplot reads the picture."""
    with open(picture, "rb") as file:
        width, height = struct.unpack(">16x2I", file.read(24))
    strips = {"left": f"::0::{BORDER - 1}", "right": f"::{width - BORDER}::{width - 1}",
              "top": f":::0::{BORDER - 1}", "bottom": f":::{height - BORDER}::{height - 1}"}
    script = f"set table $pixels\nfile = '{picture.name}'\n"
    for name, strip in strips.items():
        script += f"plot file binary filetype=png every {strip} using ($1 + $2 + $3) with image\n" \
                  f"unset table\nstats $pixels using 3 name '{name}' nooutput\nset table $pixels\n" \
                  f"print '{name} ', {name}_min\n"
    done = subprocess.run(["gnuplot", "-d"], cwd=picture.parent, input=script, capture_output=True, text=True,
                          check=True)
    # gnuplot 6 says more there.
    found = dict(words for words in map(str.split, done.stderr.splitlines()) if words and words[0] in strips)
    assert found.keys() == strips.keys(), done.stderr
    return [name for name, least in found.items() if float(least) < 3*255]
