"""What the package tests share: an installation in a temporary prefix, and outside projects."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["FILIGREE_SOURCE"])
BUILD = Path(os.environ["FILIGREE_BUILD"])
COMPILERS = [f"-DCMAKE_C_COMPILER={os.environ['FILIGREE_CC']}", f"-DCMAKE_CXX_COMPILER={os.environ['FILIGREE_CXX']}"]


def run(*command, **options):
    return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **options)


class OutsideTest(unittest.TestCase):
    """Tests with a temporary folder, `self.folder`."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="filigree-package-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def expect_done(self, *command, **options):
        """What the command prints; it must exit with 0."""
        done = run(*command, **options)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}")
        return done.stdout

    def install(self):
        prefix = self.folder / "prefix"
        self.expect_done("cmake", "--install", BUILD, "--prefix", prefix)
        return prefix

    def configure(self, project, build, *options):
        """The result of configuring a project into the folder `build`."""
        return run("cmake", "-S", project, "-B", self.folder / build, "-G", "Ninja", *COMPILERS, *options)

    def expect_configured(self, project, build, *options):
        done = self.configure(project, build, *options)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def project(self, name, text):
        """A project of one CMakeLists.txt."""
        folder = self.folder / name
        folder.mkdir()
        start = f"cmake_minimum_required(VERSION 3.25)\nproject({name} LANGUAGES C CXX)\n"
        (folder / "CMakeLists.txt").write_text(start + text)
        return folder
