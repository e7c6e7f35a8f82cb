#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "graph/registry.h"
#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/cache/hit_faces/gather_faces.h"
#include "passes/cache/hit_faces/kept/kept_faces.h"
#include "passes/cache/hit_faces/point_batch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

/// Factor of the probability that a link to a face without light is kept, from round to round: what such faces add is
/// an ever smaller part of the light, and each round takes time whatever its size.
constexpr float kSurvival = 0.5f;

}  // namespace

/// Light of the voxel faces that gather rays hit: rounds of rays find the faces that light comes from, then it is
/// passed along these rays (docs/hit-faces.md). It is new in each frame, or kept and updated within a budget
/// (KeptFaces). Source: Magalhães 2020, section 6.1 (light on demand); Keller et al. 2014 (path space filtering);
/// Neumann 1995 (Monte Carlo radiosity).
class LightHitFaces final : public Pass {
 public:
    static constexpr const char* kName = "light_hit_faces";
    static constexpr const char* kHelp =
        "Lights the voxel faces that gather rays hit, anew in each frame or within a budget. "
        "Each face has up to points_per_face of the rays' hits as its points. Shadow rays measure their direct light, "
        "and a ray from each links it to another face, whose light it reflects. Faces that only these rays hit are lit "
        "likewise, and so on, so that no bounce is lost; then light is passed along the links, a bounce at a time. "
        "gather_rays reads it with `source: hit_faces`. Rays follow the image, not the scene. "
        "With an update_budget light is kept while surfaces stand still, and rays go where they lower the error most. "
        "Biased by: voxel size (a face has one value). Noisy by: points_per_face, light_samples. "
        "Leaves unlit: all that no ray hits. "
        "Source: Magalhães 2020, section 6.1 (light on demand); Keller et al. 2014 (path space filtering).";
    struct Params {
        uint32_t pointsPerFace = 16;
        uint32_t bounces = 8;
        uint32_t lightSamples = 1;
        float updateBudget = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("points_per_face", &Params::pointsPerFace,
                      "Points of a face that gather rays hit, of as many hits; one of other faces.", 1u, 64u)
                    .lessNoise(),
                field("bounces", &Params::bounces, "Bounces of light at the faces; the gather adds one.", 0u, 32u),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u, 256u)
                    .lessNoise(),
                field("update_budget", &Params::updateBudget,
                      "Most rays in a frame to light faces, for each pixel of the image: light is kept from frame to "
                      "frame, and what matters most is updated. 0: no limit, and nothing is kept.",
                      0.0f, 64.0f)};
        }
    };

    explicit LightHitFaces(const Params& params) : params_(params) {
        if (params.updateBudget > 0)
            kept_.emplace(*this, KeptFaces::Params{params.pointsPerFace, params.bounces, params.updateBudget});
    }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// What a round of rays hit first: faces [firstFace, firstFace + faces), with their points.
    struct Round {
        uint32_t firstFace = 0, faces = 0, firstPoint = 0, points = 0, slotsPerFace = 1;
        bool hasLinks = false;
        float survival = 1;  ///< Of links to faces without light, times their albedo.
    };
    /// Marks the faces that gather rays hit. @return the hits.
    std::vector<FaceHits> markGatherHits(PassContext& context);
    /// Lights all faces anew, within no budget.
    void lightAll(PassContext& context, std::vector<FaceHits> hits);
    /// Measures direct light at the points of a round, and links them to others.
    void lightPoints(PassContext& context, const Round& round, uint32_t seed);
    /// Passes light along the links of the first `linked` of all points.
    void passLight(PassContext& context, uint32_t faces, uint32_t points, uint32_t linked);

    const Params params_;
    In<VoxelLevels> voxels_{*this, "voxels", "surface voxels whose faces are lit"};
    In<GBuffer> gbuffer_{*this, "gbuffer", "where the gather rays start"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    Out<HitFaceLight> light_{*this, "hit_face_light", "light that arrives at the faces that rays hit"};
    Kernel placePoints_{*this, "place_points.comp"};
    Kernel linkPoints_{*this, "passes/cache/hit_faces/link_points.comp"};
    Kernel numberLinks_{*this, "number_links.comp"};
    Kernel averageDirect_{*this, "gather_links.comp", {{"DIRECT", "1"}}};
    Kernel gatherLinks_{*this, "gather_links.comp"};
    GatherFaces gatherFaces_{*this, FaceKind::Voxels};
    NewFaces newFaces_{*this, FaceKind::Voxels};
    PointBatch batch_{*this};
    std::optional<KeptFaces> kept_;
    Buffer lost_;                               ///< Rays that hit where no voxel is.
    Buffer roundHits_, roundFaces_;             ///< Of the rays of a round's points.
    Buffer pointDirect_, links_, firstPoints_;  ///< Of all points; of all faces.
    Buffer faceDirect_, faceIrradiance_;        ///< Of all faces; the second after every other bounce.
};

