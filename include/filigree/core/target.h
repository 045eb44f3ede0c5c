// Which instruction set the SIMD code runs on.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"

#include <string>
#include <string_view>

namespace filigree {

// Restricts all SIMD code of this process to one target: "scalar", "sse4", "avx2", "avx3" (AVX-512), or
// "best". Results do not depend on it. Fails on a name it does not know and on a target this processor lacks.
FILIGREE_API Status forceTarget(std::string_view name);

// Applies the environment variable FILIGREE_TARGET when it is set. The command and the tests call this first.
FILIGREE_API Status forceTargetFromEnvironment();

// The name of the target in use.
FILIGREE_API std::string currentTarget();

}  // namespace filigree
