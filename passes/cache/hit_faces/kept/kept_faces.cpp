#include "passes/cache/hit_faces/kept/kept_faces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {

KeptFaces::KeptFaces(ProgramOwner& owner, const Params& params)
    : params_(params),
      clearPoints_(owner, "clear_points.comp"),
      offerPoints_(owner, "offer_points.comp"),
      countReads_(owner, "count_reads.comp"),
      passImportance_(owner, "pass_importance.comp"),
      placeOld_(owner, "place_kept_points.comp", definesOf(params.kind)),
      placeNew_(owner, "place_kept_points.comp", definesOf(params.kind, {{"NEW", "1"}})),
      storeOthers_(owner, "store_light.comp"),
      storeOwn_(owner, "store_light.comp", {{"OWN", "1"}}),
      storeLinks_(owner, "store_links.comp"),
      linkPoints_(owner, "passes/cache/hit_faces/link_points.comp", definesOf(params.kind, {{"KEEP_ALL", "1"}})),
      gatherDirect_(owner, "gather_kept_links.comp", {{"DIRECT", "1"}}),
      gatherLinks_(owner, "gather_kept_links.comp"),
      lights_(owner),
      selection_(owner) {}

void KeptFaces::clear(PassContext& context, uint64_t allFaces, HitFaceLight& light) {
    ensureSize(light.numbers, context.device, "numbers of lit faces",
               std::max<uint64_t>(allFaces, 1) * sizeof(uint32_t));
    context.stream.fill(light.numbers, NO_FACE);
    ++light.generation;
    lights_.clear(context);
    faces_ = 0;
}

void KeptFaces::update(PassContext& context, const Store& store, HitFaceLight& light, NewFaces& newFaces,
                       const PointBatch& batch, const std::vector<FaceHits>& hits, const Buffer& lost) {
    Update update{context, store, light, newFaces, batch, lost, randomSeed(context.frame, context.frameIndex), {}};
    ++frame_;
    lights_.agePoints(context, batch, faces_, params_.pointsPerFace,
                      {{"pointPlaces", pointPlaces_}, {"hiddenLights", hiddenLights_}, {"pointDirect", pointDirect_}});
    update.lights = lights_.toMeasure(batch, *context.frame.scene);
    addFaces(update, hits, true);
    countImportance(update, hits);
    select(update);
    measureAgain(update);
    lightNew(update);
    passLight(update);
    context.report("kept faces", faces_);
    context.report("points", selection_.again().count + selection_.added().count);
    context.report("points measured again", selection_.again().count);
}

void KeptFaces::addFaces(const Update& update, const std::vector<FaceHits>& hits, bool offerToAll) {
    PassContext& context = update.context;
    const uint32_t rays = hits.back().first + hits.back().count, firstNew = faces_;
    const uint32_t added = update.newFaces.number(context, update.light, firstNew, rays);
    faces_ += added;
    const uint64_t perFace = params_.pointsPerFace, points = faces_ * perFace, oldPoints = firstNew * perFace;
    grow(pointHits_, context, "points of kept faces", points * sizeof(gpu::FaceHit), oldPoints * sizeof(gpu::FaceHit));
    grow(pointPlaces_, context, "places of points", points * sizeof(gpu::PointPlace),
         oldPoints * sizeof(gpu::PointPlace));
    grow(pointDirect_, context, "direct irradiance of points", points * sizeof(glm::vec4),
         oldPoints * sizeof(glm::vec4));
    grow(links_, context, "links of points", points * sizeof(gpu::FaceLink), oldPoints * sizeof(gpu::FaceLink));
    grow(measuredAt_, context, "frames of points", points * sizeof(uint32_t), oldPoints * sizeof(uint32_t));
    grow(hiddenLights_, context, "lights hidden from points", points * lights_.hiddenWords() * sizeof(uint32_t),
         oldPoints * lights_.hiddenWords() * sizeof(uint32_t));
    grow(importance_, context, "importance of faces", faces_ * sizeof(uint32_t), firstNew * sizeof(uint32_t));
    grow(update.light.irradiance, context, "irradiance of lit faces", faces_ * sizeof(glm::vec4),
         firstNew * sizeof(glm::vec4));
    context.dispatch(clearPoints_, uint32_t(added * perFace),
                     {{"pointHits", pointHits_},
                      {"pointDirect", pointDirect_},
                      {"links", links_},
                      {"importance", importance_},
                      {"irradiance", update.light.irradiance},
                      {"firstFace", firstNew},
                      {"count", uint32_t(added * perFace)},
                      {"pointsPerFace", params_.pointsPerFace}});
    const uint32_t firstFace = offerToAll ? 0 : firstNew;
    if (faces_ == firstFace) return;
    const uint32_t taken = update.newFaces.chooseSlots(context, update.light, hits, firstFace, faces_ - firstFace,
                                                       params_.pointsPerFace, update.seed);
    context.dispatch(offerPoints_, taken,
                     {update.newFaces.points(),
                      {"pointHits", pointHits_},
                      {"count", taken},
                      {"firstPoint", firstFace * params_.pointsPerFace}});
}

