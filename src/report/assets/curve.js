// The order of cells along the curve that subdivided triangles are stored in (VK_KHR_opacity_micromap): the same
// arithmetic as filigree/micromap/curve.h.

// Spreads the low 16 bits to the even places.
function spreadBits(bits) {
  bits = (bits | (bits << 8)) & 0x00ff00ff;
  bits = (bits | (bits << 4)) & 0x0f0f0f0f;
  bits = (bits | (bits << 2)) & 0x33333333;
  return (bits | (bits << 1)) & 0x55555555;
}

// The way back: the even places, gathered.
function gatherBits(bits) {
  bits &= 0x55555555;
  bits = (bits | (bits >>> 1)) & 0x33333333;
  bits = (bits | (bits >>> 2)) & 0x0f0f0f0f;
  bits = (bits | (bits >>> 4)) & 0x00ff00ff;
  return (bits | (bits >>> 8)) & 0x0000ffff;
}

// Each bit becomes the parity of itself and all higher ones, in the low 16 bits.
function prefixParity(bits) {
  bits ^= bits >>> 1;
  bits ^= bits >>> 2;
  bits ^= bits >>> 4;
  return bits ^ (bits >>> 8);
}

// Curve index of the cell at (i, j) of the lattice with 2^level steps a side; `flipped` is 0 or 1.
function curveIndexAt(i, j, flipped, level) {
  const mask = (1 << level) - 1;
  const w = ~(i + j) - flipped;
  const low = ~(i ^ w) & mask;
  const tie = (i ^ j) & low;
  const high = ((prefixParity(tie) ^ i) & ~low & mask) | tie;
  return (spreadBits(low) | (spreadBits(high) << 1)) >>> 0;
}

// Curve index of the cell that holds a point with the weights u and v of corners 1 and 2; in single precision, as
// the reference function has it.
function curveIndex(u, v, level) {
  const n = 1 << level;
  const scaledU = Math.fround(u > 0 ? Math.min(u, 1) : 0) * n;
  const scaledV = Math.fround(v > 0 ? Math.min(v, 1) : 0) * n;
  const floorU = Math.floor(scaledU);
  const floorV = Math.floor(scaledV);
  let i = Math.min(floorU, n - 1);
  const j = Math.min(floorV, n - 1);
  const sum = i + j;
  if (sum >= n) i -= sum - n + 1;
  const fractions = Math.fround((scaledU - floorU) + (scaledV - floorV));
  return curveIndexAt(i, j, fractions >= 1 && sum < n - 1 ? 1 : 0, level);
}

// The way back: the corners [i, j] x 3 of the cell at a curve index, in the lattice with 2^level steps a side.
function cellCorners(index) {
  const low = gatherBits(index);
  const high = gatherBits(index >>> 1);
  const turns = prefixParity(low & ~high);
  const swaps = prefixParity(low) >>> 1;
  const i = ((~low & (high ^ swaps)) ^ (turns >>> 1)) & 0xffff;
  const j = ((low & high) ^ (turns >>> 1)) & 0xffff;
  return (turns & 1) !== 0 ? [i + 1, j + 1, i, j + 1, i + 1, j] : [i, j, i + 1, j, i, j + 1];
}
