// Alpha textures as one state for each texel-sized cell (Waldemarson and Doggett 2024, section 5):
// docs/spec/bitmask.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/image/alpha_image.h"
#include "filigree/micromap/state.h"

#include "filigree_lookup.h"

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

    // As lookups have it.
    static BitmaskAxis of(filigree_bitmask_axis axis) {
        return {axis.size, static_cast<image::Wrap>(axis.wrap), axis.between_texels != 0};
    }
    [[nodiscard]] filigree_bitmask_axis plain() const {
        return {size, static_cast<uint32_t>(wrap), betweenTexels ? 1u : 0u};
    }

    // One more cell than texels, -1 to size - 1, where the border is between texels, too.
    [[nodiscard]] uint32_t extra() const { return filigree_bitmask_extra(plain()); }
    [[nodiscard]] uint32_t cells() const { return size + extra(); }
    [[nodiscard]] int64_t firstCell() const { return -int64_t{extra()}; }

    // Which of the stored cells any cell equals, mirrored ones by their mirror image.
    [[nodiscard]] uint32_t stored(int64_t cell) const { return filigree_bitmask_stored(plain(), cell); }
};

// Looks states up in a set that was checked when it was opened. Looks into the view that it was opened from.
class FILIGREE_API BitmaskReader {
  public:
    // Checks all of `set`.
    static Result<BitmaskReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t textureCount() const { return set_.mapCount; }
    [[nodiscard]] BitmaskAxis axisU(uint32_t texture) const {
        return BitmaskAxis::of(filigree_bitmask_axis_u_(record(texture)));
    }
    [[nodiscard]] BitmaskAxis axisV(uint32_t texture) const {
        return BitmaskAxis::of(filigree_bitmask_axis_v_(record(texture)));
    }

    // The state of the cell of texture < textureCount() that holds the texture coordinate (u, v). 4-state: a
    // known one holds all over the cell; an unknown one has the side of the cell's centre. 2-state: the side
    // of the cell's centre. Beyond 2^40 texels, and for NaN, unknown-opaque, 2-state opaque.
    [[nodiscard]] micromap::State at(uint32_t texture, float u, float v) const {
        return static_cast<micromap::State>(filigree_bitmask_at_point(&view_, texture, u, v));
    }

    // Bits of at() (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead() const {
        return 8 * descriptorBytes + micromap::bitsPerState(set_.format);
    }

    // at(textures[k], u[k], v[k]) into states[k] for all k, in SIMD. All spans have one length.
    void lookup(std::span<const uint32_t> textures, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;

    // What the bits are spent on; adds up to 8 * (descriptors + payload).
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    static constexpr double reach = 1099511627776.0;  // 2^40 texels
    static constexpr size_t descriptorBytes = 12;

    BitmaskReader(const EncodedView& set, const filigree_bitmask& view) : set_(set), view_(view) {}

    [[nodiscard]] const uint8_t* record(uint32_t texture) const {
        return filigree_bitmask_record_(&view_.blocks, texture);
    }

    EncodedView set_;
    filigree_bitmask view_;
};

// A bitmask for each source; texture k of the set is sources[k]. The result does not depend on the executor.
// ErrorKind::usage for a guard above 8 texels or numbers that are not finite and >= 0, ErrorKind::limit above
// 4 GiB - 1 of payload.
FILIGREE_API Result<EncodedSet> encodeBitmasks(std::span<const BitmaskSource> sources,
                                               micromap::Format format,
                                               const Executor& executor = serialExecutor(),
                                               ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
