#include "passes/inject_clusters/inject_clusters.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct ReflectPush {
    uint32_t faces;
    float voxelFaceArea;
    uint32_t hasBounced;
};

}  // namespace

void InjectClusters::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    clusters_ = builder.read<VoxelClusters>("clusters", "surface voxels in groups");
    visibility_ = builder.read<ClusterVisibility>("cluster_visibility", "which clusters each face sees");
    light_ = builder.write<ClusterLight>("cluster_light", "what clusters send");
}

void InjectClusters::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    const std::optional<uint32_t> injected = plan.get(irradiance_).lightBounces;
    if (injected) plan.get(light_).lightBounces = *injected + params_.bounces;
    const uint64_t faces = ClusterGather::bytes(voxels.voxelCount);
    plan.reserve("light of clusters (at most)", ClusterGather::bytes(plan.get(clusters_).maxCount));
    plan.reserve("light of voxels (estimated)", faces);
    if (params_.bounces > 0) plan.reserveScratch("bounced light (estimated)", faces);
}

void InjectClusters::prepare(PassSetup& setup) {
    version_.reset();
    gather_ = ClusterGather(setup.device, setup.compiler);
    reflectVoxels_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_clusters/reflect.comp"));
    sumClusters_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_clusters/sum.comp"));
}

void InjectClusters::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const ClusterVisibility& visibility = context.get(visibility_);
    const std::tuple version{voxels.version, visibility.version, context.get(irradiance_).version};
    if (version_ == version) return;
    version_ = version;
    ClusterLight& light = context.get(light_);
    ++light.version;
    const auto make = [&](auto& buffer, const char* name, uint64_t count) {
        const uint64_t bytes = ClusterGather::bytes(count);
        if (buffer && buffer.bytes() == bytes) return;
        buffer = {};
        buffer = std::remove_reference_t<decltype(buffer)>(context.device, name, bytes);
    };
    make(light.clusters, "radiosity of clusters", context.get(clusters_).count);
    make(light.voxels, "radiosity of voxels", voxels.voxelCount);
    if (params_.bounces > 0) {
        make(bounced_, "bounced light", voxels.voxelCount);
        context.stream.fill(bounced_, 0);
    }
    reflect(context, false);
    for (uint32_t i = 0; i < params_.bounces; ++i) {
        gather_.gather(context.stream, visibility, light, bounced_);
        reflect(context, true);
        context.stream.finish();
    }
    context.stream.finish();
    bounced_ = {};
}

void InjectClusters::reflect(PassContext& context, bool hasBounced) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelClusters& clusters = context.get(clusters_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    ClusterLight& light = context.get(light_);
    const uint32_t faces = kFaces * voxels.voxelCount;
    context.stream.dispatch(
        reflectVoxels_,
        {{"VoxelMaterialsAt", voxels.materials.at()},
         {"DirectAt", irradiance.direct.at()},
         {"IndirectAt", irradiance.indirect.at()},
         {"area", irradiance.area},
         {"BouncedAt", hasBounced ? bounced_.at() : light.voxels.at()},
         {"RadiosityAt", light.voxels.at()}},
        ReflectPush{faces, voxels.grid.voxelSize * voxels.grid.voxelSize, hasBounced ? 1u : 0u},
        linearGroups(faces));
    context.stream.dispatch(sumClusters_,
                            {{"VoxelMaterialsAt", voxels.materials.at()},
                             {"clusters", clusters.clusters},
                             {"members", clusters.members},
                             {"RadiosityAt", light.voxels.at()},
                             {"sent", light.clusters}},
                            clusters.count, linearGroups(clusters.count));
}

}  // namespace voxray
