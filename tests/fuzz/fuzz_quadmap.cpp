// Any bits as maps: every pattern decodes, and batches agree with single lookups. The same bytes as a square:
// what the encoders make of it is conservative, and the same again.
#include "filigree/core/target.h"
#include "filigree/quadmap/encode.h"
#include "filigree/quadmap/reader.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace filigree;
using namespace filigree::quadmap;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

// Looks up every region of every map.
void lookUpAll(const SquareReader& reader) {
    const unsigned side = sideOf(reader.format());
    std::vector<uint32_t> maps;
    std::vector<Half> halves;
    std::vector<float> u;
    std::vector<float> v;
    for (uint32_t map = 0; map < std::min<size_t>(reader.mapCount(), 4); ++map) {
        for (unsigned k = 0; k < side * side; ++k) {
            maps.push_back(map);
            halves.push_back(static_cast<Half>(k % 2));
            u.push_back((static_cast<float>(k % side) + 0.5F) / static_cast<float>(side));
            v.push_back((static_cast<float>(k / side) + 0.5F) / static_cast<float>(side));
        }
    }
    std::vector<Region> regions(maps.size());
    reader.lookup(maps, halves, u, v, regions);
    for (size_t k = 0; k < maps.size(); ++k) {
        if (regions[k] > Region::opaque) fail("a map holds what is no state");
        if (regions[k] != reader.at(maps[k], halves[k], u[k], v[k])) fail("a batch differs from at()");
    }
}

Square squareOf(std::span<const uint8_t> bytes, unsigned side) {
    Square square(side);
    for (size_t k = 0; k < square.regions.size() && !bytes.empty(); ++k) {
        square.regions[k] = static_cast<Region>(bytes[k / 4 % bytes.size()] >> (2 * (k % 4)) & 3);
    }
    return square;
}

template <class Encode>
void tryEncoder(SquareFormat format, const Square& square, const Encode& encode) {
    const auto block = encode();
    if (block != encode()) fail("two blocks of one square differ");
    const auto reader = SquareReader::open(format, block);
    if (!reader.ok()) fail("a block is refused");
    if (!isConservative(square, reader->decode(0))) fail("a map is not conservative");
}

void encodeAll(std::span<const uint8_t> bytes, unsigned which, Prefer prefer) {
    const Square small = squareOf(bytes, vq2Side);
    const Square large = squareOf(bytes, vq4Side);
    using enum SquareFormat;
    switch (which) {
        case 0:
            tryEncoder(vq2, small, [&] { return encodeVq2(small, Vq2Method::paperLiteral, prefer); });
            break;
        case 1:
            tryEncoder(vq2, small, [&] { return encodeVq2(small, Vq2Method::paperSensible, prefer); });
            break;
        case 2:
            tryEncoder(vq2, small, [&] { return encodeVq2(small, Vq2Method::best, prefer); });
            break;
        case 3:
            tryEncoder(vq2Plus, small, [&] { return encodeVq2Plus(small, prefer); });
            break;
        case 4:
            tryEncoder(vq4, large, [&] { return encodeVq4(large, Vq4Method::paper, prefer); });
            break;
        case 5:
            tryEncoder(vq4, large, [&] { return encodeVq4(large, Vq4Method::fast, prefer); });
            break;
        case 6:
            tryEncoder(vq4Plus, large, [&] { return encodeVq4Plus(large, Vq4Method::fast, prefer); });
            break;
        default:
            break;
    }
}

}  // namespace

// Format and target, encoder, preference; then the maps, which are also a square's regions.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 3) return 0;
    const std::span<const uint8_t> bytes(data + 3, size - 3);
    static_cast<void>(forceTarget((data[0] & 0x80) != 0 ? "best" : "scalar").ok());
    const auto format = static_cast<SquareFormat>(data[0] % squareFormatCount);
    if (const auto reader = SquareReader::open(format, bytes)) lookUpAll(*reader);
    encodeAll(bytes, data[1] % 8, static_cast<Prefer>(data[2] % 3));
    return 0;
}
