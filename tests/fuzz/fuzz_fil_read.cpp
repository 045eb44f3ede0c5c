// Any bytes as a .fil file, once as they are and once with their hashes made right, so that what lies behind
// the hashes is reached. None may crash, hang or take much memory.
#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/io/fil.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/fil_squares.h"

#include "sample_fil.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

void readAll(std::vector<uint8_t> bytes) {
    using namespace filigree;
    io::FilReadOptions options;
    options.maxBytes = uint64_t{64} << 20;
    const auto file = io::FilFile::parse(std::move(bytes), "input", options);
    if (!file) return;
    if (file->set().encoding == encoding::Encoding::bitmask) {
        static_cast<void>(encoding::BitmaskReader::open(file->set()).ok());
        return;
    }
    std::vector<int32_t> indices(file->meta().triangleCount());
    file->readIndices(0, indices);
    static_cast<void>(encoding::openReader(file->set()).ok());
}

void readSquares(std::vector<uint8_t> bytes) {
    using namespace filigree;
    io::FilReadOptions options;
    options.maxBytes = uint64_t{64} << 20;
    const auto file = io::FilSquareFile::parse(std::move(bytes), "input", options);
    if (!file) return;
    std::vector<int32_t> indices(file->meta().triangleCount());
    file->readIndices(0, indices);
    for (size_t t = 0; t < indices.size(); ++t) {
        static_cast<void>(quadmap::verticesOf(file->place(t)));
        if (indices[t] >= 0) static_cast<void>(file->maps().decode(static_cast<size_t>(indices[t])));
    }
}

void readGrids(std::span<const uint8_t> bytes) {
    using namespace filigree;
    io::FilReadOptions options;
    options.maxBytes = uint64_t{64} << 20;
    const auto file = io::parseFilGrids(bytes, "input", serialExecutor(), options);
    if (file)
        static_cast<void>(
            grid::decodeGrids(file->grids, file->table, file->looseTriangles, serialExecutor()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::vector<uint8_t> bytes(data, data + size);
    readAll(bytes);
    readSquares(bytes);
    readGrids(bytes);
    filigree::tests::resealFil(bytes);
    readGrids(bytes);
    readAll(bytes);
    readSquares(std::move(bytes));
    return 0;
}
