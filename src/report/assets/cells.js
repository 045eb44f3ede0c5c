// The maps of a texture: unpacked when first looked at, as trees whose nodes have four children.
//
// A child is a number: 0 to 3 a state of all that lies below, 4 + code four cells of the finest level with 2 bits
// each, innerBase + k inner node k of the same map.
const innerBase = 260;

const stateCount = 4;

// How many of the four cells in a code have a state: countsOfCode[code * 4 + state].
const countsOfCode = (() => {
  const counts = new Uint8Array(256 * stateCount);
  for (let code = 0; code < 256; ++code) {
    for (let k = 0; k < 4; ++k) ++counts[code * stateCount + ((code >> (2 * k)) & 3)];
  }
  return counts;
})();

// Four shares of one as bytes, which sum up to about 255.
function packShares(counts, total) {
  let packed = 0;
  for (let s = 0; s < stateCount; ++s) packed |= Math.round((255 * counts[s]) / total) << (8 * s);
  return packed >>> 0;
}

const sharesOfCode = (() => {
  const shares = new Uint32Array(256);
  for (let code = 0; code < 256; ++code) {
    shares[code] = packShares(countsOfCode.subarray(code * stateCount, code * stateCount + stateCount), 4);
  }
  return shares;
})();

// What stands for a node of mixed states where nothing finer is shown: the unknown state of the greater part's
// side, or of 2-state maps the side itself. States 1 and 3 are the opaque ones.
function mergedState(counts, total, states) {
  const opaque = 2 * (counts[1] + counts[3]) >= total ? 1 : 0;
  return states === 2 ? opaque : 2 + opaque;
}

// Reads one map, cut to `shown` levels.
class TreeReader {
  constructor(inner, finest, states) {
    this.inner = inner;
    this.finest = finest;
    this.states = states;
    this.innerAt = 0;
    this.finestAt = 0;
    this.children = [];
    this.shares = [];
  }

  // The node next in the streams, `height` levels above the finest; adds its cells to `counts`.
  read(height, depthLeft, counts) {
    const total = 4 ** height;
    const own = [0, 0, 0, 0];
    const value = height === 1 ? this.readFinest(own) : this.readInner(height, depthLeft, own);
    for (let s = 0; s < stateCount; ++s) counts[s] += own[s];
    return depthLeft > 0 ? value : mergedState(own, total, this.states);
  }

  readFinest(counts) {
    const code = this.finest[this.finestAt++];
    for (let s = 0; s < stateCount; ++s) counts[s] += countsOfCode[code * stateCount + s];
    return 4 + code;
  }

  readInner(height, depthLeft, counts) {
    const mask = this.inner[this.innerAt++];
    const states = this.inner[this.innerAt++];
    const node = depthLeft > 0 ? this.shares.length : -1;
    if (node >= 0) {
      this.shares.push(0);
      this.children.push(0, 0, 0, 0);
    }
    for (let k = 0; k < 4; ++k) {
      let child = (states >> (2 * k)) & 3;
      if ((mask >> k) & 1) {
        child = this.read(height - 1, depthLeft - 1, counts);
      } else {
        counts[child] += 4 ** (height - 1);
      }
      if (node >= 0) this.children[4 * node + k] = child;
    }
    if (node >= 0) this.shares[node] = packShares(counts, 4 ** height);
    return innerBase + node;
  }
}

// Columns of 32-bit numbers, each stored as four planes of bytes, which compress well.
class ColumnReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  numbers(count) {
    const out = new Uint32Array(count);
    for (let shift = 0; shift < 32; shift += 8, this.at += count) {
      for (let k = 0; k < count; ++k) out[k] |= this.bytes[this.at + k] << shift;
    }
    return out;
  }

  floats(count) { return new Float32Array(this.numbers(count).buffer); }

  rest(count) {
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
}

// Offsets of parts that follow each other, from their lengths.
function runningSums(lengths) {
  const sums = new Uint32Array(lengths.length + 1);
  for (let k = 0; k < lengths.length; ++k) sums[k + 1] = sums[k] + lengths[k];
  return sums;
}

class MapList {
  constructor(bytes, count) {
    const columns = new ColumnReader(bytes);
    this.count = count;
    this.record = columns.numbers(count);
    this.storedLevel = columns.numbers(count);
    this.level = columns.numbers(count);  // of the cells that the page holds
    this.states = columns.numbers(count);
    this.bytes = columns.numbers(count);
    this.sharers = columns.numbers(count);
    this.cells = Array.from({ length: stateCount }, () => columns.numbers(count));  // at the stored level
    const inner = columns.numbers(count);
    const finest = columns.numbers(count);
    this.innerFrom = runningSums(inner);
    this.finestFrom = runningSums(finest);
    this.inner = columns.rest(2 * this.innerFrom[count]);
    this.finest = columns.rest(this.finestFrom[count]);
    this.showLevel(12);
  }

  // No map is shown finer than this.
  showLevel(level) {
    this.most = level;
    this.trees = new Array(this.count);
  }

  unknownShare(map) {
    return (this.cells[2][map] + this.cells[3][map]) / 4 ** this.storedLevel[map];
  }

  shownLevel(map) { return Math.min(this.level[map], this.most); }

  tree(map) { return (this.trees[map] ??= this.unpack(map)); }

  unpack(map) {
    const level = this.shownLevel(map);
    const inner = this.inner.subarray(2 * this.innerFrom[map], 2 * this.innerFrom[map + 1]);
    const finest = this.finest.subarray(this.finestFrom[map], this.finestFrom[map + 1]);
    if (inner.length === 0 && finest.length === 0) {
      const state = [0, 1, 2, 3].find((s) => this.cells[s][map] > 0) ?? 0;
      return { root: state, level, children: new Uint32Array(0), shares: new Uint32Array(0) };
    }
    const reader = new TreeReader(inner, finest, this.states[map]);
    const root = reader.read(this.level[map], level, [0, 0, 0, 0]);
    return { root, level, children: Uint32Array.from(reader.children), shares: Uint32Array.from(reader.shares) };
  }

  // The state of the cell at a curve index of shownLevel(map).
  stateAt(map, index) {
    const { root, level, children } = this.tree(map);
    let value = root;
    for (let shift = 2 * (level - 1); value >= 4; shift -= 2) {
      const digit = (index >>> shift) & 3;
      value = value < innerBase ? ((value - 4) >> (2 * digit)) & 3 : children[4 * (value - innerBase) + digit];
    }
    return value;
  }
}

class TriangleList {
  constructor(bytes, count) {
    const columns = new ColumnReader(bytes);
    this.count = count;
    this.uv = Array.from({ length: 6 }, () => columns.floats(count));  // u0 v0 u1 v1 u2 v2
    this.map = new Int32Array(columns.numbers(count).buffer);  // or -1 - state for a triangle that is all one
    this.equals = columns.numbers(count);  // triangles of the scene that are the same
    this.mesh = columns.numbers(count);
    this.primitive = columns.numbers(count);
    this.triangle = columns.numbers(count);
  }

  // Of triangle t in the texture, square texels.
  area(t, width, height) {
    const [u0, v0, u1, v1, u2, v2] = this.uv.map((column) => column[t]);
    return (Math.abs((u1 - u0) * (v2 - v0) - (u2 - u0) * (v1 - v0)) * width * height) / 2;
  }
}

// The bytes in a script element of base64 around a zlib stream.
async function unpackBytes(element) {
  const text = atob(element.textContent);
  const packed = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) packed[k] = text.charCodeAt(k);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
