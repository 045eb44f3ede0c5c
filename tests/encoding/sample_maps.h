// Sets of micromaps made in code, and the encodings that every test of them runs over.
#pragma once

#include "filigree/encoding/encode.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/micromap/quadtree.h"

#include "encoding/stored.h"

#include <random>
#include <string>
#include <vector>

namespace filigree::tests {

struct SampleSet {
    std::string name;
    micromap::QuadtreeList maps;
    [[nodiscard]] std::vector<micromap::QuadtreeView> views() const;
};

// One micro-triangle of another state than the rest.
micromap::Quadtree oddOne(unsigned level, uint64_t index, micromap::State rest, micromap::State odd);
// No four siblings alike.
micromap::Quadtree checkerboard(unsigned level, micromap::State even, micromap::State odd);
// Known inside and outside of a circle about the first vertex, unknown along it.
micromap::Quadtree disc(unsigned level, double radius);
// Nested uniform parts: a node above the finest level is uniform with probability `stop`.
micromap::Quadtree noise(unsigned level, double stop, std::mt19937& random);

// Every kind of map, small and large; an empty set; mixed levels.
std::vector<SampleSet> sampleSets();

// Some hundred bytes, for tests that break each one.
SampleSet smallSet();

// Reads a set that must be good; fails the test otherwise.
std::unique_ptr<encoding::MapReader> openGood(const encoding::EncodedView& view);

encoding::EncodedSet encodeGood(encoding::Encoding encoding, const SampleSet& set, micromap::Format format,
                                const Executor& executor = serialExecutor());

}  // namespace filigree::tests