void KeptFaces::countImportance(const Update& update, const std::vector<FaceHits>& hits) {
    PassContext& context = update.context;
    std::swap(importance_, importanceBefore_);
    grow(importance_, context, "importance of faces", importanceBefore_.bytes(), 0);
    context.stream.fill(importance_, 0);
    for (const FaceHits& batch : hits)
        context.dispatch(
            countReads_, batch.count,
            {update.light, {"hitFaces", *batch.faces}, {"importance", importance_}, {"count", batch.count}});
    context.dispatch(passImportance_, faces_,
                     {{"links", links_},
                      {"before", importanceBefore_},
                      {"importance", importance_},
                      {"faces", faces_},
                      {"pointsPerFace", params_.pointsPerFace}});
}

void KeptFaces::select(const Update& update) {
    if (faces_ == 0) return selection_.selectNone();
    const std::vector<Binding> kept{update.newFaces.takenSlots(), {"pointDirect", pointDirect_},
                                    {"pointHits", pointHits_},    {"measuredAt", measuredAt_},
                                    {"importance", importance_},  {"irradiance", update.light.irradiance}};
    // Without a light that shines, what is known of it takes no ray
    PointSelection::Candidates candidates{
        {}, faces_, params_.pointsPerFace, frame_, update.lights.all.rays + 1, std::max(update.lights.again.rays, 1u)};
    for (const Binding& binding : kept) candidates.kept.push_back(ifUsed(binding));
    const glm::uvec2 pixels = update.context.frame.pixels();
    selection_.select(update.context, candidates,
                      uint32_t(std::floor(double(params_.raysPerPixel) * pixels.x * pixels.y)));
}

void KeptFaces::measure(const Update& update, const MeasuredLights& lights, const SelectedPoints& points,
                        uint32_t first, uint32_t count) {
    PassContext& context = update.context;
    const auto store = [&](const Kernel& kernel, std::vector<Binding> more) {
        context.dispatch(kernel, count,
                         {context.scene,
                          {"selected", points.points},
                          {"direct", update.batch.direct},
                          {"pointDirect", pointDirect_},
                          {"hiddenLights", hiddenLights_},
                          ifUsed({"pointPlaces", pointPlaces_}),
                          {"first", first},
                          {"count", count},
                          {"words", lights_.hiddenWords()},
                          {"keepsLight", lights.keepsLight},
                          more});
    };
    update.batch.measure(context, lights.others, count, update.seed);
    store(storeOthers_, {});
    for (const LightSource& source : lights.own) {
        update.batch.measure(context, {source}, count, update.seed);
        store(storeOwn_, {{"light", source.light}});
    }
}

