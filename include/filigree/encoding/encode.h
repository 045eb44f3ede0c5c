// Micromaps as quadtrees to any encoding of them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include <span>

namespace filigree::encoding {

// What some encodings can do besides.
struct EncodeOptions {
    // Store the opaque share of interior nodes where the encoding can do without (sdag).
    bool aggregates = false;
    // With Encoding::gruen and Format::twoState: a set bit means "not known to be transparent" and reads as
    // unknown-opaque, which is conservative, instead of the opaque side.
    bool maybeOpaque = false;
};

// Encodes `maps`, of levels 0..maxLevel in any mixture; map k of the set is maps[k]. With Format::twoState
// the sides of states are kept. The result does not depend on the executor. ErrorKind::limit when the set
// outgrows the encoding's offsets, ErrorKind::usage for Encoding::bitmask, which does not encode micromaps,
// ErrorKind::cancelled. Progress in micromaps.
FILIGREE_API Result<EncodedSet> encode(Encoding encoding, std::span<const micromap::QuadtreeView> maps,
                                       micromap::Format format, const EncodeOptions& options = {},
                                       const Executor& executor = serialExecutor(),
                                       ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
