// Alpha textures as one state for each texel-sized cell (Waldemarson and Doggett 2024, section 5):
// docs/spec/bitmask.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bytes.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/image/alpha_image.h"
#include "filigree/micromap/state.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// A texture and what is asked of it. Vertex alpha (COLOR_0) varies over a texture's uses and cannot be part
// of a bitmask: where it is not 1, look nothing up.
struct BitmaskSource {
    const image::AlphaTexture* texture = nullptr;
    image::AlphaTest test;
};

// How the cells of one axis are stored. Cell c of a linearly filtered axis lies between the centres of texels
// c and c + 1; with nearest filtering cells are texels.
struct BitmaskAxis {
    uint32_t size = 1;  // texels
    image::Wrap wrap = image::Wrap::repeat;
    bool betweenTexels = true;

    // One more cell than texels, -1 to size - 1, where the border is between texels, too.
    [[nodiscard]] uint32_t extra() const { return betweenTexels && wrap != image::Wrap::repeat ? 1 : 0; }
    [[nodiscard]] uint32_t cells() const { return size + extra(); }
    [[nodiscard]] int64_t firstCell() const { return -int64_t{extra()}; }

    // Which of the stored cells any cell equals, mirrored ones by their mirror image.
    [[nodiscard]] uint32_t stored(int64_t cell) const {
        const int64_t at = cell - firstCell();
        if (at >= 0 && at < cells()) return static_cast<uint32_t>(at);
        if (wrap == image::Wrap::clampToEdge) return at < 0 ? 0 : cells() - 1;
        const int64_t period = wrap == image::Wrap::repeat ? int64_t{size} : 2 * int64_t{size};
        const int64_t in = (at % period + period) % period;
        return static_cast<uint32_t>(in < cells() ? in : period - 1 + extra() - in);
    }
};

// Looks states up in a set that was checked when it was opened. Looks into the view that it was opened from.
class FILIGREE_API BitmaskReader {
  public:
    // Checks all of `set`.
    static Result<BitmaskReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t textureCount() const { return set_.mapCount; }
    [[nodiscard]] BitmaskAxis axisU(uint32_t texture) const { return axis(texture, 4, 0); }
    [[nodiscard]] BitmaskAxis axisV(uint32_t texture) const { return axis(texture, 6, 2); }

    // The state of the cell of texture < textureCount() that holds the texture coordinate (u, v). 4-state: a
    // known one holds all over the cell; an unknown one has the side of the cell's centre. 2-state: the side
    // of the cell's centre. Beyond 2^40 texels, and for NaN, unknown-opaque, 2-state opaque.
    [[nodiscard]] micromap::State at(uint32_t texture, float u, float v) const {
        const BitmaskAxis columns = axisU(texture);
        const BitmaskAxis rows = axisV(texture);
        const double half = columns.betweenTexels ? 0.5 : 0;
        const double x = double{u} * columns.size - half;
        const double y = double{v} * rows.size - half;
        if (!(x > -reach && x < reach && y > -reach && y < reach)) return outOfReach();
        const uint64_t cell =
            uint64_t{rows.stored(floorOf(y))} * columns.cells() + columns.stored(floorOf(x));
        const uint64_t bit = cell << widthShift_;
        const unsigned byte = set_.payload.data()[loadLe<uint32_t>(descriptor(texture)) + bit / 8];
        return static_cast<micromap::State>((byte >> (bit % 8)) & stateMask_);
    }

    // Bits of at() (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead() const { return 8 * descriptorBytes + (1u << widthShift_); }

    // at(textures[k], u[k], v[k]) into states[k] for all k, in SIMD. All spans have one length.
    void lookup(std::span<const uint32_t> textures, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;

    // What the bits are spent on; adds up to 8 * (descriptors + payload).
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    static constexpr double reach = 1099511627776.0;  // 2^40 texels
    static constexpr size_t descriptorBytes = 12;

    explicit BitmaskReader(const EncodedView& set)
        : set_(set),
          widthShift_(set.format == micromap::Format::fourState ? 1 : 0),
          stateMask_((1u << micromap::bitsPerState(set.format)) - 1) {}

    static int64_t floorOf(double x) {
        const auto towardsZero = static_cast<int64_t>(x);
        return towardsZero - (x < static_cast<double>(towardsZero) ? 1 : 0);
    }
    [[nodiscard]] micromap::State outOfReach() const { return static_cast<micromap::State>(stateMask_); }
    [[nodiscard]] const uint8_t* descriptor(uint32_t texture) const {
        return set_.descriptors.data() + descriptorBytes * texture;
    }
    [[nodiscard]] BitmaskAxis axis(uint32_t texture, size_t sizeAt, unsigned wrapShift) const {
        const uint8_t* from = descriptor(texture);
        return {loadLe<uint16_t>(from + sizeAt) + 1u, static_cast<image::Wrap>((from[8] >> wrapShift) & 3),
                (from[8] & 16) == 0};
    }

    EncodedView set_;
    unsigned widthShift_;  // log2 of a state's bits
    unsigned stateMask_;
};

// A bitmask for each source; texture k of the set is sources[k]. The result does not depend on the executor.
// ErrorKind::usage for a guard above 8 texels or numbers that are not finite and >= 0, ErrorKind::limit above
// 4 GiB - 1 of payload.
FILIGREE_API Result<EncodedSet> encodeBitmasks(std::span<const BitmaskSource> sources,
                                               micromap::Format format,
                                               const Executor& executor = serialExecutor(),
                                               ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
