// Finds equal things by their hashes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::encoding {

// Numbers under 64-bit hashes, several under one. What is equal, the caller decides: a hash alone never does.
class HashTable {
  public:
    static constexpr uint32_t none = UINT32_MAX;

    // The number under `hash` for which equal(number) is true, or none.
    template <class Equal>
    [[nodiscard]] uint32_t find(uint64_t hash, Equal equal) const {
        if (slots_.empty()) return none;
        for (size_t at = hash & mask_;; at = (at + 1) & mask_) {
            const Slot& slot = slots_[at];
            if (slot.number == none) return none;
            if (slot.hash == hash && equal(slot.number)) return slot.number;
        }
    }

    // Adds one more, number < none.
    void add(uint64_t hash, uint32_t number) {
        if (2 * (size_ + 1) > slots_.size()) grow();
        put({hash, number});
        ++size_;
    }

    // find(), or add() of `number` where there is none.
    template <class Equal>
    uint32_t findOrAdd(uint64_t hash, uint32_t number, Equal equal) {
        const uint32_t found = find(hash, equal);
        if (found != none) return found;
        add(hash, number);
        return number;
    }

  private:
    struct Slot {
        uint64_t hash = 0;
        uint32_t number = none;
    };

    void put(const Slot& slot) {
        size_t at = slot.hash & mask_;
        while (slots_[at].number != none) at = (at + 1) & mask_;
        slots_[at] = slot;
    }

    void grow() {
        std::vector<Slot> old(slots_.empty() ? 16 : 2 * slots_.size());
        old.swap(slots_);
        mask_ = slots_.size() - 1;
        for (const Slot& slot : old) {
            if (slot.number != none) put(slot);
        }
    }

    std::vector<Slot> slots_;
    size_t mask_ = 0;
    size_t size_ = 0;
};

}  // namespace filigree::encoding
