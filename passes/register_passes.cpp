#include "passes/register_passes.h"

#include "passes/accumulate/accumulate.h"
#include "passes/build_hybrid_leaves/build_hybrid_leaves.h"
#include "passes/cluster_visibility/cluster_visibility.h"
#include "passes/cluster_voxels/cluster_voxels.h"
#include "passes/compare_voxels/compare_voxels.h"
#include "passes/composite/composite.h"
#include "passes/direct_packed_voxels/direct_packed_voxels.h"
#include "passes/direct_shadow_maps/direct_shadow_maps.h"
#include "passes/direct_shadow_rays/direct_shadow_rays.h"
#include "passes/direct_voxels/direct_voxels.h"
#include "passes/filter_irradiance/filter_irradiance.h"
#include "passes/filter_voxels/filter_voxels.h"
#include "passes/find_patches/find_patches.h"
#include "passes/gather_cached_rays/gather_cached_rays.h"
#include "passes/gather_clusters/gather_clusters.h"
#include "passes/gather_cones/gather_cones.h"
#include "passes/gather_irradiance/gather_irradiance.h"
#include "passes/gather_merged_rays/gather_merged_rays.h"
#include "passes/gather_mirror/gather_mirror.h"
#include "passes/gather_rays/gather_rays.h"
#include "passes/gather_stepped_cones/gather_stepped_cones.h"
#include "passes/gather_surfels/gather_surfels.h"
#include "passes/gather_vpls/gather_vpls.h"
#include "passes/gbuffer/gbuffer_pass.h"
#include "passes/inject_camera_rays/inject_camera_rays.h"
#include "passes/inject_clusters/inject_clusters.h"
#include "passes/inject_gather_hits/inject_gather_hits.h"
#include "passes/inject_light_rays/inject_light_rays.h"
#include "passes/inject_packed_light_rays/inject_packed_light_rays.h"
#include "passes/inject_radiosity/inject_radiosity.h"
#include "passes/inject_rsm/inject_rsm.h"
#include "passes/inject_shadow_map/inject_shadow_map.h"
#include "passes/inject_voxel_rays/inject_voxel_rays.h"
#include "passes/light_clipmap/light_clipmap.h"
#include "passes/light_octree/light_octree.h"
#include "passes/link_surfels/link_surfels.h"
#include "passes/merge_voxels/merge_voxels.h"
#include "passes/path_trace/path_trace_pass.h"
#include "passes/path_trace/path_tracer.h"
#include "passes/place_surfels/place_surfels.h"
#include "passes/probe_irradiance/probe_irradiance.h"
#include "passes/render_rsm/render_rsm.h"
#include "passes/sample_vpls/sample_vpls.h"
#include "passes/select_vpls/select_vpls.h"
#include "passes/show_voxels/show_voxels.h"
#include "passes/smooth_surfels/smooth_surfels.h"
#include "passes/trace_gather_rays/trace_gather_rays.h"
#include "passes/update_radiance_cache/update_radiance_cache.h"
#include "passes/voxelize/voxelize_pass.h"
#include "passes/voxelize_clipmap/voxelize_clipmap.h"
#include "passes/voxelize_octree/voxelize_octree.h"
#include "passes/voxelize_packed/voxelize_packed.h"

namespace voxray {

void registerPasses(Registry& registry) {
    registry.add<GBufferPass>();
    registry.add<VoxelizePass>();
    registry.add<CompareVoxels>();
    registry.add<Accumulate>();
    registry.add<BuildHybridLeaves>();
    registry.add<InjectLightRays>();
    registry.add<PlaceSurfels>();
    registry.add<InjectVoxelRays>();
    registry.add<LightOctree>();
    registry.add<LinkSurfels>();
    registry.add<InjectRadiosity>();
    registry.add<SmoothSurfels>();
    registry.add<InjectGatherHits>();
    registry.add<InjectCameraRays>();
    registry.add<InjectRsm>();
    registry.add<InjectShadowMap>();
    registry.add<FilterVoxels>();
    registry.add<VoxelizeClipmap>();
    registry.add<LightClipmap>();
    registry.add<GatherCones>();
    registry.add<ProbeIrradiance>();
    registry.add<GatherIrradiance>();
    registry.add<GatherSurfels>();
    registry.add<ShowVoxels>();
    registry.add<TraceGatherRays>();
    registry.add<GatherRays>();
    registry.add<MergeVoxels>();
    registry.add<GatherMergedRays>();
    registry.add<ClusterVoxels>();
    registry.add<FindPatches>();
    registry.add<FindClusterVisibility>();
    registry.add<InjectClusters>();
    registry.add<GatherClusters>();
    registry.add<UpdateRadianceCache>();
    registry.add<GatherCachedRays>();
    registry.add<RenderRsm>();
    registry.add<SampleVpls>();
    registry.add<SelectVpls>();
    registry.add<GatherVpls>();
    registry.add<GatherMirror>();
    registry.add<FilterIrradiance>();
    registry.add<DirectShadowRays>();
    registry.add<DirectShadowMaps>();
    registry.add<DirectVoxels>();
    registry.add<Composite>();
    registry.add<PathTracePass>();
    // As published, for comparison: last, for messages name passes in this order.
    registry.add<VoxelizeOctree>();
    registry.add<VoxelizePacked>();
    registry.add<InjectPackedLightRays>();
    registry.add<DirectPackedVoxels>();
    registry.add<GatherSteppedCones>();
    registry.preview = [](const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                          uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces) {
        const PathTraceOptions options{
            .width = width, .height = height, .spp = spp, .bounces = bounces, .rays = RaysToCome::Few};
        return pathTrace(state, tracer, camera, options).total;
    };
}

}  // namespace voxray
