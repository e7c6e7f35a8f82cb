#include "passes/inject/inject_voxel_rays/hit_faces.h"

namespace voxray {

HitFaces::HitFaces(ProgramOwner& owner)
    : markSurfelFaces_(owner, "mark_surfel_faces.comp"),
      markHitFaces_(owner, "mark_hit_faces.comp"),
      select_(owner, "select_surfels.comp") {}

void HitFaces::plan(PassPlan& plan) {
    plan.buffer(count_, "number of surfels to light", sizeof(uint32_t));
    plan.buffer(selected_, "surfels to light", Surfels::kMaxChunkSurfels * sizeof(gpu::Surfel));
}

void HitFaces::mark(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels, const GBuffer& gbuffer,
                    const GatherHits& hits) {
    const auto clear = [&](Buffer& buffer, const char* name) {
        ensureSize(buffer, context.device, name, uint64_t(voxels.voxelCount) * sizeof(uint32_t));
        context.stream.fill(buffer, 0);
    };
    clear(hitFaces_, "faces to light");
    if (context.changed(voxels) || context.changed(surfels)) {
        clear(facesWithSurfels_, "faces with surfels");
        for (const Surfels::Chunk& chunk : surfels.chunks)
            context.dispatch(
                markSurfelFaces_, chunk.count,
                {{"surfels", chunk.surfels}, {"facesWithSurfels", facesWithSurfels_}, {"count", chunk.count}});
    }
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t rays = hits.batchBlocks(b) * hits.layout.raysPerBlock;
        context.dispatch(markHitFaces_, rays,
                         {context.scene,
                          gbuffer,
                          voxels,
                          {"hits", hits.batches[b]},
                          {"hitFaces", hitFaces_},
                          {"facesWithSurfels", facesWithSurfels_},
                          {"layout", hits.layout},
                          {"firstBlock", b * hits.blocksPerBatch},
                          {"rays", rays}});
    }
}

uint32_t HitFaces::select(PassContext& context, const Surfels::Chunk& chunk) const {
    CommandStream& stream = context.stream;
    stream.fill(count_, 0);
    context.dispatch(select_, chunk.count,
                     {{"surfels", chunk.surfels},
                      {"hitFaces", hitFaces_},
                      {"selected", selected_},
                      {"selectedCount", count_},
                      {"count", chunk.count}});
    return stream.readAs<uint32_t>(count_, 1)[0];
}

}  // namespace voxray
