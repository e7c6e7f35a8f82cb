#include "passes/cache/hit_faces/new_faces.h"

#include <algorithm>

#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/common/compute/bit_words.h"

namespace voxray {

NewFaces::NewFaces(ProgramOwner& owner, FaceKind kind)
    : numberFaces_(owner, "number_faces.comp"),
      vote_(owner, "choose_hits.comp", {{"VOTE", "1"}}),
      store_(owner, "choose_hits.comp"),
      compaction_(owner) {
    if (kind == FaceKind::Cells) cellSort_.emplace(owner);
}

void NewFaces::begin(PassContext& context, uint64_t allFaces, const Buffer* keys) {
    if (cellSort_) cellSort_->keys = keys;
    const uint64_t words = std::max<uint64_t>(bitWords(allFaces), 1);
    ensureSize(marked_, context.device, "marked faces", words * sizeof(uint32_t));
    context.stream.fill(marked_, 0);
}

uint32_t NewFaces::number(PassContext& context, const HitFaceLight& light, uint32_t firstFace, uint32_t rays) {
    const uint64_t words = marked_.bytes() / sizeof(uint32_t);
    growTo(newFaces_, context.device, "new faces", std::min<uint64_t>(rays, 32 * words) * sizeof(uint32_t));
    const uint32_t faces = compaction_.run(context.stream, marked_, newFaces_, uint32_t(words));
    if (cellSort_) sortCells(context, faces);
    context.dispatch(numberFaces_, faces,
                     {light, marks(), {"newFaces", newFaces_}, {"count", faces}, {"firstFace", firstFace}});
    return faces;
}

void NewFaces::sortCells(PassContext& context, uint32_t faces) {
    ensureSize(cellSort_->words, context.device, "words of cells' keys", newFaces_.bytes());
    for (uint32_t word = 0; word < 2; ++word) {
        context.dispatch(cellSort_->readWords, faces,
                         {{"cells", newFaces_},
                          {"cellKeys", *cellSort_->keys},
                          {"words", cellSort_->words},
                          {"count", faces},
                          {"word", word}});
        cellSort_->radixSort.record(context.stream, cellSort_->words, newFaces_, faces);
    }
}

uint32_t NewFaces::choose(PassContext& context, const HitFaceLight& light, const std::vector<FaceHits>& hits,
                          uint32_t firstFace, uint32_t faces, uint32_t slotsPerFace, uint32_t seed) {
    vote(context, light, hits, firstFace, faces, slotsPerFace, seed);
    if (slotsPerFace == 1) return faces;  // Each has a hit.
    return listSlots(context.stream, uint64_t(faces) * slotsPerFace);
}

uint32_t NewFaces::chooseSlots(PassContext& context, const HitFaceLight& light, const std::vector<FaceHits>& hits,
                               uint32_t firstFace, uint32_t faces, uint32_t slotsPerFace, uint32_t seed) {
    vote(context, light, hits, firstFace, faces, slotsPerFace, seed);
    return listSlots(context.stream, uint64_t(faces) * slotsPerFace);
}

uint32_t NewFaces::listSlots(CommandStream& stream, uint64_t slots) {
    return compaction_.run(stream, takenSlots_, pointSlots_, uint32_t(bitWords(slots)));
}

void NewFaces::vote(PassContext& context, const HitFaceLight& light, const std::vector<FaceHits>& hits,
                    uint32_t firstFace, uint32_t faces, uint32_t slotsPerFace, uint32_t seed) {
    CommandStream& stream = context.stream;
    const uint64_t slots = uint64_t(faces) * slotsPerFace, words = bitWords(slots);
    growTo(slotKeys_, context.device, "keys of points", slots * sizeof(uint32_t));
    growTo(slotHits_, context.device, "hits of points", slots * sizeof(gpu::FaceHit));
    growTo(takenSlots_, context.device, "taken slots of points", words * sizeof(uint32_t));
    growTo(pointSlots_, context.device, "slots of points", slots * sizeof(uint32_t));
    stream.fill(slotKeys_, 0xffffffffu);
    stream.fill(takenSlots_, 0);
    for (const Kernel* kernel : {&vote_, &store_})
        for (const FaceHits& batch : hits)
            context.dispatch(*kernel, batch.count,
                             {light,
                              ifUsed({"hits", *batch.hits}),
                              {"hitFaces", *batch.faces},
                              {"slotKeys", slotKeys_},
                              ifUsed({"slotHits", slotHits_}),
                              ifUsed({"takenSlots", takenSlots_}),
                              {"count", batch.count},
                              {"firstHit", batch.first},
                              {"firstFace", firstFace},
                              {"slotsPerFace", slotsPerFace},
                              {"seed", seed}});
}

}  // namespace voxray
