#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/compaction.h"
#include "passes/final_gather/hit_faces/hit_face_light.h"

namespace voxray {

/// Hits of rays, and the face of each (hitFace()), `first` of which come before them in the round.
struct FaceHits {
    const Buffer *hits, *faces;
    uint32_t first, count;
};

/// The faces that a round of rays hits first, and the hits that are chosen as their points: `slotsPerFace` hits of each
/// face, or fewer, of which each is as likely as any other. Which ones does not depend on the order of threads.
class NewFaces {
 public:
    explicit NewFaces(ProgramOwner& owner);

    /// Unmarks all faces.
    void begin(PassContext& context, uint32_t voxelCount);
    /// For shaders that include mark_face.glsl.
    Binding marks() const { return {"markedFaces", marked_}; }
    /// Numbers the marked faces from `firstFace` on and unmarks them. @param rays that marked: at most as many faces.
    /// @return the number of faces; waits for the device.
    uint32_t number(PassContext& context, const HitFaceLight& light, uint32_t firstFace, uint32_t rays);
    /// Chooses points of `faces` faces that have been numbered. @return the number of points; waits for the device.
    uint32_t choose(PassContext& context, const HitFaceLight& light, const std::vector<FaceHits>& hits,
                    uint32_t firstFace, uint32_t faces, uint32_t slotsPerFace, uint32_t seed);
    /// The same for faces of which some have no hit. @return the number of slots that have a hit.
    uint32_t chooseSlots(PassContext& context, const HitFaceLight& light, const std::vector<FaceHits>& hits,
                         uint32_t firstFace, uint32_t faces, uint32_t slotsPerFace, uint32_t seed);
    /// The chosen hits: slots that have one, ascending, and hits by slot.
    std::vector<Binding> points() const { return {{"pointSlots", pointSlots_}, slotHits()}; }
    Binding slotHits() const { return {"slotHits", slotHits_}; }
    /// Which slots have a hit.
    Binding takenSlots() const { return {"takenSlots", takenSlots_}; }

 private:
    void vote(PassContext& context, const HitFaceLight& light, const std::vector<FaceHits>& hits, uint32_t firstFace,
              uint32_t faces, uint32_t slotsPerFace, uint32_t seed);
    /// Lists the slots that have a hit.
    uint32_t listSlots(CommandStream& stream, uint64_t slots);

    Kernel numberFaces_, vote_, store_;
    Compaction compaction_;
    Buffer marked_, newFaces_;
    Buffer slotKeys_, slotHits_, takenSlots_, pointSlots_;
};

}  // namespace voxray
