#pragma once

#include <vector>

#include "passes/cache/hit_faces/kept/changing_lights.h"
#include "passes/cache/hit_faces/kept/point_selection.h"
#include "passes/cache/hit_faces/new_faces.h"
#include "passes/cache/hit_faces/point_batch.h"

namespace voxray {

/// Light of faces that is kept from frame to frame, while surfaces stand still. In each frame a budget of rays goes to
/// the points by whose update the image's error is expected to fall most for each ray: of faces that this frame's rays
/// read, directly or by links, points that have no light, and points whose lights have changed. What is left renews the
/// oldest. Docs: docs/hit-faces.md. Source: Smits, Arvo and Salesin 1992 (importance); Schied et al. 2018 (light that
/// changes is found before it is averaged); Boissé et al. 2023 (GI-1.0, budgets of a kept store).
class KeptFaces {
 public:
    struct Params {
        uint32_t pointsPerFace, bounces;
        float raysPerPixel;
        FaceKind kind = FaceKind::Voxels;
    };
    /// What shaders that include hit_face.glsl read: of hits, and of faces alone.
    struct Store {
        std::vector<Binding> ofHits, ofFaces;
    };
    /// Memory, without what buffers have beyond that to grow: of a point its hit, place, light and link, which of 32
    /// lights are hidden, and what selects it; of a face its importance and irradiance.
    static constexpr double kBytesPerPoint = 120, kBytesPerFace = 56;
    KeptFaces(ProgramOwner& owner, const Params& params);

    /// A frame's update. @param hits of gather rays, by batch; their faces are marked where they have no number.
    /// @param lost counts rays that hit where no voxel is.
    void update(PassContext& context, const Store& store, HitFaceLight& light, NewFaces& newFaces,
                const PointBatch& batch, const std::vector<FaceHits>& hits, const Buffer& lost);
    /// Forgets all light, before the first update and where surfaces have changed. @param allFaces lit or not.
    void clear(PassContext& context, uint64_t allFaces, HitFaceLight& light);
    uint32_t faces() const { return faces_; }

 private:
    /// What an update works with.
    struct Update {
        PassContext& context;
        const Store& store;
        HitFaceLight& light;
        NewFaces& newFaces;
        const PointBatch& batch;
        const Buffer& lost;
        uint32_t seed;
        LightsOfPoints lights;
    };
    /// Numbers marked faces, which begin without light, and offers hits as points of the faces from `firstFace` on.
    void addFaces(const Update& update, const std::vector<FaceHits>& hits, bool offerToAll);
    void countImportance(const Update& update, const std::vector<FaceHits>& hits);
    /// Selects points within the budget.
    void select(const Update& update);
    /// Measures direct light of these at the batch's surfels, of `count` points from the `first` on.
    void measure(const Update& update, const MeasuredLights& lights, const SelectedPoints& points, uint32_t first,
                 uint32_t count);
    void measureAgain(const Update& update);
    void lightNew(const Update& update);
    void passLight(const Update& update);

    const Params params_;
    Kernel clearPoints_, offerPoints_, countReads_, passImportance_;
    Kernel placeOld_, placeNew_, storeOthers_, storeOwn_, storeLinks_, linkPoints_, gatherDirect_, gatherLinks_;
    ChangingLights lights_;
    PointSelection selection_;
    uint32_t faces_ = 0;  ///< That have a number.
    uint32_t frame_ = 0;
    Buffer pointHits_, pointPlaces_, pointDirect_, links_, measuredAt_;  ///< By point: `pointsPerFace` of each face.
    Buffer hiddenLights_;                                                ///< By point: a bit for each light.
    Buffer importance_, importanceBefore_;                               ///< By face.
    Buffer faceDirect_, faceIrradiance_;        ///< By face; the second after every other bounce.
    Buffer newLinks_, roundHits_, roundFaces_;  ///< Of new points.
};

}  // namespace voxray
