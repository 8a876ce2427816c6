"""Names and titles with commands for a shell or gnuplot, through scripts/plot: the commands must not be run."""
import shutil
import subprocess

from common import Part, complaints_about, files_below, run, save

WORDS = ["; touch CANARY", "$(touch CANARY)", "`touch CANARY`", "| touch CANARY", "& touch CANARY &", "> CANARY",
         "'; touch CANARY; '", '"; touch CANARY; "', "\" . system(\"touch CANARY\") . \"", "'.system('touch CANARY').'", "`system touch CANARY`",
         "\\\\n; system 'touch CANARY'", "{/Symbol @x_^}", "%s %d %n", "$HOME ${IFS}", "* ? [a]", "-e", "--help", "~root",
         "!touch CANARY", "#", "\\", "a\\", "ä€𝄞", "<touch CANARY", "a  b", "= 1 /", "!"]


def fortran(text):
    return "'" + text.replace("'", "''") + "'"


def campaign(program, scripts, quick, work, failures):
    part = Part("names near a shell")
    if not shutil.which("gnuplot"):
        part.notes.append("SKIPPED the pictures: there is no gnuplot")
    for i, word in enumerate(WORDS):
        for j, place in enumerate(("title", "directory", "above")):
            # A picture takes a tenth of a second: the short form tries some.
            if quick and (i + j) % 9:
                continue
            folder = work/f"{i} {place}"
            folder.mkdir()
            text = "&surface kind = 'wave_2d' /\n&load pbar_over_pstar = 0.3, 0.6 /\n"
            output = "results"
            if place == "title":
                text += f"&scene title = {fortran(word)} /\n"
            else:
                output = ("../outside " if place == "above" else "") + word.replace("/", ":").strip()
                text += f"&output directory = {fortran(output)} /\n"
            (folder/"deck.nml").write_text(text)
            words = [program, "deck.nml"] + (["--output", "results"] if place == "title" else [])
            outcome = run(words, folder)
            complaints = complaints_about(outcome, (0,))
            made = files_below(work)
            target = (folder/output).resolve()
            for name in made:
                if "CANARY" in name.rsplit("/", 1)[-1]:
                    complaints.append(f"{name} was made")
            if outcome.status == 0 and not (target/"deck.summary.dat").exists():
                complaints.append("the summary is not in the output directory")
            elif outcome.status == 0 and shutil.which("gnuplot"):
                drawn = subprocess.run([scripts/"plot", "--", target/"deck.summary.dat"], cwd=folder, capture_output=True,
                                       check=False)
                if drawn.returncode or not (target/"deck.summary.png").exists():
                    complaints.append(f"no picture: {drawn.stderr.decode(errors='replace').strip()}")
                complaints += [f"the picture makes {name}" for name in files_below(work) - made
                               if not name.endswith("deck.summary.png")]
            if not part.count(f"{place}-{i}.nml", complaints):
                save(failures, f"{place}-{i}.nml", text.encode())
    return part
