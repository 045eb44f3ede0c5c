// Records under a hierarchy: what goes in comes out, near enough, whatever the threads.
#include "filigree/grid/encode_grids.h"

#include "filigree/grid/check.h"
#include "filigree/grid/convert.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/error.h"

#include "sample_grids.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

using tests::encoded;
using tests::mixedBox;
using tests::optionsFor;

constexpr std::array bothCodecs{Codec::paper, Codec::lattice};

uint32_t looseCount(const GridMesh& mesh) {
    return static_cast<uint32_t>(mesh.looseTriangles.size());
}

class EncodeGrids : public testing::TestWithParam<Codec> {};
INSTANTIATE_TEST_SUITE_P(Codecs, EncodeGrids, testing::ValuesIn(bothCodecs),
                         [](const auto& codec) { return std::string(nameOf(codec.param)); });

TEST_P(EncodeGrids, PassesItsOwnChecks) {
    for (const uint32_t side : {8U, 21U}) {
        GridMesh mesh = mixedBox(side);
        const EncodedGrids grids = encoded(mesh, optionsFor(mesh, GetParam()));
        const Status checked = check(grids, serialExecutor());
        EXPECT_TRUE(checked) << checked.error().message;
        const Status placed = checkPlaces(grids, mesh.grids, looseCount(mesh));
        EXPECT_TRUE(placed) << placed.error().message;
        EXPECT_GT(clusterCount(grids), 0u);
        const GridBytes bytes = bytesOf(grids);
        EXPECT_EQ(bytes.total(), grids.records.size() + grids.nodes.size() * 80 + grids.offsets.size() * 4);
    }
}

TEST_P(EncodeGrids, GivesTheSameBytesForAnyThreads) {
    GridMesh mesh = mixedBox(40);
    const EncodeOptions options = optionsFor(mesh, GetParam(), GetParam() == Codec::paper);
    const EncodedGrids one = encoded(mesh, options);
    const auto threads = makeThreadedExecutor(2);
    GridMesh again = mixedBox(40);
    const EncodedGrids other = encoded(again, options, *threads);
    EXPECT_EQ(one.records, other.records);
    EXPECT_EQ(one.offsets, other.offsets);
    ASSERT_EQ(one.nodes.size(), other.nodes.size());
    EXPECT_EQ(std::memcmp(one.nodes.data(), other.nodes.data(), one.nodes.size() * sizeof(bvh::Node)), 0);
    EXPECT_EQ(mesh.looseTriangles, again.looseTriangles);
}

TEST_P(EncodeGrids, DecodesEveryVertexNearItsSource) {
    GridMesh mesh = mixedBox(21);
    const EncodedGrids grids = encoded(mesh, optionsFor(mesh, GetParam()));
    const DecodedGrids decoded = decodeGrids(grids, mesh.grids, looseCount(mesh), serialExecutor());
    const GridErrors errors = errorsOf(mesh, decoded, serialExecutor());
    EXPECT_EQ(errors.all.vertices, mesh.vertices.size() + 3 * mesh.looseTriangles.size());
    EXPECT_LT(errors.all.max, 0.05);
    EXPECT_GT(errors.all.max, 0);
    EXPECT_LE(errors.all.rms, errors.all.max);
    EXPECT_LE(errors.subGridMean, errors.subGridMax);
}

TEST_P(EncodeGrids, DecodesAsAMesh) {
    GridMesh mesh = mixedBox(12);
    const EncodedGrids grids = encoded(mesh, optionsFor(mesh, GetParam()));
    const GridMesh surface = decodedMesh(grids, mesh, serialExecutor());
    EXPECT_EQ(surface.grids, mesh.grids);
    EXPECT_EQ(surface.triangleCount(), mesh.triangleCount());
    EXPECT_EQ(surface.looseSources, mesh.looseSources);
    for (size_t k = 0; k < mesh.vertices.size(); ++k) {
        const Vec3 off = minus(surface.vertices[k], mesh.vertices[k]);
        ASSERT_LT(dot(off, off), 0.05F * 0.05F);
    }
}

// Half a step, and what floats cannot hold (grid/lattice_choice.h).
TEST(EncodeLattice, KeepsItsBoundOnEveryVertex) {
    GridMesh mesh = torus(65, serialExecutor());
    const EncodeOptions options = optionsFor(mesh, Codec::lattice);
    const EncodedGrids grids = encoded(mesh, options);
    const DecodedGrids decoded = decodeGrids(grids, mesh.grids, 0, serialExecutor());
    for (size_t k = 0; k < mesh.vertices.size(); ++k) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const double off = double{decoded.vertices[k][axis]} - double{mesh.vertices[k][axis]};
            ASSERT_LE(std::fabs(off), options.lattice.step[axis] / 2 + 2 * std::ldexp(1.0, -22));
        }
    }
    EXPECT_LE(errorsOf(mesh, decoded, serialExecutor()).all.max, 1e-3 + 1e-6);
}

