// The demo's scene, made once a process.
#pragma once

#include "jobs/demo_scene.h"

#include <cstdint>
#include <vector>

namespace filigree::tests {

inline const std::vector<uint8_t>& demoBytes() {
    static const std::vector<uint8_t> bytes = *jobs::makeDemoScene();
    return bytes;
}

}  // namespace filigree::tests
