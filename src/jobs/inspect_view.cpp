#include "jobs/inspect_view.h"

#include "filigree/io/image_file.h"
#include "filigree/report/number.h"

#include "jobs/cell_map.h"
#include "jobs/overlay_legend.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using MapKey = std::pair<int, int32_t>;  // into Scene::micromaps, and a record of these

// One texture on its way into the page.
struct Draft {
    report::MappedTexture texture;
    std::vector<report::PlacedTriangle> triangles;
    std::vector<MapKey> maps;
    std::vector<uint64_t> sharers;  // of each map
    image::AlphaImage alpha;
};

report::Edge edgeOf(image::Wrap wrap) {
    switch (wrap) {
        case image::Wrap::repeat:
            return report::Edge::repeat;
        case image::Wrap::mirroredRepeat:
            return report::Edge::mirror;
        default:
            return report::Edge::clamp;
    }
}

void addNote(report::MappedTexture& texture, const std::string& note) {
    texture.note += (texture.note.empty() ? "" : " ") + note;
}

void addTriangles(const TextureGroup& group, Draft& draft) {
    std::map<MapKey, int32_t> numbers;
    for (const TrianglePlace& place : distinctTriangles(group.primitives)) {
        report::PlacedTriangle t;
        const auto uv = place.uvTriangle().uv;
        for (size_t k = 0; k < 3; ++k) {
            t.uv[2 * k] = uv[k].u;
            t.uv[2 * k + 1] = uv[k].v;
        }
        t.map = place.micromapIndex();
        if (t.map >= 0) {
            const auto [found, isNew] = numbers.try_emplace({place.primitive->micromaps, t.map},
                                                            static_cast<int32_t>(draft.maps.size()));
            if (isNew) {
                draft.maps.push_back(found->first);
                draft.sharers.push_back(0);
            }
            t.map = found->second;
            draft.sharers[static_cast<size_t>(t.map)] += place.equals;
        }
        t.equals = place.equals;
        t.mesh = place.primitive->meshIndex;
        t.primitive = place.primitive->primitiveIndex;
        t.triangle = static_cast<uint32_t>(place.triangle);
        draft.triangles.push_back(t);
    }
}

Draft draftOf(const scene::Scene& scene, const ViewInput& input) {
    Draft draft;
    const AlphaSource& source = input.group.source;
    const InspectedTexture& measured = input.measured;
    draft.alpha = textureOf(scene, source).image;
    draft.texture.name = measured.name;
    draft.texture.width = draft.alpha.width;
    draft.texture.height = draft.alpha.height;
    draft.texture.edges = {edgeOf(source.wrapU), edgeOf(source.wrapV)};
    draft.texture.nearest = source.filter == image::Filter::nearest;
    draft.texture.triangles = measured.triangles;
    draft.texture.mostOverlaps = measured.overlaps.empty() ? 0 : measured.overlaps.rbegin()->first;
    draft.texture.shares = measured.areaShares();
    addTriangles(input.group, draft);
    return draft;
}

// ---- pictures ----

Status encodePicture(Draft& draft) {
    std::vector<uint8_t> grey(draft.alpha.texels.size());
    std::ranges::transform(draft.alpha.texels, grey.begin(),
                           [](uint16_t texel) { return static_cast<uint8_t>((texel + 128) / 257); });
    auto png = io::encodeGreyPng(draft.alpha.width, draft.alpha.height, grey);
    if (!png) return png.error();
    draft.texture.png = std::move(*png);
    return {};
}

// Halves the largest until they fit.
Status shrinkPictures(std::vector<Draft>& drafts, size_t budget) {
    const auto pageBytes = [](const Draft& d) { return d.texture.png.size() * 4 / 3; };
    size_t total = 0;
    for (const Draft& draft : drafts) total += pageBytes(draft);
    while (budget > 0 && total > budget) {
        Draft& largest = *std::ranges::max_element(drafts, {}, pageBytes);
        if (std::max(largest.alpha.width, largest.alpha.height) <= 16) break;
        total -= pageBytes(largest);
        largest.alpha = image::halve(largest.alpha);
        if (const Status encoded = encodePicture(largest); !encoded) return encoded;
        total += pageBytes(largest);
    }
    for (Draft& draft : drafts) {
        if (draft.alpha.width != draft.texture.width)
            addNote(draft.texture,
                    fmt::format("To keep the page small, the picture below is {} x {} texels of {} x {}.",
                                draft.alpha.width, draft.alpha.height, draft.texture.width,
                                draft.texture.height));
    }
    return {};
}

