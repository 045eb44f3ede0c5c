#include "picture_options.h"

#include "parsed_number.h"

#include <algorithm>
#include <array>

namespace filigree::app {
namespace {

jobs::CameraChoice parsedCamera(const std::string& text) {
    const auto parts = CLI::detail::split(text, ',');
    if (parts.size() == 1) return parsedNumber<unsigned>(text, "--camera", text);
    std::array<float, 10> numbers{};
    if (parts.size() != numbers.size()) throw CLI::ConversionError(text, "--camera");
    std::ranges::transform(parts, numbers.begin(), [&](const std::string& part) {
        return parsedNumber<float>(part, "--camera", text);
    });
    const auto& n = numbers;
    return jobs::OwnCamera{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9]};
}

}  // namespace

void addSizeOption(CLI::App& verb, uint32_t& width, uint32_t& height, const std::string& usual) {
    const auto parse = [&width, &height](const std::string& text) {
        const auto sides = CLI::detail::split(text, 'x');
        if (sides.size() != 2) throw CLI::ConversionError(text, "--size");
        width = parsedNumber<uint32_t>(sides[0], "--size", text);
        height = parsedNumber<uint32_t>(sides[1], "--size", text);
    };
    verb.add_option_function<std::string>("--size", parse, "Pixels; default " + usual)->type_name("WxH");
}

void addCameraOption(CLI::App& verb, jobs::CameraChoice& camera, const std::string& usual) {
    const auto parse = [&camera](const std::string& text) { camera = parsedCamera(text); };
    verb.add_option_function<std::string>(
            "--camera", parse,
            "Eye, target and up as x,y,z each, then the vertical angle of view in degrees; or the number of "
            "one of the file's cameras, from 0. Default: " +
                usual)
        ->type_name("EYE,TARGET,UP,FOV|N");
}

}  // namespace filigree::app
