#include "filigree/encoding/encode.h"

#include "filigree/encoding/dag.h"
#include "filigree/encoding/flat.h"
#include "filigree/encoding/gruen.h"
#include "filigree/encoding/indexed_tree.h"
#include "filigree/encoding/sdag.h"
#include "filigree/encoding/tree.h"

#include <fmt/format.h>

namespace filigree::encoding {

Result<EncodedSet> encode(Encoding encoding, std::span<const micromap::QuadtreeView> maps,
                          micromap::Format format, const EncodeOptions& options, const Executor& executor,
                          ProgressSink& progress) {
    switch (encoding) {
        case Encoding::flat:
            return encodeFlat(maps, format, executor, progress);
        case Encoding::gruen:
            return encodeGruen(maps, format,
                               options.maybeOpaque ? GruenBit::maybeOpaque : GruenBit::opaqueSide, executor,
                               progress);
        case Encoding::tree:
            return encodeTree(maps, format, executor, progress);
        case Encoding::indexedTree:
            return encodeIndexedTree(maps, format, executor, progress);
        case Encoding::dag:
            return encodeDag(maps, format, executor, progress);
        case Encoding::sdag:
            return encodeSdag(maps, format, options.aggregates, executor, progress);
        case Encoding::bitmask:
            return Error{ErrorKind::usage, "bitmask encodes textures, not micromaps"};
        default:
            return Error{ErrorKind::unsupported, fmt::format("{} is not in this version", nameOf(encoding))};
    }
}

}  // namespace filigree::encoding
