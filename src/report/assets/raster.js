// Triangles into pixels, in three ways: the states of the topmost triangle, the mean over all triangles that lie over
// a pixel, or how many these are. Each pixel is looked up on its own, so a picture is exact however deep the zoom.

const hiddenPixel = 1;        // covered, and clear
const gridFrom = 4;           // pixels of a cell's least height from which its outline shows
const leastCell = 0.75;       // pixels of a cell's edge; finer nodes are mixed
const outlineFromEdge = 7;    // pixels of a triangle's longest edge

const packColour = ([r, g, b], alpha) => ((alpha << 24) | (b << 16) | (g << 8) | r) >>> 0;

// What of the states is shown, and in which colours.
class Palette {
  constructor(colours, visible) {
    this.colours = colours;
    this.visible = visible;
    this.pixels = Uint32Array.from(colours, (c, s) => (visible[s] ? packColour(c, 255) : hiddenPixel));
    this.codes = Uint32Array.from(sharesOfCode, (shares) => this.mixed(shares));
  }

  // The colour of a node of mixed states; hidden ones leave it clearer.
  mixed(shares) {
    const sum = [0, 0, 0];
    let total = 0;
    for (let s = 0; s < stateCount; ++s) {
      const share = (shares >>> (8 * s)) & 255;
      if (!this.visible[s]) continue;
      total += share;
      for (let k = 0; k < 3; ++k) sum[k] += share * this.colours[s][k];
    }
    return total === 0 ? hiddenPixel : packColour(sum.map((x) => Math.round(x / total)), Math.min(total, 255));
  }
}

// One triangle laid over pixels: b1 and b2 at pixel (x, y) are b1At + b1X * x + b1Y * y.
function layTriangle(corners, at, scale, left, top) {
  const x0 = left + scale * corners[at];
  const y0 = top + scale * corners[at + 1];
  const ax = scale * (corners[at + 2] - corners[at]);
  const ay = scale * (corners[at + 3] - corners[at + 1]);
  const bx = scale * (corners[at + 4] - corners[at]);
  const by = scale * (corners[at + 5] - corners[at + 1]);
  const det = ax * by - ay * bx;
  const longest = Math.max(Math.hypot(ax, ay), Math.hypot(bx, by), Math.hypot(bx - ax, by - ay));
  return {
    det,
    longest,
    lowX: Math.min(x0, x0 + ax, x0 + bx),
    highX: Math.max(x0, x0 + ax, x0 + bx),
    lowY: Math.min(y0, y0 + ay, y0 + by),
    highY: Math.max(y0, y0 + ay, y0 + by),
    b1X: by / det,
    b1Y: -bx / det,
    b1At: (0.5 - x0) * (by / det) + (0.5 - y0) * (-bx / det),
    b2X: -ay / det,
    b2Y: ax / det,
    b2At: (0.5 - x0) * (-ay / det) + (0.5 - y0) * (ax / det),
  };
}

// The pixels [first, end) of a row in which a weight from + step * x is not negative, within [first, end) given.
function narrow(range, from, step) {
  if (step > 0) {
    range.first = Math.max(range.first, Math.ceil(-from / step));
  } else if (step < 0) {
    range.end = Math.min(range.end, Math.ceil(-from / step));
  } else if (from < 0) {
    range.end = range.first;
  }
}

// Calls span(y, first, end) for each row of the triangle within the box.
function forEachSpan(t, box, span) {
  const yEnd = Math.min(box.bottom, Math.ceil(t.highY));
  const range = { first: 0, end: 0 };
  for (let y = Math.max(box.top, Math.floor(t.lowY)); y < yEnd; ++y) {
    range.first = box.left;
    range.end = box.right;
    const b1 = t.b1At + t.b1Y * y;
    const b2 = t.b2At + t.b2Y * y;
    narrow(range, b1, t.b1X);
    narrow(range, b2, t.b2X);
    narrow(range, 1 - b1 - b2, -t.b1X - t.b2X);
    if (range.first < range.end) span(y, range.first, range.end);
  }
}

