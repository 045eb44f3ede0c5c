#include "io/test_json.h"

namespace filigree::io {

Json testToJson(const image::AlphaTest& test) {
    Json json = Json::object();
    json["version"] = testVersion;
    json["alphaMode"] = test.mode == image::AlphaMode::mask ? "MASK" : "BLEND";
    if (test.mode == image::AlphaMode::mask) json["cutoff"] = test.cutoff;
    json["factor"] = test.factor;
    json["mips"] = test.mips;
    json["guard"] = test.guard;
    return json;
}

Result<image::AlphaTest> testFromJson(const Json& json, const std::string& path) {
    ObjectReader reader(json, path);
    reader.integer("version", testVersion, testVersion);
    image::AlphaTest test;
    const std::string mode = reader.text("alphaMode", "");
    if (mode != "MASK" && mode != "BLEND") reader.fail("alphaMode", Json(mode), "MASK or BLEND");
    test.mode = mode == "BLEND" ? image::AlphaMode::blend : image::AlphaMode::mask;
    test.cutoff = reader.number("cutoff", test.cutoff, 0);
    test.factor = reader.number("factor", 1, 0, 1);
    test.mips = static_cast<unsigned>(reader.optionalInteger("mips", 0, 32).value_or(0));
    test.guard = reader.number("guard", 0, 0);
    if (const Status status = reader.status(); !status) return status.error();
    return test;
}

}  // namespace filigree::io