TEST(EncodeLattice, HasNoCracks) {
    GridMesh mesh = mixedBox(21);
    const EncodedGrids grids = encoded(mesh, optionsFor(mesh, Codec::lattice));
    const Cracks cracks = cracksOf(mesh, decodeGrids(grids, mesh.grids, looseCount(mesh), serialExecutor()));
    EXPECT_GT(cracks.shared, 50u);
    EXPECT_EQ(cracks.cracked, 0u);
}

TEST(EncodeLattice, NamesTheStepThatWouldFit) {
    GridMesh mesh = terrain(9, serialExecutor());
    EncodeOptions options;
    options.lattice.step = {1e-9, 1e-9, 1e-9};
    const auto grids = encodeGrids(mesh, options, serialExecutor(), silentProgress());
    ASSERT_FALSE(grids);
    EXPECT_NE(grids.error().message.find("a step of"), std::string::npos) << grids.error().message;
}

TEST(EncodePaper, NeedsNoOffsetsWithoutClusters) {
    GridMesh mesh = terrain(66, serialExecutor());
    const EncodedGrids grids = encoded(mesh, optionsFor(mesh, Codec::paper));
    EXPECT_TRUE(grids.offsets.empty());
    EXPECT_EQ(grids.leafCount(), 17u * 17u);
    EXPECT_TRUE(check(grids, serialExecutor()));
    EXPECT_TRUE(checkPlaces(grids, mesh.grids, 0));
}

TEST(EncodePaper, RefusesMixedDiagonals) {
    GridMesh mesh = terrain(9, serialExecutor());
    mesh.diagonals.assign(mesh.quadCount(), Diagonal::bd);
    EXPECT_TRUE(encodeGrids(mesh, optionsFor(mesh, Codec::paper), serialExecutor(), silentProgress()));
    mesh.diagonals[5] = Diagonal::ac;
    const auto grids = encodeGrids(mesh, optionsFor(mesh, Codec::paper), serialExecutor(), silentProgress());
    ASSERT_FALSE(grids);
    EXPECT_EQ(grids.error().kind, ErrorKind::unsupported);
}

TEST(EncodePaper, HasTheErrorThatIsMeasuredWithoutIt) {
    GridMesh mesh = box(21, serialExecutor());
    for (const auto code : {DisplacementCode::unitVector, DisplacementCode::sharedExponent}) {
        EncodeOptions options = optionsFor(mesh, Codec::paper);
        options.displacement = code;
        const DecodedGrids decoded = decodeGrids(encoded(mesh, options), mesh.grids, 0, serialExecutor());
        const GridErrors errors = errorsOf(mesh, decoded, serialExecutor());
        const VertexErrors measured = paperErrors(mesh, code, serialExecutor());
        EXPECT_EQ(measured.vertices, mesh.vertices.size());
        EXPECT_DOUBLE_EQ(measured.max, errors.grids.max);
        EXPECT_NEAR(measured.rms, errors.grids.rms, 1e-12);
    }
}

class EncodeSnapped : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Loose, EncodeSnapped, testing::Bool());

TEST_P(EncodeSnapped, HasNoCracks) {
    for (const uint32_t side : {8U, 13U, 40U}) {
        GridMesh mesh = GetParam() ? mixedBox(side) : box(side, serialExecutor());
        const auto cracks = [&](bool snap) {
            const EncodedGrids grids = encoded(mesh, optionsFor(mesh, Codec::paper, snap));
            EXPECT_TRUE(check(grids, serialExecutor()));
            EXPECT_TRUE(checkPlaces(grids, mesh.grids, looseCount(mesh)));
            return cracksOf(mesh, decodeGrids(grids, mesh.grids, looseCount(mesh), serialExecutor()));
        };
        EXPECT_GT(cracks(false).cracked, 0u) << side;
        EXPECT_GT(cracks(false).widest, 0) << side;
        EXPECT_EQ(cracks(true).cracked, 0u) << side;
        EXPECT_EQ(cracks(true).widest, 0) << side;
        EXPECT_EQ(cracks(true).shared, cracks(false).shared) << side;
    }
}

// The records decode to one point at each place of a vertex inside a grid, too: of cut sub-grids and their
// neighbours alike.
TEST_P(EncodeSnapped, AgreesInsideGrids) {
    GridMesh mesh = GetParam() ? mixedBox(21) : box(21, serialExecutor());
    const EncodedGrids grids = encoded(mesh, optionsFor(mesh, Codec::paper, true));
    const DecodedGrids decoded = decodeGrids(grids, mesh.grids, looseCount(mesh), serialExecutor());
    for (size_t k = 0; k < grids.leafCount(); ++k) {
        const bool isCluster = !grids.offsets.empty() && (grids.offsets[k] & EncodedGrids::clusterBit) != 0;
        if (isCluster) continue;
        const uint8_t* const record =
            grids.records.data() + (grids.offsets.empty() ? 128 * k : 8 * size_t{grids.offsets[k]});
        const PaperPlace place = paperPlace(record);
        const PaperVertices vertices = decodePaper(record, grids.paper);
        const VertexGrid& grid = mesh.grids[place.grid];
        for (unsigned row = 0; row <= place.rows; ++row) {
            for (unsigned column = 0; column <= place.columns; ++column) {
                const size_t at =
                    grid.firstVertex + size_t{place.gridRow + row} * grid.columns + place.gridColumn + column;
                ASSERT_EQ(vertices[row * 5 + column], decoded.vertices[at]) << k;
            }
        }
    }
}

