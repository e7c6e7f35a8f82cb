#include "passes/cache/hit_faces/gather_faces.h"

namespace voxray {

uint64_t GatherFaces::plan(PassPlan& plan, const GatherHits& hits) {
    faces_ = std::vector<Buffer>(hits.batches.size());
    uint64_t all = 0;
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint64_t rays = uint64_t(hits.batchBlocks(b)) * hits.layout.raysPerBlock;
        plan.buffer(faces_[b], "faces that gather rays hit", rays * sizeof(uint32_t));
        all += rays;
    }
    return all;
}

std::vector<FaceHits> GatherFaces::mark(PassContext& context, const GatherHits& hits, const GBuffer& gbuffer,
                                        const std::vector<Binding>& store, const HitFaceLight& light,
                                        const NewFaces& newFaces) {
    std::vector<FaceHits> all;
    uint32_t first = 0;
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t rays = hits.batchBlocks(b) * hits.layout.raysPerBlock;
        context.dispatch(mark_, rays,
                         {context.scene,
                          store,
                          gbuffer,
                          light,
                          newFaces.marks(),
                          {"hits", hits.batches[b]},
                          {"hitFaces", faces_[b]},
                          {"layout", hits.layout},
                          {"firstBlock", b * hits.blocksPerBatch},
                          {"rays", rays}});
        all.push_back({&hits.batches[b], &faces_[b], first, rays});
        first += rays;
    }
    return all;
}

}  // namespace voxray
