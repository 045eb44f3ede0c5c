#include "jobs/busy_view.h"

#include "filigree/trace/rays.h"

#include "jobs/random.h"

#include <cmath>
#include <numbers>
#include <unordered_set>
#include <vector>

namespace filigree::jobs {
namespace {

constexpr unsigned tries = 64;

// Placements of primitives that have holes.
struct Leaf {
    const scene::Primitive* primitive = nullptr;
    const scene::Instance* instance = nullptr;
};

std::vector<Leaf> leavesOf(const scene::Scene& scene, const trace::World& world) {
    std::unordered_set<const scene::Primitive*> tested;
    for (size_t k = 0; k < world.surfaceCount(); ++k) {
        if (world.isTested(k)) tested.insert(&world.primitive(k));
    }
    std::vector<Leaf> leaves;
    for (const auto& instance : scene.instances) {
        for (const auto& primitive : scene.meshes[instance.mesh].primitives) {
            if (tested.contains(&primitive)) leaves.push_back({&primitive, &instance});
        }
    }
    return leaves;
}

Vec3 randomCentre(const Leaf& leaf, Random& random) {
    const size_t triangle = random.next() % leaf.primitive->triangleCount();
    Vec3 centre{};
    for (size_t k = 0; k < 3; ++k) {
        const auto& corner = leaf.primitive->positions[leaf.primitive->indices[3 * triangle + k]];
        centre = plus(centre, times(transformed(leaf.instance->transform, corner), 1.0F / 3));
    }
    return centre;
}

scene::Camera randomView(const Vec3& target, float diagonal, Random& random) {
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const double rise = random.uniform(0, 0.35);  // radians
    const double distance = diagonal * random.uniform(0.01, 0.12);
    const Vec3 away{static_cast<float>(std::cos(turn) * std::cos(rise)), static_cast<float>(std::sin(rise)),
                    static_cast<float>(std::sin(turn) * std::cos(rise))};
    return trace::lookAt(plus(target, times(away, static_cast<float>(distance))), target, {0, 1, 0}, 1);
}

}  // namespace

scene::Camera busyView(const scene::Scene& scene, const trace::World& world) {
    scene::Camera best = trace::overview(world, 16.0F / 9);
    const std::vector<Leaf> leaves = leavesOf(scene, world);
    const auto texture = trace::Opacity::make(trace::Method::texture, 4, world, {}, {});
    if (leaves.empty() || !texture) return best;
    Random random(1);
    uint64_t most = 0;
    for (unsigned k = 0; k < tries; ++k) {
        trace::RenderSettings settings;
        settings.width = 64;
        settings.height = 36;
        settings.integrator = trace::Integrator::primary;
        const Leaf& leaf = leaves[random.next() % leaves.size()];
        settings.camera = randomView(randomCentre(leaf, random), world.bounds().diagonal(), random);
        trace::Counters counters;
        castRays(world, *texture, raysOf(world, *texture, settings), false, counters);
        const uint64_t candidates = counters.total().candidateHits;
        if (candidates <= most) continue;
        most = candidates;
        best = settings.camera;
    }
    return best;
}

}  // namespace filigree::jobs
