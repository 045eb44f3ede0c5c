#include "filigree/jobs/compare.h"

#include "filigree/core/file.h"
#include "filigree/io/fil.h"
#include "filigree/report/drawing.h"

#include "jobs/encode_scene.h"
#include "jobs/inspection.h"
#include "jobs/level_sweep.h"
#include "jobs/page_parts.h"
#include "jobs/peak_memory.h"
#include "jobs/scene_bytes.h"
#include "jobs/stopwatch.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using encoding::Encoding;
using micromap::Format;

constexpr uint64_t triangleIndexBytes = 12;

Status check(const CompareOptions& options) {
    if (const Status levels = checkLevels(options.levels); !levels) return levels;
    return check(options.parameters);
}

// Flat states and masks in row order take the same bytes, of which every one is known beforehand.
bool isCounted(Encoding encoding) {
    return encoding == Encoding::flat || encoding == Encoding::gruen;
}

class Comparison {
  public:
    Comparison(const CompareOptions& options, const Executor& executor, ProgressSink& progress)
        : options_(options), executor_(executor), progress_(progress) {}

    // Adds the rows of one level: bakes it in each form that a row needs.
    Status add(scene::Scene& scene, unsigned level) {
        for (const unsigned states : {2u, 4u}) {
            const auto wanted = encodingsOf(states);
            if (wanted.empty()) continue;
            const auto maps =
                bakeAt(scene, options_.input, options_.parameters, level, states, executor_, progress_);
            if (!maps) return maps.error();
            if (summary_.rows.empty()) describe(scene, *maps);
            for (const Wanted& one : wanted) {
                if (progress_.cancelled()) return Error{ErrorKind::cancelled, "the comparison was cancelled"};
                if (const Status added = addRow(scene, *maps, one, level); !added) return added;
            }
        }
        return {};
    }

    CompareSummary take() && {
        std::ranges::sort(summary_.rows, {}, [](const CompareRow& row) {
            return std::tuple(row.states, row.level, encoding::encodingNamed(row.method));
        });
        for (const Encoding encoding : missing_)
            summary_.notes.push_back(fmt::format("{}: not in this version, left out", nameOf(encoding)));
        return std::move(summary_);
    }

  private:
    struct Wanted {
        Encoding encoding;
        Format format;
    };

    [[nodiscard]] bool wants(unsigned states) const {
        return std::ranges::find(options_.states, states) != options_.states.end();
    }

    // What is encoded from maps that were baked with `bakedStates`. Nearly always the states are those
    // wanted in the end.
    [[nodiscard]] std::vector<Wanted> encodingsOf(unsigned bakedStates) const {
        std::vector<Wanted> wanted;
        for (unsigned k = 0; k < encoding::encodingCount; ++k) {
            const auto encoding = static_cast<Encoding>(k);
            for (const unsigned states : {2u, 4u}) {
                BakeParameters parameters;
                parameters.states = states;
                if (!wants(states) || parametersFor(encoding, parameters).states != bakedStates) continue;
                wanted.push_back({encoding, states == 2 ? Format::twoState : Format::fourState});
            }
        }
        return wanted;
    }

    void describe(const scene::Scene& scene, const SceneMaps& maps) {
        summary_.triangles = maps.triangles;
        summary_.maskedTriangles = maps.maskedTriangles;
        summary_.textureBytes = textureBytes(scene, maps);
        summary_.vertexBytes = vertexBytes(maps);
        summary_.triangleIndexBytes = triangleIndexBytes * maps.maskedTriangles;
        summary_.notes = maps.notes;
        if (const uint64_t count = vertexAlphaTriangles(maps); count > 0) {
            summary_.notes.push_back(
                fmt::format("triangles with a vertex alpha, which no bitmask knows: {}", count));
        }
    }

