#include "passes/cluster_voxels/cluster_voxels.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct ListVoxelsPush {
    gpu::VoxelGrid grid;
    uint32_t words;
};

}  // namespace

void ClusterVoxels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    clusters_ = builder.write<VoxelClusters>("clusters", "surface voxels in groups");
}

void ClusterVoxels::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    plan.get(clusters_).maxCount = voxels.voxelCount;
    plan.reserve("clusters (at most)", VoxelClusters::bytes(voxels.voxelCount, voxels.voxelCount));
    plan.reserve("sorting of voxels (estimated)", RadixSort::scratchBytes(voxels.voxelCount));
    const uint64_t seeds = growth_.seeds(voxels);
    plan.reserveScratch("growth of clusters (estimated)",
                        growth_.scratchBytes(voxels) + ClusterList::scratchBytes(voxels.voxelCount, seeds));
    if (params_.asksFragments()) fragments_.plan(plan, voxels);
}

void ClusterVoxels::prepare(PassSetup& setup) {
    version_.reset();
    growth_.prepare(setup.device, setup.compiler);
    if (params_.asksFragments()) fragments_.prepare(setup);
    list_.prepare(setup.device, setup.compiler);
    coordinates_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/common/voxels/list_voxels.comp"));
}

void ClusterVoxels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelClusters& clusters = context.get(clusters_);
    if (version_ == voxels.version) return;
    version_ = voxels.version;
    CommandStream& stream = context.stream;
    clusters.clusters = {}, clusters.ofVoxel = {}, clusters.members = {}, clusters.coordinates = {};
    clusters.coordinates =
        Buffer(context.device, "coordinates of voxels", voxels.voxelCount * sizeof(glm::uvec3));
    stream.dispatch(coordinates_, voxels.bindings({{"voxelCoordinates", clusters.coordinates}}),
                    ListVoxelsPush{voxels.grid, uint32_t(voxels.words())}, linearGroups(voxels.words()));
    FragmentAngles::Sums fragments;
    if (params_.asksFragments()) fragments = fragments_.measure(context, voxels);
    const ClusterGrowth::Result growth = growth_.grow(stream, voxels, clusters.coordinates, fragments);
    list_.make(stream, voxels, growth, clusters);
    clusters.version = voxels.version;
    context.report("clusters", clusters.count);
    context.report("clusters, % of voxels", 100.0 * clusters.count / voxels.voxelCount);
    context.report("voxels no seed reached, %", 100.0 * growth.unassigned / voxels.voxelCount);
    if (params_.normals == ClusterNormals::Area) return;
    const ClusterGrowth::OpenSpaceCounts& open = growth.openSpace;
    context.report("voxels whose surfaces disagree, %", 100.0 * open.disagreeing / voxels.voxelCount);
    context.report("voxels whose open ways tie, %", 100.0 * open.tied / voxels.voxelCount);
    context.report("voxels that fragments decide otherwise, %", 100.0 * open.decided / voxels.voxelCount);
    context.report("voxels with another normal than by area, %", 100.0 * open.changed / voxels.voxelCount);
}

}  // namespace voxray
