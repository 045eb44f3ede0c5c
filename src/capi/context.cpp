#include "capi/context.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/caller_executor.h"
#include "capi/sized.h"

namespace filigree::capi {
namespace {

constexpr filigree_context_settings defaults = FILIGREE_CONTEXT_SETTINGS_INIT;
constexpr uint32_t mostThreads = 4096;

Memory memoryFor(const filigree_context_settings& settings) {
    if ((settings.allocate == nullptr) != (settings.release == nullptr))
        fail(FILIGREE_ERROR_ARGUMENT, "allocate, release: one of them is NULL");
    if (settings.allocate == nullptr) return {};
    return {settings.allocate, settings.release, settings.allocator_user};
}

std::unique_ptr<Executor> executorFor(const filigree_context_settings& settings) {
    if (settings.parallel_for != nullptr) {
        const uint32_t concurrency = within(settings.concurrency, 1U, mostThreads, "concurrency");
        return std::make_unique<CallerExecutor>(settings.parallel_for, settings.parallel_for_user,
                                                concurrency);
    }
    const uint32_t threads = within(settings.threads, 0U, mostThreads, "threads");
    return threads == 1 ? nullptr : makeThreadedExecutor(threads);
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_context_settings_init(filigree_context_settings* settings, size_t struct_size) {
    return initialise(settings, struct_size, defaults);
}

filigree_error filigree_context_create(const filigree_context_settings* settings, filigree_context** out,
                                       filigree_error_info* error) {
    return make(out, error, [&] {
        const auto given = taken(settings, defaults, "settings");
        auto context = makeHandle<filigree_context>(memoryFor(given));
        context->executor = executorFor(given);
        return context.release();
    });
}

void filigree_context_destroy(filigree_context* context) {
    destroy(context);
}
