// Structs that begin with their size, between callers and libraries of different versions.
#pragma once

#include "capi/failure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace filigree::capi {

// More than any struct will have: a size above it was never set.
inline constexpr size_t mostStructBytes = 4096;

// The size of T in the first version that had it. To be written out once T grows.
template <class T>
inline constexpr size_t firstBytes = sizeof(T);

template <class T>
void checkSize(const T& given, std::string_view name) {
    static_assert(std::is_trivially_copyable_v<T> && offsetof(T, struct_size) == 0);
    if (given.struct_size >= firstBytes<T> && given.struct_size <= mostStructBytes) return;
    fail(FILIGREE_ERROR_STRUCT, "{}: struct_size is {}, expected {}", name, given.struct_size, sizeof(T));
}

// What the caller set: its fields over `defaults`. NULL stands for the defaults.
template <class T>
T taken(const T* given, const T& defaults, std::string_view name) {
    if (given == nullptr) return defaults;
    checkSize(*given, name);
    const auto* bytes = reinterpret_cast<const unsigned char*>(given);
    const size_t known = std::min(given->struct_size, sizeof(T));
    const auto isSet = [](unsigned char byte) { return byte != 0; };
    if (std::any_of(bytes + known, bytes + given->struct_size, isSet)) {
        fail(FILIGREE_ERROR_STRUCT, "{}: fields behind its first {} bytes are set; this version knows none",
             name, sizeof(T));
    }
    T full = defaults;
    std::memcpy(&full, bytes, known);
    full.struct_size = sizeof(T);
    return full;
}

// The same of a struct that has to be there.
template <class T>
T takenOf(const T* given, const T& defaults, std::string_view name) {
    if (given == nullptr) fail(FILIGREE_ERROR_ARGUMENT, "{}: is NULL", name);
    return taken(given, defaults, name);
}

// Copies `values` to as much as the caller has; what is beyond them becomes zero.
template <class T>
void write(const T& values, T* to, size_t structSize) {
    auto* bytes = reinterpret_cast<unsigned char*>(to);
    const size_t known = std::min(structSize, sizeof(T));
    std::memcpy(bytes, &values, known);
    std::fill(bytes + known, bytes + structSize, static_cast<unsigned char>(0));
    to->struct_size = structSize;
}

template <class T>
void give(const T& values, T* to, std::string_view name) {
    if (to == nullptr) fail(FILIGREE_ERROR_ARGUMENT, "{}: is NULL", name);
    checkSize(*to, name);
    write(values, to, to->struct_size);
}

// Defaults into a struct of the caller's size.
template <class T>
filigree_error initialise(T* to, size_t structSize, const T& defaults) {
    if (to == nullptr) return FILIGREE_ERROR_ARGUMENT;
    if (structSize < firstBytes<T> || structSize > mostStructBytes) return FILIGREE_ERROR_STRUCT;
    write(defaults, to, structSize);
    return FILIGREE_OK;
}

}  // namespace filigree::capi
