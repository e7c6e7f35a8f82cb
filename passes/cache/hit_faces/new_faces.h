#pragma once

#include <optional>
#include <vector>

#include "graph/pass.h"
#include "passes/cache/hit_faces/face_kind.h"
#include "passes/cache/hit_faces/hit_face_light.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/radix_sort.h"

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
    NewFaces(ProgramOwner& owner, FaceKind kind);

    /// Unmarks all faces. @param allFaces marked or not. @param keys of cells, RadianceCache::keys; null: voxels'
    /// faces.
    void begin(PassContext& context, uint64_t allFaces, const Buffer* keys = nullptr);
    /// For shaders that include mark_face.glsl.
    Binding marks() const { return {"markedFaces", marked_}; }
    /// Numbers the marked faces from `firstFace` on and unmarks them: those of voxels in the order of voxels, cells in
    /// that of their keys, since the slots of cells depend on the order of threads. @param rays that marked: at most as
    /// many faces.
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
    /// Sorts `faces` new cells by their keys.
    void sortCells(PassContext& context, uint32_t faces);

    /// Puts new cells in the order of their keys.
    struct CellSort {
        explicit CellSort(ProgramOwner& owner) : readWords(owner, "words_of_keys.comp"), radixSort(owner) {}
        Kernel readWords;
        RadixSort radixSort;
        const Buffer* keys = nullptr;  ///< By slot.
        Buffer words;
    };

    Kernel numberFaces_, vote_, store_;
    Compaction compaction_;
    std::optional<CellSort> cellSort_;
    Buffer marked_, newFaces_;
    Buffer slotKeys_, slotHits_, takenSlots_, pointSlots_;
};

}  // namespace voxray
