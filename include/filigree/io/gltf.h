// glTF 2.0 files in: a document, and the scene that it holds.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace filigree::io {

// A .glb or .gltf file as it stands: the JSON document and its buffers. What the project does not know stays
// in it, so that writing it again loses nothing. Buffers are held once and never copied.
class FILIGREE_API GltfDocument {
  public:
    // Reads `path`, GLB or JSON by its first bytes, and the buffer files that it names. A buffer file that
    // cannot be read is an error only for what needs it. Fails on a header, chunk or buffer that is shorter
    // than it claims, on surplus bytes, and on JSON that is no glTF 2.0 or nested too deep.
    static Result<GltfDocument> load(const std::filesystem::path& path);

    // The same from memory. Relative URIs start at `baseFolder`; `name` stands for the file in errors.
    static Result<GltfDocument> parse(std::vector<uint8_t> bytes, const std::filesystem::path& baseFolder,
                                      const std::string& name);

    // The same from memory of the caller's, used in place, which must outlive this.
    static Result<GltfDocument> view(std::span<const uint8_t> bytes, const std::filesystem::path& baseFolder,
                                     const std::string& name);

    GltfDocument(GltfDocument&&) noexcept;
    GltfDocument& operator=(GltfDocument&&) noexcept;
    ~GltfDocument();

    [[nodiscard]] const std::string& name() const;  // of the file, for messages

    // The document itself, for this room only.
    struct Data;
    [[nodiscard]] const Data& data() const { return *data_; }

  private:
    explicit GltfDocument(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

// What of a document is read.
struct ReadOptions {
    bool blendAlpha = false;  // decode the alpha of BLEND materials too, not only of MASK
    bool colour = false;    // decode every base colour image to ColourImage, and read all texture coordinates
    bool micromaps = true;  // read the micromaps that the file has; false passes over them unread
    // The most memory that geometry, images and micromaps may take together, in bytes; above it
    // ErrorKind::limit.
    uint64_t maxBytes = uint64_t{8} << 30;
};

// Reads the scene. Primitives of a material whose alpha matters (MASK, and BLEND with blendAlpha) must be
// readable in full: what is wrong or unsupported there is an error that names it. Any other primitive that
// cannot be read is left without geometry and noted. Image i of the scene is image i of the file.
FILIGREE_API Result<scene::Scene> readScene(const GltfDocument& document, const ReadOptions& options = {});

}  // namespace filigree::io
