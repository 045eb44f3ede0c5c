// Whether micromaps to be written agree with themselves.
#pragma once

#include "filigree/core/result.h"
#include "filigree/io/gltf_write.h"

namespace filigree::io {

// ErrorKind::usage where a primitive names micromaps that are not there or an index that is no record, and
// where micromaps have no record.
Status checkOutput(const MicromapOutput& output);

}  // namespace filigree::io