    Status addRow(const scene::Scene& scene, const SceneMaps& maps, const Wanted& wanted, unsigned level) {
        const bool textures = wanted.encoding == Encoding::bitmask;
        CompareRow row;
        row.method = nameOf(wanted.encoding);
        row.level = level;
        row.states = wanted.format == Format::twoState ? 2 : 4;
        row.maps = textures ? maps.groups.size() : maps.maps.size();
        row.indexBytes =
            io::filIndexBytes(wanted.encoding, static_cast<uint32_t>(row.maps), maps.maskedTriangles);
        if (isCounted(wanted.encoding)) {
            row.payloadBytes = row.maps * micromap::flatBytes(level, wanted.format);
            row.descriptorBytes = row.maps * micromap::recordBytes;
        } else if (const CompareRow* const same = textures ? sameTextures(row.states) : nullptr) {
            row.payloadBytes = same->payloadBytes;
            row.descriptorBytes = same->descriptorBytes;
        } else {
            const Status measured = measure(scene, maps, wanted, row);
            if (!measured && measured.error().kind == ErrorKind::unsupported)
                return leaveOut(wanted.encoding);
            if (!measured) return measured.error().within(options_.input.string());
        }
        summary_.rows.push_back(std::move(row));
        return {};
    }

    Status measure(const scene::Scene& scene, const SceneMaps& maps, const Wanted& wanted, CompareRow& row) {
        const Stopwatch watch;
        const auto set = encodeMaps(scene, maps, wanted.encoding, wanted.format, executor_);
        if (!set) return set.error();
        row.encodeSeconds = watch.seconds();
        row.payloadBytes = set->payload.size();
        row.descriptorBytes = set->descriptors.size();
        return {};
    }

    // The row of the textures at an earlier level; they are the same at each.
    [[nodiscard]] const CompareRow* sameTextures(unsigned states) const {
        for (const CompareRow& row : summary_.rows) {
            if (row.method == nameOf(Encoding::bitmask) && row.states == states) return &row;
        }
        return nullptr;
    }

    Status leaveOut(Encoding encoding) {
        if (std::ranges::find(missing_, encoding) == missing_.end()) missing_.push_back(encoding);
        return {};
    }

    const CompareOptions& options_;
    const Executor& executor_;
    ProgressSink& progress_;
    CompareSummary summary_;
    std::vector<Encoding> missing_;
};

Status writePage(const CompareOptions& options, const CompareSummary& summary) {
    if (options.page.empty()) return {};
    report::Page page;
    page.title = "What the micromaps of " + summary.scene + " take";
    page.lead = "Every published way to store them, level by level. Equal maps are stored once.";
    page.sections = comparisonSections(summary, options);
    addNotes(summary.notes, page);
    return writeFile(options.page, report::toHtml(page));
}

Status writeReport(const CompareOptions& options, const CompareSummary& summary) {
    if (const Status written = writePage(options, summary); !written) return written;
    if (options.outputFolder.empty()) return {};
    if (const Status made = makeFolder(options.outputFolder); !made) return made;
    const std::string csv = report::toCsv(rowTable(summary));
    if (const Status written = writeFile(options.outputFolder / "compare.csv", csv); !written) return written;
    for (const unsigned states : options.states) {
        const std::string svg = report::toSvg(report::layOut(comparisonChart(summary, states)));
        const auto path = options.outputFolder / fmt::format("compare_{}_states.svg", states);
        if (const Status written = writeFile(path, svg); !written) return written;
    }
    return {};
}

}  // namespace

Result<CompareSummary> compare(const CompareOptions& options, const Executor& executor,
                               ProgressSink& progress) {
    if (const Status checked = check(options); !checked) return checked.error();
    const Stopwatch watch;
    auto scene = readUnbaked(options.input, options.parameters);
    if (!scene) return scene.error();
    Comparison comparison(options, executor, progress);
    for (const unsigned level : options.levels) {
        if (const Status added = comparison.add(*scene, level); !added) return added.error();
    }
    CompareSummary summary = std::move(comparison).take();
    summary.scene = options.input.filename().string();
    summary.seconds = watch.seconds();
    summary.peakBytes = peakMemory();
    if (const Status written = writeReport(options, summary); !written) return written.error();
    return summary;
}

}  // namespace filigree::jobs
