#include "passes/gather_clusters/gather_clusters.h"

#include <utility>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct FilterPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    int32_t radius;
};

struct StorePush {
    uint32_t pairs;
    float voxelFaceArea;
};

}  // namespace

void GatherClusters::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    injected_ = builder.read<VoxelIrradiance>("irradiance", "light that was injected");
    clusters_ = builder.read<VoxelClusters>("clusters", "surface voxels in groups");
    visibility_ = builder.read<ClusterVisibility>("cluster_visibility", "which clusters each face sees");
    light_ = builder.read<ClusterLight>("cluster_light", "what clusters send");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "injected direct light, gathered indirect");
}

void GatherClusters::plan(PassPlan& plan) {
    const uint32_t voxels = plan.get(voxels_).voxelCount;
    plan.get(irradiance_).lightBounces = oneMore(plan.get(light_).lightBounces);
    plan.reserve("irradiance of voxels (estimated)", VoxelIrradiance::bytes(voxels));
    plan.reserveScratch("irradiance of faces (estimated)", 2 * ClusterGather::bytes(voxels));
}

void GatherClusters::prepare(PassSetup& setup) {
    version_.reset();
    gather_ = ClusterGather(setup.device, setup.compiler);
    filter_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_clusters/filter.comp"));
    store_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_clusters/store.comp"));
}

void GatherClusters::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& injected = context.get(injected_);
    const ClusterVisibility& visibility = context.get(visibility_);
    const ClusterLight& light = context.get(light_);
    const std::tuple version{visibility.version, light.version, injected.version};
    if (version_ == version) return;
    version_ = version;

    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    LargeBuffer faces(context.device, "irradiance of faces", ClusterGather::bytes(count));
    LargeBuffer filtered(context.device, "filtered irradiance", ClusterGather::bytes(count));
    stream.fill(faces, 0);
    gather_.gather(stream, visibility, light, faces);
    for (uint32_t i = 0; i < params_.filterPasses; ++i) {
        stream.dispatch(filter_,
                        voxels.bindings({{"coordinates", context.get(clusters_).coordinates},
                                         {"FacesAt", faces.at()},
                                         {"FilteredAt", filtered.at()}}),
                        FilterPush{voxels.grid, count, int32_t(params_.filterSize / 2)}, linearGroups(count));
        stream.finish();
        std::swap(faces, filtered);
    }

    VoxelIrradiance& result = context.get(irradiance_);
    result.allocate(context.device, count);
    stream.copy(injected.direct, result.direct, injected.direct.bytes());
    stream.dispatch(store_,
                    {{"VoxelMaterialsAt", voxels.materials.at()},
                     {"FacesAt", faces.at()},
                     {"FluxAt", result.indirect.at()},
                     {"area", result.area}},
                    StorePush{3 * count, voxels.grid.voxelSize * voxels.grid.voxelSize},
                    linearGroups(3 * count));
    stream.finish();
}

}  // namespace voxray
