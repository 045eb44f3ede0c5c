#include "filigree/encoding/map_reader.h"

#include "filigree/encoding/dag.h"
#include "filigree/encoding/flat.h"
#include "filigree/encoding/gruen.h"
#include "filigree/encoding/indexed_tree.h"
#include "filigree/encoding/sdag.h"
#include "filigree/encoding/tree.h"

#include "encoding/reader_of.h"

#include <fmt/format.h>

namespace filigree::encoding {

Result<std::unique_ptr<MapReader>> openReader(const EncodedView& set) {
    switch (set.encoding) {
        case Encoding::flat:
            return openAs<FlatReader>(set);
        case Encoding::gruen:
            return openAs<GruenReader>(set);
        case Encoding::tree:
            return openAs<TreeReader>(set);
        case Encoding::indexedTree:
            return openAs<IndexedTreeReader>(set);
        case Encoding::dag:
            return openAs<DagReader>(set);
        case Encoding::sdag:
            return openAs<SdagReader>(set);
        case Encoding::bitmask:
            return Error{ErrorKind::usage, "bitmask holds textures, not micromaps"};
        default:
            return Error{ErrorKind::unsupported,
                         fmt::format("{} is not in this version", nameOf(set.encoding))};
    }
}

}  // namespace filigree::encoding