// Curve index of the cell that holds weights (b1, b2), n = 2^level.
function cellAt(b1, b2, n, level) {
  const u = b1 > 0 ? b1 * n : 0;
  const v = b2 > 0 ? b2 * n : 0;
  let i = u < n ? u | 0 : n - 1;
  const j = v < n ? v | 0 : n - 1;
  const sum = i + j;
  if (sum >= n) i -= sum - n + 1;
  return curveIndexAt(i, j, sum < n - 1 && u - i + (v - j) >= 1 ? 1 : 0, level);
}

// A triangle's map as it is looked up at one scale: nodes finer than a pixel show the mean of what is below them.
class Lookup {
  constructor(maps, map, longest, palette) {
    this.palette = palette;
    if (map < 0) {
      this.level = 0;
      this.root = -1 - map;
      return;
    }
    const { root, level, children, shares } = maps.tree(map);
    this.root = root;
    this.children = children;
    this.shares = shares;
    this.level = Math.max(0, Math.min(level, Math.floor(Math.log2(longest / leastCell))));
    this.mapLevel = level;
  }

  // The colour of the cell at a curve index of `level`.
  pixel(index) {
    let value = this.root;
    for (let shift = 2 * (this.level - 1); value >= 4 && shift >= 0; shift -= 2) {
      const digit = (index >>> shift) & 3;
      value = value < innerBase ? ((value - 4) >>> (2 * digit)) & 3 : this.children[4 * (value - innerBase) + digit];
    }
    if (value < 4) return this.palette.pixels[value];
    return value < innerBase ? this.palette.codes[value - 4] : this.palette.mixed(this.shares[value - innerBase]);
  }
}

const darker = (pixel, share) => {
  const keep = 1 - share;
  const r = (pixel & 255) * keep;
  const g = ((pixel >>> 8) & 255) * keep;
  const b = ((pixel >>> 16) & 255) * keep;
  return ((pixel & 0xff000000) | (b << 16) | (g << 8) | r) >>> 0;
};

// How dark the lines are at a pixel: the outlines of cells that are large enough, and of the triangle.
class Lines {
  constructor(t, level) {
    const n = 2 ** level;
    const flat = Math.hypot(t.b1X + t.b2X, t.b1Y + t.b2Y);
    this.n = n;
    this.heights = [1 / Math.hypot(t.b1X, t.b1Y), 1 / Math.hypot(t.b2X, t.b2Y), 1 / flat];
    const thin = Math.min(...this.heights) / n;
    this.grid = level > 0 && thin >= gridFrom ? Math.min(0.15 + (thin - gridFrom) * 0.025, 0.5) : 0;
    this.outline = t.longest >= outlineFromEdge ? 0.8 : 0;
    this.shown = this.grid > 0 || this.outline > 0;
  }

  at(b1, b2) {
    const [h1, h2, h0] = this.heights;
    const b0 = 1 - b1 - b2;
    const edge = Math.min(b1 * h1, b2 * h2, b0 * h0);
    if (edge < 1) return this.outline * Math.min(1, 1.4 - edge);
    if (this.grid === 0) return 0;
    const near = (b, h) => Math.abs(b * this.n - Math.round(b * this.n)) * (h / this.n);
    return this.grid * Math.max(0, 1 - Math.min(near(b1, h1), near(b2, h2), near(b0, h0)));
  }
}

// One picture in the making. The view puts texel (x, y) at pixel (left + scale * x, top + scale * y).
class Raster {
  constructor(width, height, view, texture) {
    this.width = width;
    this.height = height;
    this.view = view;
    this.box = {
      left: Math.max(0, Math.round(view.left)),
      top: Math.max(0, Math.round(view.top)),
      right: Math.min(width, Math.round(view.left + view.scale * texture.width)),
      bottom: Math.min(height, Math.round(view.top + view.scale * texture.height)),
    };
    this.pixels = new Uint32Array(width * height);
    this.left = Math.max(0, this.box.right - this.box.left) * Math.max(0, this.box.bottom - this.box.top);
  }

