#include "filigree/grid/lattice_choice.h"

#include "filigree/grid/error.h"

#include "grid/axis_spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

constexpr std::array axisNames{'x', 'y', 'z'};

// The vertex at `index` of grids and loose vertices, for people.
std::string vertexName(const GridMesh& mesh, size_t index) {
    if (index < mesh.vertices.size()) return fmt::format("vertex {} of the grids", index);
    return fmt::format("loose vertex {}", index - mesh.vertices.size());
}

struct MeshAxes {
    std::array<AxisCoordinates, 3> coordinates;
    std::array<std::optional<AxisSpacing>, 3> spacing;
    std::array<std::optional<size_t>, 3> breach;  // vertices that keep an axis from being regular

    [[nodiscard]] double across(size_t k) const { return coordinates[k].high - coordinates[k].low; }
    [[nodiscard]] double diagonal() const { return std::hypot(across(0), across(1), across(2)); }
};

Result<MeshAxes> axesOf(const GridMesh& mesh) {
    if (mesh.vertices.empty() && mesh.looseVertices.empty())
        return Error{ErrorKind::format, "the mesh has no vertices"};
    MeshAxes axes;
    for (size_t k = 0; k < 3; ++k) {
        AxisCoordinates& range = axes.coordinates[k];
        std::optional<size_t> broken;
        forEachCoordinate(mesh, k, [&](double value, size_t index) {
            if (!std::isfinite(value)) broken = index;
            range.low = index == 0 ? value : std::min(range.low, value);
            range.high = index == 0 ? value : std::max(range.high, value);
            return !broken;
        });
        if (broken)
            return Error{ErrorKind::format, fmt::format("{}: {} is not a finite number",
                                                        vertexName(mesh, *broken), axisNames[k])};
        const SpacingSearch found = findSpacing(mesh, k, range);
        axes.spacing[k] = found.spacing;
        axes.breach[k] = found.breach;
    }
    return axes;
}

Result<Lattice> latticeOf(const MeshAxes& axes, const Lattice& lattice) {
    for (size_t k = 0; k < 3; ++k) {
        const double last = std::round((axes.coordinates[k].high - lattice.origin[k]) / lattice.step[k]);
        if (last < latticeLimit) continue;
        return Error{
            ErrorKind::limit,
            fmt::format("{} spans {:g}, which takes {:.0f} steps of {:g}; {} fit, a step of {:g} does",
                        axisNames[k], axes.across(k), last, lattice.step[k], latticeLimit - 1,
                        axes.across(k) / (latticeLimit - 1))};
    }
    return lattice;
}

// Steps of all axes, where n axes that are not taken as they are get stepOfFree(n).
struct Steps {
    Lattice lattice;
    unsigned free = 0;
};
Steps stepsFor(const MeshAxes& axes, const std::function<double(unsigned)>& stepOfFree) {
    const auto isTaken = [&](size_t k, double step) {
        const auto& spacing = axes.spacing[k];
        return spacing && (spacing->even || spacing->step >= step);
    };
    const auto countFree = [&](double step) {
        unsigned count = 0;
        for (size_t k = 0; k < 3; ++k) count += axes.across(k) > 0 && !isTaken(k, step) ? 1 : 0;
        return count;
    };
    // The more axes are free the smaller is the step, so that no more become free than were counted.
    const double step = stepOfFree(std::max(countFree(stepOfFree(1)), 1U));
    Steps steps;
    steps.free = countFree(step);
    for (size_t k = 0; k < 3; ++k) {
        const bool taken = isTaken(k, step);
        steps.lattice.origin[k] = taken ? axes.spacing[k]->origin : axes.coordinates[k].low;
        steps.lattice.step[k] = taken ? axes.spacing[k]->step : step;
    }
    return steps;
}

Status checkWanted(const MeshAxes& axes, double wanted, const char* name) {
    if (wanted > 0 && wanted <= axes.diagonal()) return {};
    return Error{ErrorKind::usage,
                 fmt::format("{} {:g}: expected more than 0 and at most the diagonal of the "
                             "mesh, {:g}",
                             name, wanted, axes.diagonal())};
}

