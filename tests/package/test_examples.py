"""The examples, each built as an outside project against the installed package, end with the lines of expected.txt."""

import unittest

from outside import OutsideTest, SOURCE

EXAMPLES = sorted(path.parent for path in (SOURCE / "examples").glob("*/CMakeLists.txt"))


class Examples(OutsideTest):
    def test_examples(self):
        prefix = self.install()
        self.assertGreaterEqual(len(EXAMPLES), 4)
        for example in EXAMPLES:
            with self.subTest(example.name):
                self.expect_configured(example, example.name, f"-DCMAKE_PREFIX_PATH={prefix}")
                self.expect_done("cmake", "--build", self.folder / example.name)
                printed = self.expect_done(self.folder / example.name / example.name)
                self.assertTrue(printed.endswith((example / "expected.txt").read_text()), printed)


if __name__ == "__main__":
    unittest.main()
