#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "passes/common/voxels/face_irradiance.h"
#include "passes/probes/update_probes/probe_rays.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// What lights the hits of probe rays.
enum class ProbeSource { Probes, Voxels };
template <>
struct EnumNames<ProbeSource> {
    static constexpr std::array names{std::pair{ProbeSource::Probes, "probes"},
                                      std::pair{ProbeSource::Voxels, "voxels"}};
};

/// The light that comes to probes along their rays, and its ports.
class ProbeLight {
 public:
    ProbeLight(Pass& pass, ProbeSource source);

    /// @param rays maximum number of rays in a batch. @param backsAreDark whether surfaces hit from behind bring
    /// no light.
    void plan(PassPlan& plan, uint32_t rays, uint32_t lightSamples, bool backsAreDark);
    /// Resource::lightBounces of what comes from voxels.
    std::optional<uint32_t> voxelBounces(const PassPlan& plan) const;
    /// Brings the voxels' light up to date; once before shade().
    void update(PassContext& context);
    /// Shades the hits of a batch. @param lookup the probes to look up at hits. @return the light's binding.
    Binding shade(PassContext& context, const ProbeRays& rays, const ProbeBatch& batch,
                  const std::vector<Binding>& lookup, uint32_t seed) const;

 private:
    const ProbeSource source_;
    In<VoxelLevels> voxels_;
    In<VoxelIrradiance> irradiance_;
    std::optional<FaceIrradiance> faces_;
    std::optional<SurfelDirectLight> direct_;
    Kernel shade_, addDirect_;
    std::vector<LightSource> sources_;
    uint32_t lightSamples_ = 1;
    Buffer light_, surfels_, directLight_;
};

}  // namespace voxray
