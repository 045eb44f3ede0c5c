// What a caller handed over, checked.
#pragma once

#include "capi/failure.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace filigree::capi {

template <class T>
const T& required(const T* given, std::string_view name) {
    if (given == nullptr) fail(FILIGREE_ERROR_ARGUMENT, "{}: is NULL", name);
    return *given;
}
template <class T>
T& required(T* given, std::string_view name) {
    if (given == nullptr) fail(FILIGREE_ERROR_ARGUMENT, "{}: is NULL", name);
    return *given;
}

// `count` values of the caller's; NULL where there is none.
template <class T>
std::span<T> listOf(T* values, size_t count, std::string_view name) {
    if (values == nullptr && count > 0)
        fail(FILIGREE_ERROR_ARGUMENT, "{}: is NULL, expected {} of them", name, count);
    if (count > SIZE_MAX / sizeof(T)) fail(FILIGREE_ERROR_ARGUMENT, "{}: {} are too many", name, count);
    return {values, count};
}

// A number within [least, most].
template <class T>
T within(T value, T least, T most, std::string_view name) {
    if (!(value >= least && value <= most))
        fail(FILIGREE_ERROR_ARGUMENT, "{}: is {}, expected {} to {}", name, value, least, most);
    return value;
}

// The enumerator of a C enum's number; the last is `last`.
template <class Enum>
Enum enumerator(uint32_t value, Enum last, std::string_view name) {
    return static_cast<Enum>(within(value, uint32_t{0}, static_cast<uint32_t>(last), name));
}

inline bool flag(uint32_t value, std::string_view name) {
    return within(value, uint32_t{0}, uint32_t{1}, name) != 0;
}

template <class A, class B>
bool overlap(std::span<A> a, std::span<B> b) {
    const auto beginA = reinterpret_cast<uintptr_t>(a.data());
    const auto beginB = reinterpret_cast<uintptr_t>(b.data());
    return beginA < beginB + b.size_bytes() && beginB < beginA + a.size_bytes();
}
template <class A, class B>
void checkApart(std::span<A> output, std::span<B> other, std::string_view outputName,
                std::string_view otherName) {
    if (overlap(output, other)) fail(FILIGREE_ERROR_ARGUMENT, "{}: overlaps {}", outputName, otherName);
}

}  // namespace filigree::capi
