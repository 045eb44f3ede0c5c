"""bench lookup and bench encode: rows for all that was asked, and methods that agree."""

import json
import unittest

from asset import leaf
from program import CliTest

LOOKUP_KEYS = ["scene", "method", "level", "states", "pattern", "mode", "ns_per_lookup", "ratio_to_flat", "ratio_to_dag"]
ENCODE_KEYS = ["scene", "method", "level", "states", "nodes", "seconds_1", "seconds_n", "threads", "nodes_per_second",
               "speedup"]
METHODS = ["flat", "gruen", "bitmask", "tree", "indexed-tree", "dag", "sdag"]
MODES = ["dependent", "independent", "batch"]


class Bench(CliTest):
    def setUp(self):
        super().setUp()
        # A disc, and an alpha that leaves little known.
        self.write("leaf.glb", leaf(64).glb())
        self.write("noise.glb", leaf(64, alpha=lambda x, y: (x * 37 + y * 11) % 256).glb())

    def rows(self, *args):
        self.expect_done("bench", *args, "--json", "rows.json")
        return json.loads((self.folder / "rows.json").read_text())["rows"]

    def test_lookups_of_every_method_agree(self):
        rows = self.rows("lookup", "leaf.glb", "noise.glb", "--levels", "1,4,7", "--lookups", "20000", "--rounds", "1")
        got = [tuple(row[key] for key in LOOKUP_KEYS[:6]) for row in rows]
        # No ray leaves a flat scene to meet it again: there are no hits.
        wanted = [(scene, method, level, states, "random", mode) for scene in ("leaf.glb", "noise.glb")
                  for level in (1, 4, 7) for states in (2, 4) for method in METHODS for mode in MODES]
        self.assertEqual(sorted(got), sorted(wanted))
        for row in rows:
            self.assertEqual(list(row), LOOKUP_KEYS)
            self.assertGreater(row["ns_per_lookup"], 0)
            if row["method"] in ("flat", "dag"):
                self.assertEqual(row["ratio_to_" + row["method"]], 1)

    def test_lookups_of_chosen_methods(self):
        rows = self.rows("lookup", "leaf.glb", "--levels", "5", "--states", "2", "--methods", "sdag,tree", "--lookups",
                         "2", "--rounds", "2", "--patterns", "random")
        self.assertEqual([row["method"] for row in rows], ["tree"] * 3 + ["sdag"] * 3)
        self.assertEqual([row["ratio_to_dag"] for row in rows], [None] * 6)
        self.assertEqual(self.rows("lookup", "leaf.glb", "--levels", "0", "--states", "2", "--lookups", "2"), [])

    def test_encoders_are_timed_on_one_and_more_threads(self):
        rows = self.rows("encode", "leaf.glb", "--levels", "3,6", "--rounds", "1", "--threads", "2")
        self.assertEqual([(row["level"], row["states"], row["method"]) for row in rows],
                         [(level, states, method) for level in (3, 6) for states in (2, 4) for method in METHODS[3:]])
        for row in rows:
            self.assertEqual(list(row), ENCODE_KEYS)
            self.assertEqual((row["scene"], row["threads"]), ("leaf.glb", 2))
            self.assertAlmostEqual(row["nodes"] / row["seconds_1"], row["nodes_per_second"], delta=1)
            self.assertEqual(row["nodes"] % 4, 2)  # of two maps, 4 I + 1 each
        self.assertEqual(len(self.rows("encode", "leaf.glb", "--levels", "6", "--methods", "flat,gruen")), 4)

    def test_wrong_usage(self):
        for verb in ("lookup", "encode"):
            self.expect_error(2, "bench", verb)
            self.expect_error(1, "bench", verb, "none.glb", says="none.glb")
            for option, value in (("--levels", "13"), ("--rounds", "0"), ("--methods", "morton"), ("--states", "3")):
                self.expect_error(2, "bench", verb, "leaf.glb", option, value, says=option)
        for count in ("1", "100000000"):
            self.expect_error(2, "bench", "lookup", "leaf.glb", "--lookups", count, says="--lookups")
        self.expect_error(2, "bench", "lookup", "leaf.glb", "--patterns", "spiral", says="--patterns")
        self.expect_error(2, "bench", "encode", "leaf.glb", "--methods", "bitmask", says="bitmask")


if __name__ == "__main__":
    unittest.main()
