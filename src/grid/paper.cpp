#include "filigree/grid/paper.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

constexpr std::array<std::string_view, 2> displacementNames{"unit-vector", "shared-exponent"};

float withSign(float magnitude, uint32_t sign) {
    return std::bit_cast<float>(std::bit_cast<uint32_t>(magnitude) | sign << 31);
}

// 2^exponent, of a biased exponent 1 to 254.
float powerOfTwo(uint32_t biased) {
    return std::bit_cast<float>(biased << 23);
}

Vec3 unitDisplacement(uint32_t code, const PaperCode& paper) {
    const uint32_t length = code & 0x7ff;
    const uint32_t bits = length == 0 ? 0 : (length << 18) + (uint32_t{paper.exponentBase} << 23);
    const auto scale = std::bit_cast<float>(bits);
    const UnitVectors& vectors = unitVectors();
    const uint32_t k = code >> 11 & 0x3ff;
    return {withSign(vectors.x[k] * scale, code >> 21 & 1), withSign(vectors.y[k] * scale, code >> 22 & 1),
            withSign(vectors.z[k] * scale, code >> 23 & 1)};
}

Vec3 sharedDisplacement(uint32_t code, const PaperCode& paper) {
    const float scale = powerOfTwo((code >> 15 & 63) + paper.exponentBase - 4);
    Vec3 displacement{};
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto mantissa = static_cast<float>(code >> (10 - 5 * axis) & 31);
        displacement[axis] = withSign(mantissa * scale, code >> (21 + axis) & 1);
    }
    return displacement;
}

Vec3 cornerAt(const uint8_t* record, size_t corner) {
    Vec3 position{};
    for (size_t axis = 0; axis < 3; ++axis)
        position[axis] = std::bit_cast<float>(loadLe<uint32_t>(record + 12 * corner + 4 * axis));
    return position;
}

Vec3 mixed(const Vec3& near, const Vec3& far, float nearWeight, float farWeight) {
    return plus(times(near, nearWeight), times(far, farWeight));
}

Vec3 displacementAt(const uint8_t* record, const PaperCode& paper, unsigned column, unsigned row) {
    const auto slot = paperSlot(column, row);
    if (!slot) return {0, 0, 0};
    return displacementOf(paperSlotCode(record, *slot), paper);
}

Error paperError(const std::string& message) {
    return {ErrorKind::format, message};
}

Status checkPlace(const PaperPlace& place) {
    const auto wrongSide = [](unsigned quads) { return quads < 1 || quads > paperQuads; };
    if (wrongSide(place.columns) || wrongSide(place.rows)) {
        return paperError(fmt::format("{} x {} quads, expected 1 to 4 each", place.columns, place.rows));
    }
    const bool leaves =
        place.gridColumn + place.columns > place.gridColumns || place.gridRow + place.rows > place.gridRows;
    if (!leaves) return {};
    return paperError(fmt::format("{} x {} quads at ({}, {}) leave their grid of {} x {} quads",
                                  place.columns, place.rows, place.gridColumn, place.gridRow,
                                  place.gridColumns, place.gridRows));
}

bool isCorner(const PaperPlace& place, unsigned column, unsigned row) {
    return column % place.columns == 0 && row % place.rows == 0;
}

// Slots of corners and of what lies outside the sub-grid must be 0.
Status checkSlots(const uint8_t* record, const PaperPlace& place) {
    for (unsigned row = 0; row < paperSide; ++row) {
        for (unsigned column = 0; column < paperSide; ++column) {
            const auto slot = paperSlot(column, row);
            if (!slot || paperSlotCode(record, *slot) == 0) continue;
            const bool isInside = column <= place.columns && row <= place.rows;
            if (isInside && !isCorner(place, column, row)) continue;
            return paperError(fmt::format("the displacement of vertex ({}, {}) is {:#x}, expected 0", column,
                                          row, paperSlotCode(record, *slot)));
        }
    }
    return {};
}

}  // namespace

