#include "filigree/core/bytes.h"
#include "filigree/core/stage.h"
#include "filigree/encoding/dag.h"

#include "encoding/dag_build.h"
#include "encoding/dag_layout.h"
#include "encoding/dag_nodes.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace filigree::encoding {
namespace {

using micromap::QuadtreeView;

// Some neighbouring maps that one thread turns into a graph of their own.
struct Chunk {
    size_t first = 0;
    size_t end = 0;
    dag::Nodes nodes;
    std::vector<uint32_t> roots;  // [end - first]
};

// Cuts the maps where their quadtrees fill so many bits. Any cuts lead to the same bytes: small ones spread
// well over threads, large ones leave less to merge.
constexpr size_t chunkBits = size_t{1} << 18;

std::vector<Chunk> chunksOf(std::span<const QuadtreeView> maps) {
    std::vector<Chunk> chunks;
    size_t bits = chunkBits;
    for (size_t k = 0; k < maps.size(); ++k) {
        if (bits >= chunkBits) {
            chunks.push_back({k, k, {}, {}});
            bits = 0;
        }
        bits += maps[k].bits;
        chunks.back().end = k + 1;
    }
    return chunks;
}

void build(std::span<const QuadtreeView> maps, micromap::Format format, Chunk& chunk) {
    dag::Builder builder(chunk.nodes, format);
    for (size_t k = chunk.first; k < chunk.end; ++k) chunk.roots.push_back(builder.add(maps[k]));
}

// Adds a chunk's nodes, children first, to the graph of all, whose pointers are words; its roots become
// words, too. Since both keep nodes in the order of their first occurrence, so does the result. Frees the
// chunk's nodes.
void merge(Chunk& chunk, dag::Nodes& all) {
    std::vector<uint32_t> starts(chunk.nodes.size());
    for (size_t number = 0; number < starts.size(); ++number) {
        const unsigned height = chunk.nodes.height(number);
        const auto words = chunk.nodes.words(number);
        std::array<uint32_t, 1 + dag::children> moved;
        std::ranges::copy(words, moved.begin());
        if (height > dag::leafHeight) {
            for (size_t k = 1; k < words.size(); ++k) moved[k] = starts[words[k]];
        }
        starts[number] = all.start(all.intern(height, std::span(moved).first(words.size())));
    }
    for (uint32_t& root : chunk.roots) root = starts[root];
    chunk.nodes = {};
}

Error tooLarge() {
    return {ErrorKind::limit,
            fmt::format("dag: the micromaps take more than the {} bytes that its pointers reach: choose a "
                        "lower level or another encoding",
                        dag::maxWords * dag::wordBytes)};
}

// Builds some chunks at a time while it merges those before, so that memory holds few unmerged ones.
Status buildAll(std::span<const QuadtreeView> maps, micromap::Format format, const Stage& stage,
                std::vector<Chunk>& chunks, dag::Nodes& all) {
    const size_t atOnce = 4 * size_t{stage.concurrency()};
    for (size_t first = 0; first < chunks.size() + atOnce; first += atOnce) {
        const size_t merged = first < atOnce ? 0 : first - atOnce;
        const size_t count = first < chunks.size() ? std::min(atOnce, chunks.size() - first) : 0;
        stage.parallelFor(1 + count, 1, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end; ++k) {
                if (k > 0) {
                    Chunk& chunk = chunks[first + k - 1];
                    build(maps, format, chunk);
                    stage.advance(chunk.end - chunk.first);
                }
                if (k > 0 || first == 0) continue;
                for (size_t m = merged; m < std::min(first, chunks.size()); ++m) {
                    if (all.words().size() <= dag::maxWords) merge(chunks[m], all);
                }
            }
        });
        if (const Status status = stage.status(); !status) return status;
        if (all.words().size() > dag::maxWords) return tooLarge();
    }
    return {};
}

void writeWords(std::span<const uint32_t> words, std::vector<uint8_t>& to) {
    to.resize(dag::wordBytes * words.size());
    for (size_t k = 0; k < words.size(); ++k) storeLe(to.data() + dag::wordBytes * k, words[k]);
}

}  // namespace

Result<EncodedSet> encodeDag(std::span<const QuadtreeView> maps, micromap::Format format,
                             const Executor& executor, ProgressSink& progress) {
    const Stage stage(executor, progress, "encode", maps.size(), "micromaps");
    std::vector<Chunk> chunks = chunksOf(maps);
    dag::Nodes all;
    if (const auto built = buildAll(maps, format, stage, chunks, all); !built) return built.error();
    EncodedSet set{Encoding::dag, format, static_cast<uint32_t>(maps.size()), {}, {}};
    writeWords(all.words(), set.payload);
    set.descriptors.resize(dag::descriptorBytes * maps.size());
    for (const Chunk& chunk : chunks) {
        for (size_t k = chunk.first; k < chunk.end; ++k) {
            const uint32_t descriptor = chunk.roots[k - chunk.first] | (maps[k].level << dag::rootBits);
            storeLe(set.descriptors.data() + dag::descriptorBytes * k, descriptor);
        }
    }
    return set;
}

}  // namespace filigree::encoding
