// Does a glTF file keep the rules of EXT_mesh_opacity_micromap?
#pragma once

#include "filigree/core/api.h"
#include "filigree/io/breach.h"
#include "filigree/io/gltf.h"

#include <vector>

namespace filigree::io {

// Checks every rule of docs/spec/gltf.md, in document order: those of the extension in both drafts, and those
// of glTF itself that it leans on. Where only one draft has a rule, the message says which. Each rule is
// reported once for an object, by its first breach.
FILIGREE_API std::vector<Breach> checkRules(const GltfDocument& document);

}  // namespace filigree::io
