// How an EncodedSize begins a JSON object.
#pragma once

#include "filigree/jobs/encoded_size.h"

#include "jobs/json_text.h"

namespace filigree::jobs {

inline Json levelJson(const EncodedSize& size) {
    return size.level ? Json(*size.level) : Json("auto");
}

// The members that every result about an encoded set has, in their order.
inline Json encodedJson(const EncodedSize& size, double seconds, uint64_t peakBytes) {
    return {{"encoding", size.encoding},
            {"level", levelJson(size)},
            {"states", size.states},
            {"payload_bytes", size.payloadBytes},
            {"descriptor_bytes", size.descriptorBytes},
            {"seconds", seconds},
            {"peak_bytes", peakBytes},
            {"maps", size.maps}};
}

}  // namespace filigree::jobs