// ---- triangles ----

// Of each texture the first `most`.
void packTriangles(std::vector<Draft>& drafts, size_t most) {
    for (Draft& draft : drafts) {
        const auto kept = std::span(draft.triangles).first(std::min(most, draft.triangles.size()));
        draft.texture.shownTriangles = kept.size();
        draft.texture.packedTriangles = report::packTriangles(kept);
    }
}

void packTriangles(std::vector<Draft>& drafts, const ViewBudget& budget) {
    size_t most = SIZE_MAX;
    for (packTriangles(drafts, most); budget.triangles > 0; packTriangles(drafts, most)) {
        size_t total = 0;
        size_t longest = 0;
        for (const Draft& draft : drafts) {
            total += draft.texture.packedTriangles.size();
            longest = std::max(longest, draft.texture.shownTriangles);
        }
        if (total <= budget.triangles || longest <= 1) break;
        most = longest / 2;
    }
    for (Draft& draft : drafts) {
        if (draft.texture.shownTriangles < draft.triangles.size())
            addNote(draft.texture,
                    fmt::format("To keep the page small, it holds the first {} of {} distinct triangles.",
                                report::formatCount(draft.texture.shownTriangles),
                                report::formatCount(draft.triangles.size())));
    }
}

// ---- maps ----

void packMaps(const scene::Scene& scene, Draft& draft, unsigned mostLevel) {
    std::vector<report::CellMap> maps;
    for (size_t k = 0; k < draft.maps.size(); ++k) {
        const auto& [micromaps, record] = draft.maps[k];
        maps.push_back(cellMap(scene.micromaps[static_cast<size_t>(micromaps)].set,
                               static_cast<uint32_t>(record), mostLevel));
        maps.back().sharers = draft.sharers[k];
    }
    draft.texture.maps = maps.size();
    draft.texture.packedMaps = report::packMaps(maps);
}

unsigned highestLevel(const scene::Scene& scene, const Draft& draft) {
    unsigned highest = 0;
    for (const auto& [micromaps, record] : draft.maps) {
        const auto& records = scene.micromaps[static_cast<size_t>(micromaps)].set.records;
        highest = std::max<unsigned>(highest, records[static_cast<size_t>(record)].level);
    }
    return highest;
}

// The highest level at which all maps fit into `room` bytes; 0: no limit.
void packMaps(const scene::Scene& scene, std::vector<Draft>& drafts, size_t room, const Executor& executor) {
    std::vector<unsigned> highest;
    for (const Draft& draft : drafts) highest.push_back(highestLevel(scene, draft));
    unsigned level = highest.empty() ? 0 : *std::ranges::max_element(highest);
    for (;; --level) {
        executor.parallelFor(drafts.size(), 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) packMaps(scene, drafts[i], level);
        });
        size_t total = 0;
        for (const Draft& draft : drafts) total += draft.texture.packedMaps.size();
        if (room == 0 || total <= room || level == 0) break;
    }
    for (size_t i = 0; i < drafts.size(); ++i) {
        if (highest[i] > level)
            addNote(drafts[i].texture,
                    fmt::format("To keep the page small, maps above level {0} are drawn as of level "
                                "{0}; figures are of the stored level. --full holds all.",
                                level));
    }
}

}  // namespace

Result<report::MapView> inspectView(const scene::Scene& scene, std::span<const ViewInput> inputs,
                                    const ViewBudget& budget, const Executor& executor) {
    std::vector<Draft> drafts;
    for (const ViewInput& input : inputs) {
        drafts.push_back(draftOf(scene, input));
        if (const Status encoded = encodePicture(drafts.back()); !encoded) return encoded.error();
    }
    if (const Status shrunk = shrinkPictures(drafts, budget.pictures); !shrunk) return shrunk.error();
    packTriangles(drafts, budget);
    size_t used = 0;
    for (const Draft& d : drafts) used += d.texture.png.size() * 4 / 3 + d.texture.packedTriangles.size();
    const size_t room = budget.all == 0 ? 0 : budget.all - std::min(used, budget.all - 1);
    packMaps(scene, drafts, room, executor);
    report::MapView view;
    for (size_t s = 0; s < view.states.size(); ++s) {
        const auto state = static_cast<micromap::State>(s);
        view.states[s] = {stateName(state), stateColour(state)};
    }
    for (Draft& draft : drafts) view.textures.push_back(std::move(draft.texture));
    return view;
}

}  // namespace filigree::jobs