void LightHitFaces::plan(PassPlan& plan) {
    plan[light_].lightBounces = params_.bounces;
    plan[light_].keepsNumbers = kept_.has_value();
    const uint64_t gatherRays = gatherFaces_.plan(plan, plan[hits_]);
    // Points are different hits, so that no round has more of them than there are gather rays
    batch_.plan(plan, requireLightSources(*plan.frame.scene, kName), params_.lightSamples, gatherRays);
    plan.buffer(lost_, "number of lost rays", sizeof(uint32_t));
    const double hitFaces = 2 * plan[voxels_].estimatedCount, rays = double(gatherRays);
    plan.estimate(plan[voxels_].estimatedCount * kFaces * sizeof(uint32_t));
    if (kept_) {
        plan.estimate(hitFaces * (KeptFaces::kBytesPerFace + params_.pointsPerFace * KeptFaces::kBytesPerPoint));
        return;
    }
    const double faces = std::min(rays, hitFaces), points = std::min(rays, params_.pointsPerFace * faces);
    plan.estimate(points * (sizeof(glm::vec4) + sizeof(gpu::FaceLink) + sizeof(Hit)) + faces * 3 * sizeof(glm::vec4));
}

void LightHitFaces::record(PassContext& context) {
    HitFaceLight& light = context[light_];
    context.stream.fill(lost_, 0);
    const uint64_t allFaces = std::max<uint64_t>(uint64_t(context[voxels_].voxelCount) * kFaces, 1);
    newFaces_.begin(context, allFaces);
    if (kept_) {
        if (context.changed(voxels_)) kept_->clear(context, allFaces, light);
        kept_->update(context, {context[voxels_].bindings(), {}}, light, newFaces_, batch_, markGatherHits(context),
                      lost_);
    } else {
        ensureSize(light.numbers, context.device, "numbers of lit faces", allFaces * sizeof(uint32_t));
        context.stream.fill(light.numbers, NO_FACE);
        lightAll(context, markGatherHits(context));
    }
    context.report("rays that hit no voxel", context.stream.readAs<uint32_t>(lost_, 1)[0]);
}

void LightHitFaces::lightAll(PassContext& context, std::vector<FaceHits> hits) {
    HitFaceLight& light = context[light_];
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);

    // Each round lights the faces that no round before it has hit
    uint32_t faces = 0, points = 0, linked = 0;
    float survival = 1;
    for (uint32_t bounce = 0; bounce <= params_.bounces; ++bounce, survival *= kSurvival) {
        Round round{.firstFace = faces, .firstPoint = points};
        round.faces = newFaces_.number(context, light, faces, hits.back().first + hits.back().count);
        if (round.faces == 0) break;
        round.slotsPerFace = bounce == 0 ? params_.pointsPerFace : 1;
        round.hasLinks = bounce < params_.bounces;
        round.survival = survival;
        const uint32_t roundSeed = seed + bounce * 0x9e3779b9u;
        round.points = newFaces_.choose(context, light, hits, faces, round.faces, round.slotsPerFace, roundSeed);
        faces += round.faces;
        points += round.points;
        lightPoints(context, round, roundSeed);
        if (!round.hasLinks) break;
        linked = points;
        hits = {{&roundHits_, &roundFaces_, 0, round.points}};
    }
    passLight(context, faces, points, linked);
    context.report("lit faces", faces);
    context.report("points", points);
}

