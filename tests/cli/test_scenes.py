"""Real scenes: baked as a user would, and proven in depth."""

import json
import os
import unittest
from pathlib import Path

from program import CliTest

SCENES = Path(os.environ.get("FILIGREE_SHARED_DATA", "")) / "data" / "scenes"


@unittest.skipUnless(SCENES.is_dir(), "the shared test data is absent (FILIGREE_SHARED_DATA names none)")
class Scenes(CliTest):
    def test_lookups_at_hits_of_rays_agree(self):
        self.expect_done("bench", "lookup", SCENES / "0ad_forest_temperate.glb", "--levels", "4", "--lookups", "20000",
                         "--rounds", "1", "--patterns", "hits", "--json", "rows.json")
        rows = json.loads((self.folder / "rows.json").read_text())["rows"]
        self.assertEqual({row["pattern"] for row in rows}, {"hits"})
        self.assertEqual(len(rows), 7 * 3 * 2)

    def test_every_scene_bakes_and_validates(self):
        for scene in sorted(SCENES.glob("*.glb")):
            with self.subTest(scene=scene.name):
                self.expect_done("bake", scene, "-o", "out.glb", "--json", "bake.json")
                self.expect_done("validate", "out.glb", "--deep", "--json", "validate.json")
                baked = json.loads((self.folder / "bake.json").read_text())
                checked = json.loads((self.folder / "validate.json").read_text())
                self.assertGreater(baked["masked_triangles"], 0)
                self.assertEqual((checked["valid"], checked["deep"]["wrong"]), (True, 0))
                self.assertLessEqual(checked["deep"]["over_cautious"], 1e-5 * checked["deep"]["micro_triangles"])

    def test_every_scene_compresses_and_expands(self):
        for scene in sorted(SCENES.glob("*.glb")):
            for states in (2, 4):
                with self.subTest(scene=scene.name, states=states):
                    options = ["--level", "6", "--states", states]
                    self.expect_done("bake", scene, "-o", "baked.glb", *options)
                    self.expect_done("compress", scene, "-o", "x.fil", *options)
                    self.expect_done("validate", "x.fil")
                    self.expect_done("expand", "x.fil", "--asset", scene, "-o", "out.glb")
                    self.assertEqual((self.folder / "out.glb").read_bytes(), (self.folder / "baked.glb").read_bytes())

    @unittest.skipUnless(os.environ.get("FILIGREE_FULL"), "long: ./check --full")
    def test_gruen_masks_are_never_wrong(self):
        for scene in sorted(SCENES.glob("*.glb")):
            for states in (2, 4):
                with self.subTest(scene=scene.name, states=states):
                    self.expect_done("compress", scene, "-o", "x.fil", "--encoding", "gruen", "--level", "6", "--states",
                                     states)
                    self.expect_done("expand", "x.fil", "--asset", scene, "-o", "out.glb")
                    self.expect_done("validate", "out.glb", "--deep", "--json", "deep.json")
                    deep = json.loads((self.folder / "deep.json").read_text())["deep"]
                    self.assertEqual(deep["wrong"], 0)
                    self.assertGreater(deep["micro_triangles"], 0)

    @unittest.skipUnless(os.environ.get("FILIGREE_FULL"), "long: ./check --full")
    def test_what_is_lost_is_never_a_lie(self):
        for scene in sorted(SCENES.glob("*.glb")):
            for options in (["--max-extra-anyhit", "20"], ["--one-bit"]):
                for encoding in ("tree", "sdag"):
                    with self.subTest(scene=scene.name, options=options, encoding=encoding):
                        self.expect_done("compress", scene, "-o", "x.fil", "--encoding", encoding, "--level", "6", *options)
                        self.expect_done("validate", "x.fil")
                        self.expect_done("expand", "x.fil", "--asset", scene, "-o", "out.glb")
                        self.expect_done("validate", "out.glb", "--deep", "--json", "deep.json")
                        deep = json.loads((self.folder / "deep.json").read_text())["deep"]
                        self.assertEqual(deep["wrong"], 0)

    @unittest.skipUnless(os.environ.get("FILIGREE_FULL"), "long: ./check --full")
    def test_level_10_takes_little_memory(self):
        for scene in sorted(SCENES.glob("*.glb")):
            for states in (2, 4):
                with self.subTest(scene=scene.name, states=states):
                    self.expect_done("compress", scene, "-o", "x.fil", "--level", "10", "--states", states, "--json",
                                     "x.json")
                    self.assertLess(json.loads((self.folder / "x.json").read_text())["peak_bytes"], 1 << 30)
                    self.expect_done("validate", "x.fil")


if __name__ == "__main__":
    unittest.main()
