#include "filigree/image/outline.h"

#include "textures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace filigree::image {
namespace {

using tests::Random;
using Cell = std::pair<int64_t, int64_t>;  // row, column

Threshold half(const AlphaTexture& t) {
    return sideThreshold(AlphaTest{}, 1, t.image.steps);
}

bool isCrossed(const Outline& outline, int64_t x, int64_t y) {
    const bool first = outline.texelIsOpaque(x, y);
    return outline.texelIsOpaque(x + 1, y) != first || outline.texelIsOpaque(x, y + 1) != first ||
           outline.texelIsOpaque(x + 1, y + 1) != first;
}

// The unwrapped cells of the pieces that forEachRun() gives for a block of cells, band by band.
std::set<Cell> cellsOf(const Outline& outline, const Outline::Cells& block) {
    std::set<Cell> cells;
    for (int64_t row = block.firstRow; row <= block.lastRow;) {
        const int64_t last = std::min(outline.bandEnd(row), block.lastRow);
        outline.forEachRun({row, last, block.firstColumn, block.lastColumn}, [&](const Outline::Run& run) {
            for (size_t k = run.first; k < run.end; ++k) {
                const OutlinePiece piece = outline.piece(k);
                cells.insert({run.row + piece.row, run.column + piece.cell});
            }
            return true;
        });
        row = last + 1;
    }
    return cells;
}

Outline::Cells randomBlock(Random& random, int64_t reach) {
    const auto at = [&] {
        return static_cast<int64_t>(random.below(static_cast<uint32_t>(2 * reach))) - reach;
    };
    const int64_t x = at();
    const int64_t y = at();
    return {y, y + random.below(30), x, x + random.below(30)};
}

// All crossed cells come up, and no cell that is not crossed, whatever the wrap modes: beyond the borders,
// over many periods, and far away.
TEST(Outline, RunsHoldTheCrossedCells) {
    Random random(1);
    for (int round = 0; round < 600; ++round) {
        const AlphaTexture t = random.texture(1 + random.below(20), 1 + random.below(20));
        const Outline outline(t, random.below(2) != 0 ? Filter::linear : Filter::nearest, half(t));
        const Outline::Cells block = randomBlock(random, round % 3 == 0 ? 1'000'000 : 40);
        const std::set<Cell> found = cellsOf(outline, block);
        for (const auto& [row, column] : found) {
            EXPECT_TRUE(isCrossed(outline, column, row)) << column << " " << row;
        }
        bool any = false;
        for (int64_t y = block.firstRow; y <= block.lastRow; ++y) {
            for (int64_t x = block.firstColumn; x <= block.lastColumn; ++x) {
                if (!isCrossed(outline, x, y)) continue;
                any = true;
                EXPECT_TRUE(found.contains({y, x})) << x << " " << y;
            }
        }
        bool crosses = false;
        for (int64_t row = block.firstRow; row <= block.lastRow; row = outline.alikeEnd(row) + 1) {
            const int64_t last = std::min(outline.alikeEnd(row), block.lastRow);
            crosses = crosses || outline.crosses({row, last, block.firstColumn, block.lastColumn});
            if (last == block.lastRow) break;
        }
        EXPECT_TRUE(crosses || !any);
        EXPECT_TRUE(!outline.empty() || !any);
    }
}

TEST(Outline, NoPieceComesTwiceInABlockOfOnePeriod) {
    Random random(2);
    for (int round = 0; round < 100; ++round) {
        const AlphaTexture t = random.texture(1 + random.below(20), 1 + random.below(20));
        const Outline outline(t, Filter::linear, half(t));
        std::map<size_t, int> seen;
        const int64_t firstX = outline.axisX().representative(0);
        const int64_t firstY = outline.axisY().representative(0);
        for (int64_t row = firstY; row < firstY + outline.axisY().cells; row = outline.bandEnd(row) + 1) {
            outline.forEachRun({row, outline.bandEnd(row), firstX, firstX + outline.axisX().cells - 1},
                               [&](const Outline::Run& run) {
                                   for (size_t k = run.first; k < run.end; ++k) ++seen[k];
                                   return true;
                               });
        }
        EXPECT_EQ(seen.size() + Outline::padding, outline.pieceArrays().cell.size());
        for (const auto& [piece, count] : seen) EXPECT_EQ(count, 1) << piece;
    }
}

double distanceToSegment(const OutlinePiece& p, double x, double y) {
    const double dx = double{p.x1} - p.x0;
    const double dy = double{p.y1} - p.y0;
    const double length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp(((x - p.x0) * dx + (y - p.y0) * dy) / length, 0.0, 1.0) : 0;
    return std::hypot(x - p.x0 - t * dx, y - p.y0 - t * dy);
}

// Where the sign of the patch changes between neighbours of a fine grid, a piece is as near as it says.
TEST(Outline, TheCurveStaysWithinTheBulge) {
    Random random(3);
    for (int round = 0; round < 150; ++round) {
        const AlphaTexture t = random.texture(2 + random.below(4), 2 + random.below(4));
        const Outline outline(t, Filter::linear, half(t));
        std::map<Cell, std::vector<OutlinePiece>> pieces;
        for (size_t k = 0; k + Outline::padding < outline.pieceArrays().cell.size(); ++k) {
            const OutlinePiece p = outline.piece(k);
            pieces[{outline.axisY().representative(p.row), outline.axisX().representative(p.cell)}].push_back(
                p);
        }
        for (const auto& [cell, arcs] : pieces) {
            const Patch patch = outline.patch(cell.second, cell.first);
            const auto at = [&](double x, double y) { return patch.at(PatchPoint<double>{x, y}); };
            const double steep = 1e-6 + 2e-7 * (std::fabs(patch.alongX) + std::fabs(patch.alongY) +
                                                2 * std::fabs(patch.twist));
            for (const OutlinePiece& p : arcs) {
                EXPECT_TRUE(std::min({p.x0, p.y0, p.x1, p.y1}) >= 0 &&
                            std::max({p.x0, p.y0, p.x1, p.y1}) <= 1);
                EXPECT_NEAR(at(p.x0, p.y0), 0, steep);
                EXPECT_NEAR(at(p.x1, p.y1), 0, steep);
            }
            constexpr int steps = 32;
            for (int a = 0; a <= steps; ++a) {
                for (int b = 0; b < steps; ++b) {
                    // Along a grid line the patch is linear, so the crossing is known.
                    for (const bool alongX : {true, false}) {
                        const double fixed = a / double{steps};
                        const double from = b / double{steps};
                        const double to = (b + 1) / double{steps};
                        const double v0 = alongX ? at(from, fixed) : at(fixed, from);
                        const double v1 = alongX ? at(to, fixed) : at(fixed, to);
                        if ((v0 >= 0) == (v1 >= 0)) continue;
                        const double moving = from + (to - from) * v0 / (v0 - v1);
                        const double x = alongX ? moving : fixed;
                        const double y = alongX ? fixed : moving;
                        const bool near = std::ranges::any_of(arcs, [&](const OutlinePiece& p) {
                            return distanceToSegment(p, x, y) <= p.bulge + 1e-6;
                        });
                        ASSERT_TRUE(near) << x << " " << y;
                    }
                }
            }
        }
    }
}

TEST(Outline, SplittingKeepsTheCurve) {
    Random random(4);
    size_t split = 0;
    for (int round = 0; round < 60; ++round) {
        const AlphaTexture t = random.texture(3, 3);
        const Outline outline(t, Filter::linear, half(t));
        for (size_t k = 0; k + Outline::padding < outline.pieceArrays().cell.size(); ++k) {
            const OutlinePiece p = outline.piece(k);
            const auto halves = outline.split(p, outline.patch(outline.axisX().representative(p.cell),
                                                               outline.axisY().representative(p.row)));
            if (!halves) continue;
            ++split;
            const auto& [first, second] = *halves;
            EXPECT_EQ(first.x0, p.x0);
            EXPECT_EQ(first.y0, p.y0);
            EXPECT_EQ(second.x1, p.x1);
            EXPECT_EQ(second.y1, p.y1);
            EXPECT_EQ(first.x1, second.x0);
            EXPECT_EQ(first.y1, second.y0);
            EXPECT_LE(distanceToSegment(p, first.x1, first.y1), p.bulge + 1e-6);
            EXPECT_LE(std::max(first.bulge, second.bulge), p.bulge + 2e-6F);
        }
    }
    EXPECT_GT(split, 100U);
}

TEST(Outline, SidesAreThoseOfTheSamples) {
    Random random(5);
    for (int round = 0; round < 300; ++round) {
        const AlphaTexture t = random.texture(1 + random.below(9), 1 + random.below(9));
        const Threshold threshold = half(t);
        const Outline linear(t, Filter::linear, threshold);
        const Outline nearest(t, Filter::nearest, threshold);
        for (int k = 0; k < 50; ++k) {
            const double x = random.between(-30, 30);
            const double y = random.between(-30, 30);
            const double alpha = sampleBilinear(t, x + 0.5, y + 0.5) * 65535;
            const Outline::Side side = linear.sideAt(x, y);
            if (std::fabs(alpha - threshold.value) > 1e-6) {
                EXPECT_EQ(side.opaque, alpha >= threshold.value);
            }
            if (side.distance < 1) {
                EXPECT_NEAR(side.distance, std::fabs(alpha - threshold.value) / 65535, 1e-9);
            }
            const double texel = sampleNearest(t, x + 0.5, y + 0.5) * 65535;
            EXPECT_EQ(nearest.sideAt(x, y).opaque, texel > threshold.value - 0.25);
        }
    }
}

TEST(CellAxis, CopiesReadTheSameTexels) {
    for (const Wrap wrap : tests::wraps) {
        for (uint32_t size = 1; size < 6; ++size) {
            const CellAxis axis(size, wrap);
            for (int64_t cell = -20; cell < 20; ++cell) {
                const int64_t canonical = axis.canonical(cell);
                ASSERT_TRUE(canonical >= 0 && canonical < axis.cells);
                const int64_t other = axis.representative(canonical);
                EXPECT_EQ(axis.canonical(other), canonical);
                EXPECT_EQ(wrapTexel(cell, size, wrap), wrapTexel(other, size, wrap));
                EXPECT_EQ(wrapTexel(cell + 1, size, wrap), wrapTexel(other + 1, size, wrap));
            }
        }
    }
}

TEST(Outline, ConstantTexturesHaveNone) {
    for (const uint32_t size : {1U, 5U, 64U, 65U, 200U}) {
        AlphaTexture t;
        t.image = {size, 3, std::vector<uint16_t>(size_t{size} * 3, 40000), 65535};
        for (const Wrap wrap : tests::wraps) {
            t.wrapU = t.wrapV = wrap;
            EXPECT_TRUE(Outline(t, Filter::linear, half(t)).empty());
            t.image.texels[size - 1] = 0;
            EXPECT_EQ(Outline(t, Filter::linear, half(t)).empty(), false);
            t.image.texels[size - 1] = 40000;
        }
    }
}

}  // namespace
}  // namespace filigree::image
