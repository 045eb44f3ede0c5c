"""bench grids: a row for each scene and method, ratios to stock Embree triangles, and leaks of closed shapes."""

import json
import unittest

from program import CliTest

METHODS = ["triangles", "triangles-compact", "triangles-qbvh8", "grids", "grids-compact", "paper", "lattice"]
KEYS = ["scene", "triangles", "method", "bytes_per_triangle", "build_seconds", "primary_mrays", "bounce_mrays", "ao_mrays",
        "ratio_primary", "ratio_bounce", "ratio_ao"]
PLY = """ply
format ascii 1.0
element vertex 9
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0.1 0
2 0 0
0 0.2 1
1 0.5 1
2 0.1 1
0 0 2
1 0.2 2
2 0 2
4 0 1 4 3
4 1 2 5 4
4 3 4 7 6
4 4 5 8 7
"""


class BenchGrids(CliTest):
    def bench(self, *args):
        self.expect_done("bench", "grids", *args, "--size", "48x32", "--rounds", "1", "--json", "rows.json")
        return json.loads((self.folder / "rows.json").read_text())

    def test_rows_of_shapes(self):
        result = self.bench("--sizes", "65,97", "--leak-rays", "4000", "--leak-size", "40")
        rows = result["rows"]
        scenes = ["terrain 65", "terrain 97", "torus 65", "torus 97"]
        self.assertEqual([(row["scene"], row["method"]) for row in rows], [(s, m) for s in scenes for m in METHODS])
        for row in rows:
            self.assertLessEqual(set(KEYS), set(row))
            self.assertEqual(row["triangles"], 2 * (int(row["scene"].split()[1]) - 1) ** 2)
            for key in KEYS[3:]:
                self.assertGreater(row[key], 0, key)
            if row["method"] == "triangles":
                self.assertEqual([row["ratio_primary"], row["ratio_bounce"], row["ratio_ao"]], [1, 1, 1])
        self.assertEqual(result["leaks"], {"rays": 4000, "misses": 0})
        self.assertIn("triangles-robust", {row["method"] for row in result["leaks_by_method"]})

    def test_files_and_methods(self):
        self.write("hill.ply", PLY.encode())
        rows = self.bench("hill.ply", "--methods", "lattice,paper", "--leak-rays", "0", "--html", "page.html")["rows"]
        self.assertEqual([(row["scene"], row["triangles"], row["method"]) for row in rows],
                         [("hill.ply", 8, method) for method in ("triangles", "paper", "lattice")])
        page = (self.folder / "page.html").read_text()
        for text in ("shuffled rays", "lattice, hill.ply: ", "data-csv=\"hill.ply,paper,8,", "--methods lattice,paper"):
            self.assertIn(text, page)

    def test_usage(self):
        for args, says in ((["--sizes", "3"], "--sizes 3"), (["--methods", "bvh"], "--methods bvh"),
                           (["--leak-size", "1"], "--leak-size 1"), (["hills.obj"], "hills.obj")):
            self.expect_error(2, "bench", "grids", *args, says=says)


if __name__ == "__main__":
    unittest.main()
