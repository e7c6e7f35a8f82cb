#include <algorithm>
#include <cmath>

#include "passes/common/dispatch.h"
#include "passes/voxelize/voxelize_method.h"

namespace voxray {
namespace {

constexpr int kTileSide = 8;  // Columns, as in exact.comp.

struct Push {
    gpu::VoxelGrid grid;
    uint32_t tileCount;
    float emissionScale;
};

/// Calls visit(triangle, packed tile) for the 8x8 tiles of columns that each triangle's bounds meet, seen
/// along the axis that it faces most, so that no thread walks all of a large triangle.
template <typename Visit>
void forEachTile(const Geometry& geometry, const gpu::VoxelGrid& grid, const Visit& visit) {
    const auto toGrid = [&](uint32_t vertex) {
        return (geometry.positions[vertex] - grid.origin) / grid.voxelSize;
    };
    constexpr float kSpare = 1.0f / 256;  // More than the margin of grid_triangle.glsl.
    for (uint32_t t = 0; t < geometry.triangles.size(); ++t) {
        const glm::uvec3 v = geometry.triangles[t];
        const glm::vec3 a = toGrid(v.x), b = toGrid(v.y), c = toGrid(v.z);
        const glm::vec3 n = glm::abs(glm::cross(b - a, c - a));
        const uint32_t axis = n.x > n.y ? (n.x > n.z ? 0u : 2u) : (n.y > n.z ? 1u : 2u);
        const glm::vec3 low = glm::min(a, glm::min(b, c)) - kSpare,
                        high = glm::max(a, glm::max(b, c)) + kSpare;
        int first[2], last[2];
        for (int k = 0; k < 2; ++k) {
            const int along = (int(axis) + 1 + k) % 3, end = int(grid.resolution[along]) - 1;
            first[k] = std::clamp(int(std::floor(low[along])), 0, end);
            last[k] = std::clamp(int(std::floor(high[along])), 0, end);
        }
        for (int y = first[1]; y <= last[1]; y += kTileSide)
            for (int x = first[0]; x <= last[0]; x += kTileSide)
                visit(t, uint32_t(x) | uint32_t(y) << 10 | axis << 20);
    }
}

/// Triangle-box overlap by separating axes. A thread takes one tile of a triangle and walks its columns. What
/// a voxel holds of a triangle is the triangle clipped to the voxel. Sources: Schwarz and Seidel 2010,
/// section 4 (overlap); Sutherland and Hodgman 1974 (clipping).
class Exact final : public VoxelizeMethod {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels& voxels) override {
        uint64_t tiles = 0;
        forEachTile(plan.frame.scene->geometry, voxels.grid, [&](uint32_t, uint32_t) { ++tiles; });
        plan.reserve("tiles of triangles", tiles * sizeof(glm::uvec2));
    }

    void prepare(PassSetup& setup) override {
        for (const bool mark : {false, true})
            (mark ? mark_ : add_) = makeComputeProgram(
                setup.device, setup.compiler.compile("passes/voxelize/exact.comp", stepDefines(mark)));
    }

    void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) override {
        if (step.mark) {
            std::vector<glm::uvec2> tiles;
            forEachTile(context.frame.scene->geometry, voxels.grid, [&](uint32_t triangle, uint32_t tile) {
                tiles.push_back({triangle, tile});
            });
            tileCount_ = uint32_t(tiles.size());
            tiles_ = Buffer(context.device, "tiles of triangles", tiles.size() * sizeof(tiles[0]));
            context.stream.upload(tiles_, tiles);
        }
        context.stream.dispatch(step.mark ? mark_ : add_,
                                stepBindings(context, voxels, step, {{"tiles", tiles_}}),
                                Push{voxels.grid, tileCount_, step.emissionScale}, linearGroups(tileCount_));
    }

 private:
    Program mark_, add_;
    Buffer tiles_;
    uint32_t tileCount_ = 0;
};

}  // namespace

std::unique_ptr<VoxelizeMethod> makeExact() {
    return std::make_unique<Exact>();
}

}  // namespace voxray
