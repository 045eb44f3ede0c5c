"""Runs the command in a folder of its own and says what came of it."""

import os
import resource
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["FILIGREE"]
SECONDS = 120
MAX_RESIDENT_KIB = 1 << 20


class CliTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        return name

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*"))

    def run_program(self, *args):
        return subprocess.run([PROGRAM, *map(str, args)], cwd=self.folder, capture_output=True, text=True,
                              errors="replace", timeout=SECONDS)

    def expect_done(self, *args):
        result = self.run_program(*args)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def expect_error(self, code, *args, says=""):
        """The exit code, one line on stderr that holds `says`, nothing on stdout, and no new file."""
        before = self.files()
        result = self.run_program(*args)
        self.assertEqual(result.returncode, code, f"{args}: {result.stderr}")
        self.assertTrue(result.stderr.startswith("filigree: "), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(says, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(self.files(), before)

    def expect_bounded_memory(self):
        """No child so far has held more than MAX_RESIDENT_KIB."""
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, MAX_RESIDENT_KIB)
