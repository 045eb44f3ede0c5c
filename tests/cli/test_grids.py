"""grids on meshes and heightfields, and what it refuses."""

import json
import math
import struct
import unittest
import zlib

from asset import disc, leaf, png
from program import CliTest

KEYS = {
    "triangles": None, "grids": None, "in_grid_share": None, "clusters": None, "codec": None, "step": None,
    "bytes": {"geometry", "bvh", "clusters", "attributes", "total"},
    "bytes_per_triangle": None,
    "error": {"rms", "max", "rms_over_diagonal", "max_over_diagonal", "subgrid_percent_mean", "subgrid_percent_max"},
    "seconds": {"convert", "encode", "build"},
}


def heights(width, height, value):
    """A 16-bit grey PNG."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = b"".join(b"\0" + b"".join(struct.pack(">H", value(x, y)) for x in range(width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def hills(x, y):
    return int(2000 + 900 * math.sin(x / 9) * math.cos(y / 7) + 40 * math.sin(3 * x + y))


def ply(vertices, faces, counts=None):
    """An ASCII PLY; `counts` are what its header claims."""
    vertex_count, face_count = counts or (len(vertices), len(faces))
    lines = ["ply", "format ascii 1.0", f"element vertex {vertex_count}", "property float x", "property float y",
             "property float z", f"element face {face_count}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(str(c) for c in v) for v in vertices]
    lines += [" ".join(str(i) for i in (len(f), *f)) for f in faces]
    return ("\n".join(lines) + "\n").encode()


def sheet(side, bump=0.1):
    """Quads over a bumpy square, all with the same diagonal."""
    at = lambda x, y: y * (side + 1) + x
    vertices = [(x, bump * math.sin(1.3 * x + 0.7 * y), y) for y in range(side + 1) for x in range(side + 1)]
    faces = [(at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)) for y in range(side) for x in range(side)]
    return vertices, faces


class Grids(CliTest):
    def setUp(self):
        super().setUp()
        self.write("hills.png", heights(65, 50, hills))
        self.write("sheet.ply", ply(*sheet(24)))
        self.write("leaf.glb", leaf(64).glb())

    def result(self, name="r.json"):
        return json.loads((self.folder / name).read_text())

    def grids(self, *args):
        done = self.expect_done("grids", *args, "-o", "out.fil", "--json", "r.json")
        self.expect_done("validate", "out.fil")
        return self.result(), done

    def test_result_has_the_keys(self):
        for codec in ("lattice", "paper"):
            result, done = self.grids("sheet.ply", "--codec", codec)
            self.assertEqual(list(result), list(KEYS))
            for key, parts in KEYS.items():
                if parts:
                    self.assertEqual(set(result[key]), parts)
            self.assertEqual((result["triangles"], result["grids"], result["codec"]), (1152, 1, codec))
            self.assertEqual(result["in_grid_share"], 1)
            sizes = result["bytes"]
            self.assertEqual(sizes["total"], sizes["geometry"] + sizes["bvh"] + sizes["clusters"])
            self.assertAlmostEqual(result["bytes_per_triangle"], sizes["total"] / 1152)
            for word in ("geometry", "BVH", "total", "sub-grids", "16 to 31"):
                self.assertIn(word, done.stdout)

    def test_match_paper_is_the_default(self):
        paper, _ = self.grids("sheet.ply", "--codec", "paper")
        for option in ([], ["--match-paper"]):
            lattice, _ = self.grids("sheet.ply", *option)
            self.assertLessEqual(lattice["error"]["rms"], paper["error"]["rms"])
            self.assertGreater(lattice["error"]["rms"], 0.9 * paper["error"]["rms"])
            self.assertLess(lattice["error"]["max"], paper["error"]["max"])

    def test_max_error_in_world_units_and_of_the_diagonal(self):
        diagonal = math.hypot(24, 24, 0.2)
        for text, bound in (("0.01", 0.01), ("1e-4d", 1e-4 * diagonal)):
            error = self.grids("sheet.ply", "--max-error", text)[0]["error"]
            self.assertLess(error["max"], bound * 1.001 + 1e-5)
            self.assertGreater(error["max"], bound / 3)

    def test_lossless_heights(self):
        result, _ = self.grids("hills.png", "--lossless", "--cell", "4", "--height-scale", "0.5")
        self.assertEqual((result["error"]["max"], result["triangles"], result["step"]), (0, 2 * 64 * 49, 0.5))

    def test_snap_closes_cracks(self):
        # A T of two grids, their sub-grids out of phase where they meet.
        vertices, faces = sheet(20)
        self.write("step.ply", ply(vertices, [f for k, f in enumerate(faces) if k // 20 < 10 or 3 <= k % 20 < 14]))
        cracked, done = self.grids("step.ply", "--codec", "paper")
        self.assertIn("cracks", done.stdout)
        snapped, done = self.grids("step.ply", "--codec", "paper", "--snap")
        self.assertIn("at 0 of", done.stdout)
        self.assertGreaterEqual(snapped["bytes"]["geometry"], cracked["bytes"]["geometry"])

    def test_displacements_differ(self):
        unit, _ = self.grids("sheet.ply", "--codec", "paper", "--displacement", "unit-vector")
        shared, _ = self.grids("sheet.ply", "--codec", "paper", "--displacement", "shared-exponent")
        self.assertLess(unit["error"]["rms"], shared["error"]["rms"])

    def test_same_bytes_for_any_thread_count(self):
        for codec in ("lattice", "paper"):
            files = []
            for threads in (1, 2):
                self.expect_done("grids", "hills.png", "-o", "x.fil", "--codec", codec, "--threads", threads)
                files.append((self.folder / "x.fil").read_bytes())
            self.assertEqual(*files)

    def test_attributes_and_zstd(self):
        asset = leaf(64)
        for material in asset.doc["materials"]:
            material["alphaMode"] = "OPAQUE"
        self.write("leaf.glb", asset.glb())
        with_all, _ = self.grids("leaf.glb", "--max-error", "1e-4d")
        size = (self.folder / "out.fil").stat().st_size
        without, _ = self.grids("leaf.glb", "--max-error", "1e-4d", "--no-attributes")
        self.assertGreater(with_all["bytes"]["attributes"], 0)
        self.assertEqual(without["bytes"]["attributes"], 0)
        self.assertLess((self.folder / "out.fil").stat().st_size, size)
        self.grids("hills.png", "--codec", "paper")
        size = (self.folder / "out.fil").stat().st_size
        self.grids("hills.png", "--codec", "paper", "--zstd")
        self.assertLess((self.folder / "out.fil").stat().st_size, size)

    def test_error_map(self):
        self.grids("hills.png", "--codec", "paper", "--error-map", "map.png")
        self.assertEqual((self.folder / "map.png").read_bytes()[:4], b"\x89PNG")

    def test_page(self):
        for name, codec in (("hills.png", "paper"), ("sheet.ply", "lattice")):
            self.grids(name, "--codec", codec, "--html", "page.html", "--size", "96x54")
            page = (self.folder / "page.html").read_text()
            for text in (f"Compressed grids of {name}", "Sub-grids by their error", "error, % of the sub-grid",
                         "Triangles by the size of their grid", "data-csv=\"total,", "--html page.html"):
                self.assertIn(text, page)
            self.assertEqual(page.count("data:image/png;base64,"), 4)
        self.expect_error(1, "grids", "hills.png", "-o", "x.fil", "--html", "missing/page.html", "--size", "48x27",
                          says="missing")
        self.expect_error(2, "grids", "hills.png", "-o", "x.fil", "--size", "0x27", says="0 x 27")

    def test_masked_triangles_are_left_out(self):
        self.expect_error(1, "grids", "leaf.glb", "-o", "x.fil", says="no triangles")

    def refuse(self, data, name, says, *args):
        self.write(name, data)
        self.expect_error(1, "grids", name, "-o", "x.fil", *args, says=says)

    def test_bad_meshes(self):
        vertices, faces = sheet(2)
        for number in ("nan", "inf"):
            self.refuse(ply([(number, 0, 0)] + vertices[1:], faces), "x.ply", "vertex 0")
        self.refuse(ply([(1, 2, 3)] * 9, faces), "x.ply", "one point")
        self.refuse(ply(vertices, [(0, 1, 99)]), "x.ply", "99")
        self.refuse(ply(vertices, faces, (9, 5)), "x.ply", "")
        self.refuse(ply(vertices, faces, (4000000000, 4)), "x.ply", "")
        self.refuse(ply(vertices, []), "x.ply", "")
        self.refuse(b"ply\n", "x.ply", "")
        for size in ((1, 9), (9, 1), (1, 1)):
            self.refuse(heights(*size, hills), "x.png", "")
        self.refuse(png(8, 8, disc(8)), "x.png", "grey")
        self.expect_error(1, "grids", "none.ply", "-o", "x.fil", says="none.ply")
        self.expect_bounded_memory()

    def test_bad_precision(self):
        self.expect_error(2, "grids", "sheet.ply", "-o", "x.fil", "--max-error", "1000", says="--max-error")
        self.expect_error(2, "grids", "sheet.ply", "-o", "x.fil", "--max-error", "2d", says="--max-error")
        self.expect_error(1, "grids", "sheet.ply", "-o", "x.fil", "--max-error", "1e-10", says="a step of")
        self.expect_error(2, "grids", "hills.png", "-o", "x.fil", "--cell", "0", says="cell")
        self.expect_error(2, "grids", "hills.png", "-o", "x.fil", "--height-scale", "nan", says="height")

    def test_backend_vulkan_renders_grids(self):
        small = ("--size", "48x32", "--spp", "1", "--integrator", "shadow", "--json", "r.json")
        device = ("--backend", "vulkan")
        tried = self.run_program("render", "leaf.glb", "-o", "out.png", *small, *device, "--method", "texture")
        if tried.returncode == 1:
            self.skipTest(tried.stderr.strip())
        self.grids("hills.png")
        self.expect_done("render", "out.fil", "-o", "cpu.png", *small)
        cpu = self.result()
        self.expect_done("render", "out.fil", "-o", "device.png", *small, *device)
        result = self.result()
        self.assertEqual(result["grids"]["triangles"], cpu["grids"]["triangles"])
        self.assertGreater(result["grids"]["bytes"], 0)
        self.assertAlmostEqual(result["rays"], cpu["rays"], delta=4)
        self.expect_done("render", "out.fil", "-o", "out.png", *small, *device, "--scene", "leaf.glb")
        self.grids("hills.png", "--codec", "paper")
        self.expect_error(1, "render", "out.fil", "-o", "out.png", *small, *device, says="codec paper")

    def test_truncated_files_are_refused(self):
        self.grids("sheet.ply")
        whole = (self.folder / "out.fil").read_bytes()
        for size in (0, 7, 24, 100, 1000, len(whole) - 1):
            self.write("part.fil", whole[:size])
            result = self.run_program("validate", "part.fil")
            self.assertEqual(result.returncode, 1, size)
        for verb in (["expand", "leaf.glb", "out.fil"], ["compress", "out.fil", "--encoding", "dag"]):
            result = self.run_program(*verb, "-o", "x.glb")
            self.assertNotEqual(result.returncode, 0)

    def test_flat_and_tiny_meshes(self):
        self.write("flat.ply", ply(*sheet(5, 0)))
        self.grids("flat.ply")
        self.grids("flat.ply", "--codec", "paper")
        self.write("one.ply", ply([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        result, _ = self.grids("one.ply")
        self.assertEqual((result["triangles"], result["grids"], result["clusters"]), (1, 0, 1))
        self.grids("one.ply", "--codec", "paper", "--snap")
        self.write("two.png", heights(2, 2, lambda x, y: x + y))
        self.grids("two.png", "--lossless")


if __name__ == "__main__":
    unittest.main()
