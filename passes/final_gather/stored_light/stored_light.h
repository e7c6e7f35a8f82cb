#pragma once

#include <optional>
#include <vector>

#include "passes/cache/hit_faces/hit_face_light.h"
#include "passes/cache/radiance_cache.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/final_gather/merged_voxels/irradiance_tree.h"
#include "passes/final_gather/stored_light/stored_light_params.h"

namespace voxray {

/// Stored light at the hits of gather rays: its ports, and the definitions and bindings of its shaders.
class StoredLight {
 public:
    StoredLight(Pass& pass, const StoredLightParams& params);

    /// Whether direct light is stored, too.
    bool holdsDirect(const PassPlan& plan) const;
    /// Resource::lightBounces.
    std::optional<uint32_t> bounces(const PassPlan& plan) const;
    /// Of shaders that include stored_light.glsl.
    Defines defines() const;
    /// What a report calls the hits beyond the near field where no light is stored.
    const char* unlitName() const;
    /// Brings the light up to date. @return its bindings.
    std::vector<Binding> update(PassContext& context);

 private:
    const GatherSource source_;
    const bool readsVoxelDirect_;  ///< Whether direct light is read from voxels, too.
    const uint32_t minSamples_;
    In<VoxelLevels> voxels_;
    In<VoxelIrradiance> irradiance_;
    In<IrradianceTree> tree_;
    In<RadianceCache> cache_;
    In<HitFaceLight> hitFaces_;
    std::optional<FaceIrradiance> faces_;  ///< Of voxels.
};

}  // namespace voxray
