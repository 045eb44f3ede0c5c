#include "jobs/grid_input.h"

#include "filigree/io/gltf.h"
#include "filigree/io/ply.h"
#include "filigree/report/number.h"
#include "filigree/scene/faces.h"

#include "jobs/stopwatch.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

std::string extensionOf(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

Result<mesh::FaceMesh> readOpaqueFaces(const std::filesystem::path& path, std::vector<std::string>& notes) {
    const auto document = io::GltfDocument::load(path);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.micromaps = false;
    const auto scene = io::readScene(*document, reading);
    if (!scene) return scene.error();
    auto faces = scene::opaqueFaces(*scene);
    if (!faces) return faces.error().within(path.string());
    notes = scene->notes;
    if (faces->leftOut > 0) {
        notes.push_back(fmt::format("{} triangles of masked or blended materials are left out",
                                    report::formatCount(faces->leftOut)));
    }
    return std::move(faces->mesh);
}

Result<mesh::FaceMesh> readFaces(const std::filesystem::path& path, std::vector<std::string>& notes) {
    return extensionOf(path) == ".ply" ? io::readPly(path) : readOpaqueFaces(path, notes);
}

}  // namespace

bool isHeightfield(const std::filesystem::path& path) {
    return extensionOf(path) == ".png";
}

Status checkGridInput(const std::filesystem::path& path) {
    const std::string extension = extensionOf(path);
    for (const char* known : {".glb", ".gltf", ".ply", ".png"}) {
        if (extension == known) return {};
    }
    return Error{ErrorKind::usage, fmt::format("{}: expected a .glb, .gltf, .ply or .png", path.string())};
}

Result<GridInput> readGridInput(const std::filesystem::path& path, const grid::ConvertOptions& converting,
                                const io::HeightfieldOptions& heights, const Executor& executor) {
    if (const Status status = checkGridInput(path); !status) return status.error();
    GridInput input;
    const Stopwatch reading;
    if (isHeightfield(path)) {
        auto mesh = io::readHeightfield(path, heights);
        if (!mesh) return mesh.error();
        input.mesh = std::move(*mesh);
        input.readSeconds = reading.seconds();
        return input;
    }
    const auto faces = readFaces(path, input.notes);
    if (!faces) return faces.error();
    input.readSeconds = reading.seconds();
    const Stopwatch conversion;
    auto mesh = grid::gridsOf(*faces, converting, executor);
    if (!mesh) return mesh.error().within(path.string());
    input.mesh = std::move(*mesh);
    input.convertSeconds = conversion.seconds();
    if (input.mesh.triangleCount() > 0) return input;
    return Error{ErrorKind::format, fmt::format("{}: holds no triangles", path.string())};
}

}  // namespace filigree::jobs
