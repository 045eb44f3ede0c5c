// Memory from the caller's allocator.
#pragma once

#include "filigree.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace filigree::capi {

// Where memory comes from and goes back to.
class Memory {
  public:
    Memory() noexcept;  // malloc and free
    Memory(filigree_allocate allocate, filigree_release release, void* user)
        : allocate_(allocate), release_(release), user_(user) {}

    // Throws std::bad_alloc. Aligned for every type of C, as malloc's.
    [[nodiscard]] void* take(size_t bytes) const {
        void* memory = allocate_(user_, bytes);
        if (memory == nullptr) throw std::bad_alloc();
        return memory;
    }
    void giveBack(void* memory) const { release_(user_, memory); }

  private:
    filigree_allocate allocate_;
    filigree_release release_;
    void* user_;
};

// A list of plain values of a fixed size.
template <class T>
class Array {
  public:
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));

    Array() = default;
    // Not initialised. Throws std::bad_alloc.
    Array(const Memory& memory, size_t count) : memory_(memory), count_(count) {
        if (count > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
        if (count > 0) values_ = static_cast<T*>(memory.take(count * sizeof(T)));
    }
    Array(const Memory& memory, std::type_identity_t<std::span<const T>> values)
        : Array(memory, values.size()) {
        std::copy(values.begin(), values.end(), values_);
    }
    Array(Array&& other) noexcept { swap(other); }
    Array& operator=(Array&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Array() {
        if (values_ != nullptr) memory_.giveBack(values_);
    }

    [[nodiscard]] size_t size() const { return count_; }
    [[nodiscard]] std::span<const T> values() const { return {values_, count_}; }
    [[nodiscard]] std::span<T> values() { return {values_, count_}; }
    const T& operator[](size_t k) const { return values_[k]; }
    T& operator[](size_t k) { return values_[k]; }

  private:
    void swap(Array& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(values_, other.values_);
        std::swap(count_, other.count_);
    }

    Memory memory_;
    T* values_ = nullptr;
    size_t count_ = 0;
};

// A handle on its way to the caller. Handles hold the memory that they came from as `memory`.
template <class Handle>
struct Returner {
    void operator()(Handle* handle) const {
        const Memory memory = handle->memory;
        handle->~Handle();
        memory.giveBack(handle);
    }
};
template <class Handle>
using Owned = std::unique_ptr<Handle, Returner<Handle>>;

template <class Handle>
Owned<Handle> makeHandle(const Memory& memory) {
    static_assert(std::is_nothrow_default_constructible_v<Handle>);
    auto* handle = ::new (memory.take(sizeof(Handle))) Handle();
    handle->memory = memory;
    return Owned<Handle>(handle);
}

template <class Handle>
void destroy(Handle* handle) {
    if (handle != nullptr) Returner<Handle>()(handle);
}

}  // namespace filigree::capi
