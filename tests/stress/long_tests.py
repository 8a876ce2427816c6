"""The tests with the label `long`, which scripts/test leaves out."""
import re
import subprocess

LINE = re.compile(r"^ *\d+/\d+ Test +#\d+: (\S+) \.*(.*?) +[\d.]+ sec$", re.MULTILINE)


def campaign(settings, _work):
    """Runs them by ctest, whose words are kept if one fails, but for the short form of this campaign."""
    part = settings.part("long tests")
    outcome = subprocess.run(["ctest", "--test-dir", settings.programs.parents[1], "-L", "^long$", "-E", "^stress[.]",
                              "--output-on-failure", "--no-tests=error"], stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, check=False)
    log = {"long_tests.log": outcome.stdout}
    for name, word in LINE.findall(outcome.stdout):
        part.count(name, [] if "Passed" in word else [word.strip("* ")], log)
    if outcome.returncode != 0 and not part.failures:
        part.count("ctest", [outcome.stderr.strip() or f"exit status {outcome.returncode}"], log)
    return part