  // Calls each(copy, triangle) for the copies in sight, topmost first. A generator: yields between copies.
  * inSight(copies, isShown, each) {
    const { scale, left, top } = this.view;
    for (let k = copies.owners.length - 1; k >= 0; --k) {
      if (!isShown(copies.owners[k])) continue;
      const t = layTriangle(copies.corners, 6 * k, scale, left, top);
      if (t.det === 0 || t.highX <= this.box.left || t.lowX >= this.box.right) continue;
      if (t.highY <= this.box.top || t.lowY >= this.box.bottom) continue;
      each(k, t);
      yield;
    }
  }

  // Front to back: what is covered is not looked up again.
  * states(copies, triangles, maps, isShown, palette) {
    const pixels = this.pixels;
    const walk = this.inSight(copies, isShown, (k, t) => {
      const lookup = new Lookup(maps, triangles.map[copies.owners[k]], t.longest, palette);
      const lines = new Lines(t, lookup.level === lookup.mapLevel ? lookup.level : 0);
      const n = 2 ** lookup.level;
      forEachSpan(t, this.box, (y, first, end) => {
        const row = y * this.width;
        for (let x = first; x < end; ++x) {
          if (pixels[row + x] !== 0) continue;
          const b1 = t.b1At + t.b1Y * y + t.b1X * x;
          const b2 = t.b2At + t.b2Y * y + t.b2X * x;
          let pixel = lookup.pixel(cellAt(b1, b2, n, lookup.level));
          if (lines.shown) {
            const share = lines.at(b1, b2);
            if (share > 0) pixel = pixel === hiddenPixel ? ((share * 140) << 24) >>> 0 : darker(pixel, share);
          }
          pixels[row + x] = pixel === 0 ? hiddenPixel : pixel;
          --this.left;
        }
      });
    });
    for (const step of walk) {
      if (this.left <= 0) return;
      yield step;
    }
  }

  // The mean colour of all triangles over each pixel.
  * mean(copies, triangles, maps, isShown, palette) {
    const sums = new Float32Array(4 * this.pixels.length);
    const counts = new Uint32Array(this.pixels.length);
    yield* this.inSight(copies, isShown, (k, t) => {
      const lookup = new Lookup(maps, triangles.map[copies.owners[k]], t.longest, palette);
      const n = 2 ** lookup.level;
      forEachSpan(t, this.box, (y, first, end) => {
        for (let x = first, at = y * this.width + first; x < end; ++x, ++at) {
          const b1 = t.b1At + t.b1Y * y + t.b1X * x;
          const b2 = t.b2At + t.b2Y * y + t.b2X * x;
          const pixel = lookup.pixel(cellAt(b1, b2, n, lookup.level));
          const alpha = pixel >>> 24;
          sums[4 * at] += alpha * (pixel & 255);
          sums[4 * at + 1] += alpha * ((pixel >>> 8) & 255);
          sums[4 * at + 2] += alpha * ((pixel >>> 16) & 255);
          sums[4 * at + 3] += alpha;
          ++counts[at];
        }
      });
    });
    for (let at = 0; at < counts.length; ++at) {
      const alpha = sums[4 * at + 3];
      if (alpha === 0) continue;
      const colour = [0, 1, 2].map((c) => Math.round(sums[4 * at + c] / alpha));
      this.pixels[at] = packColour(colour, Math.min(255, Math.round(alpha / counts[at])));
    }
  }

  // How many triangles lie over each pixel, by `heat(count)`.
  * overlaps(copies, isShown, heat) {
    yield* this.inSight(copies, isShown, (k, t) => {
      forEachSpan(t, this.box, (y, first, end) => {
        const row = y * this.width;
        for (let x = row + first; x < row + end; ++x) ++this.pixels[x];
      });
    });
    const colours = new Map();
    for (let at = 0; at < this.pixels.length; ++at) {
      const count = this.pixels[at];
      if (count === 0) continue;
      let pixel = colours.get(count);
      if (pixel === undefined) colours.set(count, (pixel = heat(count)));
      this.pixels[at] = pixel;
    }
  }

  image() {
    return new ImageData(new Uint8ClampedArray(this.pixels.buffer), this.width, this.height);
  }
}
