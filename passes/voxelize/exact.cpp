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

/// Calls visit(triangle, packed tile) for the 8x8 tiles of columns that a triangle's bounds meet, seen along
/// the axis that it faces most, so that no thread walks all of a large triangle; only tiles that may reach
/// into the region.
template <typename Visit>
void forEachTile(const Geometry& geometry, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                 uint32_t triangle, const Visit& visit) {
    const auto corner = [&](int k) {
        return (geometry.positions[geometry.triangles[triangle][k]] - grid.origin) / grid.voxelSize;
    };
    const glm::vec3 n = glm::abs(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const int axis = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    const GridBounds bounds(geometry, grid, triangle);
    const auto column = [&](float at, int along) {
        return std::clamp(int(std::floor(at)), 0, int(grid.resolution[along]) - 1);
    };
    for (int y = column(bounds.low[w], w); y <= column(bounds.high[w], w); y += kTileSide)
        for (int x = column(bounds.low[u], u); x <= column(bounds.high[u], u); x += kTileSide) {
            glm::vec3 low = bounds.low, high = bounds.high;
            low[u] = float(x), high[u] = float(x + kTileSide);
            low[w] = float(y), high[w] = float(y + kTileSide);
            if (region.meets(low, high))
                visit(triangle, uint32_t(x) | uint32_t(y) << 10 | uint32_t(axis) << 20);
        }
}

/// Triangle-box overlap by separating axes. A thread takes one tile of a triangle and walks its columns. What
/// a voxel holds of a triangle is the triangle clipped to the voxel. Sources: Schwarz and Seidel 2010,
/// section 4 (overlap); Sutherland and Hodgman 1974 (clipping).
class Exact final : public VoxelizeMethod {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels& voxels) override {
        uint64_t tiles = 0;
        const Geometry& geometry = plan.frame.scene->geometry;
        const VoxelRegion everywhere(voxels.grid);
        for (uint32_t t = 0; t < geometry.triangles.size(); ++t)
            forEachTile(geometry, voxels.grid, everywhere, t, [&](uint32_t, uint32_t) { ++tiles; });
        plan.reserveScratch("tiles of triangles", tiles * sizeof(glm::uvec2));
    }

    void prepare(PassSetup& setup) override {
        for (const bool mark : {false, true})
            (mark ? mark_ : add_) = makeComputeProgram(
                setup.device, setup.compiler.compile("passes/voxelize/exact.comp", stepDefines(mark)));
    }

    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override {
        std::vector<glm::uvec2> tiles;
        for (const uint32_t t : triangles)
            forEachTile(context.frame.scene->geometry, grid, region, t,
                        [&](uint32_t triangle, uint32_t tile) {
                            tiles.push_back({triangle, tile});
                        });
        tileCount_ = uint32_t(tiles.size());
        tiles_ = Buffer(context.device, "tiles of triangles",
                        std::max<size_t>(tiles.size(), 1) * sizeof(tiles[0]));
        if (!tiles.empty()) context.stream.upload(tiles_, tiles);
    }

    void release() override { tiles_ = {}; }

    void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) override {
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