TEST(EncodeGridsBadInput, IsRefused) {
    GridMesh empty;
    for (const Codec codec : bothCodecs) {
        EncodeOptions options;
        options.codec = codec;
        const auto grids = encodeGrids(empty, options, serialExecutor(), silentProgress());
        ASSERT_FALSE(grids);
        EXPECT_EQ(grids.error().message, "the mesh has no triangles");
    }
}

TEST(FineLattice, HoldsFloatsExactly) {
    for (const float far : {0.0F, 100.0F, -3e5F}) {
        GridMesh mesh = torus(17, serialExecutor());
        for (Vec3& vertex : mesh.vertices) vertex[1] += far;
        const auto lattice = fineLattice(mesh);
        ASSERT_TRUE(lattice);
        for (const Vec3& vertex : mesh.vertices) {
            const LatticePoint p = lattice->pointAt(vertex);
            const Vec3 decoded = lattice->positionOf(p);
            ASSERT_EQ(lattice->pointAt(decoded), p);
            for (size_t axis = 0; axis < 3; ++axis) {
                ASSERT_GE(p[axis], 0);
                ASSERT_LT(p[axis], latticeLimit);
                // Exact, not rounded to a float.
                ASSERT_EQ(double{decoded[axis]}, lattice->origin[axis] + lattice->step[axis] * p[axis]);
            }
        }
    }
}

TEST(EncodeGrids, EveryStageStopsWhenCancelled) {
    GridMesh mesh = tests::mixedBox(8);
    const EncodeOptions options = tests::optionsFor(mesh, Codec::lattice);
    const EncodedGrids whole = tests::encoded(mesh, options);
    const std::atomic<bool> stop = true;
    FunctionProgress progress(stop);
    const Executor& serial = serialExecutor();
    const auto isCancelled = [](const auto& result) {
        return !result && result.error().kind == ErrorKind::cancelled;
    };
    EXPECT_TRUE(isCancelled(encodeGrids(mesh, options, serial, progress)));
    EXPECT_TRUE(isCancelled(check(whole, serial, progress)));
    EXPECT_TRUE(isCancelled(latticeForRms(mesh, 1e-3, serial, progress)));
    const mesh::FaceMesh faces{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {}, {}};
    EXPECT_TRUE(isCancelled(gridsOf(faces, {}, serial, progress)));
    const auto records = encodeRecords(mesh, options);
    ASSERT_TRUE(records);
    EXPECT_TRUE(isCancelled(buildGrids(*records, serial, progress)));
}

TEST(EncodeGrids, TablesThatDoNotAgreeAreErrors) {
    const GridMesh good = tests::mixedBox(8);
    const EncodeOptions options = tests::optionsFor(good, Codec::lattice);
    const auto expectError = [&](std::string_view part, auto&& change) {
        GridMesh mesh = good;
        change(mesh);
        const auto encoded = encodeGrids(mesh, options);
        ASSERT_FALSE(encoded) << part;
        EXPECT_EQ(encoded.error().kind, ErrorKind::format);
        EXPECT_NE(encoded.error().message.find(part), std::string::npos) << encoded.error().message;
    };
    expectError("vertices of grids, their tables say", [](GridMesh& mesh) { mesh.vertices.pop_back(); });
    expectError("grid 1: begins at vertex 7", [](GridMesh& mesh) { mesh.grids[1].firstVertex = 7; });
    expectError("expected sides of 2 to 65536", [](GridMesh& mesh) { mesh.grids[2].rows = 1; });
    expectError("loose triangle 3: vertex 99999", [](GridMesh& mesh) { mesh.looseTriangles[3][1] = 99999; });
    expectError("3 texture coordinates", [](GridMesh& mesh) { mesh.uvs.resize(3); });
    expectError("loose vertex 3 is not finite", [](GridMesh& mesh) { mesh.looseVertices[3][1] = NAN; });
}

TEST(EncodeGrids, NumbersThatAreNoneAreErrors) {
    GridMesh mesh = tests::mixedBox(8);
    const EncodeOptions options = tests::optionsFor(mesh, Codec::lattice);
    mesh.vertices[3][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(encodeGrids(mesh, options));
    EXPECT_FALSE(latticeForError(mesh, 1e-3));
    mesh::FaceMesh faces{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 7, mesh::noVertex}}, {}, {}};
    EXPECT_FALSE(gridsOf(faces));
    faces.faces[0][2] = 2;
    faces.positions[1][2] = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(gridsOf(faces));
}

}  // namespace
}  // namespace filigree::grid
