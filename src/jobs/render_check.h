// What the options of `render` ask for, once they agree.
#pragma once

#include "filigree/core/result.h"
#include "filigree/jobs/render.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/render.h"

#include <string_view>

namespace filigree::jobs {

// The method that no CPU has: flat micromaps that the device itself looks into.
inline constexpr std::string_view hardwareMethod = "hardware";

struct RenderAsked {
    trace::Method method;  // micromap for hardwareMethod
    trace::Integrator integrator;
};

// ErrorKind::usage or ErrorKind::unsupported for options that are out of range or do not go together.
Result<RenderAsked> checked(const RenderOptions& options);

}  // namespace filigree::jobs
