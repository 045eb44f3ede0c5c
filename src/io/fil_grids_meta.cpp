#include "io/fil_grids_meta.h"

#include "io/byte_fields.h"
#include "io/fil_layout.h"

namespace filigree::io {

std::vector<uint8_t> encodeGridMeta(const FilGridHead& head) {
    const bool isPaper = head.codec == grid::Codec::paper;
    ByteWriter to;
    to.put(static_cast<uint8_t>(filFirstGrids + static_cast<unsigned>(head.codec)));
    to.put(static_cast<uint8_t>(isPaper ? head.paper.displacement : grid::DisplacementCode{}));
    to.put(isPaper ? head.paper.exponentBase : uint8_t{0});
    to.put(uint8_t{0});
    for (const uint32_t count : {head.records, head.grids, head.looseTriangles, head.looseVertices})
        to.put(count);
    to.put(head.asset.bytes);
    to.put(head.asset.hash[0]);
    to.put(head.asset.hash[1]);
    to.put(head.asset.name);
    for (const double number : head.lattice.origin) to.put(number);
    for (const double number : head.lattice.step) to.put(number);
    return std::move(to).take();
}

Result<FilGridHead> decodeGridMeta(std::span<const uint8_t> bytes) {
    ByteReader from(bytes);
    FilGridHead head;
    const auto code =
        from.take<uint8_t>("the codec of grids", filFirstGrids, filFirstGrids + filGridCodecs - 1);
    const bool isLattice = code != filFirstGrids;
    head.codec = isLattice ? grid::Codec::lattice : grid::Codec::paper;
    const auto displacement = from.take<uint8_t>("the code of displacements", 0, isLattice ? 0 : 1);
    const auto base = from.take<uint8_t>("the exponent base", 0, isLattice ? 0 : 255);
    if (!isLattice) head.paper = {static_cast<grid::DisplacementCode>(displacement), base};
    from.take<uint8_t>("a reserved byte", 0, 0);
    head.records = from.take<uint32_t>("records", 1, UINT32_MAX);
    head.grids = from.take<uint32_t>("grids", 0, head.records);
    head.looseTriangles = from.take<uint32_t>("loose triangles");
    head.looseVertices = from.take<uint32_t>("loose vertices", 0, uint64_t{3} * head.looseTriangles);
    head.asset.bytes = from.take<uint64_t>("the asset's size");
    for (uint64_t& half : head.asset.hash) half = from.take<uint64_t>("the asset's hash");
    head.asset.name = from.takeText("the asset's name");
    for (double& number : head.lattice.origin)
        number = std::bit_cast<double>(from.take<uint64_t>("the lattice's origin"));
    for (double& number : head.lattice.step)
        number = std::bit_cast<double>(from.take<uint64_t>("the lattice's step"));
    from.expectEnd();
    if (!from.status()) return from.status().error();
    return head;
}

}  // namespace filigree::io
