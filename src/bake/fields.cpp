#include "bake/fields.h"

#include "bake/classify.h"
#include "bake/placement.h"

namespace filigree::bake {
namespace {

bool isConstant(const mesh::UvTriangle& t) {
    return t.alpha[0] == t.alpha[1] && t.alpha[1] == t.alpha[2];
}

}  // namespace

Fields::Fields(const image::AlphaTexture& texture, const image::AlphaTest& test,
               std::span<const mesh::UvTriangle> triangles)
    : chain_(texture, test.mips) {
    bool needShaded = false;
    for (const mesh::UvTriangle& t : triangles) {
        if (isConstant(t) && (constant_.contains(t.alpha[0]) || constant_.size() < mostFields)) {
            constant_.try_emplace(t.alpha[0], chain_.levels(), test, t.alpha[0]);
        } else {
            needShaded = true;
        }
    }
    if (needShaded) shaded_.emplace(chain_, test);
}

bool Fields::canPlace(const mesh::UvTriangle& triangle) const {
    const image::AlphaImage& image = chain_.levels().front()->image;
    return isPlaceable(triangle, image.width, image.height);
}

void Fields::classify(const mesh::UvTriangle& triangle, unsigned level, bool twoState,
                      const Executor& executor, Classified& to) const {
    if (!canPlace(triangle)) {
        to.appendLeaf(level, twoState ? 1 : 3);
        return;
    }
    const auto field = isConstant(triangle) ? constant_.find(triangle.alpha[0]) : constant_.end();
    if (field != constant_.end()) {
        bake::classify(triangle, field->second, level, twoState, executor, to);
    } else {
        classifyShaded(triangle, *shaded_, level, twoState, to);
    }
}

}  // namespace filigree::bake
