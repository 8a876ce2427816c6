#!/usr/bin/env python3
"""scripts/build, with a stand-in for cmake: what it builds, what it says, and that two at once do not disturb each other.
scripts/constants: that cmake accepts its copy of the sources, and that it finds the constants.
All scripts: that they refuse options that they do not know, before they begin.

usage: test_build.py [unittest's options]
"""
import importlib.machinery
import importlib.util
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2]/"scripts"
# It writes what it is asked for, and while it builds another one must not.
CMAKE = """#!/bin/sh
case $1 in
-S)
   printf '%s\\n' CMAKE_BUILD_TYPE:S=Release WAVYCON_TESTS:B=ON "CMAKE_HOME_DIRECTORY:I=$2" >"$4/CMakeCache.txt"
   echo "$*" | grep -o 'WAVYCON_MPI=.*' | sed 's/=/:S=/' >>"$4/CMakeCache.txt"
   touch "$4/build.ninja"
   ;;
--build)
   echo "begins $4" >>"$2/order"
   sleep 0.3
   echo "ends $4" >>"$2/order"
   for i in 1 2 3 4 5 6 7 8; do echo "compiling"; echo "Warning: number $i"; done
   ;;
esac
"""


def write(path, text):
    path.write_text(text)
    path.chmod(0o755)


class Build(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.programs = pathlib.Path(folder.name)
        write(cls.programs/"cmake", CMAKE)

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="a folder with blanks ")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for name in "scripts", "src", "tests":
            (self.root/name).mkdir()
        (self.root/"CMakeLists.txt").touch()
        for name in "build", "common.sh":
            shutil.copy(SCRIPTS/name, self.root/"scripts")
        write(self.root/"scripts"/"dependencies", "#!/bin/sh\n")

    def start(self, *words):
        path = os.pathsep.join([str(self.programs), os.environ["PATH"]])
        return subprocess.Popen([self.root/"scripts"/"build", *words], env=dict(os.environ, PATH=path), text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def build(self, *words):
        """Runs it; what it says."""
        process = self.start(*words)
        said, complaints = process.communicate()
        self.assertEqual((0, ""), (process.returncode, said), complaints)
        return complaints

    def built(self):
        return (self.root/"build"/"order").read_text().splitlines()

    def test_targets(self):
        self.build("wavycon")
        self.build("--mpi")
        self.build("--mpi", "all")
        self.build()
        self.assertEqual(["ends wavycon", "ends wavycon-mpi", "ends all", "ends all"], self.built()[1::2])

    def test_few_warnings_are_shown(self):
        said = self.build("wavycon")
        self.assertIn("8 warnings", said)
        self.assertEqual(5, said.count("Warning: number"))
        self.assertNotIn("compiling", said)

    @unittest.skipUnless(shutil.which("flock"), "there is no flock")
    def test_builds_wait_for_each_other(self):
        self.build("wavycon")
        (self.root/"build"/"order").unlink()
        processes = [self.start("wavycon") for _ in range(3)]
        said = [process.communicate()[1] for process in processes]
        self.assertEqual([0, 0, 0], [process.returncode for process in processes], said)
        self.assertEqual(["begins wavycon", "ends wavycon"]*3, self.built())
        self.assertEqual(2, sum("waiting for another build to end" in words for words in said), said)


class Constants(unittest.TestCase):
    def test_a_copy_of_the_sources_can_be_built(self):
        loader = importlib.machinery.SourceFileLoader("constants", str(SCRIPTS/"constants"))
        constants = importlib.util.module_from_spec(importlib.util.spec_from_loader("constants", loader))
        loader.exec_module(constants)
        with tempfile.TemporaryDirectory() as folder:
            tree = constants.Tree(pathlib.Path(folder))
            self.assertTrue((tree.build/"CMakeCache.txt").is_file())
            self.assertEqual([], [name for name, values in tree.values.items() if not values])


class Options(unittest.TestCase):
    PASSED_ON = "run"   # the program refuses what it does not know
    EXAMPLE = "slurm_example.sh"   # Slurm starts it, without options

    def test_unknown_options_are_refused_before_work_begins(self):
        scripts = [path.name for path in SCRIPTS.iterdir() if path.is_file() and os.access(path, os.X_OK)]
        scripts = sorted(set(scripts) - {self.PASSED_ON, self.EXAMPLE})
        self.assertLess(30, len(scripts))
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            shutil.copytree(SCRIPTS, root/"scripts")
            for name in "dependencies", "build":   # what the others begin with
                write(root/"scripts"/f"{name}-itself", (SCRIPTS/name).read_text())
                write(root/"scripts"/name, f"#!/bin/sh\necho WORK {name} >&2\nexit 1\n")
            for program in "cmake", "gnuplot", "wavycon":
                write(root/program, f"#!/bin/sh\necho WORK {program} >&2\nexit 1\n")
            environment = dict(os.environ, PATH=os.pathsep.join([folder, os.environ["PATH"]]), WAVYCON=str(root/"wavycon"),
                               PYTHONPATH=str(SCRIPTS.parent/"tests"/"support"), PYTHONDONTWRITEBYTECODE="1")
            before = sorted(root.rglob("*"))
            words = [[name, "--bogus"] for name in scripts] + [
                ["build", "wavycon", "--bogus"], ["build", "--mpi", "--bogus"], ["lint", "ruff", "--bogus"],
                ["lint", "--install", "--bogus"], ["test", "bogus"], ["test", "-L", "unit", "--bogus=1"],
                ["test", "-L", "unit", "bogus"], ["coverage", "-R", "exact", "-bogus"], ["gallery", "--into", "x", "--bogus"],
                ["release", "--check", "--bogus"], ["fig01.sh", "--format", "svg", "--bogus"]]
            for name, *options in words:
                path = root/"scripts"/(name + "-itself"*(name in ("dependencies", "build")))
                with self.subTest(name, options=options):
                    outcome = subprocess.run([path, *options], env=environment, cwd=folder, text=True, capture_output=True,
                                             timeout=60, check=False)
                    self.assertIn(outcome.returncode, (1, 2), outcome)
                    self.assertIn("bogus", outcome.stderr)
                    self.assertRegex(outcome.stderr, "(?i)usage: ")
                    self.assertNotIn("WORK", outcome.stderr)
                    self.assertEqual("", outcome.stdout)
                    self.assertEqual(before, sorted(root.rglob("*")))


if __name__ == "__main__":
    unittest.main()
