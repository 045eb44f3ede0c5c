"""The pages of the demo and of a scene: nothing on the console, and what they say is true."""

import csv
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from baked import Baked, barycentrics_to_index, weights
from webdriver import Browser, browser

PROGRAM = os.environ["FILIGREE"]
SHARED = Path(os.environ.get("FILIGREE_SHARED_DATA", "none"))
SCREENSHOTS = Path(os.environ["FILIGREE_SCREENSHOTS"])
SKIPPED = 77
STAGE = "document.querySelector('.map-view .stage')"


def program(*args):
    subprocess.run([PROGRAM, *map(str, args), "--quiet"], check=True)


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(*browser())
        cls.addClassCleanup(cls.browser.close)
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)

    def setUp(self):
        self.browser.size(1400, 900)
        self.browser.dark(False)

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])

    def open(self, page):
        """Opens a page with a view, until all is drawn; the seconds it took."""
        start = time.monotonic()
        self.browser.open(page)
        self.browser.wait(f"{STAGE}?.dataset.drawn")
        return time.monotonic() - start

    def picture(self, name):
        self.browser.save_screenshot(SCREENSHOTS / f"{name}.png")

    def box(self):
        """Of the stage in the window: left, top, width, height."""
        self.browser.run(f"{STAGE}.scrollIntoView({{block: 'center'}})")
        box = self.browser.run(f"return {STAGE}.getBoundingClientRect()")
        return box["left"], box["top"], box["width"], box["height"]

    def middle(self):
        left, top, width, height = self.box()
        return left + width / 2, top + height / 2

    def settled(self, act):
        """Does what changes the picture; the ms to the first answer and to the whole picture."""
        before = self.browser.run(f"return {STAGE}.dataset.ticket")
        act()
        self.browser.wait(f"{STAGE}.dataset.ticket !== '{before}' && {STAGE}.dataset.drawn")
        data = self.browser.run(f"return {{...{STAGE}.dataset}}")
        return float(data["answered"]), float(data["drawn"])

    def zoom(self, delta=-240):
        x, y = self.middle()
        return self.settled(lambda: self.browser.wheel(x, y, delta))

    def report(self, name, seconds):
        zooms = [self.zoom() for _ in range(4)]
        answered = ", ".join(f"{first:.0f} ({whole:.0f})" for first, whole in zooms)
        print(f"{name}: opened in {seconds:.2f} s; zooms answered in {answered} ms (whole picture)")

    def texel(self, x, y):
        """What lies at a place in the window."""
        return self.browser.run("""
            const [x, y] = arguments;
            const stage = window.filigree.views[0].stage;
            const box = stage.host.getBoundingClientRect();
            return stage.texelAt((x - box.left) * stage.ratio, (y - box.top) * stage.ratio);""", x, y)

    def facts(self):
        return self.browser.run("""
            return Object.fromEntries([...document.querySelectorAll('[data-fact]')].map(
                (fact) => [fact.dataset.fact, fact.textContent]));""")

    def choose(self, label, value):
        """An option of a select of the view."""
        self.browser.click(f".map-view select[aria-label='{label}'] option[value='{value}']")

    def column(self, table, number):
        rows = self.browser.run("""
            return [...document.querySelector(arguments[0]).tBodies[0].rows].map((row) => row.dataset.csv);""", table)
        return [row[number] for row in csv.reader(rows)]

    def expect_sorted(self, table, number):
        heading = f"{table} thead th:nth-child({number + 1}) button"
        self.browser.click(heading)
        falling = [float(x) for x in self.column(table, number) if x]
        self.assertEqual(falling, sorted(falling, reverse=True))
        self.browser.click(heading)
        self.assertEqual([float(x) for x in self.column(table, number) if x], falling[::-1])


