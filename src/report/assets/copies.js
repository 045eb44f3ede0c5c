// Where triangles lie in the texture: parts beyond it come back into it as its wrap modes say.

const mostCopiesAlongAxis = 64;
const mostCopies = 500000;  // of all triangles together

// The pairs [offset, sign] that bring a coordinate range into [0, 1]: offset + sign * coordinate.
function copiesAlongAxis(lo, hi, wrap) {
  if (wrap === 'clamp') return [[0, 1]];
  const first = Math.floor(lo);
  const last = Math.min(Math.max(first, Math.ceil(hi) - 1), first + mostCopiesAlongAxis - 1);
  const copies = [];
  for (let tile = first; tile <= last; ++tile) {
    const mirrored = wrap === 'mirror' && Math.abs(tile) % 2 === 1;
    copies.push(mirrored ? [tile + 1, -1] : [-tile, 1]);
  }
  return copies;
}

// All copies of all triangles, in texels: six coordinates each, and the triangle that each is of.
class Copies {
  constructor(texture, triangles) {
    const corners = [];
    const owners = [];
    for (let t = 0; t < triangles.count && owners.length < mostCopies; ++t) {
      const uv = triangles.uv.map((column) => column[t]);
      if (!uv.every((x) => Math.abs(x) < 2 ** 20)) continue;
      const us = copiesAlongAxis(Math.min(uv[0], uv[2], uv[4]), Math.max(uv[0], uv[2], uv[4]), texture.wrap[0]);
      const vs = copiesAlongAxis(Math.min(uv[1], uv[3], uv[5]), Math.max(uv[1], uv[3], uv[5]), texture.wrap[1]);
      for (const [v0, vSign] of vs) {
        for (const [u0, uSign] of us) {
          for (let k = 0; k < 6; k += 2) {
            corners.push((u0 + uSign * uv[k]) * texture.width, (v0 + vSign * uv[k + 1]) * texture.height);
          }
          owners.push(t);
        }
      }
    }
    this.corners = Float64Array.from(corners);
    this.owners = Int32Array.from(owners);
  }

  // The weights of corners 1 and 2 at a point in texels, or nothing where it lies outside copy k.
  weightsAt(k, x, y) {
    const c = this.corners;
    const at = 6 * k;
    const ax = c[at + 2] - c[at];
    const ay = c[at + 3] - c[at + 1];
    const bx = c[at + 4] - c[at];
    const by = c[at + 5] - c[at + 1];
    const det = ax * by - ay * bx;
    if (det === 0) return null;
    const px = x - c[at];
    const py = y - c[at + 1];
    const u = (px * by - py * bx) / det;
    const v = (ax * py - ay * px) / det;
    return u >= 0 && v >= 0 && u + v <= 1 ? [u, v] : null;
  }
}
