// Any bytes as a tiny texture, a test and some triangles: bakes them and holds every state to the judge.
#include "filigree/bake/bake.h"
#include "filigree/micromap/set.h"
#include "filigree/verify/verify.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace filigree;

// Reads numbers from the input; zeros once it has ended.
class Source {
  public:
    Source(const uint8_t* data, size_t size) : data_(data), left_(size) {}
    [[nodiscard]] bool ended() const { return left_ == 0; }
    uint8_t byte() {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }
    uint32_t below(uint32_t count) { return byte() % count; }
    uint32_t word() {
        uint32_t word = 0;
        for (unsigned k = 0; k < 4; ++k) word |= static_cast<uint32_t>(byte()) << (8 * k);
        return word;
    }
    // Short numbers on a lattice, which touch things, or the bits of any float.
    float coordinate(uint32_t texels) {
        switch (below(4)) {
            case 0:
                return static_cast<float>(static_cast<int8_t>(byte())) / static_cast<float>(2 * texels);
            case 1:
                return static_cast<float>(static_cast<int8_t>(byte())) / 16;
            case 2:
                return static_cast<float>(static_cast<int32_t>(word())) * 0x1p-30F;
            default: {
                const auto any = std::bit_cast<float>(word());
                return std::isfinite(any) ? std::fmod(any, 512.0F) : any;
            }
        }
    }
    float alpha() {
        const uint8_t a = byte();
        return a < 128 ? 1 : static_cast<float>(a - 128) / 127;
    }
    double unit() { return word() * 0x1p-32; }

  private:
    const uint8_t* data_;
    size_t left_;
};

image::AlphaTexture textureFrom(Source& source) {
    image::AlphaTexture texture;
    const uint32_t width = 1 + source.below(8);
    const uint32_t height = 1 + source.below(8);
    const uint32_t kind = source.below(3);
    std::vector<uint8_t> texels(size_t{width} * height);
    for (uint8_t& t : texels) {
        const uint8_t value = source.byte();
        t = kind == 0 ? value : kind == 1 ? (value & 1) * 255 : static_cast<uint8_t>(126 + value % 4);
    }
    texture.image = image::alphaImageFrom8Bit(width, height, texels);
    texture.wrapU = static_cast<image::Wrap>(source.below(3));
    texture.wrapV = static_cast<image::Wrap>(source.below(3));
    texture.filter = static_cast<image::Filter>(source.below(3));
    return texture;
}

image::AlphaTest testFrom(Source& source) {
    constexpr double cutoffs[] = {0, 0.2, 0.5, 1, 1.5, 128 / 255.0};
    constexpr double guards[] = {0, 0, 1.0 / 256, 0.25, 1, 3.5};
    image::AlphaTest test;
    test.mode = source.below(4) == 0 ? image::AlphaMode::blend : image::AlphaMode::mask;
    test.cutoff = source.below(2) == 0 ? source.unit() : cutoffs[source.below(6)];
    if (source.below(4) == 0) test.factor = source.unit();
    if (source.below(4) == 0) test.mips = source.below(4);
    test.guard = guards[source.below(6)];
    return test;
}

mesh::UvTriangle triangleFrom(Source& source, const image::AlphaImage& image) {
    mesh::UvTriangle triangle;
    for (mesh::Uv& uv : triangle.uv) uv = {source.coordinate(image.width), source.coordinate(image.height)};
    const uint32_t kind = source.below(8);
    if (kind == 0) triangle.uv[2] = triangle.uv[0];
    if (kind == 1) triangle.alpha.fill(source.alpha());
    if (kind == 2) triangle.alpha = {source.alpha(), source.alpha(), source.alpha()};
    return triangle;
}

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void failOn(const verify::Finding& f, const mesh::UvTriangle& t) {
    std::fprintf(stderr, "micro-triangle %llu of level %u is %d, truly %d; corners",
                 static_cast<unsigned long long>(f.microTriangle), f.level, static_cast<int>(f.state),
                 static_cast<int>(f.truth));
    for (size_t k = 0; k < 3; ++k)
        std::fprintf(stderr, " (%a, %a; %a)", double{t.uv[k].u}, double{t.uv[k].v}, double{t.alpha[k]});
    fail("");
}

// The states of all triangles, one after the other.
std::vector<micromap::State> statesOf(const micromap::FlatSet& set) {
    std::vector<micromap::State> states;
    for (const int32_t index : set.indices) {
        if (micromap::isSpecialIndex(index)) {
            states.push_back(micromap::stateOfSpecialIndex(index));
            continue;
        }
        const micromap::Record& record = set.records[static_cast<size_t>(index)];
        for (uint64_t k = 0; k < micromap::microTriangleCount(record.level); ++k)
            states.push_back(micromap::flatState(set, record, k));
    }
    return states;
}

micromap::FlatSet bakeFlat(std::span<const mesh::UvTriangle> triangles, const image::AlphaTexture& texture,
                           const image::AlphaTest& test, const bake::Settings& settings) {
    const auto baked = bake::bake(triangles, texture, test, settings, serialExecutor(), silentProgress());
    if (!baked) fail("settings in range are refused");
    const auto flat = micromap::flatten(baked->set);
    if (!flat) fail("small micromaps cannot be flattened");
    return *flat;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Source source(data, size);
    bake::Settings settings;
    settings.level = source.below(4);
    const image::AlphaTest test = testFrom(source);
    const image::AlphaTexture texture = textureFrom(source);
    std::vector<mesh::UvTriangle> triangles;
    while (!source.ended() && triangles.size() < 6) triangles.push_back(triangleFrom(source, texture.image));

    const micromap::FlatSet four = bakeFlat(triangles, texture, test, settings);
    const auto counts =
        verify::deepCheck(triangles, four, texture, test, {}, serialExecutor(), silentProgress());
    if (!counts) fail("the bake cannot be judged");
    if (counts->wrong > 0) failOn(counts->first[0], triangles[counts->first[0].triangle]);

    // One micromap may be uniform where the other is not, so whole sets are compared only where sizes agree.
    settings.format = micromap::Format::twoState;
    const auto sides = statesOf(bakeFlat(triangles, texture, test, settings));
    const auto states = statesOf(four);
    for (size_t k = 0; k < states.size() && sides.size() == states.size(); ++k) {
        if (micromap::isOpaqueSide(states[k]) != micromap::isOpaqueSide(sides[k]))
            fail("2-state is not the side of 4-state");
    }
    return 0;
}
