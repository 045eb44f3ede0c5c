"""bench vulkan: a row for each path, method, level and number of states; render's hardware micromaps and paths."""

import json
import unittest

from asset import leaf
from program import CliTest

KEYS = ["scene", "path", "method", "build", "states", "level", "frame_ms", "ratio_to_texture", "opacity_bytes"]
TINY = ("--size", "16x12")


class BenchVulkan(CliTest):
    def setUp(self):
        super().setUp()
        self.write("leaf.glb", leaf(32).glb())

    def bench(self, *args):
        return self.run_program("bench", "vulkan", "leaf.glb", *TINY, "--rounds", "1", "--json", "rows.json", *args)

    def rows(self, *args):
        done = self.bench(*args)
        if done.returncode == 1 and "Vulkan" in done.stderr:
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads((self.folder / "rows.json").read_text())
        self.assertEqual(list(result), ["device", "driver", "rows"])
        self.assertTrue(result["device"] and result["driver"])
        return result["rows"]

    def test_rows(self):
        rows = self.rows("--levels", "2,3", "--methods", "texture,micromap,bitmask")
        paths = {row["path"] for row in rows}
        self.assertTrue(paths and paths <= {"query", "pipeline"})
        wanted = {("texture", None, None)} | {("bitmask", states, None) for states in (2, 4)}
        wanted |= {("micromap", states, level) for states in (2, 4) for level in (2, 3)}
        got = [(row["path"], row["method"], row["states"], row["level"]) for row in rows]
        self.assertEqual(sorted(got, key=str), sorted(((p, *w) for p in paths for w in wanted), key=str))
        for row in rows:
            self.assertEqual(list(row), KEYS)
            self.assertIsNone(row["build"])
            self.assertGreater(row["frame_ms"], 0)
            self.assertEqual(row["opacity_bytes"] > 0, row["method"] != "texture")
            if row["method"] == "texture":
                self.assertEqual(row["ratio_to_texture"], 1)

    def test_one_path(self):
        every = self.rows("--levels", "1", "--methods", "texture")
        for path in sorted({row["path"] for row in every}):
            self.assertEqual([row["path"] for row in self.rows("--methods", "texture", "--path", path)], [path])

    def test_paths_draw_the_same(self):
        shas = []
        for path in {row["path"] for row in self.rows("--methods", "texture", "--levels", "1")}:
            self.expect_done("render", "leaf.glb", "-o", "out.png", *TINY, "--spp", "1", "--backend", "vulkan", "--path", path,
                             "--method", "micromap", "--level", "3", "--json", "r.json")
            result = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(result["path"], path)
            self.assertIsNone(result["build"])
            self.assertGreater(result["device_seconds"], 0)
            shas.append(result["image_sha256"])
        self.assertEqual(len(set(shas)), 1)

    def test_micromaps_of_the_device_or_a_clear_error(self):
        self.rows("--methods", "texture", "--levels", "1")  # skips without a device
        render = ("render", "leaf.glb", "-o", "out.png", *TINY, "--backend", "vulkan", "--method", "hardware")
        done = self.run_program(*render, "--build", "fast-build", "--json", "r.json")
        if done.returncode == 0:
            self.assertEqual(json.loads((self.folder / "r.json").read_text())["build"], "fast-build")
            return
        for args in (render, ("bench", "vulkan", "leaf.glb", *TINY, "--methods", "hardware")):
            self.expect_error(1, *args, says="this device has no opacity micromaps")

    def test_wrong_usage(self):
        self.expect_error(2, "bench", "vulkan")
        self.expect_error(1, "bench", "vulkan", "none.glb", says="none.glb")
        for option, value in (("--levels", "13"), ("--rounds", "0"), ("--spp", "0"), ("--methods", "morton"),
                              ("--states", "3"), ("--integrator", "gamma"), ("--size", "0x5"), ("--build", "slow")):
            self.expect_error(2, "bench", "vulkan", "leaf.glb", option, value)
        for says, args in (("--backend vulkan", ("--method", "hardware")), ("--backend vulkan", ("--path", "query")),
                           ("--method hardware", ("--backend", "vulkan", "--build", "fast-trace"))):
            self.expect_error(2, "render", "leaf.glb", "-o", "out.png", *args, says=says)


if __name__ == "__main__":
    unittest.main()
