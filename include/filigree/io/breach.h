// A broken rule, as the checkers of files report it.
#pragma once

#include <string>

namespace filigree::io {

// One broken rule.
struct Breach {
    std::string path;     // JSON path in the document, such as /meshes/0/primitives/1, or a file of a folder
    std::string rule;     // the rule's id, see docs/spec/gltf.md and docs/spec/raw.md
    std::string message;  // what was found and what was expected
};

}  // namespace filigree::io
