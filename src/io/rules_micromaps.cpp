// Rules of the root extension object.
#include "io/micromap_bytes.h"
#include "io/rules.h"

#include <array>
#include <map>

#include <fmt/format.h>

namespace filigree::io {
namespace {

using Pair = std::pair<uint64_t, uint64_t>;  // level, format

class MicromapCheck {
  public:
    MicromapCheck(RuleCheck& check, const Json& json, std::string path)
        : check_(check), json_(json), path_(std::move(path)) {}

    MicromapFacts run() {
        if (!json_.is_object()) {
            check_.breach(path_, "omm-micromap", "found " + describe(json_) + ", expected an object");
            return {};
        }
        data_ = view("data");
        triangles_ = view("triangles");
        if (data_) checkNoStride("data", *data_);
        if (triangles_) checkTriangles();
        checkUsage();
        if (!triangles_) return {};
        return {recordCount()};
    }

  private:
    [[nodiscard]] std::string at(std::string_view key) const { return fmt::format("{}/{}", path_, key); }

    std::optional<BufferView> view(const char* key) {
        ObjectReader reader(json_, path_);
        const size_t index = reader.index(key, check_.data().list("bufferViews").size());
        if (const Status status = reader.status(); !status) {
            check_.breach("omm-view", at(key), status.error());
            return std::nullopt;
        }
        const Result<BufferView> found = readBufferView(check_.data(), index);
        if (found) return *found;
        check_.breach("omm-view", at(key), found.error());
        return std::nullopt;
    }

    void checkNoStride(const char* key, const BufferView& view) {
        if (!view.byteStride) return;
        check_.breach(
            at(key), "omm-stride",
            fmt::format("newest draft: its buffer view has byteStride {}, expected none", *view.byteStride));
    }

    [[nodiscard]] size_t stride() const { return triangles_->byteStride.value_or(micromap::recordBytes); }

    [[nodiscard]] size_t recordCount() const {
        const size_t bytes = triangles_->bytes.size();
        if (stride() < micromap::recordBytes || bytes < micromap::recordBytes) return 0;
        return (bytes - micromap::recordBytes) / stride() + 1;
    }

    void checkTriangles() {
        checkNoStride("triangles", *triangles_);
        const size_t bytes = triangles_->bytes.size();
        if (stride() < micromap::recordBytes || stride() % 4 != 0) {
            check_.breach(
                at("triangles"), "omm-record-stride",
                fmt::format("older draft: byteStride {}, expected a multiple of 4, at least 8", stride()));
        }
        if (bytes % micromap::recordBytes != 0) {
            check_.breach(
                at("triangles"), "omm-triangles-length",
                fmt::format("newest draft: a buffer view of {} bytes, expected a multiple of 8", bytes));
        }
        checkRecords();
    }

    void checkRecords() {
        std::vector<micromap::Record> legal;
        bool illegalTold = false;
        bool outsideTold = false;
        for (size_t i = 0; i < recordCount(); ++i) {
            const RawRecord raw = decodeRecord(triangles_->bytes.data() + i * stride());
            if (!isLegal(raw)) {
                if (!illegalTold) tellIllegal(i, raw);
                illegalTold = true;
                continue;
            }
            ++found_[{raw.level, raw.format}];
            legal.push_back({raw.byteOffset, raw.level, static_cast<micromap::Format>(raw.format)});
            const uint64_t end = raw.byteOffset + dataBytes(raw);
            if (!data_ || end <= data_->bytes.size() || outsideTold) continue;
            outsideTold = true;
            check_.breach(at("triangles"), "omm-record-region",
                          fmt::format("record {}: bytes {} to {}, expected inside the {} bytes of data", i,
                                      raw.byteOffset, end, data_->bytes.size()));
        }
        if (illegalTold) return;
        if (const std::optional<Overlap> overlap = findOverlap(legal)) {
            check_.breach(
                at("triangles"), "omm-record-overlap",
                fmt::format("records {} and {} share bytes of data", overlap->first, overlap->second));
        }
    }

    void tellIllegal(size_t index, const RawRecord& raw) {
        const bool level = raw.level > micromap::maxLevel;
        check_.breach(
            at("triangles"), level ? "omm-record-level" : "omm-record-format",
            level ? fmt::format("record {}: level {}, expected 0 to {}", index, raw.level, micromap::maxLevel)
                  : fmt::format("record {}: format {}, expected 1 or 2", index, raw.format));
    }

