// Checks of tests that are written in C, and an allocator that counts and fails.
#ifndef FILIGREE_TESTS_CAPI_CHECK_H
#define FILIGREE_TESTS_CAPI_CHECK_H

#include "filigree.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// How many checks failed so far.
extern int failedChecks;

void noteFailure(const char* file, int line, const char* what);

#define CHECK(condition) ((condition) ? (void)0 : noteFailure(__FILE__, __LINE__, #condition))

// Runs a call that should give `code`; `info` is a filigree_error_info whose message has to agree with that.
#define CHECK_CODE(expected, info, call) noteCode(__FILE__, __LINE__, #call, (expected), (call), (info))
void noteCode(const char* file, int line, const char* what, filigree_error expected, filigree_error found,
              const filigree_error_info* info);

// Memory that is out, and after how many allocations there is none left (negative: never).
typedef struct Meter {
    long live;
    long failAt;
    long taken;
} Meter;
void* meterAllocate(void* meter, size_t bytes);
void meterRelease(void* meter, void* memory);
filigree_context* meteredContext(Meter* meter);

#ifdef __cplusplus
}
#endif

#endif
