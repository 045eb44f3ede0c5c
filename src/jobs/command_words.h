// Command lines that pages show beside what they made.
#pragma once

#include "filigree/jobs/bake.h"
#include "filigree/jobs/grids.h"
#include "filigree/jobs/render.h"

#include <span>
#include <string>
#include <vector>

namespace filigree::jobs {

// The options that differ from their defaults, as the command line takes them: all of a bake, or those that
// decide when a state is known.
std::vector<std::string> bakeWords(const BakeParameters& parameters);
std::vector<std::string> testWords(const BakeParameters& parameters);

// "--camera=..." as the command line takes it; empty for no choice.
std::string cameraWord(const CameraChoice& camera);

// The whole line that does the same again.
std::string renderCommand(const RenderOptions& options);
std::string gridsCommand(const GridsOptions& options);

// A command line for people to copy: words with more than plain characters stand in single quotes.
std::string shellCommand(std::span<const std::string> words);

}  // namespace filigree::jobs
