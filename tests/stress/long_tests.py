"""The tests with the label `long`, which scripts/test leaves out."""
import re
import subprocess

from common import Part

LINE = re.compile(r"^ *\d+/\d+ Test +#\d+: (\S+) \.*(.*?) +[\d.]+ sec$", re.MULTILINE)


def campaign(build, results):
    """Runs them by ctest, whose words are kept if one fails, but for the short form of this campaign. `build`: the folder
    of the build."""
    part = Part("long tests")
    outcome = subprocess.run(["ctest", "--test-dir", build, "-L", "^long$", "-E", "^stress[.]", "--output-on-failure",
                              "--no-tests=error"], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    for name, word in LINE.findall(outcome.stdout):
        part.count(name, [] if "Passed" in word else [word.strip("* ")])
    if outcome.returncode != 0 and not part.failures:
        part.count("ctest", [outcome.stderr.strip() or f"exit status {outcome.returncode}"])
    if part.failures:
        results.mkdir(parents=True, exist_ok=True)
        (results/"long_tests.log").write_text(outcome.stdout)
    return part
