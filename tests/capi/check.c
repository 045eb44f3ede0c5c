#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int failedChecks = 0;

void noteFailure(const char* file, int line, const char* what) {
    ++failedChecks;
    fprintf(stderr, "%s:%d: %s\n", file, line, what);
}

void noteCode(const char* file, int line, const char* what, filigree_error expected, filigree_error found,
              const filigree_error_info* info) {
    if (found != expected) {
        ++failedChecks;
        fprintf(stderr, "%s:%d: %s gave %s, expected %s: %s\n", file, line, what, filigree_error_name(found),
                filigree_error_name(expected), info != NULL ? info->message : "");
        return;
    }
    if (info == NULL) return;
    if (info->code != (uint32_t)found) noteFailure(file, line, "the code of the info differs");
    if ((found == FILIGREE_OK) != (info->message[0] == 0)) noteFailure(file, line, "the message is wrong");
    if (memchr(info->message, '\n', sizeof info->message) != NULL)
        noteFailure(file, line, "the message is more than a line");
}

void* meterAllocate(void* user, size_t bytes) {
    Meter* meter = user;
    if (meter->failAt >= 0 && meter->taken >= meter->failAt) return NULL;
    ++meter->taken;
    ++meter->live;
    return malloc(bytes);
}

void meterRelease(void* user, void* memory) {
    Meter* meter = user;
    --meter->live;
    free(memory);
}

filigree_context* meteredContext(Meter* meter) {
    filigree_context_settings settings = FILIGREE_CONTEXT_SETTINGS_INIT;
    filigree_context* context = NULL;
    settings.allocate = meterAllocate;
    settings.release = meterRelease;
    settings.allocator_user = meter;
    filigree_context_create(&settings, &context, NULL);
    return context;
}
