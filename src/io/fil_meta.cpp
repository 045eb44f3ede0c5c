#include "io/fil_meta.h"

#include "filigree/core/bytes.h"

#include "io/byte_fields.h"
#include "io/fil_layout.h"

#include <bit>
#include <cmath>
#include <utility>

namespace filigree::io {
namespace {

constexpr size_t groupBytes = 34;  // without its name
constexpr size_t primitiveBytes = 16;
constexpr uint32_t maxMips = 32;
constexpr uint64_t maxTriangles = uint64_t{1} << 40;

void putGroup(const FilGroup& group, ByteWriter& to) {
    const image::AlphaTest test = group.test.value_or(image::AlphaTest{image::AlphaMode::mask, 0, 0, 0, 0});
    to.put(group.name);
    to.put(static_cast<uint8_t>(group.test.has_value()));
    to.put(static_cast<uint8_t>(test.mode));
    to.put(test.mips);
    to.put(test.cutoff);
    to.put(test.factor);
    to.put(test.guard);
}

FilGroup takeGroup(ByteReader& from) {
    constexpr double any = 1e308;
    FilGroup group;
    group.name = from.takeText("a group's name");
    const bool known = from.take<uint8_t>("whether a test is known", 0, 1) != 0;
    image::AlphaTest test;
    test.mode = static_cast<image::AlphaMode>(from.take<uint8_t>("the alpha mode", 0, 1));
    test.mips = from.take<uint32_t>("mips", 0, maxMips);
    test.cutoff = from.takeNumber("the cutoff", any);
    test.factor = from.takeNumber("the factor", 1);
    test.guard = from.takeNumber("the guard", any);
    if (known) group.test = test;
    return group;
}

void takeEncoding(ByteReader& from, FilHead& head) {
    const size_t at = from.position();
    const auto code = from.take<uint8_t>("the encoding");
    if (code < encoding::encodingCount) {
        head.encoding = static_cast<encoding::Encoding>(code);
    } else if (code >= filFirstSquares && code < filFirstSquares + filSquareFormats) {
        head.squares = static_cast<quadmap::SquareFormat>(code - filFirstSquares);
    } else if (code >= filFirstGrids && code < filFirstGrids + filGridCodecs) {
        from.fail(at, "holds vertex grids, expected micromaps or squares");
    } else {
        from.fail(at, fmt::format("the encoding is {}, expected 0 to {} or {} to {}", code,
                                  encoding::encodingCount - 1, filFirstSquares,
                                  filFirstSquares + filSquareFormats - 1));
    }
}

void takePrimitives(ByteReader& from, FilMeta& meta) {
    const uint32_t count = from.takeCount("primitives", primitiveBytes);
    meta.primitives.reserve(count);
    for (uint32_t k = 0; k < count; ++k) {
        const size_t at = from.position();
        FilPrimitive p;
        p.mesh = from.take<uint32_t>("a mesh");
        p.primitive = from.take<uint32_t>("a primitive");
        p.triangles = from.take<uint32_t>("a primitive's triangles");
        p.group = from.take<uint32_t>("a primitive's group");
        if (p.group >= meta.groups.size())
            from.fail(at + 12, fmt::format("group {} of {}", p.group, meta.groups.size()));
        if (k > 0) {
            const FilPrimitive& before = meta.primitives.back();
            if (std::pair(p.mesh, p.primitive) <= std::pair(before.mesh, before.primitive)) {
                from.fail(at, fmt::format("primitive {} of mesh {} after primitive {} of mesh {}, expected "
                                          "rising numbers",
                                          p.primitive, p.mesh, before.primitive, before.mesh));
            }
        }
        meta.primitives.push_back(p);
    }
}

}  // namespace

uint64_t FilMeta::triangleCount() const {
    uint64_t sum = 0;
    for (const FilPrimitive& p : primitives) sum += p.triangles;
    return sum;
}

std::vector<uint8_t> encodeMeta(const FilHead& head) {
    const FilMeta& meta = head.meta;
    ByteWriter to;
    to.put(head.squares ? static_cast<uint8_t>(filFirstSquares + static_cast<unsigned>(*head.squares))
                        : static_cast<uint8_t>(head.encoding));
    to.put(static_cast<uint8_t>(head.format));
    to.put(static_cast<uint8_t>(meta.level.value_or(filNoLevel)));
    to.put(uint8_t{0});
    to.put(head.mapCount);
    to.put(meta.asset.bytes);
    to.put(meta.asset.hash[0]);
    to.put(meta.asset.hash[1]);
    to.put(meta.asset.name);
    to.put(static_cast<uint32_t>(meta.groups.size()));
    for (const FilGroup& group : meta.groups) putGroup(group, to);
    to.put(static_cast<uint32_t>(meta.primitives.size()));
    for (const FilPrimitive& p : meta.primitives) {
        for (const uint32_t number : {p.mesh, p.primitive, p.triangles, p.group}) to.put(number);
    }
    return std::move(to).take();
}

Result<FilHead> decodeMeta(std::span<const uint8_t> bytes) {
    ByteReader from(bytes);
    FilHead head;
    takeEncoding(from, head);
    head.format = static_cast<micromap::Format>(from.take<uint8_t>("the format", 1, 2));
    const size_t levelAt = from.position();
    const auto level = from.take<uint8_t>("the level");
    if (level <= micromap::maxLevel) {
        head.meta.level = level;
    } else if (level != filNoLevel) {
        from.fail(levelAt,
                  fmt::format("level {}, expected 0 to {} or {}", level, micromap::maxLevel, filNoLevel));
    }
    from.take<uint8_t>("a reserved byte", 0, 0);
    head.mapCount = from.take<uint32_t>("the number of maps", 0, INT32_MAX);
    head.meta.asset.bytes = from.take<uint64_t>("the asset's size");
    head.meta.asset.hash[0] = from.take<uint64_t>("the asset's hash");
    head.meta.asset.hash[1] = from.take<uint64_t>("the asset's hash");
    head.meta.asset.name = from.takeText("the asset's name");
    const uint32_t groups = from.takeCount("groups", groupBytes);
    head.meta.groups.reserve(groups);
    for (uint32_t k = 0; k < groups; ++k) head.meta.groups.push_back(takeGroup(from));
    takePrimitives(from, head.meta);
    if (const uint64_t triangles = head.meta.triangleCount(); triangles > maxTriangles)
        from.fail(from.position(), fmt::format("{} triangles, expected at most {}", triangles, maxTriangles));
    from.expectEnd();
    if (!from.status()) return from.status().error();
    return head;
}

}  // namespace filigree::io
