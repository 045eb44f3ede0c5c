"""Arguments: help, version, and wrong usage (exit 2)."""

import unittest

from asset import leaf
from program import CliTest

VERBS = (["bake"], ["compress"], ["expand"], ["compare"], ["validate"], ["inspect"], ["vq"], ["bench", "bake"], ["bench", "lookup"],
         ["bench", "encode"], ["render"], ["demo"])


class Usage(CliTest):
    def test_version(self):
        self.assertRegex(self.expect_done("--version").stdout, r"^filigree \d+\.\d+\.\d+\n$")

    def test_help_names_every_verb(self):
        text = self.expect_done("--help").stdout
        for verb in VERBS:
            self.assertIn(verb[0], text)

    def test_every_verb_has_help_with_an_example(self):
        for verb in VERBS:
            text = self.expect_done(*verb, "--help").stdout
            self.assertIn("Example: filigree " + " ".join(verb), text)
            for option in ("--json", "--threads", "--quiet"):
                self.assertIn(option, text)

    def test_wrong_usage(self):
        self.write("in.glb", leaf().glb())
        bake = ["bake", "in.glb", "-o", "out.glb"]
        for args in ([], ["sing"], ["bake"], ["bake", "in.glb"], ["inspect", "in.glb"], ["bench"],
                     ["validate", "in.glb", "--sample", "0.5"], bake + ["--sing"], bake + ["more.glb"]):
            self.expect_error(2, *args)
        for option, *values in (["--level", "13", "-1", "x", ""], ["--max-level", "13"],
                                ["--cutoff", "2", "-0.1", "nan"], ["--states", "3"], ["--guard", "-1", "inf"],
                                ["--threads", "-1", "x"], ["--mips", "-1", "x"], ["--budget", "-1", "1X", "M", "1.5M", "17179869184G", ""]):
            for value in values:
                self.expect_error(2, *bake, f"{option}={value}", says=option)

    def test_grids(self):
        grids = ["grids", "in.glb", "-o", "out.fil"]
        for args in (["--codec", "zip"], ["--max-error", "0"], ["--max-error", "-1d"], ["--max-error", "x"],
                     ["--max-error", "inf"], ["--lossless", "--match-paper"], ["--snap"],
                     ["--max-error", "1", "--lossless"], ["--codec", "paper", "--lossless"],
                     ["--displacement", "unit-vector", "--lossless"], ["--displacement", "short"],
                     ["--cell", "2"], ["--height-scale", "2"], ["--error-map", "x.jpg"]):
            self.expect_error(2, *grids, *args, says=args[0])
        self.expect_error(2, "grids", "in.obj", "-o", "out.fil", says="expected a .glb, .gltf, .ply or .png")


if __name__ == "__main__":
    unittest.main()
