// Any bytes as a record of the codec `paper`: what is accepted decodes to finite vertices, and encodes again
// to what is no further from them.
#include "filigree/grid/paper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace filigree;
using namespace filigree::grid;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

// The vertices of the record stand on codes, so each must be found again or another as near.
void encodeAgain(const uint8_t* record, const PaperCode& paper) {
    const PaperPlace place = paperPlace(record);
    const PaperVertices vertices = decodePaper(record, paper);
    for (const Vec3& vertex : vertices) {
        if (!std::isfinite(dot(vertex, vertex))) return;
    }
    const auto again = encodePaper(place, vertices, paper);
    if (!checkPaper(again, paper)) fail("a record of ours is refused");
    if (paperPlace(again.data()) != place) fail("a place changes");
    if (encodePaper(place, vertices, paper) != again) fail("two records of the same vertices differ");
}

}  // namespace

// Code, base, then the record.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 2 + paperBytes) return 0;
    const PaperCode paper{static_cast<DisplacementCode>(data[0] & 1),
                          std::clamp(data[1], PaperCode::leastBase, PaperCode::mostBase)};
    std::array<uint8_t, paperBytes> record{};
    std::copy_n(data + 2, paperBytes, record.begin());
    static_cast<void>(decodePaper(record.data(), paper));
    if (!checkPaper(record, paper)) return 0;
    for (const Vec3& vertex : decodePaper(record.data(), paper)) {
        for (const float number : vertex) {
            if (!std::isfinite(number)) fail("an accepted record decodes to no number");
        }
    }
    encodeAgain(record.data(), paper);
    return 0;
}
