#include "jobs/one_stage.h"

#include <string>

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

class Recorder final : public ProgressSink {
  public:
    void begin(std::string_view stage, uint64_t total, std::string_view) override {
        log += std::string(stage) + " " + std::to_string(total) + ";";
    }
    void advance(uint64_t units) override { log += "+" + std::to_string(units) + ";"; }
    void end() override { log += "end;"; }
    std::string log;
};

TEST(OneStage, HidesTheStagesInside) {
    Recorder recorder;
    {
        OneStage stage(recorder, "bake", 10, "triangles");
        stage.begin("inner", 3, "tiles");
        stage.advance(3);
        stage.end();
        stage.advanceTo(8);
        stage.advanceTo(5);
        stage.advance(2);
    }
    EXPECT_EQ(recorder.log, "bake 10;+3;+5;+2;end;");
}

}  // namespace
}  // namespace filigree::jobs
