// The numbers behind the header of a PLY file, one after another.
#pragma once

#include "io/ply_header.h"

#include <cstdint>
#include <span>

namespace filigree::io {

class PlyValues {
  public:
    // `body` is what stands behind the header.
    PlyValues(PlyFormat format, std::span<const uint8_t> body) : format_(format), left_(body) {}

    // False where the file ends, or a text is no number; then failure() tells which.
    bool take(PlyType type, double& value);

    // Passes over one value, or a whole list.
    bool skip(const PlyProperty& property);

    // A list's length, checked against what is left of the file.
    bool takeCount(const PlyProperty& list, uint64_t& count);

    // Upper bound of how many things of `leastBytes` each can follow.
    [[nodiscard]] bool canHold(uint64_t count, size_t leastBytes) const {
        return leastBytes == 0 || count <= left_.size() / leastBytes;
    }
    [[nodiscard]] const char* failure() const { return failure_; }
    // Behind the last element: whether nothing but blanks of a text follows.
    [[nodiscard]] bool atEnd();

  private:
    bool takeText(PlyType type, double& value);
    void passBlanks();
    bool fail(const char* failure) {
        failure_ = failure;
        return false;
    }

    PlyFormat format_;
    std::span<const uint8_t> left_;
    const char* failure_ = "";
};

}  // namespace filigree::io