void KeptFaces::measureAgain(const Update& update) {
    const SelectedPoints& points = selection_.again();
    PassContext& context = update.context;
    for (uint32_t first = 0; first < points.count; first += update.batch.size) {
        const uint32_t count = std::min(update.batch.size, points.count - first);
        context.dispatch(placeOld_, count,
                         {context.scene,
                          update.store.ofFaces,
                          {"selected", points.points},
                          {"pointHits", pointHits_},
                          {"surfels", update.batch.surfels},
                          {"first", first},
                          {"count", count}});
        measure(update, update.lights.again, points, first, count);
    }
}

void KeptFaces::lightNew(const Update& update) {
    const SelectedPoints& points = selection_.added();
    if (points.count == 0) return;
    PassContext& context = update.context;
    grow(newLinks_, context, "links of new points", points.count * sizeof(gpu::FaceLink), 0);
    grow(roundHits_, context, "hits of new points", points.count * sizeof(Hit), 0);
    grow(roundFaces_, context, "faces of new points", points.count * sizeof(uint32_t), 0);
    for (uint32_t first = 0; first < points.count; first += update.batch.size) {
        const uint32_t count = std::min(update.batch.size, points.count - first);
        context.dispatch(placeNew_, count,
                         {context.scene,
                          update.store.ofFaces,
                          update.newFaces.slotHits(),
                          {"selected", points.points},
                          {"pointHits", pointHits_},
                          {"pointDirect", pointDirect_},
                          {"surfels", update.batch.surfels},
                          {"rays", update.batch.rays},
                          {"pointPlaces", pointPlaces_},
                          {"first", first},
                          {"count", count},
                          {"seed", update.seed + 0x51u}});
        measure(update, update.lights.all, points, first, count);
        context.tracer.closestHit(context.stream, update.batch.rays, update.batch.hits, count);
        context.dispatch(linkPoints_, count,
                         {context.scene,
                          update.store.ofHits,
                          update.light,
                          update.newFaces.marks(),
                          {"rays", update.batch.rays},
                          {"hits", update.batch.hits},
                          {"roundHits", roundHits_},
                          {"hitFaces", roundFaces_},
                          {"links", newLinks_},
                          {"lost", update.lost},
                          {"first", first},
                          {"count", count},
                          {"firstPoint", 0u}});
    }
    addFaces(update, {{&roundHits_, &roundFaces_, 0, points.count}}, false);
    context.dispatch(storeLinks_, points.count,
                     {update.light,
                      {"selected", points.points},
                      {"newLinks", newLinks_},
                      {"links", links_},
                      {"measuredAt", measuredAt_},
                      {"count", points.count},
                      {"frame", frame_}});
}

void KeptFaces::passLight(const Update& update) {
    PassContext& context = update.context;
    const uint64_t bytes = std::max<uint64_t>(faces_, 1) * sizeof(glm::vec4);
    for (Buffer* buffer : {&faceDirect_, &faceIrradiance_, &update.light.irradiance})
        grow(*buffer, context, "irradiance of lit faces", bytes, 0);
    const auto faces = [&](const Buffer& irradiance) {
        return std::vector<Binding>{ifUsed({"pointDirect", pointDirect_}),
                                    {"irradiance", irradiance},
                                    {"faces", faces_},
                                    {"pointsPerFace", params_.pointsPerFace}};
    };
    context.dispatch(gatherDirect_, faces_, {faces(faceDirect_)});
    const Buffer* previous = &faceDirect_;
    for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
        const Buffer& next = (params_.bounces - bounce) % 2 == 1 ? update.light.irradiance : faceIrradiance_;
        context.dispatch(gatherLinks_, faces_,
                         {faces(next), {"links", links_}, {"direct", faceDirect_}, {"previous", *previous}});
        previous = &next;
    }
    if (params_.bounces == 0) context.stream.copy(faceDirect_, update.light.irradiance, bytes);
}

}  // namespace voxray