std::vector<FaceHits> LightHitFaces::markGatherHits(PassContext& context) {
    return gatherFaces_.mark(context, context[hits_], context[gbuffer_], context[voxels_].bindings(), context[light_],
                             newFaces_);
}

void LightHitFaces::lightPoints(PassContext& context, const Round& round, uint32_t seed) {
    CommandStream& stream = context.stream;
    const uint64_t points = uint64_t(round.firstPoint) + round.points, faces = uint64_t(round.firstFace) + round.faces;
    grow(pointDirect_, context, "direct irradiance of points", points * sizeof(glm::vec4),
         round.firstPoint * sizeof(glm::vec4));
    grow(links_, context, "links of points", points * sizeof(gpu::FaceLink), round.firstPoint * sizeof(gpu::FaceLink));
    grow(firstPoints_, context, "first points of faces", (faces + 1) * sizeof(uint32_t),
         round.firstFace * sizeof(uint32_t));
    grow(roundHits_, context, "hits of a round", round.points * sizeof(Hit), 0);
    grow(roundFaces_, context, "faces of a round", round.points * sizeof(uint32_t), 0);
    for (uint32_t first = 0; first < round.points; first += batch_.size) {
        const uint32_t count = std::min(batch_.size, round.points - first);
        context.dispatch(placePoints_, count,
                         {context.scene,
                          newFaces_.points(),
                          {"surfels", batch_.surfels},
                          {"rays", batch_.rays},
                          {"firstPoints", firstPoints_},
                          {"first", first},
                          {"count", count},
                          {"firstPoint", round.firstPoint},
                          {"firstFace", round.firstFace},
                          {"slotsPerFace", round.slotsPerFace},
                          {"seed", seed + 0x51u}});
        batch_.measure(context, count, seed);
        stream.copy(batch_.direct, pointDirect_, count * sizeof(glm::vec4), 0,
                    (uint64_t(round.firstPoint) + first) * sizeof(glm::vec4));
        if (!round.hasLinks) continue;
        context.tracer.closestHit(stream, batch_.rays, batch_.hits, count);
        context.dispatch(linkPoints_, count,
                         {context.scene,
                          context[voxels_],
                          context[light_],
                          newFaces_.marks(),
                          {"rays", batch_.rays},
                          {"hits", batch_.hits},
                          {"roundHits", roundHits_},
                          {"hitFaces", roundFaces_},
                          {"links", links_},
                          {"lost", lost_},
                          {"first", first},
                          {"count", count},
                          {"firstPoint", round.firstPoint},
                          {"seed", seed + 0xa3u},
                          {"survival", round.survival}});
    }
}

void LightHitFaces::passLight(PassContext& context, uint32_t faces, uint32_t points, uint32_t linked) {
    HitFaceLight& light = context[light_];
    const uint64_t bytes = std::max<uint64_t>(faces, 1) * sizeof(glm::vec4);
    for (Buffer* buffer : {&faceDirect_, &faceIrradiance_, &light.irradiance})
        grow(*buffer, context, "irradiance of lit faces", bytes, 0);
    if (faces == 0) return;
    context.stream.upload(firstPoints_, std::as_bytes(std::span(&points, 1)), uint64_t(faces) * sizeof(uint32_t));
    context.dispatch(numberLinks_, linked, {light, {"links", links_}, {"count", linked}});
    context.dispatch(
        averageDirect_, faces,
        {{"firstPoints", firstPoints_}, {"pointDirect", pointDirect_}, {"irradiance", faceDirect_}, {"faces", faces}});
    const Buffer* previous = &faceDirect_;
    for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
        const Buffer& next = (params_.bounces - bounce) % 2 == 1 ? light.irradiance : faceIrradiance_;
        context.dispatch(gatherLinks_, faces,
                         {{"firstPoints", firstPoints_},
                          {"links", links_},
                          {"direct", faceDirect_},
                          {"previous", *previous},
                          {"irradiance", next},
                          {"faces", faces},
                          {"linked", linked}});
        previous = &next;
    }
    if (params_.bounces == 0) context.stream.copy(faceDirect_, light.irradiance, bytes);
}

VOXRAY_REGISTER_PASS(LightHitFaces);

}  // namespace voxray
