#include "passes/gather_clusters/gather_clusters.h"

#include <algorithm>
#include <utility>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct StorePush {
    uint32_t pairs;
    float voxelFaceArea;
};

}  // namespace

void GatherClusters::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    patches_ = builder.read<VoxelPatches>("patches", "surfaces by the open space that they look into");
    clusters_ = builder.read<VoxelClusters>("clusters", "surface voxels in groups");
    visibility_ = builder.read<ClusterVisibility>("cluster_visibility", "which clusters each patch sees");
    light_ = builder.read<ClusterLight>("cluster_light", "what clusters send");
    irradiance_ =
        builder.write<VoxelIrradiance>("irradiance", "direct light, and indirect light that was gathered");
}

void GatherClusters::plan(PassPlan& plan) {
    const uint32_t voxels = plan.get(voxels_).voxelCount;
    plan.get(irradiance_).lightBounces = oneMore(plan.get(light_).lightBounces);
    plan.reserve("irradiance of voxels (estimated)", VoxelIrradiance::bytes(voxels));
    plan.reserveScratch("irradiance of faces (estimated)", 2 * ClusterGather::bytes(kSidesPerVoxel * voxels));
}

void GatherClusters::prepare(PassSetup& setup) {
    version_.reset();
    gather_ = ClusterGather(setup.device, setup.compiler);
    filter_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_clusters/filter.comp"));
    store_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_clusters/store.comp"));
}

void GatherClusters::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    const ClusterVisibility& visibility = context.get(visibility_);
    const ClusterLight& light = context.get(light_);
    const std::pair version{visibility.version, light.version};
    if (version_ == version) return;
    version_ = version;

    CommandStream& stream = context.stream;
    const uint32_t sides = patches.sideCount;
    const uint64_t bytes = ClusterGather::bytes(std::max(sides, 1u));
    LargeBuffer faces(context.device, "irradiance of faces", bytes);
    LargeBuffer filtered(context.device, "filtered irradiance", bytes);
    stream.fill(faces, 0);
    gather_.gather(stream, visibility, light, faces);
    // Binomial weights of 5 voxels are those of 3, twice.
    const uint32_t steps = params_.filterPasses * (params_.filterSize / 2);
    for (uint32_t i = 0; i < steps; ++i) {
        stream.dispatch(filter_,
                        {{"sides", patches.sides},
                         {"coordinates", context.get(clusters_).coordinates},
                         {"firstNeighbour", patches.firstNeighbour},
                         {"NeighboursAt", patches.neighbours.at()},
                         {"VoxelMaterialsAt", patches.materials.at()},
                         {"FacesAt", faces.at()},
                         {"FilteredAt", filtered.at()}},
                        sides, linearGroups(sides));
        stream.finish();
        std::swap(faces, filtered);
    }

    VoxelIrradiance& result = context.get(irradiance_);
    result.allocate(context.device, voxels.voxelCount);
    stream.dispatch(store_,
                    {{"sides", patches.sides},
                     {"firstSide", patches.firstSide},
                     {"VoxelMaterialsAt", patches.materials.at()},
                     {"FacesAt", faces.at()},
                     {"SidesDirectAt", light.direct.at()},
                     {"DirectAt", result.direct.at()},
                     {"IndirectAt", result.indirect.at()},
                     {"area", result.area}},
                    StorePush{3 * voxels.voxelCount, voxels.grid.voxelSize * voxels.grid.voxelSize},
                    linearGroups(3 * voxels.voxelCount));
    stream.finish();
    requireLight(stream, voxels, result);
}

}  // namespace voxray
