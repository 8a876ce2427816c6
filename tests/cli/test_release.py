#!/usr/bin/env python3
"""scripts/release: this tree passes its cheap checks, mistakes are found, and with stand-ins for what it runs it makes the
same archive in two clones.

usage: test_release.py [unittest's options]
"""
import os
import pathlib
import shutil
import subprocess
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILES = ("CMakeLists.txt", "pyproject.toml", "CITATION.cff", "CHANGELOG.md", "packaging/conda/recipe.yaml",
         "packaging/spack/package.py", "outputs/reference", "scripts/release", "scripts/common.sh", ".gitattributes",
         "src/base/version.cmake")
STEPS = "test", "lint", "stress", "docs", "wheel"
STAND_IN = """#!/bin/sh
mkdir -p build/wheel
echo "$0 $SOURCE_DATE_EPOCH" >>build/steps
touch build/wheel/wavycon-VERSION-py3-none-any.whl
"""
VERSION = (ROOT/"CMakeLists.txt").read_text(encoding="utf-8").split("project(wavycon VERSION ")[1].split()[0]
GIT = dict(os.environ, GIT_CONFIG_GLOBAL=os.devnull, GIT_CONFIG_NOSYSTEM="1", GIT_AUTHOR_NAME="a", GIT_AUTHOR_EMAIL="a@b",
           GIT_COMMITTER_NAME="a", GIT_COMMITTER_EMAIL="a@b", GIT_COMMITTER_DATE="1000000000 +0000",
           GIT_AUTHOR_DATE="1000000000 +0000")


def release(root, *words):
    """Exit status and messages."""
    done = subprocess.run([root/"scripts"/"release", *words], text=True, capture_output=True, env=GIT, check=False)
    return done.returncode, done.stderr


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="a folder with blanks ")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()/"tree"
        for name in FILES:
            target = self.root/name
            target.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if (ROOT/name).is_dir() else shutil.copy)(ROOT/name, target)

    def change(self, name, old, new):
        text = (self.root/name).read_text(encoding="utf-8")
        self.assertIn(old, text)
        (self.root/name).write_text(text.replace(old, new, 1), encoding="utf-8")

    def git(self, *words):
        subprocess.run(["git", *words], cwd=self.root, env=GIT, check=True, capture_output=True)

    def test_this_tree(self):
        status, said = release(ROOT, "--check")
        self.assertEqual(0, status, said)
        self.assertRegex(said, rf"^release: wavycon {VERSION} \(.*\): version, dates and checksums agree\n$")

    def test_mistakes(self):
        for name, old, message in (("CITATION.cff", f"version: {VERSION}", f"CITATION.cff: the version is '9.9', not '{VERSION}'"),
                                   ("CHANGELOG.md", f"## {VERSION}", "CHANGELOG.md: the version is '9.9'"),
                                   ("packaging/conda/recipe.yaml", f"version: {VERSION}", "recipe.yaml: the version is '9.9'"),
                                   ("packaging/spack/package.py", f'version("{VERSION}', "package.py: the version is '9.9'")):
            with self.subTest(name):
                new = old.replace(VERSION, "9.9")
                self.change(name, old, new)
                status, said = release(self.root, "--check")
                self.assertEqual((1, 1), (status, said.count("\n")), said)
                self.assertIn(message, said)
                self.change(name, new, old)
        self.change("CHANGELOG.md", f"## {VERSION} (", f"## {VERSION} (1")
        status, said = release(self.root, "--check")
        self.assertEqual(1, status)
        self.assertIn("CHANGELOG.md: the date is ''", said)
        with open(self.root/"outputs"/"reference"/"yield.dat", "a", encoding="utf-8") as file:
            file.write("\n")
        self.assertIn("have not the checksums of SHA256SUMS", release(self.root, "--check")[1])

    @unittest.skipUnless(shutil.which("git"), "there is no git")
    def test_the_same_archive_in_two_clones(self):
        heading = (self.root/"CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")[1].split("\n")[0]
        self.change("CHANGELOG.md", heading, f"{VERSION} (not released)")
        self.assertEqual((1, "CHANGELOG.md has no date of this version"), self.last(release(self.root)))
        self.change("CHANGELOG.md", "(not released)", "(2001-02-03)")
        cited = (self.root/"CITATION.cff").read_text(encoding="utf-8").split("date-released: ")[1].split("\n")[0]
        self.change("CITATION.cff", cited, "2001-02-03")
        for name in STEPS:
            (self.root/"scripts"/name).write_text(STAND_IN.replace("VERSION", VERSION), encoding="utf-8")
            (self.root/"scripts"/name).chmod(0o755)
        (self.root/".gitignore").write_text("/build*/\n", encoding="utf-8")
        self.git("init", "--quiet")
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "first")
        self.git("clone", "--quiet", ".", "../other")
        archives = []
        for root in (self.root, self.root.with_name("other")):
            status, said = release(root)
            self.assertEqual(0, status, said)
            made = sorted(path.name for path in (root/"build"/"release").iterdir())
            self.assertEqual(["SHA256SUMS", f"wavycon-{VERSION}-py3-none-any.whl", f"wavycon-{VERSION}.tar.gz"], made)
            self.assertEqual("".join(f"scripts/{name} 1000000000\n" for name in STEPS), (root/"build"/"steps").read_text())
            archives.append((root/"build"/"release"/made[-1]).read_bytes())
            with tarfile.open(root/"build"/"release"/made[-1]) as archive:
                names = [name for name in archive.getnames() if "." in name]
                commit = archive.extractfile(f"wavycon-{VERSION}/src/base/version.cmake").read().decode()
            self.assertRegex(commit, r'set\(archived "[0-9a-f]{40}"\)')
            self.assertIn(f"wavycon-{VERSION}/scripts/common.sh", names)
            self.assertEqual(sorted(names), names)
        self.assertEqual(*archives)
        (self.root/"CHANGELOG.md").touch()
        (self.root/"new").touch()
        self.assertEqual((1, "?? new"), self.last(release(self.root)))
        (self.root/"new").unlink()
        (self.root/"scripts"/"docs").write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
        self.git("commit", "--all", "--quiet", "--message", "second")
        self.assertEqual((1, "scripts/docs failed"), self.last(release(self.root)))

    @staticmethod
    def last(found):
        """The exit status and the last line, without the program's name."""
        return found[0], found[1].splitlines()[-1].replace("release: ", "", 1)


if __name__ == "__main__":
    unittest.main()
