// The ways to decide a candidate hit with a surface that has holes.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/reader.h"
#include "filigree/trace/world.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace filigree::trace {

// `none` takes every hit, `texture` interpolates texture coordinates and filters the alpha texture: the
// reference. The others look a state up first.
enum class Method : uint8_t {
    none,
    texture,
    bitmask,
    gruen,
    micromap,
    tree,
    indexedTree,
    dag,
    sdag,
    vq2,
    vq4,
    vq2Plus,
    vq4Plus,
};
inline constexpr size_t methodCount = 13;

// The names of the command line.
FILIGREE_API std::string_view nameOf(Method method);
FILIGREE_API std::optional<Method> methodNamed(std::string_view name);

// The encoding of micromaps, or of bitmasks, that a method reads, if it reads one.
FILIGREE_API std::optional<encoding::Encoding> encodingOf(Method method);
// The format of squares that a method reads, if it reads squares.
FILIGREE_API std::optional<quadmap::SquareFormat> squareFormatOf(Method method);

// What a method knows of a surface.
struct SurfaceMaps {
    // [triangle_count], a map of the set or special (-1..-4). Empty: nothing, every candidate is unknown.
    // With Method::bitmask its place is taken by `texture`.
    std::span<const int32_t> indices;
    std::optional<uint32_t> texture;  // of a bitmask set
};

// The squares of a surface's triangle pairs.
struct SurfaceSquares {
    // [triangle_count], a map of the reader or special: -1 transparent, -2 opaque, -3 and -4 mixed. Empty:
    // every candidate is unknown.
    std::span<const int32_t> indices;
    std::span<const quadmap::SquarePlace> places;  // [triangle_count], where the index is none of the special
};

// A method with its data, which it looks into.
class FILIGREE_API Opacity {
  public:
    // `states` 4: unknown states fetch the texture. 2: their side decides, and nothing is fetched where there
    // is a state. `surfaces` by surface of `world`, both of which must outlive this; not needed by `none` and
    // `texture`. `set` is checked, and looked into from then on.
    static Result<Opacity> make(Method method, unsigned states, const World& world,
                                const encoding::EncodedView& set, std::vector<SurfaceMaps> surfaces);

    // The same for the methods that read squares. With two states mixed regions hit by chance, as
    // quadmap::isHit has it: the same for each ray and place. The reader's bytes must outlive this.
    static Result<Opacity> make(Method method, unsigned states, const World& world,
                                const quadmap::SquareReader& squares,
                                const std::vector<SurfaceSquares>& surfaces);

    Opacity(Opacity&&) noexcept;
    Opacity& operator=(Opacity&&) noexcept;
    ~Opacity();

    [[nodiscard]] Method method() const;
    [[nodiscard]] unsigned states() const;
    // Bytes of opacity data in memory: the set, and each triangle's map or special index.
    [[nodiscard]] uint64_t bytes() const;

    // For this room only.
    struct Data;
    [[nodiscard]] const Data& data() const { return *data_; }

  private:
    explicit Opacity(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::trace
