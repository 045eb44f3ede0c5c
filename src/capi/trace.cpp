#include "filigree/grid/rays.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/grids.h"
#include "capi/parts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

struct filigree_tracer {
    filigree::capi::Memory memory;
    const filigree_grids* grids = nullptr;
    std::optional<filigree::grid::Tracer> tracer;
    filigree::capi::Array<filigree::grid::Ray> rays;  // [partSize], those of a batch in turn
    filigree::capi::Array<filigree::grid::Hit> hits;
};

namespace filigree::capi {
namespace {

// Plain values at each step of the caller's memory.
template <class T>
class Strided {
  public:
    using Byte = std::conditional_t<std::is_const_v<T>, const unsigned char, unsigned char>;

    Strided(T* values, size_t stride, size_t count, std::string_view name)
        : bytes_(reinterpret_cast<Byte*>(values)), stride_(stride != 0 ? stride : sizeof(T)), count_(count) {
        if (count > 0) required(values, name);
        if (stride_ < sizeof(T) || stride_ % 4 != 0)
            fail(FILIGREE_ERROR_ARGUMENT, "{}: a stride of {} bytes, expected a multiple of 4 from {} on",
                 name, stride_, sizeof(T));
        if (count > SIZE_MAX / stride_) fail(FILIGREE_ERROR_ARGUMENT, "{}: {} are too many", name, count);
    }

    [[nodiscard]] std::remove_const_t<T> load(size_t k) const {
        std::remove_const_t<T> value;
        std::memcpy(&value, bytes_ + k * stride_, sizeof value);
        return value;
    }
    void store(size_t k, const T& value) const { std::memcpy(bytes_ + k * stride_, &value, sizeof value); }
    [[nodiscard]] std::span<Byte> span() const {
        return {bytes_, count_ == 0 ? 0 : (count_ - 1) * stride_ + sizeof(T)};
    }

    // Values of the same structs lie between each other without overlapping.
    template <class U>
    [[nodiscard]] bool overlaps(const Strided<U>& other) const {
        if (!overlap(span(), other.span())) return false;
        if (stride_ != other.stride()) return true;
        const auto mine = reinterpret_cast<uintptr_t>(bytes_) % stride_;
        const auto its = reinterpret_cast<uintptr_t>(other.span().data()) % stride_;
        const size_t at = (its + stride_ - mine) % stride_;
        return at < sizeof(T) || at + sizeof(U) > stride_;
    }
    [[nodiscard]] size_t stride() const { return stride_; }

  private:
    Byte* bytes_;
    size_t stride_;
    size_t count_;
};

grid::Ray rayOf(const filigree_ray& from) {
    grid::Ray ray;
    std::ranges::copy(from.origin, ray.origin.begin());
    std::ranges::copy(from.direction, ray.direction.begin());
    ray.tMin = from.t_min;
    ray.tMax = from.t_max;
    return ray;
}

filigree_hit hitOf(const filigree_grids& grids, const grid::Hit& from) {
    filigree_hit hit{};
    hit.t = from.t;
    hit.grid = from.grid;
    hit.column = from.column;
    hit.row = from.row;
    hit.half = from.half;
    hit.u = from.u;
    hit.v = from.v;
    std::ranges::copy(from.normal, hit.normal);
    hit.source = from.grid == grid::noGrid ? UINT32_MAX : sourceOf(grids, from);
    return hit;
}

std::span<const grid::Ray> loadRays(filigree_tracer& tracer, const Strided<const filigree_ray>& rays,
                                    size_t first, size_t count) {
    const auto to = tracer.rays.values().first(count);
    for (size_t k = 0; k < count; ++k) to[k] = rayOf(rays.load(first + k));
    return to;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_tracer_create(const filigree_context* context, const filigree_grids* grids,
                                      filigree_tracer** out, filigree_error_info* error) {
    return make(out, error, [&] {
        const filigree_grids& into = required(grids, "grids");
        const Memory memory = memoryOf(context);
        auto tracer = makeHandle<filigree_tracer>(memory);
        tracer->grids = &into;
        tracer->rays = Array<filigree::grid::Ray>(memory, partSize);
        tracer->hits = Array<filigree::grid::Hit>(memory, partSize);
        tracer->tracer.emplace(into.file.grids);
        return tracer.release();
    });
}

void filigree_tracer_destroy(filigree_tracer* tracer) {
    destroy(tracer);
}

filigree_error filigree_tracer_closest(filigree_tracer* tracer, size_t count, const filigree_ray* rays,
                                       size_t ray_stride, filigree_hit* hits, size_t hit_stride,
                                       filigree_error_info* error) {
    return call(error, [&] {
        filigree_tracer& by = required(tracer, "tracer");
        const Strided<const filigree_ray> from(rays, ray_stride, count, "rays");
        const Strided<filigree_hit> to(hits, hit_stride, count, "hits");
        if (to.overlaps(from)) fail(FILIGREE_ERROR_ARGUMENT, "hits: overlap rays");
        inParts(count, [&](size_t first, size_t some) {
            const auto found = by.hits.values().first(some);
            by.tracer->closest(loadRays(by, from, first, some), found);
            for (size_t k = 0; k < some; ++k) to.store(first + k, hitOf(*by.grids, found[k]));
        });
    });
}

filigree_error filigree_tracer_any(filigree_tracer* tracer, size_t count, const filigree_ray* rays,
                                   size_t ray_stride, uint8_t* answers, filigree_error_info* error) {
    return call(error, [&] {
        filigree_tracer& by = required(tracer, "tracer");
        const Strided<const filigree_ray> from(rays, ray_stride, count, "rays");
        const auto to = listOf(answers, count, "answers");
        checkApart(to, from.span(), "answers", "rays");
        inParts(count, [&](size_t first, size_t some) {
            by.tracer->any(loadRays(by, from, first, some), to.subspan(first, some));
        });
    });
}
