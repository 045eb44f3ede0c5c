#include "bvh/slot_order.h"

#include <algorithm>

namespace filigree::bvh {
namespace {

// Part of the children, in `order_`.
struct SlotPart {
    size_t begin = 0;
    size_t end = 0;
    [[nodiscard]] size_t count() const { return end - begin; }
    [[nodiscard]] size_t middle() const { return begin + (count() + 1) / 2; }
};

class SlotHalving {
  public:
    explicit SlotHalving(std::span<const Box> children) : count_(children.size()) {
        for (size_t k = 0; k < count_; ++k) {
            order_[k] = static_cast<uint8_t>(k);
            for (size_t axis = 0; axis < 3; ++axis)
                centres_[k][axis] = (double{children[k].low[axis]} + children[k].high[axis]) / 2;
        }
    }

    SlotOrder run() {
        std::array<SlotPart, width> parts{SlotPart{0, count_}};
        SlotOrder result;
        for (size_t bit = 3, partCount = 1; bit-- > 0; partCount *= 2) {
            const size_t axis = widestAxis(std::span(parts).first(partCount));
            result.axes = static_cast<uint8_t>(result.axes | axis << 2 * bit);
            for (size_t k = partCount; k-- > 0;) {
                const SlotPart part = parts[k];
                sortAlong(axis, part);
                parts[2 * k] = {part.begin, part.middle()};
                parts[2 * k + 1] = {part.middle(), part.end};
            }
        }
        for (size_t slot = 0; slot < width; ++slot)
            result.childOf[slot] = parts[slot].count() == 0 ? SlotOrder::none : order_[parts[slot].begin];
        return result;
    }

  private:
    [[nodiscard]] size_t widestAxis(std::span<const SlotPart> parts) const {
        std::array<double, 3> spread{};
        for (const SlotPart& part : parts)
            for (size_t axis = 0; axis < 3; ++axis) spread[axis] += spreadOf(part, axis);
        return static_cast<size_t>(std::ranges::max_element(spread) - spread.begin());
    }
    [[nodiscard]] double spreadOf(const SlotPart& part, size_t axis) const {
        if (part.count() < 2) return 0;
        const auto [low, high] =
            std::minmax_element(order_.begin() + part.begin, order_.begin() + part.end,
                                [&](size_t a, size_t b) { return centres_[a][axis] < centres_[b][axis]; });
        return centres_[*high][axis] - centres_[*low][axis];
    }
    void sortAlong(size_t axis, const SlotPart& part) {
        std::sort(order_.begin() + part.begin, order_.begin() + part.end, [&](uint8_t a, uint8_t b) {
            return centres_[a][axis] != centres_[b][axis] ? centres_[a][axis] < centres_[b][axis] : a < b;
        });
    }

    size_t count_;
    std::array<uint8_t, width> order_{};
    std::array<std::array<double, 3>, width> centres_{};
};

}  // namespace

SlotOrder slotOrder(std::span<const Box> children) {
    return SlotHalving(children).run();
}

}  // namespace filigree::bvh
