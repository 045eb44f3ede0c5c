#include "capi/memory.h"

#include <cstdlib>

namespace filigree::capi {
namespace {

void* fromMalloc(void*, size_t bytes) {
    return std::malloc(bytes);
}
void toFree(void*, void* memory) {
    std::free(memory);
}

}  // namespace

Memory::Memory() noexcept : Memory(fromMalloc, toFree, nullptr) {}

}  // namespace filigree::capi
