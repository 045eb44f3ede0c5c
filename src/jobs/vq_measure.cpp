#include "jobs/vq_measure.h"

#include "jobs/stopwatch.h"

#include <algorithm>
#include <map>

namespace filigree::jobs {
namespace {

using quadmap::Square;

void addSource(const Square& square, VqMeasure measure, VqTotals& totals) {
    totals.savings[indexOf(measure)] = quadmap::savings(square);
}

// The squares of a map from 64 to 8 regions a side.
void addSources(const Square& square64, VqMap& map) {
    map.source32 = quadmap::halved(square64);
    map.source16 = quadmap::halved(map.source32);
    addSource(square64, VqMeasure::source64, map.totals);
    addSource(map.source32, VqMeasure::source32, map.totals);
    addSource(map.source16, VqMeasure::source16, map.totals);
    addSource(map.source16, VqMeasure::raw16, map.totals);
    addSource(quadmap::halved(map.source16), VqMeasure::source8, map.totals);
}

// Regions that the source leaves free count no more in the map.
Square withoutFree(const Square& source, Square map) {
    for (size_t k = 0; k < map.regions.size(); ++k) {
        if (source.regions[k] == quadmap::Region::free) map.regions[k] = quadmap::Region::free;
    }
    return map;
}

void encode(const VqEncoder& encoder, quadmap::Prefer prefer, VqMap& map) {
    const size_t k = indexOf(encoder.measure);
    const Square& source = encoder.side == 16 ? map.source16 : map.source32;
    const Stopwatch watch;
    VqResult result = encoder.run(source, prefer);
    map.totals.seconds[k] = watch.seconds();
    result.square = withoutFree(source, std::move(result.square));
    map.totals.savings[k] = quadmap::savings(result.square);
    map.totals.substitutions[k] = quadmap::substitutions(source, result.square);
    map.results[k] = std::move(result);
}

VqMap mapOf(const Square& square64, double masks, quadmap::Prefer prefer) {
    VqMap map;
    map.totals.maps = 1;
    addSources(square64, map);
    map.totals.savings[indexOf(VqMeasure::masks)] = masks;
    for (const VqEncoder& encoder : vqEncoders()) encode(encoder, prefer, map);
    return map;
}

void addTransforms(const VqMap& map, ChosenTransforms& to) {
    const auto add = [&](VqMeasure measure, std::vector<unsigned>& list) {
        if (const auto& result = map.results[indexOf(measure)]) list.push_back(result->transforms);
    };
    add(VqMeasure::vq2Best, to.vq2);
    add(VqMeasure::vq4Best, to.vq4);
}

}  // namespace

quadmap::Prefer preferOf(const VqOptions& options) {
    return options.prefer == 'T'   ? quadmap::Prefer::transparent
           : options.prefer == 'O' ? quadmap::Prefer::opaque
                                   : quadmap::Prefer::neither;
}

Result<VqMeasured> measure(const VqInput& input, const VqOptions& options, const Executor& executor,
                           ProgressSink& progress) {
    const auto masks = maskSavings(input, executor);
    if (!masks) return masks.error();
    const quadmap::SquareMaker maker(input.texture, input.test);
    std::vector<VqMap> maps(input.maps());
    executor.parallelFor(maps.size(), 1, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end && !progress.cancelled(); ++k) {
            maps[k] = mapOf(squareOf(input, maker, k, 64), (*masks)[k], preferOf(options));
            progress.advance(1);
        }
    });
    if (progress.cancelled()) return Error{ErrorKind::cancelled, "stopped"};
    VqMeasured measured;
    measured.texture = {input.name, {}, input.pairCount, input.singles};
    for (const VqMap& map : maps) {
        measured.texture.totals.add(map.totals);
        addTransforms(map, measured.transforms);
    }
    measured.first = std::move(maps.front());
    return measured;
}

TransformUse transformUseOf(const std::vector<unsigned>& chosen) {
    std::map<unsigned, uint64_t> counts;
    for (const unsigned transforms : chosen) ++counts[transforms];
    TransformUse use;
    use.used = counts.size();
    use.maps = chosen.size();
    for (const auto& [transforms, count] : counts) {
        use.unique += count == 1 ? 1 : 0;
        use.most = std::max(use.most, count);
    }
    return use;
}

double TransformUse::mostFrequentShare() const {
    return maps == 0 ? 0 : static_cast<double>(most) / static_cast<double>(maps);
}

void VqTotals::add(const VqTotals& other) {
    maps += other.maps;
    for (size_t k = 0; k < vqMeasureCount; ++k) {
        savings[k] += other.savings[k];
        substitutions[k] += other.substitutions[k];
        seconds[k] += other.seconds[k];
    }
}

double VqTotals::mean(VqMeasure measure) const {
    return maps == 0 ? 0 : savings[indexOf(measure)] / static_cast<double>(maps);
}

}  // namespace filigree::jobs
