// An allocator that has no memory left, at each allocation in turn.
#include "check.h"
#include "samples.h"
#include "suites.h"

int memorySuite(void) {
    Meter meter = {0, -1, 0};
    filigree_context* context = meteredContext(&meter);
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    failedChecks = 0;
    CHECK(context != NULL && meter.live == 1);
    meter.taken = 0;
    CHECK_CODE(FILIGREE_OK, &error, useEverything(context, &error));
    CHECK(meter.live == 1 && meter.taken > 40);
    const long allocations = meter.taken;
    for (long n = 0; n < allocations; ++n) {
        meter.taken = 0;
        meter.failAt = n;
        CHECK_CODE(FILIGREE_ERROR_MEMORY, &error, useEverything(context, &error));
        CHECK(meter.live == 1);
    }
    meter.failAt = -1;
    filigree_context_destroy(context);
    CHECK(meter.live == 0);

    meter.taken = 0;
    meter.failAt = 0;
    CHECK(meteredContext(&meter) == NULL && meter.live == 0);
    return failedChecks;
}
