"""render: the pictures, the counters and what it says to bad input."""

import json
import struct
import unittest

from asset import leaf
from program import CliTest

KEYS = ["method", "states", "level", "integrator", "width", "height", "spp", "seconds", "rays", "mrays_per_second",
        "candidate_hits", "lookups", "unknown", "texture_fetches", "bits_read", "bytes", "image_sha256"]
LOSSLESS = ("bitmask", "gruen", "micromap", "tree", "indexed-tree", "dag", "sdag", "vq2", "vq4", "vq2+", "vq4+")
SMALL = ("--size", "48x32", "--spp", "2")


def size_of(png):
    return struct.unpack(">II", png[16:24])


class Render(CliTest):
    def setUp(self):
        super().setUp()
        self.write("in.glb", leaf(64).glb())

    def render(self, *args, scene="in.glb"):
        result = self.expect_done("render", scene, "-o", "out.png", *SMALL, "--json", "r.json", *args)
        return json.loads((self.folder / "r.json").read_text()), result

    def data(self, name):
        return (self.folder / name).read_bytes()

    def test_every_method_draws_the_same_picture(self):
        for integrator in ("primary", "shadow", "ao", "path"):
            reference, _ = self.render("--integrator", integrator, "--method", "texture")
            picture = self.data("out.png")
            self.assertGreater(reference["texture_fetches"], 0)
            for method in LOSSLESS:
                with self.subTest(integrator=integrator, method=method):
                    result, _ = self.render("--integrator", integrator, "--method", method)
                    self.assertEqual(result["image_sha256"], reference["image_sha256"])
                    self.assertEqual(self.data("out.png"), picture)
                    self.assertLess(result["texture_fetches"], reference["texture_fetches"] / 2)
                    self.assertEqual(result["texture_fetches"], result["unknown"])

    def test_json_result(self):
        result, _ = self.render("--method", "sdag", "--level", "4", "--integrator", "shadow")
        self.assertEqual(list(result)[:len(KEYS)], KEYS)
        self.assertEqual([result[key] for key in KEYS[:7]], ["sdag", 4, 4, "shadow", 48, 32, 2])
        self.assertEqual(sorted(result["bytes"]), ["bvh", "geometry", "opacity", "textures"])
        self.assertEqual(result["bytes"]["textures"], 64 * 64)
        self.assertEqual(len(result["image_sha256"]), 64)
        self.assertEqual(result["rays"], sum(kind["rays"] for kind in result["ray_kinds"].values()))
        self.assertEqual(size_of(self.data("out.png")), (48, 32))

    def test_backend_vulkan_draws_what_the_texture_draws(self):
        tried = self.run_program("render", "in.glb", "-o", "out.png", *SMALL, "--backend", "vulkan", "--method", "texture")
        if tried.returncode == 1:
            self.skipTest(tried.stderr.strip())
        reference, _ = self.render("--backend", "vulkan", "--method", "texture")
        result, _ = self.render("--backend", "vulkan", "--method", "sdag")
        self.assertEqual([result["backend"], result["image_sha256"]], ["vulkan", reference["image_sha256"]])
        self.assertTrue(result["device"] and result["driver"])
        self.assertLess(result["texture_fetches"], reference["texture_fetches"])

    def test_threads_change_nothing(self):
        first = self.render("--threads", "1")[0]["image_sha256"]
        self.assertEqual(self.render("--threads", "4")[0]["image_sha256"], first)
        self.assertNotEqual(self.render("--seed", "2")[0]["image_sha256"], first)

    def test_two_states_fetch_nothing(self):
        result, _ = self.render("--states", "2")
        self.assertEqual((result["states"], result["texture_fetches"]), (2, 0))
        for method in ("vq2", "vq4+"):
            result, _ = self.render("--states", "2", "--method", method)
            self.assertEqual((result["states"], result["texture_fetches"]), (2, 0))

    def test_none_takes_every_hit(self):
        result, _ = self.render("--method", "none")
        self.assertEqual((result["states"], result["level"], result["texture_fetches"]), (None, None, 0))

    def test_baked_micromaps_serve(self):
        self.expect_done("bake", "in.glb", "-o", "baked.glb", "--level", "3")
        self.assertEqual(self.render(scene="baked.glb")[0]["level"], 3)
        self.assertEqual(self.render("--level", "5", scene="baked.glb")[0]["level"], 5)
        self.expect_done("bake", "in.glb", "-o", "baked.glb", "--level", "3", "--states", "2")
        self.assertEqual(self.render(scene="baked.glb")[0]["states"], 2)
        again, process = self.render("--states", "4", scene="baked.glb")
        self.assertEqual(again["states"], 4)
        self.assertIn("note: ", process.stderr)

    def test_heat_map_and_triptych(self):
        result, process = self.render("--heatmap", "heat.png", "--triptych", "three.png")
        self.assertTrue(result["triptych"]["identical"])
        self.assertIn("same to the bit", process.stdout)
        self.assertGreater(result["triptych"]["texture_fetches_without"], result["texture_fetches"])
        heat, three = size_of(self.data("heat.png")), size_of(self.data("three.png"))
        self.assertGreaterEqual(heat[0], 48)
        self.assertGreater(three[0], 3 * 48)
        self.render("--heatmap", "bits.png", "--heatmap-of", "bits", "--preview", "0.001")

    def test_page(self):
        reference, _ = self.render()
        result, _ = self.render("--html", "page.html", "--beside", "tree,bitmask,gruen,vq2,texture")
        self.assertEqual(result["image_sha256"], reference["image_sha256"])
        page = self.data("page.html").decode()
        for text in ("Alpha tested by micromap with 4 states", "fewer alpha tests than with the texture alone", "the same to the bit",
                     "data-csv=\"bitmask,4,", "data-csv=\"vq2,4,", "alpha tests a sample", "bits a lookup", "--beside tree,"):
            self.assertIn(text, page)
        self.assertEqual(page.count("data-csv=\"texture,"), 1)
        result, _ = self.render("--html", "page.html", "--method", "none")
        self.assertNotIn("Methods side by side", self.data("page.html").decode())

    def test_cameras(self):
        away = "0,0,5,0,0,9,0,1,0,40"
        result, process = self.render("--camera", away)
        self.assertIn("sees nothing", process.stderr)
        self.assertEqual(result["texture_fetches"], 0)
        asset = leaf(64)
        asset.doc["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]
        asset.doc["nodes"].append({"camera": 0, "translation": [0.5, 0.5, 3]})
        asset.doc["scenes"][0]["nodes"].append(1)
        self.write("camera.glb", asset.glb())
        first = self.render(scene="camera.glb")[0]["image_sha256"]
        self.assertEqual(self.render("--camera", "0", scene="camera.glb")[0]["image_sha256"], first)
        self.expect_error(2, "render", "camera.glb", "-o", "x.png", "--camera", "1", says="1 cameras")

    def test_notes_what_a_method_ignores(self):
        _, process = self.render("--method", "texture", "--level", "3", "--states", "2")
        self.assertIn("--level is ignored", process.stderr)
        self.assertIn("--states is ignored", process.stderr)
        for method in ("bitmask", "vq2"):
            result, process = self.render("--method", method, "--level", "3")
            self.assertIn("--level is ignored", process.stderr)
            self.assertEqual((result["level"], result["states"]), (None, 4))

    def test_wrong_usage(self):
        for says, args in (("choose one of", ("--method", "magic")),
                           ("choose one of", ("--integrator", "magic")), ("0 x 10", ("--size", "0x10")),
                           ("--size", ("--size", "10")), ("--size", ("--size", "axb")), ("--spp 0", ("--spp", "0")),
                           ("--states 3", ("--states", "3")), ("--level 13", ("--level", "13")),
                           ("--camera", ("--camera", "1,2,3")), ("same point", ("--camera", "0,0,0,0,0,0,0,1,0,40")),
                           ("not finite", ("--camera", "nan,0,5,0,0,0,0,1,0,40")),
                           ("between 0 and 180", ("--camera", "0,0,5,0,0,0,0,1,0,180")),
                           ("--heatmap-of", ("--heatmap-of", "love")), ("--triptych", ("--method", "none", "--triptych",
                                                                                       "t.png"))):
            with self.subTest(args=args):
                self.expect_error(2, "render", "in.glb", "-o", "out.png", *args, says=says)
        self.expect_error(2, "render", "in.glb", "-o", "out.bmp", says=".png")
        self.expect_error(2, "render", "in.glb", "-o", "out.png", "--heatmap", "heat.jpg", says=".png")
        self.expect_error(2, "render", "in.glb", says="--output")
        self.expect_error(2, "render", "in.glb", "-o", "out.png", "--beside", "tree", says="--html")
        self.expect_error(2, "render", "in.glb", "-o", "out.png", "--html", "p.html", "--beside", "tree,oak", says="oak")
        self.expect_error(1, "render", "in.glb", "-o", "out.png", *SMALL, "--html", "missing/p.html", says="missing")

    def test_bad_input(self):
        self.expect_error(1, "render", "none.glb", "-o", "out.png", says="none.glb")
        self.write("cut.glb", self.data("in.glb")[:200])
        self.expect_error(1, "render", "cut.glb", "-o", "out.png", says="cut.glb")
        self.expect_error(1, "render", "in.glb", "-o", "missing/out.png", *SMALL, says="missing")

    def test_empty_scene_and_broken_transforms(self):
        asset = leaf(16)
        asset.doc["scenes"][0]["nodes"] = []
        self.write("empty.glb", asset.glb())
        _, process = self.render(scene="empty.glb")
        self.assertIn("no triangles", process.stderr)
        asset = leaf(16)
        asset.doc["nodes"][0]["scale"] = [1e38, 1e38, 1e38]
        asset.doc["nodes"][0]["translation"] = [3e38, 3e38, 3e38]
        asset.doc["nodes"].append({"children": [0], "scale": [1e38, 1, 1]})
        asset.doc["scenes"][0]["nodes"] = [1]
        self.write("huge.glb", asset.glb())
        _, process = self.render(scene="huge.glb")
        self.assertIn("not finite", process.stderr)


if __name__ == "__main__":
    unittest.main()
