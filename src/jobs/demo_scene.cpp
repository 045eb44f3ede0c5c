#include "jobs/demo_scene.h"

#include "filigree/core/vec3.h"

#include "jobs/demo_meshes.h"
#include "jobs/demo_textures.h"
#include "jobs/glb_builder.h"
#include "jobs/random.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr int clampToEdge = 33071;
constexpr int repeat = 10497;
constexpr int linear = 9729;
constexpr int linearMipmapLinear = 9987;

struct Materials {
    size_t leaves, fern, grass, blossom, fence, bark, zinc, ground;
};

struct Meshes {
    std::array<size_t, 4> branches;  // by species
    size_t trunk, fern, grass, blossom, fence, post, ground;
};

// A cut-out material with a texture of its own.
Result<size_t> addCutOut(GlbBuilder& glb, const std::string& name, const scene::ColourImage& image,
                         int wrap) {
    const auto source = glb.addImage(name, image);
    if (!source) return source.error();
    const size_t sampler =
        glb.add("samplers",
                {{"magFilter", linear}, {"minFilter", linearMipmapLinear}, {"wrapS", wrap}, {"wrapT", wrap}});
    const size_t texture = glb.add("textures", {{"sampler", sampler}, {"source", *source}});
    return glb.add(
        "materials",
        {{"name", name},
         {"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.5},
         {"doubleSided", true}});
}

size_t addPlain(GlbBuilder& glb, const std::string& name, const Vec3& linearColour, double metallic) {
    return glb.add("materials",
                   {{"name", name},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {linearColour[0], linearColour[1], linearColour[2], 1}},
                      {"metallicFactor", metallic},
                      {"roughnessFactor", 0.9}}}});
}

Result<Materials> addMaterials(GlbBuilder& glb) {
    Materials m{};
    struct CutOut {
        const char* name;
        scene::ColourImage (*texture)();
        int wrap;
        size_t* slot;
    };
    for (const CutOut& c : {CutOut{"leaves", leavesTexture, clampToEdge, &m.leaves},
                            CutOut{"fern", fernTexture, clampToEdge, &m.fern},
                            CutOut{"grass", grassTexture, clampToEdge, &m.grass},
                            CutOut{"blossom", blossomTexture, clampToEdge, &m.blossom},
                            CutOut{"fence", fenceTexture, repeat, &m.fence}}) {
        const auto added = addCutOut(glb, c.name, c.texture(), c.wrap);
        if (!added) return added.error();
        *c.slot = *added;
    }
    m.bark = addPlain(glb, "bark", {0.10F, 0.065F, 0.04F}, 0);
    m.zinc = addPlain(glb, "zinc", {0.45F, 0.46F, 0.48F}, 0.6);
    m.ground = addPlain(glb, "ground", {0.17F, 0.18F, 0.085F}, 0);
    return m;
}

size_t addMesh(GlbBuilder& glb, const std::string& name, const Json& primitives) {
    return glb.add("meshes", {{"name", name}, {"primitives", primitives}});
}

size_t addMesh(GlbBuilder& glb, const std::string& name, const Geometry& geometry, size_t material) {
    return addMesh(glb, name, Json::array({glb.primitive(geometry, material)}));
}

Meshes addMeshes(GlbBuilder& glb, const Materials& m) {
    Meshes meshes{};
    for (size_t species = 0; species < meshes.branches.size(); ++species) {
        const Branch branch = branchMesh(species);
        const Json wood = glb.primitive(branch.wood, m.bark);
        const Json leaves = glb.primitive(branch.leaves, m.leaves);
        meshes.branches[species] =
            addMesh(glb, fmt::format("branch {}", species + 1), Json::array({wood, leaves}));
    }
    meshes.trunk = addMesh(glb, "trunk", trunkMesh(4.2F, 0.16F), m.bark);
    meshes.fern = addMesh(glb, "fern", fernMesh(), m.fern);
    meshes.grass = addMesh(glb, "grass", grassMesh(), m.grass);
    meshes.blossom = addMesh(glb, "blossom", blossomMesh(), m.blossom);
    meshes.fence = addMesh(glb, "fence", fenceMesh(), m.fence);
    meshes.post = addMesh(glb, "post", postMesh(), m.zinc);
    meshes.ground = addMesh(glb, "ground", groundMesh(36, 120), m.ground);
    return meshes;
}

// A turn by `pitch` about x, then by `yaw` about y, as a quaternion (x, y, z, w).
Json turn(float yaw, float pitch) {
    const float cy = std::cos(yaw / 2);
    const float sy = std::sin(yaw / 2);
    const float cp = std::cos(pitch / 2);
    const float sp = std::sin(pitch / 2);
    return {cy * sp, sy * cp, -sy * sp, cy * cp};
}

class Planter {
  public:
    Planter(GlbBuilder& glb, const Meshes& meshes) : glb_(glb), meshes_(meshes) {}

    void place(size_t mesh, const Vec3& at, float yaw, float pitch, float scale) {
        roots_.push_back(glb_.add("nodes", {{"mesh", mesh},
                                            {"translation", {at[0], at[1], at[2]}},
                                            {"rotation", turn(yaw, pitch)},
                                            {"scale", {scale, scale, scale}}}));
    }

