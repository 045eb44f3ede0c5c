#include "filigree/quadmap/squares.h"

#include "filigree/image/placement.h"

#include "quadmap/square_field.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace filigree::quadmap {
namespace {

bool isPlaceable(const HalfTriangle& triangle, const image::AlphaImage& image) {
    for (size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(triangle.alpha[k])) return false;
        if (!image::isPlaceable(triangle.uv[k].u, triangle.uv[k].v, image.width, image.height)) return false;
    }
    return true;
}

HalfShape shapeOf(const HalfTriangle& triangle) {
    HalfShape shape;
    for (size_t k = 0; k < 3; ++k) {
        shape.x[k] = triangle.uv[k].u;
        shape.y[k] = triangle.uv[k].v;
        shape.alpha[k] = std::max(0.0, double{triangle.alpha[k]});
    }
    return shape;
}

void markMixed(Half half, Square& square) {
    for (unsigned y = 0; y < square.side; ++y) {
        for (unsigned x = 0; x < square.side; ++x) {
            const bool isInside = half == Half::first ? x + y < square.side : x + y + 1 >= square.side;
            if (isInside) square.at(x, y) = Region::mixed;
        }
    }
}

void fill(const SquareField& field, const HalfTriangle& triangle, Half half, Square& square) {
    if (isPlaceable(triangle, field.texture().image)) {
        field.fill(shapeOf(triangle), half, square);
    } else {
        markMixed(half, square);
    }
}

Square unfilled(unsigned side) {
    assert(std::has_single_bit(side) && side <= maxSquareSide);
    return Square(side, Region::free);
}

}  // namespace

std::optional<Crop> visibleCrop(const image::AlphaImage& image) {
    Crop crop{image.width, image.height, 0, 0};
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            if (image.at(x, y) == 0) continue;
            crop = {std::min(crop.x0, x), std::min(crop.y0, y), std::max(crop.x1, x + 1), y + 1};
        }
    }
    if (crop.x1 == 0) return std::nullopt;
    return crop;
}

SquareMaker::SquareMaker(const image::AlphaTexture& texture, const image::AlphaTest& test)
    : field_(std::make_unique<SquareField>(texture, test)) {}

SquareMaker::~SquareMaker() = default;

Square SquareMaker::ofCrop(const Crop& crop, unsigned side) const {
    const image::AlphaImage& image = field_->texture().image;
    assert(crop.x0 < crop.x1 && crop.x1 <= image.width && crop.y0 < crop.y1 && crop.y1 <= image.height);
    Square square = unfilled(side);
    const auto add = [&](Half half, double x0, double x1, double y0, double y1) {
        field_->fill({{x0, x1, x0}, {y0, y0, y1}, double(image.width), double(image.height)}, half, square);
    };
    add(Half::first, crop.x0, crop.x1, crop.y0, crop.y1);
    add(Half::second, crop.x1, crop.x0, crop.y1, crop.y0);
    return square;
}

Square SquareMaker::ofTexture(unsigned side) const {
    const image::AlphaImage& image = field_->texture().image;
    return ofCrop({0, 0, image.width, image.height}, side);
}

Square SquareMaker::ofPair(const HalfTriangle& first, const HalfTriangle& second, unsigned side) const {
    Square square = unfilled(side);
    fill(*field_, first, Half::first, square);
    fill(*field_, second, Half::second, square);
    return square;
}

Square SquareMaker::ofSingle(const HalfTriangle& first, unsigned side) const {
    Square square = unfilled(side);
    fill(*field_, first, Half::first, square);
    return square;
}

Square halved(const Square& square) {
    assert(square.side % 2 == 0);
    Square half(square.side / 2, Region::free);
    for (unsigned y = 0; y < square.side; ++y) {
        for (unsigned x = 0; x < square.side; ++x) {
            Region& region = half.at(x / 2, y / 2);
            region = agreed(region, square.at(x, y));
        }
    }
    return half;
}

}  // namespace filigree::quadmap
