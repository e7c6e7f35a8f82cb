#include <array>
#include <cstring>

#include "base/error.h"
#include "passes/cones/filter_voxels/full_grids.h"
#include "passes/cones/radiance/radiance_types.h"

namespace voxray {
namespace {

constexpr uint32_t kValueBytes = 8;  // Four half floats.

/// The buffer `radianceVoxels` of passes/cones/radiance/radiance_dense.glsl.
struct DenseHeader {
    gpu::RadianceGrid grid;
    uint64_t values;
    std::array<gpu::DenseLevel, RADIANCE_DENSE_LEVELS> levels;
};
static_assert(sizeof(gpu::RadianceGrid) % 8 == 0);

uint64_t pyramidVoxels(const gpu::RadianceGrid& grid) {
    uint64_t voxels = 0;
    for (uint32_t level = 0; level < grid.levels; ++level) voxels += levelVoxels(grid.resolution, level);
    return voxels;
}

class DenseStorage final : public FullGrids {
 public:
    using FullGrids::FullGrids;

    void plan(PassPlan& plan, const SurfaceVoxels&, RadianceVoxels& radiance) override {
        const gpu::RadianceGrid& grid = radiance.grid;
        const uint64_t values = pyramidVoxels(grid) * grid.directions;
        if (values > UINT32_MAX)
            throw Error(
                "filter_voxels: {} values of {}x{}x{} voxels and their levels can't be numbered in 32 bits; "
                "lower voxelize's 'resolution'",
                values, grid.resolution.x, grid.resolution.y, grid.resolution.z);
        radiance.storage = std::vector<Buffer>(1);
        plan.buffer(radiance.storage[0], "radiance voxels", values * kValueBytes);
        plan.buffer(radiance.header, "radiance voxels' header", sizeof(DenseHeader));
        define(radiance);
    }

    void prepare(PassSetup& setup, RadianceVoxels& radiance) override {
        const gpu::RadianceGrid& grid = radiance.grid;
        DenseHeader header{grid, radiance.storage[0].address(), {}};
        uint32_t first = 0;
        for (uint32_t level = 0; level < grid.levels; ++level) {
            header.levels[level] = {levelResolution(grid.resolution, level), first};
            first += uint32_t(levelVoxels(grid.resolution, level));
        }
        setup.stream.upload(radiance.header, std::as_bytes(std::span(&header, 1)));
    }
};

}  // namespace

std::unique_ptr<RadianceStorage> makeDenseStorage(ProgramOwner& owner) {
    return std::make_unique<DenseStorage>(owner);
}

}  // namespace voxray
