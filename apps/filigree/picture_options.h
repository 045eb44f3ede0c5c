// The size and the camera of a picture.
#pragma once

#include "filigree/jobs/render.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace filigree::app {

// Adds --size WxH; width and height already hold the default, which `usual` names.
void addSizeOption(CLI::App& verb, uint32_t& width, uint32_t& height, const std::string& usual);

// Adds --camera; `usual` names what is taken without.
void addCameraOption(CLI::App& verb, jobs::CameraChoice& camera, const std::string& usual);

}  // namespace filigree::app
