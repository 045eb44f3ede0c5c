// Any bytes as a glTF file through the whole bake at level 2: parse, read, bake, hold to the judge, write.
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_write.h"
#include "filigree/jobs/bake.h"
#include "filigree/jobs/validate.h"

#include "jobs/deep.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace filigree;

io::MicromapOutput outputOf(const scene::Scene& scene) {
    io::MicromapOutput output;
    for (const auto& m : scene.micromaps) output.micromaps.push_back({m.name, &m.set, *m.bakedWith});
    for (const auto& mesh : scene.meshes) {
        for (const auto& p : mesh.primitives) {
            if (p.micromaps < 0) continue;
            output.primitives.push_back({p.meshIndex, p.primitiveIndex, static_cast<size_t>(p.micromaps),
                                         p.micromapIndices, p.indices});
        }
    }
    return output;
}

// The judge walks every cell along an edge, which far coordinates make very many.
bool isNear(const scene::Scene& scene) {
    for (const auto& mesh : scene.meshes) {
        for (const auto& p : mesh.primitives) {
            for (const mesh::Uv& uv : p.uvs) {
                if (std::fabs(uv.u) > 1000 || std::fabs(uv.v) > 1000) return false;
            }
        }
    }
    return true;
}

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    // A folder that does not exist, so that no input reaches the machine's files.
    const auto document =
        io::GltfDocument::parse(std::vector<uint8_t>(data, data + size), "/nonexistent/filigree", "input");
    if (!document) return 0;
    io::ReadOptions options;
    options.blendAlpha = true;
    options.micromaps = false;
    options.maxBytes = uint64_t{4} << 20;
    auto scene = io::readScene(*document, options);
    if (!scene) return 0;

    jobs::BakeParameters parameters;
    parameters.level = 2;
    parameters.includeBlend = true;
    parameters.rotate = true;
    parameters.mips = size % 3;
    const auto summary = jobs::bakeScene(*scene, parameters, serialExecutor(), silentProgress());
    if (!summary) return 0;

    if (isNear(*scene)) {
        jobs::ValidateSummary found;
        if (!jobs::validateDeep(*scene, 1, serialExecutor(), silentProgress(), found))
            fail("the bake cannot be judged");
        if (found.deep && found.deep->wrong > 0) fail("a known state is wrong");
    }
    static_cast<void>(io::writeWithMicromaps(*document, outputOf(*scene), "/dev/null").ok());
    return 0;
}
