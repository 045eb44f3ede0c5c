// Lists into the caller's memory: ask for the size, then fill.
#pragma once

#include "capi/arguments.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::capi {

// Calls writer(to) where there is room for `needed` elements of `elementBytes`, and says how many there are.
template <class Writer>
void fillElements(void* to, size_t elementBytes, size_t capacity, size_t* count, uint64_t needed,
                  Writer&& writer) {
    if (needed > SIZE_MAX / elementBytes)
        fail(FILIGREE_ERROR_LIMIT, "the list has {} elements, more than memory can hold", needed);
    required(count, "count") = static_cast<size_t>(needed);
    if (to == nullptr && capacity == 0) return;
    if (capacity > SIZE_MAX / elementBytes)
        fail(FILIGREE_ERROR_ARGUMENT, "capacity: {} are too many", capacity);
    const auto room = listOf(static_cast<unsigned char*>(to), capacity * elementBytes, "to");
    checkApart(room, std::span(count, 1), "to", "count");
    if (capacity < needed)
        fail(FILIGREE_ERROR_CAPACITY, "capacity: is {}, the list takes {}", capacity, needed);
    writer(to);
}

// Calls writer(span of `needed` elements at `to`), likewise.
template <class T, class Writer>
void fill(T* to, size_t capacity, size_t* count, uint64_t needed, Writer&& writer) {
    fillElements(to, sizeof(T), capacity, count, needed,
                 [&](void*) { writer(std::span(to, static_cast<size_t>(needed))); });
}

template <class T>
void fillFrom(std::span<const T> values, T* to, size_t capacity, size_t* count) {
    fill(to, capacity, count, values.size(),
         [&](std::span<T> room) { std::copy(values.begin(), values.end(), room.begin()); });
}

}  // namespace filigree::capi
