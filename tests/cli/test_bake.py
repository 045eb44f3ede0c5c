"""bake and validate on assets that are well."""

import json
import struct
import unittest

from asset import leaf
from program import CliTest

EXTENSION = "EXT_mesh_opacity_micromap"


def document(glb):
    length = struct.unpack_from("<I", glb, 12)[0]
    return json.loads(glb[20:20 + length])


class Bake(CliTest):
    def bake(self, asset, *options):
        """Bakes and validates in depth; the result's JSON and the file written."""
        self.write("in.glb", asset.glb())
        self.expect_done("bake", "in.glb", "-o", "out.glb", "--json", "bake.json", *options)
        self.expect_done("validate", "out.glb", "--deep", "--json", "validate.json")
        return json.loads((self.folder / "bake.json").read_text()), (self.folder / "out.glb").read_bytes()

    def test_json_results(self):
        result, _ = self.bake(leaf(), "--level", "5")
        self.assertEqual(list(result), ["triangles", "masked_triangles", "micromaps", "special", "levels", "bytes",
                                        "micro_triangles", "known_share", "seconds"])
        self.assertEqual(list(result["special"]),
                         ["transparent", "opaque", "unknown_transparent", "unknown_opaque"])
        self.assertEqual(list(result["bytes"]), ["data", "records", "indices"])
        self.assertEqual(list(result["seconds"]), ["read", "bake", "write", "total"])
        self.assertEqual((result["triangles"], result["masked_triangles"]), (2, 2))
        self.assertEqual(result["micro_triangles"], 2 * 4**5)
        self.assertEqual(result["levels"], {"5": result["micromaps"]})
        self.assertEqual(result["bytes"]["data"], result["micromaps"] * 4**5 // 4)
        self.assertEqual(result["bytes"]["records"], result["micromaps"] * 8)
        self.assertTrue(0.5 < result["known_share"] < 1)
        checked = json.loads((self.folder / "validate.json").read_text())
        self.assertEqual((checked["valid"], checked["breaches"]), (True, []))
        self.assertEqual(checked["deep"]["micro_triangles"], 2 * 4**5)
        self.assertEqual(checked["deep"]["wrong"], 0)

    def test_same_bytes_for_any_thread_count(self):
        _, one = self.bake(leaf(64), "--threads", "1")
        _, two = self.bake(leaf(64), "--threads", "2")
        self.assertEqual(one, two)

    def test_what_is_unknown_is_kept(self):
        asset = leaf()
        asset.doc["extensionsUsed"] = ["VENDOR_weather"]
        asset.doc["extensions"] = {"VENDOR_weather": {"rain": [1, 2.5, "drops"]}}
        asset.doc["meshes"][0]["extras"] = {"kept": True}
        _, glb = self.bake(asset)
        after = document(glb)
        self.assertEqual(after["extensions"]["VENDOR_weather"], {"rain": [1, 2.5, "drops"]})
        self.assertEqual(after["meshes"][0]["extras"], {"kept": True})
        self.assertIn("VENDOR_weather", after["extensionsUsed"])
        self.assertIn(EXTENSION, after["extensionsUsed"])
        self.assertNotIn(EXTENSION, after.get("extensionsRequired", []))
        self.assertIn(asset.bin, glb)

    def test_a_uniform_mesh_still_has_a_record(self):
        result, glb = self.bake(leaf(alpha=lambda x, y: 255))
        self.assertEqual((result["micromaps"], result["special"]["opaque"]), (1, 2))
        self.assertEqual(len(document(glb)["extensions"][EXTENSION]["micromaps"]), 1)

    def test_materials_share_where_their_alpha_is_the_same(self):
        asset = leaf()
        materials, primitives = asset.doc["materials"], asset.doc["meshes"][0]["primitives"]
        materials.append({**materials[0], "name": "same alpha", "doubleSided": True})
        materials.append({**materials[0], "name": "own cutoff", "alphaCutoff": 0.25})
        primitives += [{**primitives[0], "material": 1}, {**primitives[0], "material": 2}]
        result, glb = self.bake(asset, "--level", "4")
        after = document(glb)
        used = [p["extensions"][EXTENSION]["micromap"] for p in after["meshes"][0]["primitives"]]
        self.assertEqual(used, [0, 0, 1])
        self.assertEqual(result["micromaps"], 4)

    def test_blend_is_baked_on_request(self):
        result, _ = self.bake(leaf(mode="BLEND"))
        self.assertEqual(result["masked_triangles"], 0)
        result, _ = self.bake(leaf(mode="BLEND"), "--include-blend")
        self.assertEqual(result["masked_triangles"], 2)

    def test_every_option_gives_a_true_bake(self):
        for options in (["--states", "2"], ["--mips", "2"], ["--mips", "all"], ["--guard", "0"], ["--cutoff", "1"],
                        ["--cutoff", "0"], ["--level", "0"], ["--level", "7", "--rotate"], ["--max-level", "2"]):
            self.bake(leaf(alpha=lambda x, y: (x * 37 + y * 11) % 256), *options)

    def test_a_budget_holds(self):
        plain, _ = self.bake(leaf(64))
        for budget, option in ((700, "700"), (1024, "1K")):
            fitted, _ = self.bake(leaf(64), "--budget", option)
            self.assertLessEqual(fitted["bytes"]["data"] + fitted["bytes"]["records"], budget)
            self.assertLess(fitted["bytes"]["data"], plain["bytes"]["data"])

    def test_a_factor_without_texture_decides(self):
        asset = leaf()
        asset.doc["materials"][0]["pbrMetallicRoughness"] = {"baseColorFactor": [1, 1, 1, 0.25]}
        result, _ = self.bake(asset)
        self.assertEqual(result["special"]["transparent"], 2)

    def test_quiet_and_usual_output(self):
        self.write("in.glb", leaf().glb())
        usual = self.expect_done("bake", "in.glb", "-o", "out.glb")
        self.assertIn("micromaps", usual.stdout)
        quiet = self.expect_done("bake", "in.glb", "-o", "out.glb", "--quiet")
        self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))

    def test_raw_blobs_validate(self):
        self.write("in.glb", leaf().glb())
        self.expect_done("bake", "in.glb", "--raw", "raw")
        self.assertTrue((self.folder / "raw/manifest.json").exists())
        self.expect_done("validate", "raw")

    def test_a_baked_file_bakes_again(self):
        _, once = self.bake(leaf(), "--level", "3")
        self.write("again.glb", once)
        self.expect_done("bake", "again.glb", "-o", "twice.glb", "--level", "4")
        self.expect_done("validate", "twice.glb", "--deep")
        self.assertEqual(len(document((self.folder / "twice.glb").read_bytes())["extensions"][EXTENSION]["micromaps"]), 1)


