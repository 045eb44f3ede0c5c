#include "filigree/jobs/expand.h"

#include "filigree/encoding/gruen.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/encoding/one_bit.h"
#include "filigree/io/fil.h"
#include "filigree/io/gltf.h"
#include "filigree/micromap/set.h"

#include "jobs/encode_scene.h"
#include "jobs/encoded_json.h"
#include "jobs/micromap_files.h"
#include "jobs/peak_memory.h"
#include "jobs/stopwatch.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Status checkAsset(const ExpandOptions& options, const io::FilFile& file) {
    const auto found = io::identifyAsset(options.asset);
    if (!found) return found.error();
    const io::FilAsset& wanted = file.meta().asset;
    if (found->bytes == wanted.bytes && found->hash == wanted.hash) return {};
    return Error{ErrorKind::format, fmt::format("{} belongs to {} ({}), but {} is another file ({})",
                                                options.input.string(), wanted.name, io::contentOf(wanted),
                                                options.asset.string(), io::contentOf(*found))};
}

size_t trianglesOf(const scene::Scene& scene, const io::FilPrimitive& wanted) {
    if (wanted.mesh >= scene.meshes.size()) return 0;
    const auto& primitives = scene.meshes[wanted.mesh].primitives;
    const auto found = std::ranges::find(primitives, wanted.primitive, &scene::Primitive::primitiveIndex);
    return found == primitives.end() ? 0 : found->triangleCount();
}

// The file's primitives must be in the document, with as many triangles.
Status checkPrimitives(const io::GltfDocument& document, const io::FilMeta& meta) {
    io::ReadOptions reading;
    reading.blendAlpha = std::ranges::any_of(meta.groups, [](const io::FilGroup& group) {
        return group.test && group.test->mode == image::AlphaMode::blend;
    });
    reading.micromaps = false;
    const auto scene = io::readScene(document, reading);
    if (!scene) return scene.error();
    for (const io::FilPrimitive& p : meta.primitives) {
        const size_t triangles = trianglesOf(*scene, p);
        if (triangles == p.triangles && triangles > 0) continue;
        return Error{ErrorKind::format,
                     fmt::format("{}: /meshes/{}/primitives/{} has {} triangles, the micromaps are for {}",
                                 document.name(), p.mesh, p.primitive, triangles, p.triangles)};
    }
    return {};
}

// The maps of a file, whatever they are stored as.
class StoredMaps {
  public:
    static Result<StoredMaps> open(const io::FilFile& file) {
        StoredMaps maps;
        auto reader = encoding::openReader(file.set());
        if (!reader) return reader.error();
        maps.reader_ = std::move(*reader);
        if (file.pairs().empty()) return maps;
        const auto pairs = encoding::PairReader::open(file.set(), file.pairs());
        if (!pairs) return pairs.error();
        maps.pairs_ = *pairs;
        return maps;
    }

    [[nodiscard]] size_t count() const { return reader_->mapCount(); }
    [[nodiscard]] bool hasPairs() const { return pairs_.has_value(); }
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const {
        micromap::Quadtree stored = reader_->decode(map);
        return pairs_ ? encoding::fromPair(stored.view(), (*pairs_)[map]) : std::move(stored);
    }

  private:
    std::unique_ptr<encoding::MapReader> reader_;
    std::optional<encoding::PairReader> pairs_;
};

// The format to make flat: the set's own, but 4-state for masks of what may be opaque.
Result<micromap::Format> flatFormat(const encoding::EncodedView& set) {
    if (set.encoding != encoding::Encoding::gruen) return set.format;
    const auto reader = encoding::GruenReader::open(set);
    if (!reader) return reader.error();
    return reader->isMaybeOpaque() ? micromap::Format::fourState : set.format;
}

// The primitives of one group with indices into the group's own maps, in the order of first use.
class GroupMaps {
  public:
    GroupMaps(const StoredMaps& stored, micromap::Format format)
        : stored_(stored), places_(stored.count(), -1) {
        set_.format = format;
    }

    // Renumbers the indices of one more primitive.
    void add(std::vector<int32_t>& indices) {
        for (int32_t& index : indices) {
            if (index < 0) continue;
            int32_t& place = places_[static_cast<size_t>(index)];
            if (place < 0) {
                place = static_cast<int32_t>(set_.trees.size());
                set_.trees.push(stored_.decode(static_cast<uint32_t>(index)).view());
            }
            index = place;
        }
    }

    [[nodiscard]] Result<micromap::FlatSet> flat(const Executor& executor) const {
        auto flat = micromap::flatten(set_, executor);
        if (flat) micromap::ensureOneRecord(*flat, set_.format);
        return flat;
    }