    // One of the three usage arrays; nothing when it is not usable.
    std::optional<std::vector<uint64_t>> usageArray(const char* key, const char* rule, uint64_t least,
                                                    uint64_t most, const char* draft) {
        const Json* array = memberOf(json_, key);
        if (array == nullptr || !array->is_array() || array->empty()) {
            check_.breach(at(key), "omm-usage", "expected an array of at least one integer");
            return std::nullopt;
        }
        std::vector<uint64_t> values;
        for (size_t i = 0; i < array->size(); ++i) {
            const Json& value = (*array)[i];
            const bool whole = value.is_number_unsigned();
            if (!whole || value.get<uint64_t>() < least || value.get<uint64_t>() > most) {
                check_.breach(fmt::format("{}/{}", at(key), i), rule,
                              fmt::format("{}found {}, expected an integer from {} to {}", draft,
                                          describe(value), least, most));
                return std::nullopt;
            }
            values.push_back(value.get<uint64_t>());
        }
        return values;
    }

    void checkUsage() {
        const auto counts = usageArray("usageCounts", "omm-usage-count", 1, UINT32_MAX, "");
        const auto levels =
            usageArray("usageLevels", "omm-usage-level", 0, micromap::maxLevel, "newest draft: ");
        const auto formats = usageArray("usageFormats", "omm-usage-format", 1, 2, "");
        if (!counts || !levels || !formats) return;
        if (counts->size() != levels->size() || counts->size() != formats->size()) {
            check_.breach(
                path_, "omm-usage-lengths",
                fmt::format("usageCounts, usageLevels and usageFormats have {}, {} and {} entries, expected "
                            "the same",
                            counts->size(), levels->size(), formats->size()));
            return;
        }
        if (triangles_) checkSums(*counts, *levels, *formats);
    }

    void checkSums(const std::vector<uint64_t>& counts, const std::vector<uint64_t>& levels,
                   const std::vector<uint64_t>& formats) {
        std::map<Pair, uint64_t> claimed;
        uint64_t total = 0;
        for (size_t i = 0; i < counts.size(); ++i) {
            claimed[{levels[i], formats[i]}] += counts[i];
            total += counts[i];
        }
        if (total != recordCount()) {
            check_.breach(at("usageCounts"), "omm-usage-total",
                          fmt::format("they sum to {}, expected the {} records", total, recordCount()));
        }
        if (claimed == found_) return;
        check_.breach(at("usageCounts"), "omm-usage-sums",
                      "newest draft: their sums by level and format differ from the records': " +
                          firstDifference(claimed));
    }

    [[nodiscard]] std::string firstDifference(const std::map<Pair, uint64_t>& claimed) const {
        const auto countIn = [](const std::map<Pair, uint64_t>& map, const Pair& pair) {
            const auto it = map.find(pair);
            return it == map.end() ? 0 : it->second;
        };
        for (const auto* map : {&claimed, &found_}) {
            for (const auto& [pair, count] : *map) {
                if (countIn(claimed, pair) == countIn(found_, pair)) continue;
                return fmt::format("level {}, format {}: {} claimed, {} found", pair.first, pair.second,
                                   countIn(claimed, pair), countIn(found_, pair));
            }
        }
        return "";
    }

    RuleCheck& check_;
    const Json& json_;
    std::string path_;
    std::optional<BufferView> data_;
    std::optional<BufferView> triangles_;
    std::map<Pair, uint64_t> found_;  // records by level and format
};

}  // namespace

std::vector<MicromapFacts> checkMicromaps(RuleCheck& check, const char* extension) {
    const Json* root = extensionOf(check.data().json, extension);
    if (root == nullptr) return {};
    const std::string path = fmt::format("/extensions/{}/micromaps", extension);
    const Json* micromaps = memberOf(*root, "micromaps");
    if (micromaps == nullptr || !micromaps->is_array() || micromaps->empty()) {
        check.breach(path, "omm-micromaps", "expected an array of at least one micromap");
        return {};
    }
    std::vector<MicromapFacts> facts;
    for (size_t i = 0; i < micromaps->size(); ++i) {
        facts.push_back(MicromapCheck(check, (*micromaps)[i], fmt::format("{}/{}", path, i)).run());
    }
    return facts;
}

}  // namespace filigree::io
