#include <bit>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

std::vector<uint32_t> occupancyOf(CommandStream& stream, const SurfaceVoxels& voxels) {
    return stream.readAs<uint32_t>(voxels.occupancy, voxels.words());
}

/// Surface area in units of a voxel's face.
double areaOf(CommandStream& stream, const SurfaceVoxels& voxels) {
    double area = 0;
    for (const gpu::PackedVoxelMaterial& packed :
         stream.readAs<gpu::PackedVoxelMaterial>(voxels.materials, voxels.voxelCount))
        area += gpu::unpackMaterial(packed).area;
    return area;
}

}  // namespace

/// Counts the voxels that a voxelization misses, or adds, relative to another.
class CompareVoxels final : public Pass {
 public:
    static constexpr const char* kName = "compare_voxels";
    static constexpr const char* kHelp =
        "Compares two voxelizations: missed and added voxels, and surface area. "
        "Counts the voxels of 'truth' that 'voxels' misses, and those that it adds, and compares surface areas. "
        "Results are in values.csv and the report; there are no outputs. Exact. "
        "Both inputs need the same 'resolution'. "
        "Source: Schwarz and Seidel 2010, section 4, for 'method: exact' as the truth.";

    void plan(PassPlan& plan) override {
        const glm::uvec3 a = plan[truth_].grid.resolution, b = plan[voxels_].grid.resolution;
        if (a != b)
            throw Error(
                "compare_voxels: 'truth' has {}x{}x{} voxels, 'voxels' {}x{}x{}; give both the same 'resolution'", a.x,
                a.y, a.z, b.x, b.y, b.z);
    }
    void record(PassContext& context) override {
        const SurfaceVoxels& truth = context[truth_];
        const SurfaceVoxels& voxels = context[voxels_];
        const std::vector<uint32_t> expected = occupancyOf(context.stream, truth);
        const std::vector<uint32_t> found = occupancyOf(context.stream, voxels);
        uint64_t missed = 0, added = 0;
        for (size_t i = 0; i < expected.size(); ++i) {
            missed += uint64_t(std::popcount(expected[i] & ~found[i]));
            added += uint64_t(std::popcount(found[i] & ~expected[i]));
        }
        context.report("voxels", truth.voxelCount);
        context.report("missed", double(missed));
        context.report("added", double(added));
        context.report("area ratio", areaOf(context.stream, voxels) / areaOf(context.stream, truth));
    }

 private:
    In<SurfaceVoxels> truth_{*this, "truth", "the reference voxels"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "the voxels to compare"};
};
VOXRAY_REGISTER_PASS(CompareVoxels);

}  // namespace voxray
