#include "capi/call.h"
#include "capi/failure.h"
#include "capi/sized.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>

namespace filigree::capi {
namespace {

constexpr size_t leastInfoBytes = 64;

filigree_error write(filigree_error_info* info, filigree_error code, std::string_view message) {
    if (info == nullptr) return code;
    info->code = code;
    const size_t room = std::min(info->struct_size, sizeof *info) - offsetof(filigree_error_info, message);
    const size_t length = std::min(message.size(), room - 1);
    std::memcpy(info->message, message.data(), length);
    info->message[length] = 0;
    return code;
}

filigree_error codeOf(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::usage:
            return FILIGREE_ERROR_ARGUMENT;
        case ErrorKind::format:
            return FILIGREE_ERROR_FORMAT;
        case ErrorKind::unsupported:
            return FILIGREE_ERROR_UNSUPPORTED;
        case ErrorKind::limit:
            return FILIGREE_ERROR_LIMIT;
        case ErrorKind::cancelled:
            return FILIGREE_ERROR_CANCELLED;
        default:
            return FILIGREE_ERROR_INTERNAL;
    }
}

}  // namespace

void fail(const Error& error) {
    throw Failure{codeOf(error.kind), error.message};
}

bool isUsable(const filigree_error_info* info) {
    return info == nullptr || (info->struct_size >= leastInfoBytes && info->struct_size <= mostStructBytes);
}

filigree_error reportSuccess(filigree_error_info* info) {
    return write(info, FILIGREE_OK, "");
}

filigree_error reportFailure(filigree_error_info* info) {
    try {
        throw;
    } catch (const Failure& failure) {
        return write(info, failure.code, failure.message);
    } catch (const std::bad_alloc&) {
        return write(info, FILIGREE_ERROR_MEMORY, "no memory left");
    } catch (const std::exception& exception) {
        return write(info, FILIGREE_ERROR_INTERNAL, exception.what());
    } catch (...) {
        return write(info, FILIGREE_ERROR_INTERNAL, "an unknown exception");
    }
}

}  // namespace filigree::capi

uint32_t filigree_version(void) {
    return 10000 * FILIGREE_VERSION_MAJOR + 100 * FILIGREE_VERSION_MINOR + FILIGREE_VERSION_PATCH;
}

const char* filigree_error_name(uint32_t error) {
    switch (error) {
        case FILIGREE_OK:
            return "FILIGREE_OK";
        case FILIGREE_ERROR_ARGUMENT:
            return "FILIGREE_ERROR_ARGUMENT";
        case FILIGREE_ERROR_STRUCT:
            return "FILIGREE_ERROR_STRUCT";
        case FILIGREE_ERROR_CAPACITY:
            return "FILIGREE_ERROR_CAPACITY";
        case FILIGREE_ERROR_MEMORY:
            return "FILIGREE_ERROR_MEMORY";
        case FILIGREE_ERROR_FORMAT:
            return "FILIGREE_ERROR_FORMAT";
        case FILIGREE_ERROR_UNSUPPORTED:
            return "FILIGREE_ERROR_UNSUPPORTED";
        case FILIGREE_ERROR_LIMIT:
            return "FILIGREE_ERROR_LIMIT";
        case FILIGREE_ERROR_CANCELLED:
            return "FILIGREE_ERROR_CANCELLED";
        case FILIGREE_ERROR_INTERNAL:
            return "FILIGREE_ERROR_INTERNAL";
        default:
            return "unknown error";
    }
}
