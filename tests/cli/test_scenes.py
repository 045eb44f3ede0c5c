"""Real scenes: baked as a user would, and proven in depth."""

import json
import os
import unittest
from pathlib import Path

from program import CliTest

SCENES = Path(os.environ.get("FILIGREE_SHARED_DATA", "")) / "data" / "scenes"


@unittest.skipUnless(SCENES.is_dir(), "the shared test data is absent (FILIGREE_SHARED_DATA names none)")
class Scenes(CliTest):
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


if __name__ == "__main__":
    unittest.main()