    void placeOnGround(size_t mesh, float x, float z, float scale) {
        place(mesh, {x, groundHeight(x, z), z}, uniform(0, 2 * std::numbers::pi), 0, scale);
    }

    // A trunk with branches all round, the lower ones longer and flatter.
    void plantTree(size_t species, float x, float z, float scale) {
        const float ground = groundHeight(x, z);
        place(meshes_.trunk, {x, ground, z}, uniform(0, 6), 0, scale);
        constexpr int branches = 26;
        for (int i = 0; i < branches; ++i) {
            const float t = static_cast<float>(i) / branches;
            const float pitch = -(0.1F + 1.25F * t) + uniform(-0.15, 0.15);
            const float size = scale * (1.15F - 0.5F * t) * uniform(0.85, 1.1);
            const float height = ground + scale * (1.3F + 2.45F * t);
            place(meshes_.branches[species], {x + 0.1F * t, height, z}, 2.4F * static_cast<float>(i), pitch,
                  size);
        }
    }

    // Branches straight out of the ground.
    void plantBush(size_t species, float x, float z, float scale) {
        for (int i = 0; i < 7; ++i) {
            const float pitch = uniform(-1.3, -0.6);
            place(meshes_.branches[species], {x, groundHeight(x, z), z}, 0.9F * static_cast<float>(i), pitch,
                  scale * uniform(0.6, 0.9));
        }
    }

    // `count` of a mesh in a ring about the origin.
    void scatter(size_t mesh, int count, float near, float far, float least, float most) {
        for (int i = 0; i < count; ++i) {
            const float radius = uniform(near, far);
            const float angle = uniform(0, 2 * std::numbers::pi);
            placeOnGround(mesh, radius * std::cos(angle), radius * std::sin(angle), uniform(least, most));
        }
    }

    void buildFence(float x, float z, int panels) {
        for (int i = 0; i <= panels; ++i) {
            const float at = x + 2 * static_cast<float>(i);
            const float height = groundHeight(at, z);
            place(meshes_.post, {at, height, z}, 0, 0, 1);
            if (i < panels) place(meshes_.fence, {at, height, z}, 0, 0, 1);
        }
    }

    void addCamera(const std::string& name, const Vec3& eye, const Vec3& target) {
        const Vec3 view = normalised(minus(target, eye));
        const size_t camera = glb_.add(
            "cameras",
            {{"name", name},
             {"type", "perspective"},
             {"perspective", {{"yfov", 0.75}, {"aspectRatio", 1.5}, {"znear", 0.05}, {"zfar", 200}}}});
        roots_.push_back(
            glb_.add("nodes", {{"name", name},
                               {"camera", camera},
                               {"translation", {eye[0], eye[1], eye[2]}},
                               {"rotation", turn(std::atan2(-view[0], -view[2]), std::asin(view[1]))}}));
    }

    [[nodiscard]] const Json& roots() const { return roots_; }

  private:
    float uniform(double lo, double hi) { return static_cast<float>(random_.uniform(lo, hi)); }

    GlbBuilder& glb_;
    const Meshes& meshes_;
    Random random_{7};
    Json roots_ = Json::array();
};

void plant(Planter& planter, const Meshes& meshes) {
    planter.place(meshes.ground, {0, 0, 0}, 0, 0, 1);
    planter.plantTree(0, -3.2F, -2.6F, 1.05F);
    planter.plantTree(2, 3.4F, -3.8F, 1.2F);
    planter.plantTree(1, 0.2F, -7.5F, 1.35F);
    planter.plantTree(3, -8.5F, -6.5F, 1.2F);
    planter.plantTree(0, 8.8F, -8.5F, 1.3F);
    planter.plantBush(3, -1.0F, -3.4F, 1);
    planter.plantBush(1, 5.6F, -1.2F, 0.9F);
    planter.plantBush(2, -6.2F, -1.6F, 0.9F);
    planter.scatter(meshes.fern, 26, 0.8F, 6.5F, 0.8F, 1.3F);
    planter.scatter(meshes.grass, 340, 0.3F, 10, 0.7F, 1.4F);
    planter.scatter(meshes.blossom, 40, 0.5F, 6, 0.8F, 1.4F);
    planter.buildFence(-6, 2.2F, 3);
    planter.addCamera("glade", {1.6F, 1.9F, 7.6F}, {-0.3F, 1.55F, -2});
    planter.addCamera("ferns", {2.4F, 1.0F, 2.6F}, {-0.9F, 0.75F, -2.4F});
}

}  // namespace

Result<std::vector<uint8_t>> makeDemoScene() {
    GlbBuilder glb("filigree demo");
    const auto materials = addMaterials(glb);
    if (!materials) return materials.error();
    const Meshes meshes = addMeshes(glb, *materials);
    Planter planter(glb, meshes);
    plant(planter, meshes);
    const size_t scene = glb.add("scenes", {{"name", "glade"}, {"nodes", planter.roots()}});
    glb.set("scene", scene);
    return glb.finish();
}

}  // namespace filigree::jobs