  private:
    const StoredMaps& stored_;
    std::vector<int32_t> places_;
    micromap::TreeSet set_;
};

// All micromaps of a file, flat.
struct Expanded {
    std::vector<micromap::FlatSet> sets;        // by group
    std::vector<std::vector<int32_t>> indices;  // by primitive
};

std::vector<std::vector<int32_t>> indicesOf(const io::FilFile& file) {
    std::vector<std::vector<int32_t>> all;
    uint64_t first = 0;
    for (const io::FilPrimitive& p : file.meta().primitives) {
        auto& indices = all.emplace_back(p.triangles);
        file.readIndices(first, indices);
        first += p.triangles;
    }
    return all;
}

Result<Expanded> expandAll(const io::FilFile& file, const Executor& executor, ProgressSink& progress) {
    const auto stored = StoredMaps::open(file);
    if (!stored) return stored.error();
    const auto format =
        stored->hasPairs() ? Result<micromap::Format>(micromap::Format::fourState) : flatFormat(file.set());
    if (!format) return format.error();
    const io::FilMeta& meta = file.meta();
    Expanded expanded;
    expanded.indices = indicesOf(file);
    progress.begin("expand", meta.groups.size(), "textures");
    for (size_t g = 0; g < meta.groups.size(); ++g) {
        if (progress.cancelled()) return Error{ErrorKind::cancelled, "the expansion was cancelled"};
        GroupMaps maps(*stored, *format);
        for (size_t p = 0; p < meta.primitives.size(); ++p) {
            if (meta.primitives[p].group == g) maps.add(expanded.indices[p]);
        }
        auto flat = maps.flat(executor);
        if (!flat) return flat.error().within(meta.groups[g].name);
        expanded.sets.push_back(std::move(*flat));
        progress.advance(1);
    }
    progress.end();
    return expanded;
}

// Looks into `expanded`.
io::MicromapOutput outputOf(const io::FilMeta& meta, const Expanded& expanded) {
    io::MicromapOutput output;
    for (size_t g = 0; g < meta.groups.size(); ++g)
        output.micromaps.push_back({meta.groups[g].name, &expanded.sets[g], meta.groups[g].test});
    for (size_t p = 0; p < meta.primitives.size(); ++p) {
        const io::FilPrimitive& from = meta.primitives[p];
        auto& to = output.primitives.emplace_back();
        to.mesh = from.mesh;
        to.primitive = from.primitive;
        to.micromaps = from.group;
        to.indices = expanded.indices[p];
    }
    return output;
}

void noteLoss(const io::FilFile& file, ExpandSummary& summary) {
    const encoding::EncodedView& set = file.set();
    if (!file.pairs().empty()) {
        summary.notes.emplace_back("one bit: known states outside a map's pair have become unknown");
        return;
    }
    if (set.encoding != encoding::Encoding::gruen) return;
    summary.notes.emplace_back(set.format == micromap::Format::twoState
                                   ? "gruen: masks of what may be opaque become unknown-opaque states"
                                   : "gruen: the side of unknown states is not kept, all are unknown-opaque");
}

}  // namespace

Result<ExpandSummary> expand(const ExpandOptions& options, const Executor& executor, ProgressSink& progress) {
    const Stopwatch total;
    const auto file = io::FilFile::read(options.input);
    if (!file) return file.error();
    const encoding::EncodedView& set = file->set();
    if (set.encoding == encoding::Encoding::bitmask) {
        return Error{ErrorKind::unsupported,
                     options.input.string() + ": holds bitmask textures, which are no micromaps to expand"};
    }
    if (auto checked = checkAsset(options, *file); !checked) return checked.error();
    const auto document = io::GltfDocument::load(options.asset);
    if (!document) return document.error();
    if (auto checked = checkPrimitives(*document, file->meta()); !checked) return checked.error();
    const auto expanded = expandAll(*file, executor, progress);
    if (!expanded) return expanded.error().within(options.input.string());
    const auto output = outputOf(file->meta(), *expanded);
    if (auto written = writeMicromapFiles(*document, output, options.output, options.rawFolder); !written)
        return written.error();
    ExpandSummary summary;
    summary.size = sizeOf(set, file->meta().level);
    for (const auto& flat : expanded->sets) summary.dataBytes += flat.data.size();
    noteLoss(*file, summary);
    summary.totalSeconds = total.seconds();
    summary.peakBytes = peakMemory();
    return summary;
}

std::string toJson(const ExpandSummary& s) {
    Json json = encodedJson(s.size, s.totalSeconds, s.peakBytes);
    json["data_bytes"] = s.dataBytes;
    return dump(json);
}

}  // namespace filigree::jobs
