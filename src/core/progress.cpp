#include "filigree/core/progress.h"

namespace filigree {
namespace {

class SilentProgress final : public ProgressSink {
  public:
    void begin(std::string_view, uint64_t, std::string_view) override {}
    void advance(uint64_t) override {}
    void end() override {}
};

}  // namespace

ProgressSink& silentProgress() {
    static SilentProgress sink;
    return sink;
}

}  // namespace filigree
