// Bitmasks: any bytes as a set are refused or looked up inside their bounds; any small texture gives a set in
// which no known state is wrong.
#include "filigree/core/target.h"
#include "filigree/encoding/bitmask.h"

#include "exact_bytes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace filigree;
using encoding::BitmaskReader;
using encoding::BitmaskSource;
using encoding::EncodedView;
using micromap::Format;
using micromap::State;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

constexpr std::array coordinates{-3.01f, -1.0f, -0.26f, 0.0f, 0.125f, 0.37f, 0.5f, 0.9f, 1.0f, 1.6f, 1e20f};

void compareLookups(const BitmaskReader& reader) {
    std::vector<uint32_t> textures;
    std::vector<float> u;
    std::vector<float> v;
    for (uint32_t k = 0; k < std::min(reader.textureCount(), 8u); ++k) {
        for (size_t at = 0; at < coordinates.size(); ++at) {
            textures.push_back(k);
            u.push_back(coordinates[at]);
            v.push_back(coordinates[(3 * at + k) % coordinates.size()]);
        }
    }
    std::vector<State> states(textures.size());
    reader.lookup(textures, u, v, states);
    for (size_t k = 0; k < states.size(); ++k) {
        if (states[k] != reader.at(textures[k], u[k], v[k])) fail("a batch differs from at()");
    }
}

// Format, number of textures, bytes of descriptors, then both blocks.
void decodeAnything(std::span<const uint8_t> data) {
    if (data.size() < 3) return;
    const auto blocks = data.subspan(3);
    const size_t descriptorBytes = std::min<size_t>(data[2], blocks.size());
    const tests::ExactBytes descriptors(blocks.first(descriptorBytes));
    const tests::ExactBytes payload(blocks.subspan(descriptorBytes));
    const Format format = (data[0] & 1) != 0 ? Format::twoState : Format::fourState;
    const EncodedView set{encoding::Encoding::bitmask, format, data[1], descriptors.view(), payload.view()};
    const auto reader = BitmaskReader::open(set);
    if (!reader) return;
    compareLookups(*reader);
    uint64_t bits = 0;
    for (const encoding::Part& part : reader->parts()) bits += part.bits;
    if (bits != 8 * uint64_t{set.descriptors.size() + set.payload.size()}) fail("parts do not add up");
}

void checkPoint(const BitmaskReader& reader, const BitmaskSource& source, float u, float v) {
    const image::AlphaTexture& texture = *source.texture;
    const State state = reader.at(0, u, v);
    if (!micromap::isKnown(state)) return;
    const double x = double{u} * texture.image.width;
    const double y = double{v} * texture.image.height;
    const auto check = [&](double alpha) {
        const double excess = alpha * source.test.factor - source.test.cutoff;
        if (state == State::opaque ? excess < -1e-6 : excess > 1e-6) fail("a known state is wrong");
    };
    if (texture.filter != image::Filter::nearest) check(sampleBilinear(texture, x, y));
    if (texture.filter != image::Filter::linear) check(sampleNearest(texture, x, y));
}

// Width, wrap modes and filter, cutoff, factor, guard, mips, then texels.
void encodeAnything(std::span<const uint8_t> data) {
    if (data.size() < 7) return;
    const uint32_t width = 1 + data[0] % 16;
    const auto texels = data.subspan(6);
    const auto height = static_cast<uint32_t>(std::min<size_t>(16, texels.size() / width));
    if (height == 0) return;
    const image::AlphaTexture texture{image::alphaImageFrom8Bit(width, height, texels.first(width * height)),
                                      static_cast<image::Wrap>(data[1] % 3),
                                      static_cast<image::Wrap>(data[1] / 3 % 3),
                                      static_cast<image::Filter>(data[1] / 9 % 3)};
    const BitmaskSource source{&texture,
                               {image::AlphaMode::mask, data[2] / 255.0, data[3] / 255.0,
                                static_cast<unsigned>(data[5] % 4), data[4] / 128.0}};
    const auto set = encoding::encodeBitmasks({&source, 1}, Format::fourState, serialExecutor());
    if (!set) fail("a texture was refused");
    const auto reader = BitmaskReader::open(viewOf(*set));
    if (!reader) fail("a set was refused");
    compareLookups(*reader);
    for (int j = -20; j < 40; ++j) {
        for (int i = -20; i < 40; ++i) {
            checkPoint(*reader, source, static_cast<float>(i) / 20, static_cast<float>(j) / 20);
        }
    }
}

}  // namespace

// The first byte chooses what the others are, and the target.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0) return 0;
    // Sanitizers see no gathers; so half of the inputs run on the scalar target.
    static_cast<void>(forceTarget((data[0] & 2) != 0 ? "best" : "scalar").ok());
    const std::span<const uint8_t> rest(data + 1, size - 1);
    if ((data[0] & 1) != 0) {
        decodeAnything(rest);
    } else {
        encodeAnything(rest);
    }
    return 0;
}
