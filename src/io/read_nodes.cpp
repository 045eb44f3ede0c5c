// Nodes to instances and cameras, without recursion.
#include "io/read_parts.h"

#include <cmath>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr size_t maxNodeDepth = 1024;

using Matrix = std::array<double, 16>;  // column-major
constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix m{};
    for (size_t column = 0; column < 4; ++column) {
        for (size_t row = 0; row < 4; ++row) {
            for (size_t k = 0; k < 4; ++k) m[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
        }
    }
    return m;
}

Matrix fromParts(const std::array<double, 3>& t, const std::array<double, 4>& q,
                 const std::array<double, 3>& s) {
    const auto [x, y, z, w] = q;
    return {s[0] * (1 - 2 * (y * y + z * z)),
            s[0] * 2 * (x * y + z * w),
            s[0] * 2 * (x * z - y * w),
            0,
            s[1] * 2 * (x * y - z * w),
            s[1] * (1 - 2 * (x * x + z * z)),
            s[1] * 2 * (y * z + x * w),
            0,
            s[2] * 2 * (x * z + y * w),
            s[2] * 2 * (y * z - x * w),
            s[2] * (1 - 2 * (x * x + y * y)),
            0,
            t[0],
            t[1],
            t[2],
            1};
}

Matrix readTransform(ObjectReader& node) {
    if (node.has("matrix")) return node.numbers<16>("matrix", identity);
    return fromParts(node.numbers<3>("translation", {0, 0, 0}), node.numbers<4>("rotation", {0, 0, 0, 1}),
                     node.numbers<3>("scale", {1, 1, 1}));
}

std::array<float, 16> toFloat(const Matrix& matrix) {
    std::array<float, 16> result{};
    for (size_t i = 0; i < 16; ++i) result[i] = static_cast<float>(matrix[i]);
    return result;
}

// Walks node trees depth first, children in order.
class NodeWalk {
  public:
    explicit NodeWalk(SceneReading& reading)
        : reading_(reading),
          nodes_(reading.data.list("nodes")),
          reached_(nodes_.size()),
          placed_(nodes_.size()) {}

    Status walkScene(size_t index) {
        ObjectReader scene = reading_.data.item("scenes", index);
        const Json& roots = scene.array("nodes");
        if (const Status status = scene.status(); !status) return status;
        for (size_t i = roots.size(); i-- > 0;) {
            const Result<size_t> root = nodeIndex(roots[i], fmt::format("{}/nodes/{}", scene.path(), i));
            if (!root) return root.error();
            // Scenes may share roots; each is placed once.
            if (placed_[*root]) continue;
            if (const Status status = push({*root, 0, identity}); !status) return status;
        }
        while (!stack_.empty()) {
            const Entry entry = stack_.back();
            stack_.pop_back();
            if (const Status status = visit(entry); !status) return status;
        }
        placed_ = reached_;
        return {};
    }

  private:
    struct Entry {
        size_t node;
        size_t depth;
        Matrix parent;
    };

    Result<size_t> nodeIndex(const Json& value, const std::string& path) const {
        if (value.is_number_unsigned() && value.get<uint64_t>() < nodes_.size()) return value.get<size_t>();
        return Error{ErrorKind::format, fmt::format("{}: found {}, expected a node below {}", path,
                                                    describe(value), nodes_.size())};
    }

    Status push(const Entry& entry) {
        if (reached_[entry.node]) {
            return Error{ErrorKind::format,
                         fmt::format("/nodes/{}: reached twice, expected nodes to form trees", entry.node)};
        }
        if (entry.depth > maxNodeDepth) {
            return Error{ErrorKind::limit,
                         fmt::format("/nodes/{}: more than {} nodes deep", entry.node, maxNodeDepth)};
        }
        reached_[entry.node] = true;
        stack_.push_back(entry);
        return {};
    }

    Status visit(const Entry& entry) {
        ObjectReader node = reading_.data.item("nodes", entry.node);
        const Matrix world = product(entry.parent, readTransform(node));
        place(node, entry.node, world);
        const Json& children = node.array("children");
        if (const Status status = node.status(); !status) return status;
        for (size_t i = children.size(); i-- > 0;) {
            const Result<size_t> child =
                nodeIndex(children[i], fmt::format("{}/children/{}", node.path(), i));
            if (!child) return child.error();
            if (const Status status = push({*child, entry.depth + 1, world}); !status) return status;
        }
        return {};
    }

    void place(ObjectReader& node, size_t index, const Matrix& world) {
        const std::optional<uint64_t> mesh = node.optionalIndex("mesh", reading_.scene.meshes.size());
        const std::optional<uint64_t> camera =
            node.optionalIndex("camera", reading_.data.list("cameras").size());
        if (!node.status()) return;
        if (mesh) reading_.scene.instances.push_back({static_cast<unsigned>(*mesh), toFloat(world)});
        if (camera) placeCamera(*camera, world);
        if (mesh && extensionOf(nodes_[index], "EXT_mesh_gpu_instancing") != nullptr) {
            reading_.note(node.path() +
                          ": EXT_mesh_gpu_instancing is passed over; its mesh counts as placed once");
        }
    }

    void placeCamera(size_t index, const Matrix& world) {
        ObjectReader camera = reading_.data.item("cameras", index);
        ObjectReader perspective(camera.object("perspective"), camera.pathOf("perspective"));
        const double fov = perspective.number("yfov", 0, 0, 3.15);
        const std::string name = camera.text("name", "");
        if (!camera.status() || !perspective.status() || fov <= 0) {
            reading_.note(camera.path() + ": not a perspective camera, passed over");
            return;
        }
        reading_.scene.cameras.push_back({name, toFloat(world), static_cast<float>(fov)});
    }

    SceneReading& reading_;
    const Json& nodes_;
    std::vector<bool> reached_;
    std::vector<bool> placed_;  // by the scenes before
    std::vector<Entry> stack_;
};

}  // namespace

Status readNodes(SceneReading& reading) {
    const size_t scenes = reading.data.list("scenes").size();
    ObjectReader root(reading.data.json, "");
    const std::optional<uint64_t> chosen = root.optionalIndex("scene", scenes);
    if (const Status status = root.status(); !status) return status;
    NodeWalk walk(reading);
    const size_t first = chosen.value_or(0);
    const size_t end = chosen ? first + 1 : scenes;
    for (size_t i = first; i < end; ++i) {
        if (const Status status = walk.walkScene(i); !status) return status;
    }
    if (scenes == 0 && !reading.scene.meshes.empty())
        reading.note("the file has no scene, so nothing is placed");
    return {};
}

}  // namespace filigree::io
