"""vq on textures and on a scene."""

import json
import unittest

from asset import disc, leaf, png
from program import CliTest


class Vq(CliTest):
    def setUp(self):
        super().setUp()
        self.write("a.png", png(48, 48, disc(48)))
        self.write("b.png", png(32, 20, lambda x, y: 255 * ((x // 5 + y // 7) % 2)))
        self.write("in.glb", leaf(64).glb())

    def result(self, name):
        result = json.loads((self.folder / name).read_text())
        del result["seconds"], result["maps_per_second"]
        return result

    def test_textures_and_a_scene(self):
        done = self.expect_done("vq", "a.png", "in.glb", "b.png", "-o", "out", "--json", "r.json")
        self.assertIn("VQ2 best", done.stdout)
        result = self.result("r.json")
        names = [texture["name"] for texture in result["textures"]]
        self.assertEqual((names[0], names[2], len(names)), ("a.png", "b.png", 3))
        scene = result["textures"][1]
        self.assertEqual((scene["maps"], scene["pairs"], scene["singles"]), (1, 1, 0))
        # The scene's pair lies over the whole texture, and its square is that of the texture.
        self.assertGreater(scene["source16"], 0.5)
        for name in ("index.html", "vq.csv", "savings-vq2.svg", "savings-source.svg", "savings-vq4.svg"):
            self.assertIn(f"out/{name}", self.files())
        self.assertEqual(sum(name.endswith(".png") and name.startswith("out/") for name in self.files()), 3)

    def test_same_result_for_any_thread_count(self):
        results = []
        for threads in (1, 2):
            self.expect_done("vq", "a.png", "b.png", "in.glb", "-o", "out", "--threads", threads, "--json", "r.json")
            results.append((self.result("r.json"), (self.folder / "out/vq.csv").read_bytes()))
        self.assertEqual(*results)

    def test_limit_and_prefer(self):
        self.expect_done("vq", "a.png", "b.png", "-o", "out", "--limit", "1", "--prefer", "T", "--no-pictures",
                         "--json", "r.json")
        self.assertEqual(len(self.result("r.json")["textures"]), 1)
        self.assertFalse([name for name in self.files() if name.endswith(".png") and name.startswith("out/")])

    def test_compress_as_squares(self):
        for encoding, size in (("vq2", 32), ("vq2+", 32), ("vq4", 64), ("vq4+", 64)):
            for options in ([], ["--zstd"], ["--threads", "1"]):
                self.expect_done("compress", "in.glb", "-o", "x.fil", "--encoding", encoding, "--json", "c.json", *options)
                self.expect_done("validate", "x.fil")
            result = json.loads((self.folder / "c.json").read_text())
            self.assertEqual((result["encoding"], result["maps"], result["payload_bytes"]), (encoding, 1, size))
            self.expect_error(1, "expand", "x.fil", "--asset", "in.glb", "-o", "y.glb",
                              says=f"holds opacity squares ({encoding})")
        for option in (["--level", "3"], ["--states", "2"], ["--aggregates"], ["--one-bit"], ["--max-bytes", "1K"]):
            self.expect_error(2, "compress", "in.glb", "-o", "y.fil", "--encoding", "vq2", *option, says=option[0])
        data = (self.folder / "x.fil").read_bytes()
        self.write("cut.fil", data[:-1])
        self.assertEqual(self.run_program("validate", "cut.fil").returncode, 1)

    def test_bad_input(self):
        self.write("empty.png", b"")
        self.write("black.png", png(4, 4, lambda x, y: 0))
        self.write("cut.png", png(16, 16, disc(16))[:80])
        for name, says in (("empty.png", "empty.png"), ("black.png", "every alpha is 0"), ("cut.png", "cut.png"),
                           ("none.png", "none.png")):
            self.expect_error(1, "vq", "a.png", name, "-o", "out", says=says)
        for option in ("--prefer=C", "--cutoff=2", "--guard=-1", "--limit=-1", "--maps=x"):
            self.expect_error(2, "vq", "a.png", "-o", "out", option, says=option.split("=")[0])
        self.expect_error(2, "vq", "a.png")
        self.expect_error(2, "vq", "-o", "out")


if __name__ == "__main__":
    unittest.main()