std::string_view nameOf(DisplacementCode code) {
    return displacementNames[static_cast<size_t>(code)];
}

std::optional<DisplacementCode> displacementCodeNamed(std::string_view name) {
    for (const DisplacementCode code : {DisplacementCode::unitVector, DisplacementCode::sharedExponent}) {
        if (nameOf(code) == name) return code;
    }
    return std::nullopt;
}

PaperCode PaperCode::forDiagonal(DisplacementCode displacement, float diagonal) {
    const auto biased = static_cast<int>(std::bit_cast<uint32_t>(diagonal) >> 23);
    return {displacement, static_cast<uint8_t>(std::clamp<int>(biased + 1 - 63, leastBase, mostBase))};
}

Vec3 displacementOf(uint32_t code, const PaperCode& paper) {
    return paper.displacement == DisplacementCode::unitVector ? unitDisplacement(code, paper)
                                                              : sharedDisplacement(code, paper);
}

PaperPlace paperPlace(const uint8_t* record) {
    PaperPlace place;
    const unsigned size = record[paperSizeAt];
    place.columns = size >> 4 & 7;
    place.rows = size & 15;
    place.diagonal = (size & 0x80) != 0 ? Diagonal::bd : Diagonal::ac;
    place.grid = loadLe<uint32_t>(record + paperGridAt);
    place.gridColumn = loadLe<uint16_t>(record + paperPlaceAt);
    place.gridRow = loadLe<uint16_t>(record + paperPlaceAt + 2);
    place.gridColumns = loadLe<uint16_t>(record + paperPlaceAt + 4);
    place.gridRows = loadLe<uint16_t>(record + paperPlaceAt + 6);
    return place;
}

std::array<Vec3, 4> paperCorners(const uint8_t* record) {
    return {cornerAt(record, 0), cornerAt(record, 1), cornerAt(record, 2), cornerAt(record, 3)};
}

PaperVertices paperPatch(const std::array<Vec3, 4>& corners, unsigned columns, unsigned rows) {
    PaperVertices points{};
    for (unsigned row = 0; row < paperSide; ++row) {
        const Vec3 left = mixed(corners[0], corners[2], paperNear[rows][row], paperFar[rows][row]);
        const Vec3 right = mixed(corners[1], corners[3], paperNear[rows][row], paperFar[rows][row]);
        for (unsigned column = 0; column < paperSide; ++column) {
            points[row * paperSide + column] =
                mixed(left, right, paperNear[columns][column], paperFar[columns][column]);
        }
    }
    return points;
}

PaperVertices decodePaper(const uint8_t* record, const PaperCode& paper) {
    const PaperPlace place = paperPlace(record);
    const unsigned columns = std::min(place.columns, paperQuads);
    const unsigned rows = std::min(place.rows, paperQuads);
    PaperVertices vertices = paperPatch(paperCorners(record), columns, rows);
    for (unsigned row = 0; row < paperSide; ++row) {
        for (unsigned column = 0; column < paperSide; ++column) {
            Vec3& vertex = vertices[row * paperSide + column];
            vertex = plus(vertex, displacementAt(record, paper, column, row));
        }
    }
    return vertices;
}

Status checkPaper(std::span<const uint8_t, paperBytes> record, const PaperCode& paper) {
    const PaperPlace place = paperPlace(record.data());
    if (const Status status = checkPlace(place); !status) return status;
    if (const auto object = loadLe<uint32_t>(record.data() + paperObjectAt); object != 0)
        return paperError(fmt::format("objectID is {}, expected 0", object));
    if (const Status status = checkSlots(record.data(), place); !status) return status;
    for (const Vec3& vertex : decodePaper(record.data(), paper)) {
        if (std::isfinite(vertex[0]) && std::isfinite(vertex[1]) && std::isfinite(vertex[2])) continue;
        return paperError("a vertex is not finite");
    }
    return {};
}

}  // namespace filigree::grid
