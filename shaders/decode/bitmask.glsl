// Encoding `bitmask`: a state for each cell of a texture (Waldemarson and Doggett 2024, section 5).
// docs/spec/bitmask.md asks for double precision; integers give the same cells on every device.
#include "blocks.glsl"

// A whole number of 64 bits, two's complement.
struct Whole {
    int high;
    uint low;
};

Whole plus(Whole a, Whole b) {
    uint carry;
    const uint low = uaddCarry(a.low, b.low, carry);
    return Whole(a.high + b.high + int(carry), low);
}
Whole wholeOf(int value) {
    return Whole(value >> 31, uint(value));
}
Whole negated(Whole a) {
    return plus(Whole(~a.high, ~a.low), wholeOf(1));
}
// A number that is not negative, times 2^-shift, 1 to 41, rounded down.
Whole shiftedDown(Whole a, uint shift) {
    if (shift >= 32u) return Whole(0, uint(a.high) >> (shift - 32u));
    return Whole(a.high >> shift, funnelShift(a.low, uint(a.high), shift));
}
// The remainder, not negative, of a number below 2^42 in size.
uint remainder(Whole a, uint divisor) {
    const Whole size = a.high < 0 ? negated(a) : a;
    const uint high = (uint(size.high) % divisor) * ((0xffffffffu % divisor + 1u) % divisor);
    const uint rest = (high + size.low % divisor) % divisor;
    return a.high < 0 && rest > 0u ? divisor - rest : rest;
}

struct BitmaskAxis {
    uint size;     // texels
    uint wrap;     // 0 repeat, 1 mirrored, 2 clamp
    uint between;  // 1: cells lie between the centres of texels
    uint extra;    // cells more than texels
};

BitmaskAxis bitmaskAxis(uint size, uint wrap, uint between) {
    return BitmaskAxis(size, wrap, between, wrap == 0u ? 0u : between);
}

// Which cell of an axis holds a coordinate: floor(coordinate * size - between / 2). False out of reach and for NaN.
bool findCell(BitmaskAxis axis, float coordinate, out Whole cell) {
    const uint bits = floatBitsToUint(coordinate);
    const uint field = (bits >> 23) & 255u;
    const uint fraction = bits & 0x7fffffu;
    const int exponent = field == 0u ? -149 : int(field) - 150;
    cell = wholeOf(0);
    if (exponent > 17) return false;
    // Half texels: the product is exact.
    uint high;
    uint low;
    umulExtended(field == 0u ? fraction : fraction | 0x800000u, 2u * axis.size, high, low);
    Whole halves = Whole(int(high), low);
    bool exact = true;
    if (exponent > 0) {
        halves = Whole(int((high << exponent) | (low >> (32 - exponent))), low << exponent);
    } else if (exponent < -41) {
        exact = (high | low) == 0u;
        halves = wholeOf(0);
    } else if (exponent < 0) {
        const uint shift = uint(-exponent);
        exact = (shift >= 32u ? low | lowBits(high, shift - 32u) : lowBits(low, shift)) == 0u;
        halves = shiftedDown(halves, shift);
    }
    if ((bits >> 31) != 0u) halves = plus(negated(halves), wholeOf(exact ? 0 : -1));
    halves = plus(halves, wholeOf(-int(axis.between)));
    // Below 2^40 texels in size.
    if (halves.high >= 512 || halves.high < -512) return false;
    if (halves.high == -512 && halves.low == 0u && exact) return false;
    cell = Whole(halves.high >> 1, funnelShift(halves.low, uint(halves.high), 1u));
    return true;
}

// Which of the stored cells a cell equals.
uint storedCell(BitmaskAxis axis, Whole cell) {
    const uint cells = axis.size + axis.extra;
    const Whole at = plus(cell, wholeOf(int(axis.extra)));
    if (at.high == 0 && at.low < cells) return at.low;
    if (axis.wrap == 2u) return at.high < 0 ? 0u : cells - 1u;
    const uint period = axis.wrap == 0u ? axis.size : 2u * axis.size;
    const uint inPeriod = remainder(at, period);
    return inPeriod < cells ? inPeriod : period - 1u + axis.extra - inPeriod;
}

// The state of a texture at the texture coordinates (u, v).
uint stateAt(uint texture_, float u, float v) {
    const uint mask = widthShift == 0u ? 1u : 3u;
    const uint sizes = descriptorWords[3u * texture_ + 1u];
    const uint flags = descriptorWords[3u * texture_ + 2u];
    const uint between = (~flags >> 4) & 1u;
    const BitmaskAxis columns = bitmaskAxis((sizes & 0xffffu) + 1u, flags & 3u, between);
    const BitmaskAxis rows = bitmaskAxis((sizes >> 16) + 1u, (flags >> 2) & 3u, between);
    Whole x;
    Whole y;
    if (!findCell(columns, u, x) || !findCell(rows, v, y)) return mask;
    uint high;
    uint low;
    umulExtended(storedCell(rows, y), columns.size + columns.extra, high, low);
    const Whole place = plus(Whole(int(high), low), wholeOf(int(storedCell(columns, x))));
    const uint statesShift = 3u - widthShift;  // log2 of the states in a byte
    const uint byte = descriptorWords[3u * texture_] + shiftedDown(place, statesShift).low;
    return (payloadByte(byte) >> (lowBits(place.low, statesShift) << widthShift)) & mask;
}