class Inspect(CliTest):
    def test_page_and_pictures(self):
        self.write("in.glb", leaf().glb())
        self.expect_done("inspect", "in.glb", "-o", "page", "--json", "inspect.json")
        json.loads((self.folder / "inspect.json").read_text())
        self.assertIn("page/index.html", self.files())
        self.assertIn("map-view", (self.folder / "page/index.html").read_text())
        self.expect_done("inspect", "in.glb", "-o", "page", "--full")
        self.assertTrue(any(name.endswith(".png") for name in self.files()))


class Validate(CliTest):
    def baked(self):
        self.write("in.glb", leaf().glb())
        self.expect_done("bake", "in.glb", "-o", "out.glb", "--level", "5")
        return (self.folder / "out.glb").read_bytes()

    def test_a_breach_is_exit_1_with_its_path(self):
        glb = self.baked()
        broken = glb.replace(b'"usageLevels":[5]', b'"usageLevels":[6]')
        self.assertNotEqual(glb, broken)
        self.write("broken.glb", broken)
        result = self.run_program("validate", "broken.glb", "--json", "result.json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("/extensions/" + EXTENSION, result.stdout)
        result = json.loads((self.folder / "result.json").read_text())
        self.assertFalse(result["valid"])
        self.assertEqual(list(result["breaches"][0]), ["path", "rule", "message"])

    def test_a_false_state_is_exit_1(self):
        glb = bytearray(self.baked())
        doc = document(bytes(glb))
        micromap = doc["extensions"][EXTENSION]["micromaps"][0]
        view = doc["bufferViews"][micromap["data"]]
        start = 20 + struct.unpack_from("<I", glb, 12)[0] + 8 + view.get("byteOffset", 0)
        for i in range(start, start + view["byteLength"]):
            glb[i] ^= 0x55  # every state becomes the other side of its kind
        self.write("false.glb", bytes(glb))
        self.expect_done("validate", "false.glb")
        result = self.run_program("validate", "false.glb", "--deep")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("not valid", result.stdout)


if __name__ == "__main__":
    unittest.main()
