"""Virtual environments with packages from the Python package index."""
import importlib
import os
import subprocess
import sys

from program import skip, take_options

PIP = ["-m", "pip", "install", "--disable-pip-version-check", "--no-input", "--no-compile", "--timeout", "10", "--retries", "1"]
PATIENCE = 600  # [s] for one installation


def python_with(home, requirements, imports, interpreters=(sys.executable,), options=()):
    """The Python of an environment in the folder `home`, made if necessary; None if that fails.

    requirements: as pip takes them. imports: modules that show that the environment is complete. interpreters: Pythons
    to try, in this order. options: more options for pip. What was tried is in the file `home`.log.
    """
    python = os.path.join(home, "bin", "python")
    os.makedirs(os.path.dirname(home), exist_ok=True)
    with open(f"{home}.log", "a", encoding="utf-8") as log:
        probe = [python, "-c", "import " + ", ".join(imports)]
        if succeeds(probe, log):
            return python
        print(f"installing {', '.join(requirements)} into {home} (log beside it)", file=sys.stderr)
        for interpreter in interpreters:
            if (succeeds([interpreter, "-m", "venv", "--clear", home], log)
                    and succeeds([python, *PIP, *options, *requirements], log) and succeeds(probe, log)):
                return python
    return None


def go_on_with(*packages):
    """Returns in a Python that has the packages, wheels alone: this one if it has them, else one that is made in the
    folder of the option --environment, in which the file is started again; the test is skipped if that fails."""
    words, home = list(sys.argv), os.path.abspath(take_options("environment").environment)
    try:
        for package in packages:
            importlib.import_module(package)
    except ImportError:
        python = python_with(home, packages, packages, options=["--only-binary", ":all:"])
        if not python:
            skip(f"{', '.join(packages)} cannot be installed; see {home}.log")
        # What it compiles is kept in the folder: compiling pandas takes as long as these tests.
        variables = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        os.execve(python, [python, *words], dict(variables, PYTHONPYCACHEPREFIX=os.path.join(home, "cache")))


def go_on_with_package():
    """Returns the options --package and --needs in a Python that has the packages of --needs and finds wavycon in the
    folder of --package; the test is skipped if that fails."""
    if sys.version_info < (3, 10):
        skip("the package needs Python 3.10")
    # Kept on the command line: another Python may be started with it.
    go_on_with(*sys.argv[sys.argv.index("--needs") + 1].split(","))
    given = take_options("package", "needs")
    sys.path.insert(0, os.path.abspath(given.package))
    return given


def succeeds(command, log):
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, timeout=PATIENCE,
                              check=False).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False
