// Writes the seeds of the fuzz targets encoding_decode and encoding_round_trip: make_encoding_seeds DECODE
// ROUND_TRIP
#include "filigree/core/file.h"

#include "encoding/sample_maps.h"

#include <cstdio>
#include <filesystem>

namespace filigree::tests {
namespace {

using encoding::EncodedSet;
using encoding::Encoding;
using micromap::Format;

SampleSet seedSet() {
    SampleSet set{"seed", {}};
    std::mt19937 random(2);
    for (const unsigned level : {0u, 1u, 2u, 3u, 4u}) set.maps.push(noise(level, 0.4, random).view());
    set.maps.push(disc(4, 0.6).view());
    set.maps.push(disc(5, 0.4).view());
    set.maps.push(set.maps[5]);
    return set;
}

// As fuzz_encoding_decode.cpp reads it.
std::vector<uint8_t> decodeSeed(const EncodedSet& set) {
    const auto descriptorBytes = static_cast<unsigned>(set.descriptors.size());
    std::vector<uint8_t> seed{
        static_cast<uint8_t>(set.encoding),    static_cast<uint8_t>(set.format == Format::twoState ? 1 : 0),
        static_cast<uint8_t>(set.mapCount),    static_cast<uint8_t>(set.mapCount >> 8),
        static_cast<uint8_t>(descriptorBytes), static_cast<uint8_t>(descriptorBytes >> 8)};
    seed.insert(seed.end(), set.descriptors.begin(), set.descriptors.end());
    seed.insert(seed.end(), set.payload.begin(), set.payload.end());
    return seed;
}

Status writeDecodeSeeds(const std::filesystem::path& folder) {
    for (const Encoding encoding : testedEncodings) {
        for (const Format format : {Format::twoState, Format::fourState}) {
            const std::string name = std::string(encoding::nameOf(encoding)) +
                                     (format == Format::twoState ? "_2_state" : "_4_state");
            const auto seed = decodeSeed(encodeGood(encoding, seedSet(), format));
            if (const auto written = writeFile(folder / name, seed); !written) return written;
        }
    }
    return {};
}

Status writeRoundTripSeeds(const std::filesystem::path& folder) {
    std::mt19937 random(4);
    for (const size_t size : {3u, 30u, 200u}) {
        std::vector<uint8_t> seed(size);
        for (uint8_t& byte : seed) byte = static_cast<uint8_t>(random());
        const auto written = writeFile(folder / ("random_" + std::to_string(size)), seed);
        if (!written) return written;
    }
    return {};
}

}  // namespace
}  // namespace filigree::tests

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "make_encoding_seeds DECODE_FOLDER ROUND_TRIP_FOLDER\n");
        return 2;
    }
    for (const auto& written :
         {filigree::tests::writeDecodeSeeds(argv[1]), filigree::tests::writeRoundTripSeeds(argv[2])}) {
        if (written) continue;
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 1;
    }
    return 0;
}
