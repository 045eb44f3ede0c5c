#include "filigree/scene/faces.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::scene {
namespace {

using testing::ElementsAre;

Primitive triangle(int material) {
    Primitive primitive;
    primitive.material = material;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.indices = {0, 1, 2};
    return primitive;
}

// One mesh of an opaque, a masked and a plain triangle, placed twice: as it is, and mirrored and moved.
Scene twoInstances() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].alphaMode = AlphaMode::mask;
    Mesh mesh;
    mesh.name = "leaf";
    mesh.primitives = {triangle(0), triangle(1), triangle(-1)};
    for (unsigned p = 0; p < 3; ++p) mesh.primitives[p].primitiveIndex = p;
    mesh.primitives[2].uvs = {{0, 0}, {1, 0}, {0, 1}};
    scene.meshes.push_back(mesh);
    Instance mirrored;
    mirrored.transform = {-2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    scene.instances = {Instance{}, mirrored};
    return scene;
}

TEST(OpaqueFaces, PlacesEveryInstance) {
    const auto faces = opaqueFaces(twoInstances());
    ASSERT_TRUE(faces.ok()) << faces.error().message;
    EXPECT_EQ(faces->leftOut, 2U);
    constexpr uint32_t none = mesh::noVertex;
    EXPECT_THAT(faces->mesh.faces, ElementsAre(mesh::Face{0, 1, 2, none}, mesh::Face{3, 4, 5, none},
                                               mesh::Face{6, 8, 7, none}, mesh::Face{9, 11, 10, none}));
    EXPECT_EQ(faces->mesh.positions[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(faces->mesh.positions[7], (Vec3{3, 6, 7}));
    ASSERT_EQ(faces->mesh.uvs.size(), 12U);
    EXPECT_EQ(faces->mesh.uvs[1], (mesh::Uv{0, 0}));
    EXPECT_EQ(faces->mesh.uvs[4], (mesh::Uv{1, 0}));
    EXPECT_TRUE(mesh::check(faces->mesh).ok());
}

TEST(OpaqueFaces, NamesTheMeshOfAVertexThatIsNotFinite) {
    Scene scene = twoInstances();
    scene.meshes[0].primitives[2].positions[1][1] = NAN;
    const auto faces = opaqueFaces(scene);
    ASSERT_FALSE(faces.ok());
    EXPECT_EQ(faces.error().message,
              "mesh 0 (\"leaf\"), primitive 2: vertex 1 is at (nan, nan, nan), expected finite");
}

TEST(OpaqueFaces, EmptySceneHasNone) {
    EXPECT_TRUE(opaqueFaces({})->mesh.faces.empty());
}

}  // namespace
}  // namespace filigree::scene
