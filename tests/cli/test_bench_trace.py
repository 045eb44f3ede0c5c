"""bench trace: a row for each kind of rays, method, level and number of states, and the same hits everywhere."""

import json
import unittest

from asset import leaf
from program import CliTest

KEYS = ["scene", "rays", "method", "states", "level", "mrays_per_second", "ratio_to_texture", "fetches_per_ray",
        "tests_per_ray", "opacity_bytes"]
WITHOUT_LEVELS = ["bitmask", "vq2", "vq4", "vq2+", "vq4+"]
WITH_LEVELS = ["gruen", "micromap", "tree", "indexed-tree", "dag", "sdag"]


class BenchTrace(CliTest):
    def setUp(self):
        super().setUp()
        self.write("leaf.glb", leaf(64).glb())
        self.small = ["--size", "48x32", "--rounds", "1"]

    def rows(self, *args):
        self.expect_done("bench", "trace", *args, *self.small, "--json", "rows.json")
        return json.loads((self.folder / "rows.json").read_text())["rows"]

    def test_rows_of_every_method(self):
        rows = self.rows("leaf.glb", "--levels", "2,5")
        wanted = [(rays, method, None, None) for rays in ("primary", "shadow", "ao") for method in ("none", "texture")]
        wanted += [(rays, method, states, None) for rays in ("primary", "shadow", "ao")
                   for method in WITHOUT_LEVELS for states in (2, 4)]
        wanted += [(rays, method, states, level) for rays in ("primary", "shadow", "ao") for method in WITH_LEVELS
                   for states in (2, 4) for level in (2, 5)]
        kinds = {row["rays"] for row in rows}
        self.assertIn("primary", kinds)
        got = {(row["rays"], row["method"], row["states"], row["level"]) for row in rows}
        self.assertEqual(got, {key for key in wanted if key[0] in kinds})
        self.assertEqual(len(rows), len(got))
        for row in rows:
            self.assertEqual(list(row), KEYS)
            self.assertGreater(row["mrays_per_second"], 0)
            self.assertEqual(row["opacity_bytes"] > 0, row["states"] is not None)
            self.assertLessEqual(row["fetches_per_ray"], row["tests_per_ray"])
            if row["states"] == 2:
                self.assertEqual(row["fetches_per_ray"], 0)
            if row["method"] == "texture":
                self.assertEqual(row["ratio_to_texture"], 1)
                self.assertEqual(row["fetches_per_ray"], row["tests_per_ray"])
        self.assertGreater(max(row["tests_per_ray"] for row in rows), 0.1)

    def test_atlas_leaves_the_tests_as_they_were(self):
        args = ["leaf.glb", "--levels", "6", "--states", "4", "--methods", "texture,micromap", "--rays", "primary"]
        plain = self.rows(*args, "--html", "page.html")
        page = (self.folder / "page.html").read_text()
        for text in ("leaf.glb: primary rays", "Best against texture", "data-csv=\"leaf.glb,primary,micromap,4,6,"):
            self.assertIn(text, page)
        packed = self.rows(*args, "--atlas", "256")
        self.assertEqual([row["method"] for row in packed], ["texture", "micromap"])
        for a, b in zip(plain, packed):
            self.assertAlmostEqual(a["tests_per_ray"], b["tests_per_ray"], delta=0.01)
            self.assertAlmostEqual(a["fetches_per_ray"], b["fetches_per_ray"], delta=0.01)

    def test_wrong_usage(self):
        self.expect_error(2, "bench", "trace")
        self.expect_error(1, "bench", "trace", "none.glb", says="none.glb")
        for option, value in (("--levels", "13"), ("--rounds", "0"), ("--methods", "morton"), ("--states", "3"),
                              ("--rays", "gamma"), ("--size", "0x5"), ("--size", "5"), ("--atlas", "70000"),
                              ("--camera", "1,2"), ("--camera", "7")):
            self.expect_error(2, "bench", "trace", "leaf.glb", option, value)


if __name__ == "__main__":
    unittest.main()
