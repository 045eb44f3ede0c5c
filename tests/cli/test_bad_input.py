"""Broken assets and a machine that fails: exit 1, one line, no output file, no crash, bounded memory."""

import os
import random
import shutil
import struct
import subprocess
import unittest

from asset import Asset, leaf, png
from program import CliTest

BAKE = ["bake", "in.glb", "-o", "out.glb", "--level", "3"]


class BadInput(CliTest):
    def expect_bake_error(self, data, says=""):
        self.write("in.glb", data)
        self.expect_error(1, *BAKE, says=says)
        self.expect_bounded_memory()

    def broken(self, change, says=""):
        asset = leaf()
        change(asset.doc)
        self.expect_bake_error(asset.glb(), says)

    def test_missing_and_empty(self):
        self.expect_error(1, "bake", "none.glb", "-o", "out.glb", says="none.glb")
        self.expect_error(1, "bake", ".", "-o", "out.glb")
        self.expect_bake_error(b"")
        self.expect_bake_error(b"not a scene")

    def test_truncated(self):
        glb = leaf(8).glb()
        for length in [*range(0, 64), *range(64, len(glb), 97), len(glb) - 1]:
            self.expect_bake_error(glb[:length], says="in.glb")

    def test_flipped_bits_never_crash(self):
        glb = leaf(8).glb()
        dice = random.Random(7)
        for _ in range(150):
            broken = bytearray(glb)
            broken[dice.randrange(len(glb))] ^= 1 << dice.randrange(8)
            self.write("in.glb", bytes(broken))
            result = self.run_program(*BAKE)
            self.assertIn(result.returncode, (0, 1), result.stderr)
        self.expect_bounded_memory()

    def test_claims_of_4_gib(self):
        glb = leaf().glb()
        for offset in (8, 12, 20 + struct.unpack_from("<I", glb, 12)[0]):
            self.expect_bake_error(glb[:offset] + b"\xf0\xff\xff\xff" + glb[offset + 4:], says="in.glb")
        self.broken(lambda doc: doc["accessors"][0].update(count=2**32 - 1), says="accessors")
        self.broken(lambda doc: doc["bufferViews"][0].update(byteLength=2**32 - 1), says="bufferViews")

    def test_accessor_past_its_buffer(self):
        self.broken(lambda doc: doc["accessors"][1].update(count=400), says="accessors")
        self.broken(lambda doc: doc["accessors"][1].update(byteOffset=2**53), says="accessors")
        self.broken(lambda doc: doc["accessors"][1].update(bufferView=99), says="accessors")

    def test_index_past_its_vertices(self):
        asset = leaf()
        data = bytearray(asset.bin)
        struct.pack_into("<H", data, asset.doc["bufferViews"][2]["byteOffset"] + 4, 4)
        asset.bin = bytes(data)
        self.expect_bake_error(asset.glb(), says="4")

    def test_image_that_does_not_decode(self):
        image = png(8, 8, lambda x, y: 200)
        self.expect_bake_error(leaf(image=image[:len(image) // 2]).glb(), says="image")
        self.expect_bake_error(leaf(image=b"\x89PNG\r\n\x1a\nnothing").glb(), says="image")
        huge = bytearray(image)
        struct.pack_into(">II", huge, 16, 2**31 - 1, 2**31 - 1)
        self.expect_bake_error(leaf(image=bytes(huge)).glb(), says="image")

    def test_recursion_in_nodes(self):
        self.broken(lambda doc: doc["nodes"][0].update(children=[0]), says="nodes")

        def circle(doc):
            doc["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [2]}, {"children": [1]}]
        self.broken(circle, says="nodes")

    def test_deep_json(self):
        asset = leaf()
        asset.doc["extras"] = "DEEP"
        text = asset.glb().replace(b'"DEEP"', b"[" * 100000 + b"]" * 100000)
        header = bytearray(text)
        struct.pack_into("<I", header, 8, len(text))
        struct.pack_into("<I", header, 12, struct.unpack_from("<I", text, 12)[0] + 200000 - 6)
        self.expect_bake_error(bytes(header))

    def test_empty_mesh(self):
        self.broken(lambda doc: doc["meshes"][0].update(primitives=[]), says="meshes")
        self.broken(lambda doc: doc["accessors"][0].update(count=0), says="accessors")

    def test_what_is_needed_but_unknown_is_named(self):
        self.broken(lambda doc: doc.update(extensionsUsed=["VENDOR_shape"], extensionsRequired=["VENDOR_shape"]),
                    says="VENDOR_shape")

        def compressed(doc):
            doc["images"][0]["mimeType"] = "image/ktx2"
            doc["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
            doc["extensionsUsed"] = doc["extensionsRequired"] = ["KHR_texture_basisu"]
        self.broken(compressed, says="KHR_texture_basisu")


class FailingMachine(CliTest):
    def setUp(self):
        super().setUp()
        self.write("in.glb", leaf().glb())

    def test_unwritable_output(self):
        self.expect_error(1, "bake", "in.glb", "-o", "none/out.glb", says="none/out.glb")
        self.expect_error(1, "bake", "in.glb", "-o", ".", says="cannot write")
        self.expect_error(1, "bake", "in.glb", "--raw", "in.glb", says="in.glb")
        self.expect_error(1, "inspect", "in.glb", "-o", "in.glb", says="in.glb")

    def test_full_device(self):
        self.expect_error(1, "bake", "in.glb", "-o", "/dev/full", says="/dev/full")
        self.expect_error(1, "bake", "in.glb", "-o", "/dev/null", "--quiet", "--json", "/dev/full", says="/dev/full")

    def test_full_disk(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(disk)]
        if not shutil.which("mount") or subprocess.run(mount, capture_output=True).returncode != 0:
            self.skipTest("a small disk cannot be mounted here")
        self.addCleanup(subprocess.run, ["umount", str(disk)])
        (disk / "old.glb").write_bytes(b"old")
        asset = leaf()
        asset.view(os.urandom(64 << 10))
        self.write("in.glb", asset.glb())
        self.expect_error(1, "bake", "in.glb", "-o", "disk/out.glb", says="disk/out.glb")
        self.expect_error(1, "bake", "in.glb", "-o", "disk/old.glb", says="disk/old.glb")
        self.assertEqual((disk / "old.glb").read_bytes(), b"old")


if __name__ == "__main__":
    unittest.main()
