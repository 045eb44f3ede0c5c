// C++'s own memory runs out, at one allocation after another: an error, nothing leaked, no way out by an
// exception.
#include "capi/samples.h"
#include "filigree.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

namespace {

std::atomic<bool> isCounting{false};
std::atomic<long> allowed{0};  // until operator new fails once
std::atomic<long> live{0};
std::atomic<bool> mayDoWithout{false};  // the allocation that failed was asked for without an exception

void* allocate(std::size_t bytes) {
    if (isCounting && allowed-- == 0) return nullptr;
    void* memory = std::malloc(bytes > 0 ? bytes : 1);
    if (memory != nullptr) ++live;
    return memory;
}

void* allocateAligned(std::size_t bytes, std::align_val_t alignment) {
    if (isCounting && allowed-- == 0) return nullptr;
    const auto align = static_cast<std::size_t>(alignment);
    void* memory = std::aligned_alloc(align, (bytes + align - 1) / align * align);
    if (memory != nullptr) ++live;
    return memory;
}

void* orThrow(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void release(void* memory) {
    if (memory != nullptr) --live;
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t bytes) {
    return orThrow(allocate(bytes));
}
void* operator new[](std::size_t bytes) {
    return orThrow(allocate(bytes));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    void* memory = allocate(bytes);
    if (memory == nullptr) mayDoWithout = true;
    return memory;
}
void* operator new[](std::size_t bytes, const std::nothrow_t& tag) noexcept {
    return operator new(bytes, tag);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return orThrow(allocateAligned(bytes, alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return orThrow(allocateAligned(bytes, alignment));
}
void operator delete(void* memory) noexcept {
    release(memory);
}
void operator delete[](void* memory) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}

namespace {

filigree_error useWith(long allocations, filigree_error_info& error) {
    allowed = allocations;
    mayDoWithout = false;
    isCounting = true;
    const filigree_error code = useEverything(nullptr, &error);
    isCounting = false;
    return code;
}

TEST(WithoutMemory, eachAllocationMayFail) {
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    // What is made once in a program, such as tables.
    ASSERT_EQ(useWith(-1, error), FILIGREE_OK) << error.message;
    constexpr long many = 1L << 40;
    const long before = live;
    ASSERT_EQ(useWith(many, error), FILIGREE_OK);
    const long allocations = many - allowed;
    EXPECT_GT(allocations, 500);
    // All with FILIGREE_FULL, otherwise about two hundred of them.
    const long step = std::getenv("FILIGREE_FULL") != nullptr ? 1 : allocations / 200 + 1;
    for (long n = 0; n < allocations; n += step) {
        const filigree_error found = useWith(n, error);
        ASSERT_EQ(found, mayDoWithout ? FILIGREE_OK : FILIGREE_ERROR_MEMORY) << n << " of " << allocations;
        ASSERT_EQ(live, before) << n << " of " << allocations;
    }
}

}  // namespace
