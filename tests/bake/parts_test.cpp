// The parts of the baker, each against a plain rendering of what it does.
#include "bake/majority.h"
#include "bake/micro_polygon.h"
#include "bake/place.h"
#include "bake/rows.h"
#include "bake/tile.h"
#include "bake/trace.h"
#include "bake/votes.h"
#include "baking.h"

#include <algorithm>
#include <cmath>

namespace filigree::bake::tests {
namespace {

using image::Filter;
using image::Outline;
using image::Wrap;

Outline outlineOf(const image::AlphaTexture& texture) {
    return {texture, Filter::linear, image::sideThreshold(maskTest(), 1, texture.image.steps)};
}

TEST(Plane, RangesAndSearches) {
    Random random(1);
    for (int round = 0; round < 200; ++round) {
        Plane plane;
        plane.reset(tileLevel);
        std::vector<bool> bits(4096, false);
        for (int k = 0; k < 5; ++k) {
            const uint32_t first = random.below(4096);
            const uint32_t end = first + random.below(4097 - first);
            plane.setRange(first, end);
            std::fill(bits.begin() + first, bits.begin() + end, true);
        }
        const uint32_t one = random.below(4096);
        plane.set(one);
        bits[one] = true;
        const uint32_t none = random.below(4096);
        plane.clear(none);
        bits[none] = false;
        for (uint32_t k = 0; k < 4096; ++k) ASSERT_EQ(plane.test(k), bits[k]);
        for (int k = 0; k < 50; ++k) {
            const uint32_t from = random.below(4097);
            const uint32_t end = from + random.below(4097 - from);
            const bool value = random.below(2) != 0;
            const auto found = std::find(bits.begin() + from, bits.begin() + end, value);
            EXPECT_EQ(plane.find(value, from, end), static_cast<uint32_t>(found - bits.begin()));
        }
    }
}

TEST(Tile, StreamsAreThoseOfTheFlatMicromap) {
    Random random(2);
    for (int round = 0; round < 300; ++round) {
        const unsigned height = random.below(7);
        Tile tile;
        tile.reset(height);
        const uint32_t runs = random.below(8);
        for (uint32_t k = 0; k < runs; ++k) {
            Plane& plane = k % 2 == 0 ? tile.unknown : tile.side;
            const uint32_t first = random.below(tile.count());
            plane.setRange(first, first + random.below(tile.count() + 1 - first));
        }
        for (const bool twoState : {false, true}) {
            const auto format = twoState ? micromap::Format::twoState : micromap::Format::fourState;
            std::vector<uint8_t> flat(micromap::flatBytes(height, format), 0);
            for (uint32_t k = 0; k < tile.count(); ++k) {
                const unsigned side = tile.side.test(k) ? 1 : 0;
                const unsigned unknown = tile.unknown.test(k) ? 2 : 0;
                const unsigned bits = micromap::bitsPerState(format);
                const unsigned state = twoState ? side : side | unknown;
                flat[k * bits / 8] = static_cast<uint8_t>(flat[k * bits / 8] | state << (k * bits % 8));
            }
            BitWriter stream;
            const int state = appendTile(tile, twoState, stream);
            const micromap::QuadtreeView view{stream.words(), stream.size(), height};
            const auto expected = micromap::quadtreeFromFlat(flat, height, format);
            ASSERT_TRUE(micromap::equal(view, expected.view())) << "height " << height;
            ASSERT_EQ(state, micromap::isUniform(view) ? static_cast<int>(micromap::uniformState(view)) : -1);
        }
    }
}

TEST(TileCurve, IsTheCurve) {
    for (unsigned height = 0; height <= tileLevel; ++height) {
        const TileCurve& curve = TileCurve::of(height);
        for (uint32_t k = 0; k < micromap::microTriangleCount(height); ++k) {
            const auto t = micromap::latticeTriangle(k, height);
            EXPECT_EQ(curve.triangle(k), t);
            EXPECT_EQ(curve.index(t.i, t.j, t.flipped), k);
        }
    }
}

TEST(SubTriangle, ChildrenFollowTheCurve) {
    const unsigned level = 5;
    for (uint32_t k = 0; k < micromap::microTriangleCount(level); ++k) {
        SubTriangle part = SubTriangle::whole(level);
        for (unsigned height = level; height > 0; --height) part = part.child(k >> (2 * (height - 1)) & 3);
        auto corners = micromap::corners(micromap::latticeTriangle(k, level));
        const auto less = [](const auto& a, const auto& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; };
        std::ranges::sort(corners, less);
        std::ranges::sort(part.corner, less);
        EXPECT_EQ(part.corner, corners) << k;
    }
}

// Every point of the widened triangle lies in the cells that the rows tell.
TEST(TriangleRows, CoverTheTriangle) {
    Random random(3);
    for (int round = 0; round < 500; ++round) {
        const double margin = random.below(2) != 0 ? 0 : static_cast<double>(random.between(0, 3));
        std::array<Point<double>, 3> p;
        for (auto& c : p) c = {random.between(-9, 9), random.between(-9, 9)};
        if (random.below(4) == 0) p[1].y = p[0].y;
        if (random.below(4) == 0) p[2] = p[0];
        if (random.below(4) == 0) {
            for (auto& c : p) c = {std::round(c.x), std::round(c.y)};
        }
        const TriangleRows rows(p, margin);
        const auto together = rows.columns(rows.firstRow(), rows.lastRow());
        for (int k = 0; k < 200; ++k) {
            double a = random.between(0, 1);
            double b = random.between(0, 1);
            if (k < 3) a = k == 1 ? 1 : 0, b = k == 2 ? 1 : 0;
            if (a + b > 1) a = 1 - a, b = 1 - b;
            const double dx = random.below(3) * margin - margin;
            const double dy = random.below(3) * margin - margin;
            const double x = p[0].x + a * (p[1].x - p[0].x) + b * (p[2].x - p[0].x) + dx * (1 - 1e-12);
            const double y = p[0].y + a * (p[1].y - p[0].y) + b * (p[2].y - p[0].y) + dy * (1 - 1e-12);
            // The baker's own margin is a little wider than the triangle, for such rounding.
            const double slack = 1e-9;
            const auto row = static_cast<int64_t>(std::floor(y));
            const bool onRow = std::fabs(y - std::round(y)) < slack;
            if (!onRow) {
                ASSERT_TRUE(row >= rows.firstRow() && row <= rows.lastRow());
            }
            if (onRow) continue;
            const auto columns = rows.columns(row, row);
            EXPECT_GE(x + slack, static_cast<double>(columns.first));
            EXPECT_LE(x - slack, static_cast<double>(columns.last + 1));
            EXPECT_LE(together.first, columns.first);
            EXPECT_GE(together.last, columns.last);
        }
    }
}

// The widened shape holds the micro-triangle's corners moved by the guard, and no point further out.
TEST(WidenedShape, IsTheHullOfTheMovedCorners) {
    Random random(4);
    for (int round = 0; round < 300; ++round) {
        const double guard =
            random.below(3) == 0 ? 0 : std::ldexp(1.0, static_cast<int>(random.below(8)) - 5);
        std::array<Point<double>, 3> corners;
        for (auto& c : corners) c = {std::round(random.between(-8, 8)), std::round(random.between(-8, 8))};
        const mesh::UvTriangle t = triangleOf(
            {static_cast<float>(corners[0].x + 0.5) / 16, static_cast<float>(corners[0].y + 0.5) / 16},
            {static_cast<float>(corners[1].x + 0.5) / 16, static_cast<float>(corners[1].y + 0.5) / 16},
            {static_cast<float>(corners[2].x + 0.5) / 16, static_cast<float>(corners[2].y + 0.5) / 16});
        const image::CellAxis axis(16, Wrap::clampToEdge);
        const Placement placement(t, axis, axis);
        const SubTriangle part = SubTriangle::whole(0);
        const WidenedShape shape(corners, guard);
        const auto polygon = shape.polygon<double>(part, placement, {0, 0, false}, 0, 0);
        // The support of the shape in any direction is that of the triangle and the square.
        for (int k = 0; k < 64; ++k) {
            const double dx = std::cos(0.1 * k);
            const double dy = std::sin(0.1 * k);
            double most = -1e300;
            for (size_t v = 0; v < polygon.size(); ++v)
                most = std::max(most, polygon[v].x * dx + polygon[v].y * dy);
            double expected = -1e300;
            for (const auto& c : corners) expected = std::max(expected, c.x * dx + c.y * dy);
            expected += guard * (std::fabs(dx) + std::fabs(dy));
            ASSERT_NEAR(most, expected, 1e-9);
        }
    }
}

TEST(Votes, CountAsSamplesDo) {
    Random random(5);
    const auto texture = texture16(61, 47, [&](uint32_t, uint32_t) { return random.below(65536); });
    for (int round = 0; round < 100; ++round) {
        Votes votes{&texture.image,
                    10 + random.below(40),
                    10 + random.below(26),
                    random.between(0, 1),
                    random.between(0, 1),
                    random.below(2) != 0 ? 1.0F : -1.0F,
                    30000.5F};
        std::vector<float> x(64);
        std::vector<float> y(64);
        size_t expected = 0;
        size_t close = 0;
        for (size_t k = 0; k < 64; ++k) {
            x[k] = random.between(-8, 8);
            y[k] = random.between(-8, 8);
            const double sx = double{votes.x} + double{votes.sign} * x[k] + votes.column + 0.5;
            const double sy = double{votes.y} + double{votes.sign} * y[k] + votes.row + 0.5;
            const double alpha = image::sampleBilinear(texture, sx, sy) * 65535;
            expected += alpha >= 30000.5 ? 1 : 0;
            close += std::fabs(alpha - 30000.5) < 1 ? 1 : 0;
        }
        EXPECT_NEAR(static_cast<double>(countOpaque(votes, x, y)), static_cast<double>(expected),
                    static_cast<double>(close));
    }
}

TEST(SideRule, DepthGrowsWithTheArea) {
    EXPECT_EQ(SideRule::depth(0), 2U);
    EXPECT_EQ(SideRule::depth(64), 2U);
    EXPECT_EQ(SideRule::depth(64.1), 3U);
    EXPECT_EQ(SideRule::depth(256), 3U);
    EXPECT_EQ(SideRule::depth(1e9), 5U);
    for (unsigned depth = 2; depth <= 5; ++depth) {
        const auto& centroids = SideRule::centroids(depth);
        ASSERT_EQ(centroids.size(), micromap::microTriangleCount(depth));
        double i = 0;
        double j = 0;
        for (const auto& c : centroids) {
            EXPECT_TRUE(c.i > 0 && c.j > 0 && c.i + c.j < 1);
            i += c.i;
            j += c.j;
        }
        EXPECT_NEAR(i / static_cast<double>(centroids.size()), 1.0 / 3, 1e-12);
        EXPECT_NEAR(j / static_cast<double>(centroids.size()), 1.0 / 3, 1e-12);
    }
}

// The side of unknown micro-triangles against a dense count of samples.
TEST(SideRule, AgreesWithDenseSampling) {
    Random random(6);
    size_t unknown = 0;
    for (int round = 0; round < 60; ++round) {
        image::AlphaTexture texture = random.texture();
        const mesh::UvTriangle t = random.triangle(0.7F);
        const unsigned level = random.below(4);
        const auto states = bakeOne(t, texture, maskTest(), level);
        for (uint32_t k = 0; k < states.size(); ++k) {
            if (micromap::isKnown(states[k])) continue;
            ++unknown;
            const double share = verify::opaqueShare(t, level, k, texture, maskTest(), 64);
            if (share > 0.62) {
                EXPECT_EQ(states[k], State::unknownOpaque) << share;
            }
            if (share < 0.38) {
                EXPECT_EQ(states[k], State::unknownTransparent) << share;
            }
        }
    }
    EXPECT_GT(unknown, 100U);
}

TEST(Placement, PeriodsComeOffExactly) {
    const image::CellAxis axis(48, Wrap::mirroredRepeat);
    const auto near = triangleOf({0.25F, 0.5F}, {1.75F, 0.625F}, {0.5F, 1.5F});
    auto far = near;
    for (mesh::Uv& p : far.uv) p = {p.u + 2048, p.v - 512};
    const Placement a(near, axis, axis);
    const Placement b(far, axis, axis);
    for (int i = 0; i <= 8; ++i) {
        EXPECT_EQ(a.at(i, 8 - i, 3).x, b.at(i, 8 - i, 3).x);
        EXPECT_EQ(a.at(i, 8 - i, 3).y, b.at(i, 8 - i, 3).y);
        EXPECT_EQ(a.boundedAt(i, 8 - i, 3).x.error(), 0);
        EXPECT_EQ(a.boundedAt(i, 8 - i, 3).x.value(), a.at(i, 8 - i, 3).x);
    }
}

TEST(Placement, ReachEndsAt2To26Texels) {
    EXPECT_TRUE(isPlaceable(triangleOf({65536, 0}, {-65536, 0}, {0, 1}), 1024, 1024));
    EXPECT_FALSE(isPlaceable(triangleOf({65537, 0}, {0, 0}, {0, 1}), 1024, 1024));
    EXPECT_TRUE(isPlaceable(triangleOf({65537, 0}, {0, 0}, {0, 1}), 1023, 1024));
    auto shaded = triangleOf({0, 0}, {1, 0}, {0, 1});
    shaded.alpha[1] = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(isPlaceable(shaded, 4, 4));
}

// What the tracer leaves clear no piece of the outline touches, and what it marks is near one.
TEST(Trace, MarksWhatDenseSamplesOfTheOutlineMeet) {
    Random random(7);
    for (int round = 0; round < 60; ++round) {
        const image::AlphaTexture texture = random.texture();
        const Outline outline = outlineOf(texture);
        const mesh::UvTriangle t = random.triangle(1);
        const unsigned height = random.below(tileLevel + 1);
        const SubTriangle part = SubTriangle::whole(height);
        const Placement placement(t, outline);
        Tile tile;
        tile.reset(height);
        markCrossed(part, placement, outline, 0, tile);
        EXPECT_TRUE(mayCross(part, placement, outline, 0) ||
                    tile.unknown.find(true, 0, tile.count()) == tile.count());
        // Both sides seen at the corners and the centre of a micro-triangle: then it is crossed.
        for (uint32_t k = 0; k < tile.count(); ++k) {
            const auto lattice = micromap::corners(micromap::latticeTriangle(k, height));
            std::array<Point<double>, 3> p;
            for (size_t c = 0; c < 3; ++c) p[c] = part.position(placement, lattice[c].i, lattice[c].j);
            const bool first = outline.sideAt(p[0].x, p[0].y).opaque;
            bool unlike = false;
            for (int s = 0; s < 30; ++s) {
                double a = random.between(0, 1);
                double b = random.between(0, 1);
                if (a + b > 1) a = 1 - a, b = 1 - b;
                const auto side = outline.sideAt(p[0].x + a * (p[1].x - p[0].x) + b * (p[2].x - p[0].x),
                                                 p[0].y + a * (p[1].y - p[0].y) + b * (p[2].y - p[0].y));
                unlike = unlike || (side.opaque != first && side.distance > 1e-9);
            }
            if (unlike && outline.sideAt(p[0].x, p[0].y).distance > 1e-9) {
                ASSERT_TRUE(tile.unknown.test(k));
            }
        }
    }
}

// A plain rendering of placePieces().
int32_t placeOfPoint(const PlaceFrame& f, double a, double b) {
    const double i = std::floor(a);
    const double j = std::floor(b);
    if (i < 0 || j < 0 || a + b >= f.steps) return placeOutside;
    const int32_t flipped = a - i + b - j > 1 ? 1 : 0;
    return (static_cast<int32_t>(j) << f.rowShift) | (static_cast<int32_t>(i) << 1) | flipped;
}

TEST(PlacePieces, EndsLieWhereItSays) {
    Random random(8);
    const auto texture = texture8(64, 64, [&](uint32_t, uint32_t) { return random.below(2) * 255; });
    const Outline outline = outlineOf(texture);
    PlaceFrame frame;
    frame.column = 5;
    frame.row = 7;
    frame.ax = 0.9F;
    frame.ay = 0.2F;
    frame.a0 = -0.3F;
    frame.bx = -0.25F;
    frame.by = 1.1F;
    frame.b0 = 0.4F;
    frame.reach = 0.01F;
    frame.length = 1.2F;
    frame.steps = 64;
    frame.rowShift = 7;
    size_t placed = 0;
    for (int64_t row = 0; row < 64; row += 4) {
        outline.forEachRun({row, outline.bandEnd(row), 0, 63}, [&](const Outline::Run& all) {
            for (size_t first = all.first; first < all.end; first += Places::capacity) {
                const Outline::Run run{first, std::min(all.end, first + Places::capacity), all.column,
                                       all.row};
                Places places;
                placePieces(outline.pieceArrays(), run, frame, places);
                for (size_t k = run.first; k < run.end; ++k) {
                    const int32_t found = places.first[k - run.first];
                    if (found == placeUnclear) continue;
                    const image::OutlinePiece piece = outline.piece(k);
                    const auto lattice = [&](double x, double y) {
                        const double dx = static_cast<double>(run.column + piece.cell - frame.column) + x;
                        const double dy = static_cast<double>(run.row + piece.row - frame.row) + y;
                        return std::array{frame.ax * dx + frame.ay * dy + frame.a0,
                                          frame.bx * dx + frame.by * dy + frame.b0};
                    };
                    const auto p = lattice(piece.x0, piece.y0);
                    const auto q = lattice(piece.x1, piece.y1);
                    const int32_t atP = placeOfPoint(frame, p[0], p[1]);
                    const int32_t atQ = placeOfPoint(frame, q[0], q[1]);
                    if (found == placeOutside) {
                        // Wholly outside, or its first end is and the second says where it comes in.
                        EXPECT_EQ(atP, placeOutside);
                        EXPECT_TRUE(atQ == placeOutside || places.second[k - run.first] == atQ);
                    } else {
                        EXPECT_EQ(found, atP);
                        EXPECT_EQ(places.second[k - run.first], atQ);
                        ++placed;
                    }
                }
            }
            return true;
        });
    }
    EXPECT_GT(placed, 500U);
}

}  // namespace
}  // namespace filigree::bake::tests
