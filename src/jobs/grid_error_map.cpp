#include "jobs/grid_error_map.h"

#include "filigree/grid/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr uint32_t sheetLimit = 4096;  // pixels a side, about
constexpr uint32_t panelLimit = 1024;  // the same in a page
constexpr uint32_t sheetGap = 1;
constexpr unsigned sharesPerPercent = 10000;

// The shares of a grid, each pixel the largest of factor x factor of them.
grid::SubGridShares reducedShares(const grid::SubGridShares& from, uint32_t factor) {
    grid::SubGridShares to;
    to.columns = (from.columns + factor - 1) / factor;
    to.rows = (from.rows + factor - 1) / factor;
    to.shares.resize(size_t{to.columns} * to.rows);
    for (size_t k = 0; k < from.shares.size(); ++k) {
        const size_t row = k / from.columns / factor;
        float& share = to.shares[row * to.columns + k % from.columns / factor];
        share = std::max(share, from.shares[k]);
    }
    return to;
}

struct ErrorSheetPlace {
    uint32_t left = 0;
    uint32_t top = 0;
};

// Rectangles in rows from the top, the high ones first.
struct ErrorSheet {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<ErrorSheetPlace> places;
};

ErrorSheet packedSheet(const std::vector<grid::SubGridShares>& pieces) {
    std::vector<size_t> order(pieces.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, [&](size_t a, size_t b) {
        return std::tuple(pieces[a].rows, pieces[a].columns) > std::tuple(pieces[b].rows, pieces[b].columns);
    });
    double cells = 0;
    ErrorSheet sheet;
    for (const auto& piece : pieces) {
        cells += double(piece.columns + sheetGap) * (piece.rows + sheetGap);
        sheet.width = std::max(sheet.width, piece.columns);
    }
    if (pieces.size() > 1)
        sheet.width = std::max(sheet.width, static_cast<uint32_t>(std::ceil(std::sqrt(1.2 * cells))));
    sheet.places.resize(pieces.size());
    uint32_t left = 0;
    uint32_t top = 0;
    for (const size_t k : order) {
        if (left > 0 && left + pieces[k].columns > sheet.width) {
            left = 0;
            top = sheet.height + sheetGap;
        }
        sheet.places[k] = {left, top};
        left += pieces[k].columns + sheetGap;
        sheet.height = std::max(sheet.height, top + pieces[k].rows);
    }
    return sheet;
}

// The errors of all sub-grids on one sheet, in percent.
struct ErrorSheetSums {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> sums;
    std::string what;

    [[nodiscard]] HeatSource source() const { return {what, sums, width, height, sharesPerPercent}; }
};

ErrorSheetSums errorSums(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded, grid::Codec codec,
                         uint32_t limit) {
    std::vector<grid::SubGridShares> pieces;
    for (uint32_t k = 0; k < mesh.grids.size(); ++k) pieces.push_back(grid::subGridShares(mesh, decoded, k));
    if (pieces.empty()) pieces.push_back({1, 1, {0}});
    ErrorSheet sheet = packedSheet(pieces);
    while (std::max(sheet.width, sheet.height) > limit) {
        for (auto& piece : pieces) piece = reducedShares(piece, 2);
        const ErrorSheet smaller = packedSheet(pieces);
        if (smaller.width >= sheet.width && smaller.height >= sheet.height) break;
        sheet = smaller;
    }
    ErrorSheetSums all{sheet.width, sheet.height, {}, fmt::format("{} error, % of sub-grid", nameOf(codec))};
    all.sums.assign(size_t{sheet.width} * sheet.height, HeatSource::absent);
    for (size_t k = 0; k < pieces.size(); ++k) {
        for (size_t s = 0; s < pieces[k].shares.size(); ++s) {
            const size_t row = sheet.places[k].top + s / pieces[k].columns;
            const double percent = std::min(100 * double{pieces[k].shares[s]}, 1e5);
            all.sums[row * sheet.width + sheet.places[k].left + s % pieces[k].columns] =
                static_cast<uint32_t>(std::lround(percent * sharesPerPercent));
        }
    }
    return all;
}

}  // namespace

Canvas gridErrorMap(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded, grid::Codec codec) {
    return heatMap(errorSums(mesh, decoded, codec, sheetLimit).source());
}

HeatPanel gridErrorPanel(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded, grid::Codec codec) {
    const ErrorSheetSums all = errorSums(mesh, decoded, codec, panelLimit);
    const HeatSource source = all.source();
    return heatPanel(source, heatEnd(source));
}

}  // namespace filigree::jobs
