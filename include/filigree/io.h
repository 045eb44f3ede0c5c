// Files: glTF in and out, PNG and JPEG, PLY, heightfields, blobs for Vulkan and DXR, the container .fil; from
// paths, and from and to memory.
//
//     const auto document = io::GltfDocument::load("scene.glb");
//     if (!document) std::cerr << document.error().message << '\n';
//     const Result<scene::Scene> scene = io::readScene(*document);
#pragma once

#include "filigree/io/api_blob.h"
#include "filigree/io/breach.h"
#include "filigree/io/fil.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/fil_squares.h"
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_rules.h"
#include "filigree/io/gltf_write.h"
#include "filigree/io/heightfield.h"
#include "filigree/io/image_file.h"
#include "filigree/io/ply.h"
