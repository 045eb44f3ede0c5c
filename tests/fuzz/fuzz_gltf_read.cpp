// Any bytes as a glTF file: parse, read the scene, check the rules. None may crash, hang or take much memory.
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_rules.h"

#include <cstddef>
#include <cstdint>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace filigree;
    // A folder that does not exist, so that no input reaches the machine's files.
    const auto document =
        io::GltfDocument::parse(std::vector<uint8_t>(data, data + size), "/nonexistent/filigree", "input");
    if (!document) return 0;
    io::ReadOptions options;
    options.blendAlpha = true;
    options.colour = true;
    options.maxBytes = uint64_t{64} << 20;
    const auto scene = io::readScene(*document, options);
    static_cast<void>(scene.ok());
    static_cast<void>(io::checkRules(*document).size());
    return 0;
}
