"""compress, expand and compare, and validate on what compress writes."""

import json
import unittest

from asset import leaf
from program import CliTest

LOSSLESS = ("flat", "tree", "indexed-tree", "dag", "sdag")
SIZES = ["encoding", "level", "states", "payload_bytes", "descriptor_bytes", "seconds", "peak_bytes"]


def forest():
    """Two alpha sources, one of which two primitives share, and vertices in another order."""
    asset = leaf(64, alpha=lambda x, y: (x * 37 + y * 11) % 256)
    materials, primitives = asset.doc["materials"], asset.doc["meshes"][0]["primitives"]
    materials.append({**materials[0], "name": "own cutoff", "alphaCutoff": 0.25})
    turned = asset.accessor("H", 5123, "SCALAR", [(i,) for i in (2, 0, 1, 3, 0, 2)])
    primitives += [{**primitives[0], "material": 1}, {**primitives[0], "indices": turned}]
    return asset


class Encode(CliTest):
    def setUp(self):
        super().setUp()
        self.write("in.glb", forest().glb())

    def result(self, name):
        return json.loads((self.folder / name).read_text())

    def data(self, name):
        return (self.folder / name).read_bytes()

    def test_compress_and_expand_is_bake(self):
        for options in (["--level", "4"], ["--level", "5", "--states", "2"], [], ["--level", "0"], ["--mips", "1"]):
            self.expect_done("bake", "in.glb", "-o", "baked.glb", "--raw", "baked", *options)
            for encoding in LOSSLESS:
                with self.subTest(encoding=encoding, options=options):
                    self.expect_done("compress", "in.glb", "-o", "x.fil", "--encoding", encoding, *options)
                    self.expect_done("validate", "x.fil")
                    self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb", "--raw", "out")
                    self.assertEqual(self.data("out.glb"), self.data("baked.glb"))
                    for name in (name for name in self.files() if name.startswith("baked/")):
                        self.assertEqual(self.data(name), self.data(name.replace("baked/", "out/")), name)

    def test_json_results(self):
        self.expect_done("compress", "in.glb", "-o", "x.fil", "--encoding", "dag", "--level", "5", "--json", "c.json")
        compressed = self.result("c.json")
        self.assertEqual(list(compressed)[:7], SIZES)
        self.assertEqual((compressed["encoding"], compressed["level"], compressed["states"]), ("dag", 5, 4))
        self.assertEqual(compressed["file_bytes"], len(self.data("x.fil")))
        self.assertEqual(compressed["masked_triangles"], 6)
        self.assertGreater(compressed["peak_bytes"], 1 << 20)
        self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb", "--json", "e.json")
        expanded = self.result("e.json")
        self.assertEqual(list(expanded)[:7], SIZES)
        for key in SIZES[:5]:
            self.assertEqual(compressed[key], expanded[key], key)
        self.expect_done("compress", "in.glb", "-o", "x.fil", "--encoding", "dag", "--json", "c.json")
        self.assertIn(self.result("c.json")["level"], ("auto", 7))

    def test_same_bytes_for_any_thread_count(self):
        for encoding in LOSSLESS:
            one, two = (self.compressed("--encoding", encoding, "--threads", n) for n in (1, 2))
            self.assertEqual(one, two)

    def compressed(self, *options):
        self.expect_done("compress", "in.glb", "-o", "x.fil", *options)
        return self.data("x.fil")

    def test_zstd_is_smaller_and_the_same(self):
        plain = self.compressed("--encoding", "flat", "--level", "6")
        small = self.compressed("--encoding", "flat", "--level", "6", "--zstd")
        self.assertLess(len(small), len(plain))
        self.expect_done("validate", "x.fil")
        self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb")
        self.expect_done("bake", "in.glb", "-o", "baked.glb", "--level", "6")
        self.assertEqual(self.data("out.glb"), self.data("baked.glb"))

    def test_micromaps_that_a_scene_carries_are_kept(self):
        self.expect_done("bake", "in.glb", "-o", "baked.glb", "--level", "3", "--states", "2")
        self.expect_done("compress", "baked.glb", "-o", "x.fil", "--encoding", "tree", "--json", "c.json")
        self.assertEqual([self.result("c.json")[key] for key in ("level", "states")], [3, 2])
        self.expect_done("expand", "x.fil", "--asset", "baked.glb", "-o", "again.glb")
        self.expect_done("validate", "again.glb", "--deep")
        self.expect_done("compress", "again.glb", "-o", "y.fil", "--encoding", "tree")
        self.assertEqual(self.data("x.fil")[-64:], self.data("y.fil")[-64:])
        self.expect_done("compress", "baked.glb", "-o", "x.fil", "--encoding", "tree", "--level", "4", "--json", "c.json")
        self.assertEqual([self.result("c.json")[key] for key in ("level", "states")], [4, 4])

    def test_gruen_is_conservative(self):
        for states in ("2", "4"):
            self.compressed("--encoding", "gruen", "--level", "5", "--states", states)
            self.expect_done("validate", "x.fil")
            self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb")
            self.expect_done("validate", "out.glb", "--deep", "--json", "deep.json")
            self.assertEqual(self.result("deep.json")["deep"]["wrong"], 0)

    def test_bitmasks_are_textures_and_do_not_expand(self):
        for states, bits in (("2", 1), ("4", 2)):
            self.compressed("--encoding", "bitmask", "--states", states, "--json", "c.json")
            result = self.result("c.json")
            self.assertEqual((result["maps"], result["index_bytes"], result["level"]), (2, 0, "auto"))
            self.assertEqual(result["payload_bytes"], 2 * 64 * 64 * bits // 8)
            self.expect_done("validate", "x.fil")
            self.expect_error(1, "expand", "x.fil", "--asset", "in.glb", "-o", "out.glb", says="bitmask")

    def test_another_asset_is_an_error_that_names_both(self):
        self.compressed("--encoding", "tree")
        other = forest()
        other.doc["meshes"][0]["name"] = "other"
        self.write("other.glb", other.glb())
        self.expect_error(1, "expand", "x.fil", "--asset", "other.glb", "-o", "out.glb",
                          says="x.fil belongs to in.glb")
        self.expect_error(1, "expand", "x.fil", "--asset", "none.glb", "-o", "out.glb", says="none.glb")

    def test_a_damaged_file_is_an_error_and_a_breach(self):
        data = bytearray(self.compressed("--encoding", "tree", "--level", "5"))
        data[-1] ^= 1
        self.write("bad.fil", bytes(data))
        self.expect_error(1, "expand", "bad.fil", "--asset", "in.glb", "-o", "out.glb", says="bad.fil: section payload")
        result = self.run_program("validate", "bad.fil", "--json", "v.json")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(self.result("v.json")["breaches"][0]["rule"], "fil-container")
        for size in (0, 7, 8, 100, len(data) - 1):
            self.write("cut.fil", bytes(data[:size]))
            self.expect_error(1, "expand", "cut.fil", "--asset", "in.glb", "-o", "out.glb", says="cut.fil")

    def test_a_file_without_masks(self):
        asset = leaf(mode="OPAQUE")
        self.write("in.glb", asset.glb())
        for encoding in LOSSLESS:
            self.compressed("--encoding", encoding)
            self.expect_done("validate", "x.fil")
            self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb")

    def test_wrong_usage(self):
        self.expect_error(2, "compress", "in.glb", "-o", "x.fil", "--encoding", "zip", says="indexed-tree")
        self.expect_error(2, "compress", "in.glb", "-o", "x.fil", "--level", "13", says="--level")
        self.expect_error(2, "compress", "in.glb", "-o", "x.fil", "--budget", "1K", says="--budget")
        self.expect_error(2, "expand", "x.fil", "--asset", "in.glb", says="-o or --raw")
        for levels in ("13", "3-1", "x", "", "1,", "-1", "1-"):
            self.expect_error(2, "compare", "in.glb", f"--levels={levels}", says="--levels")
        self.expect_error(2, "compare", "in.glb", "--states", "3", says="--states")


class Loss(CliTest):
    """--max-bytes and its kin, --one-bit and --aggregates."""

    def setUp(self):
        super().setUp()
        self.write("in.glb", forest().glb())

    def compressed(self, *options):
        self.expect_done("compress", "in.glb", "-o", "x.fil", "--level", "5", "--json", "c.json", *options)
        self.expect_done("validate", "x.fil")
        return json.loads((self.folder / "c.json").read_text())

    def expect_no_lie(self):
        self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb")
        self.expect_done("validate", "out.glb", "--deep", "--json", "deep.json")
        self.assertEqual(json.loads((self.folder / "deep.json").read_text())["deep"]["wrong"], 0)

    def test_byte_bounds_are_kept_without_a_lie(self):
        for encoding in LOSSLESS + ("gruen",):
            with self.subTest(encoding=encoding):
                lossless = self.compressed("--encoding", encoding)
                bound = (lossless["payload_bytes"] + lossless["descriptor_bytes"]) // 2
                result = self.compressed("--encoding", encoding, "--max-bytes", bound)
                self.assertLessEqual(result["payload_bytes"] + result["descriptor_bytes"], bound)
                self.expect_no_lie()
                curve = result["curve"]
                self.assertEqual(list(curve[0]), ["bytes", "extra_anyhit", "known_share"])
                self.assertEqual(curve, sorted(curve, key=lambda p: -p["bytes"]))
                self.assertEqual(curve, sorted(curve, key=lambda p: p["extra_anyhit"]))
                self.assertIn(result["lossy"], curve)

    def test_loss_bounds_are_kept(self):
        for percent in (0, 1, 25):
            result = self.compressed("--max-extra-anyhit", percent)
            self.assertLessEqual(result["lossy"]["extra_anyhit"], percent / 100)
            self.expect_no_lie()
            result = self.compressed("--states", "2", "--max-changed-area", percent)
            self.assertLessEqual(result["lossy"]["changed_area"], percent / 100)
            self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb")
            self.expect_done("validate", "out.glb")

    def test_a_bound_out_of_reach_names_the_least(self):
        self.expect_error(1, "compress", "in.glb", "-o", "x.fil", "--max-bytes", "1", says="the least is")

    def test_one_bit_keeps_what_one_side_knows(self):
        for encoding in LOSSLESS + ("gruen",):
            with self.subTest(encoding=encoding):
                result = self.compressed("--encoding", encoding, "--one-bit")
                one_bit = result["one_bit"]
                self.assertEqual(sum(one_bit["maps"].values()), result["maps"])
                self.assertEqual(one_bit["bytes"], result["payload_bytes"] + result["descriptor_bytes"] +
                                 one_bit["pair_bytes"])
                self.assertLess(one_bit["bytes"], one_bit["four_state_bytes"])
                self.assertLessEqual(one_bit["known_share"], one_bit["four_state_known_share"])
                self.expect_no_lie()

    def test_aggregates_add_bytes_and_change_no_map(self):
        sizes, files = [], []
        for more in ((), ("--aggregates",)):
            self.expect_done("compress", "in.glb", "-o", "x.fil", "--level", "7", "--json", "c.json", *more)
            self.expect_done("expand", "x.fil", "--asset", "in.glb", "-o", "out.glb")
            sizes.append(json.loads((self.folder / "c.json").read_text())["payload_bytes"])
            files.append((self.folder / "out.glb").read_bytes())
        self.assertGreater(sizes[1], sizes[0])
        self.assertEqual(files[0], files[1])

    def test_wrong_usage(self):
        for options, says in (
                (("--max-bytes", "1K", "--one-bit"), "choose one"),
                (("--max-extra-anyhit", "-1"), "--max-extra-anyhit"),
                (("--max-changed-area", "1"), "--max-changed-area"),
                (("--max-extra-anyhit", "1", "--states", "2"), "--max-changed-area"),
                (("--one-bit", "--states", "2"), "--one-bit"),
                (("--one-bit", "--encoding", "bitmask"), "bitmask"),
                (("--aggregates", "--encoding", "dag"), "--aggregates"),
                (("--max-bytes", "many"), "--max-bytes")):
            self.expect_error(2, "compress", "in.glb", "-o", "x.fil", *options, says=says)


class Compare(CliTest):
    def test_rows_and_files(self):
        self.write("in.glb", forest().glb())
        result = self.expect_done("compare", "in.glb", "--levels", "2-4,6", "-o", "report", "--json", "c.json",
                                  "--html", "c.html")
        self.assertIn("indexed-tree", (self.folder / "c.html").read_text())
        self.assertIn("indexed-tree", result.stdout)
        self.assertIn("report/compare.csv", self.files())
        self.assertIn("report/compare_2_states.svg", self.files())
        compared = json.loads((self.folder / "c.json").read_text())
        self.assertEqual(list(compared)[:4], ["scene", "triangles", "masked_triangles", "rows"])
        self.assertEqual((compared["scene"], compared["masked_triangles"]), ("in.glb", 6))
        self.assertEqual(compared["texture_bytes"], 64 * 64)
        self.assertEqual((compared["vertex_bytes"], compared["triangle_index_bytes"]), (3 * 4 * 8, 6 * 12))
        rows = {(r["method"], r["level"], r["states"]): r for r in compared["rows"]}
        self.assertEqual({level for _, level, _ in rows}, {2, 3, 4, 6})
        for row in rows.values():
            self.assertEqual(list(row)[:7], ["method", "level", "states", "payload_bytes", "descriptor_bytes",
                                             "index_bytes", "total_bytes"])
            self.assertEqual(row["total_bytes"],
                             row["payload_bytes"] + row["descriptor_bytes"] + row["index_bytes"])
        self.agrees_with_compress(rows)

    def agrees_with_compress(self, rows):
        for method in LOSSLESS + ("gruen", "bitmask"):
            for states in (2, 4):
                self.expect_done("compress", "in.glb", "-o", "x.fil", "--encoding", method, "--level", "4", "--states",
                                 states, "--json", "x.json")
                compressed = json.loads((self.folder / "x.json").read_text())
                for key in ("payload_bytes", "descriptor_bytes", "index_bytes"):
                    self.assertEqual(rows[method, 4, states][key], compressed[key], (method, states, key))


if __name__ == "__main__":
    unittest.main()
