#include "passes/compare_voxels/compare_voxels.h"

#include <bit>

#include "base/error.h"

namespace voxray {
namespace {

std::vector<uint32_t> occupancyOf(CommandStream& stream, const SurfaceVoxels& voxels) {
    return stream.readAs<uint32_t>(voxels.occupancy, voxels.words());
}

/// In units of a voxel's face.
double areaOf(CommandStream& stream, const SurfaceVoxels& voxels) {
    double area = 0;
    for (const gpu::PackedVoxelMaterial& packed :
         stream.readAs<gpu::PackedVoxelMaterial>(voxels.materials, voxels.voxelCount))
        area += gpu::unpackMaterial(packed).area;
    return area;
}

}  // namespace

void CompareVoxels::declare(PassBuilder& builder) {
    truth_ = builder.read<SurfaceVoxels>("truth", "the voxels that there should be");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "the voxels to compare");
}

void CompareVoxels::plan(PassPlan& plan) {
    const glm::uvec3 a = plan.get(truth_).grid.resolution, b = plan.get(voxels_).grid.resolution;
    if (a != b)
        throw Error(
            "compare_voxels: 'truth' has {}x{}x{} voxels, 'voxels' {}x{}x{}; give both the same "
            "'resolution'",
            a.x, a.y, a.z, b.x, b.y, b.z);
}

void CompareVoxels::record(PassContext& context) {
    const SurfaceVoxels& truth = context.get(truth_);
    const SurfaceVoxels& voxels = context.get(voxels_);
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

}  // namespace voxray