class DemoPage(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        program("demo", "-o", cls.folder, "--max-level", "6", "--spp", "1")
        cls.baked = Baked((cls.folder / "scene_omm.glb").read_bytes())

    def setUp(self):
        super().setUp()
        self.seconds = self.open(self.folder / "index.html")

    def expect_true(self, x, y):
        """What the page says of a place is what the file says; whether a triangle is there."""
        self.browser.move(x, y)
        facts = self.facts()
        if "triangle" not in facts:
            return False
        mesh, primitive, triangle = map(int, re.match(r"mesh (\d+), primitive (\d+), triangle (\d+)", facts["triangle"]).groups())
        meta = self.browser.run("return window.filigree.views[0].data.meta")
        tu, tv = self.texel(x, y)
        uv = weights(self.baked.uvs(mesh, primitive, triangle), tu / meta["width"], tv / meta["height"])
        record, level, index, state = self.baked.state(mesh, primitive, triangle, uv)
        self.assertEqual(facts["state"], state, facts)
        shown = [float(b) for b in facts["barycentrics"].split(", ")]
        for told, true in zip(shown, (1 - sum(uv), *uv)):
            self.assertAlmostEqual(told, true, delta=2e-4)
        if record < 0:
            self.assertEqual(facts["record"], f"special index {record}")
        else:
            self.assertTrue(facts["record"].replace(",", "").startswith(f"{record} level {level} "), facts)
            self.assertEqual(facts["index"].replace(",", ""), f"{index} of {4**level}")
        return True

    def test_hovering_tells_the_truth(self):
        self.zoom()
        left, top, width, height = self.box()
        random.seed(7)
        places = [(left + width * random.uniform(0.1, 0.9), top + height * random.uniform(0.1, 0.9)) for _ in range(12)]
        told = [self.expect_true(round(x), round(y)) for x, y in places]
        self.assertGreater(sum(told), 6)
        self.picture("demo-hover")

    def test_a_coarser_level_has_fewer_micro_triangles(self):
        self.settled(lambda: self.choose("Finest level shown", 2))
        x, y = self.middle()
        self.browser.move(x + 40, y + 100)
        facts = self.facts()
        self.assertRegex(facts["record"], "shown at level 2")
        self.assertRegex(facts["index"], r"^\d+ of 16$")
        self.picture("demo-level-2")

    def test_every_mode_and_texture_draws(self):
        for texture in range(5):
            if texture > 0:
                self.browser.run(f"delete {STAGE}.dataset.drawn")
                self.choose("Texture", texture)
                self.browser.wait(f"document.querySelector('.map-view').dataset.ready === 'yes' && {STAGE}.dataset.drawn")
            for mode in ("overlaps", "mean", "states"):
                self.settled(lambda: self.choose("What is drawn", mode))
                self.assertGreater(self.coloured(), 1000, f"{mode} of texture {texture}")

    def coloured(self):
        """Pixels of the middle canvas that are more than faint."""
        return self.browser.run("""
            const canvas = document.querySelector('.map-view canvas.cells');
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const data = copy.getImageData(0, 0, canvas.width, canvas.height).data;
            let count = 0;
            for (let k = 3; k < data.length; k += 4) count += data[k] > 128;
            return count;""")

    def test_a_state_that_is_not_ticked_is_clear(self):
        before = self.coloured()
        self.settled(lambda: self.browser.click(".map-view fieldset label:nth-of-type(1) input"))
        self.assertLess(self.coloured(), before / 2, "most of the leaves' texture is transparent")
        self.picture("demo-filtered")

    def test_tables_sort_and_costs_jump(self):
        self.expect_sorted(".map-view .costs table", 3)
        self.expect_sorted("figure.table table", 1)
        self.settled(lambda: self.browser.click(".map-view .costs tbody tr button"))
        self.assertIn("triangle", self.facts())

    def test_the_curve_is_the_specification_s(self):
        random.seed(11)
        points = [(random.uniform(0, 1), random.uniform(0, 1), random.randint(0, 12)) for _ in range(2000)]
        points = [(u, v, level) for u, v, level in points if u + v <= 1]
        expected = [barycentrics_to_index(*point) for point in points]
        golden = SHARED / "golden/barycentric_to_index.csv"
        if golden.exists():
            for row in csv.DictReader(golden.read_text().splitlines()):
                u, v = (struct.unpack(">f", bytes.fromhex(row[bits].zfill(8)))[0] for bits in ("u_bits", "v_bits"))
                points.append((u, v, int(row["level"])))
                expected.append(int(row["index"]))
        points = [[repr(u), repr(v), level] for u, v, level in points]
        told = self.browser.run("return arguments[0].map(([u, v, level]) => window.filigree.curveIndex(+u, +v, level));", points)
        self.assertEqual(told, expected)

    def test_pages_fit_every_window(self):
        pages = {"demo": "index.html", "compare": "compare.html", "vq": "vq/index.html", "view": "view.html",
                 "terrain": "terrain.html", "terrain-view": "terrain-view.html"}
        for (width, height, phone) in ((1400, 900, False), (390, 844, True)):
            for name, page in pages.items():
                self.browser.size(width, height, phone)
                self.browser.dark(phone)
                self.browser.open(self.folder / page)
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width, page)
                self.picture(f"{name}-{width}")
                self.expect_sorted("figure.table table", 1)

    def test_the_index_leads_to_every_page(self):
        links = self.browser.run("return [...document.querySelectorAll('main a[href]')].map((a) => a.getAttribute('href'));")
        files = {link for link in links if not link.startswith("#")}
        pages = {str(page.relative_to(self.folder)) for page in self.folder.rglob("*.html")} - {"index.html"}
        self.assertLessEqual(pages, files)
        self.assertGreaterEqual(len(pages), 5)
        for file in files:
            self.assertTrue((self.folder / file).exists(), file)

    def test_pictures_have_their_scales(self):
        for page, scales in (("view.html", 8), ("terrain.html", 2)):
            self.browser.open(self.folder / page)
            broken = self.browser.run("return [...document.images].filter((image) => !image.naturalWidth).length;")
            self.assertEqual(broken, 0, page)
            self.assertGreaterEqual(self.browser.run("return document.querySelectorAll('figure img ~ .scale svg, figure a ~ .scale svg').length;"), scales, page)

    def test_times(self):
        self.report("demo", self.seconds)


@unittest.skipUnless((SHARED / "data/scenes/crytek_sponza.glb").exists(), "no shared scenes here")
class SponzaPage(PageTest):
    def test_opens_zooms_and_answers(self):
        program("inspect", SHARED / "data/scenes/crytek_sponza.glb", "-o", self.folder)
        page = self.folder / "index.html"
        self.assertLess(page.stat().st_size, 10_000_000)
        seconds = self.open(page)
        self.box()
        self.picture("sponza")
        self.report("sponza", seconds)
        x, y = self.middle()
        self.browser.move(x, y)
        self.assertRegex(self.facts()["overlaps"], "distinct triangles|this triangle alone")
        self.picture("sponza-zoomed")
        self.settled(lambda: self.choose("What is drawn", "overlaps"))
        self.expect_sorted(".map-view .costs table", 6)


if __name__ == "__main__":
    if browser() is None:
        print("skipped: no chromium and chromedriver here (Debian: chromium, chromium-driver)")
        sys.exit(SKIPPED)
    if os.environ.get("FILIGREE_TARGET"):
        print("skipped: pages are the same for every instruction set")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