// Root mean square distance over the vertices of grids, or of loose triangles where there are none. Summed in
// chunks of one size, so that threads do not matter.
double measuredRms(const GridMesh& mesh, const Lattice& lattice, const Executor& executor) {
    const std::vector<Vec3>& vertices = mesh.vertices.empty() ? mesh.looseVertices : mesh.vertices;
    constexpr size_t chunk = 1 << 15;
    std::vector<double> sums((vertices.size() + chunk - 1) / chunk);
    executor.parallelFor(sums.size(), 1, [&](size_t begin, size_t end) {
        for (size_t c = begin; c < end; ++c)
            for (size_t v = c * chunk; v < std::min(vertices.size(), (c + 1) * chunk); ++v) {
                const Vec3 decoded = lattice.positionOf(lattice.pointAt(vertices[v]));
                for (size_t k = 0; k < 3; ++k) {
                    const double off = double{decoded[k]} - double{vertices[v][k]};
                    sums[c] += off * off;
                }
            }
    });
    double sum = 0;
    for (const double part : sums) sum += part;
    return std::sqrt(sum / static_cast<double>(vertices.size()));
}

}  // namespace

Result<Lattice> latticeForError(const GridMesh& mesh, double maxError) {
    const auto axes = axesOf(mesh);
    if (!axes) return axes.error();
    if (const Status status = checkWanted(*axes, maxError, "maximum error"); !status) return status.error();
    const Steps steps = stepsFor(*axes, [&](unsigned free) { return 2 * maxError / std::sqrt(free); });
    return latticeOf(*axes, steps.lattice);
}

Result<Lattice> latticeForRms(const GridMesh& mesh, double rms, const Executor& executor,
                              ProgressSink& progress) {
    const auto axes = axesOf(mesh);
    if (!axes) return axes.error();
    if (const Status status = checkWanted(*axes, rms, "RMS error"); !status) return status.error();
    // Rounding is even over a step, with a variance of step^2 / 12, nearly; measuring mends the rest. Small
    // meshes jump, so the best of some is kept.
    double aim = rms;
    double best = 0;
    std::optional<Lattice> chosen;
    for (unsigned attempt = 0; attempt < 8 || !chosen; ++attempt) {
        if (progress.cancelled()) return Error{ErrorKind::cancelled, "stopped while choosing a lattice"};
        const Steps steps = stepsFor(*axes, [&](unsigned free) { return aim * std::sqrt(12.0 / free); });
        const auto lattice = latticeOf(*axes, steps.lattice);
        if (!lattice || steps.free == 0) return lattice;
        const double measured = measuredRms(mesh, *lattice, executor);
        if (measured <= rms && measured >= best) {
            best = measured;
            chosen = *lattice;
        }
        if (best >= 0.995 * rms) break;
        aim *= attempt < 8 && measured > 0 ? 0.9985 * rms / measured : 0.9;
    }
    return *chosen;
}

Result<Lattice> losslessLattice(const GridMesh& mesh) {
    const auto axes = axesOf(mesh);
    if (!axes) return axes.error();
    Lattice lattice;
    for (size_t k = 0; k < 3; ++k) {
        lattice.origin[k] = axes->coordinates[k].low;
        if (!(axes->across(k) > 0)) continue;
        const auto& spacing = axes->spacing[k];
        if (spacing && spacing->exact) {
            lattice.origin[k] = spacing->origin;
            lattice.step[k] = spacing->step;
        } else if (const auto dyadic = dyadicSpacingOf(mesh, k, axes->coordinates[k])) {
            lattice.step[k] = *dyadic;
        } else {
            return Error{
                ErrorKind::unsupported,
                fmt::format("{}: no lattice of {} steps holds its {} and the others'; not lossless",
                            vertexName(mesh, axes->breach[k].value_or(0)), latticeLimit, axisNames[k])};
        }
    }
    return latticeOf(*axes, lattice);
}

Result<MatchedLattice> latticeMatchingPaper(const GridMesh& mesh, DisplacementCode displacement,
                                            const Executor& executor) {
    const VertexErrors errors = paperErrors(mesh, displacement, executor);
    const auto all = static_cast<double>(errors.vertices + mesh.looseVertices.size());
    const double measured = errors.rms * std::sqrt(static_cast<double>(errors.vertices) / all);
    const double rms = measured > 0 ? measured : usualPaperRms * boundsOf(mesh).diagonal();
    const auto lattice = latticeForRms(mesh, rms, executor);
    if (!lattice) return lattice.error();
    return MatchedLattice{*lattice, rms};
}

}  // namespace filigree::grid
