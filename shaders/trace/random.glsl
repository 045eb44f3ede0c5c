// Random numbers as functions of where they are used: those of the CPU backend, bit for bit.

// Mixes 32 bits well (the finaliser "lowbias32" of Wellons' hash prospector, 2018).
uint hashed(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}
uint hashed(uint a, uint b) {
    return hashed(a + 0x9e3779b9u * (hashed(b) | 1u));
}

// In [0, 1), in steps of 2^-24.
float unitFloat(uint bits) {
    return float(bits >> 8) * 5.9604644775390625e-8;
}

// A stream of numbers for one sample of one pixel.
struct RandomStream {
    uint key;
    uint count;
};
RandomStream randomStream(uint seed, uint pixel, uint sample_) {
    return RandomStream(hashed(seed, hashed(pixel, sample_)), 0u);
}
uint randomBits(inout RandomStream random) {
    return hashed(random.key, random.count++);
}
float randomFloat(inout RandomStream random) {
    return unitFloat(randomBits(random));
}
