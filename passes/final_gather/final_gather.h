#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"
#include "passes/surfels/surfel_light.h"

namespace voxray {

/// A final gather: what the surfaces at the hits of trace_gather_rays reflect of light that is stored there,
/// and measured light where none is or where the hit is too near. Where light is stored is the user's: two
/// shaders in its folder, shade.comp and go_on.comp, include final_gather/shade.glsl and
/// final_gather/go_on.glsl and define storedLight() (final_gather/hit.glsl). Reports how many hits
/// that are far enough off to read stored light find none, in percent of the rays.
class FinalGather {
 public:
    struct Settings {
        std::string pass;                        ///< Its name, for messages.
        SpecializationConstants constants = {};  ///< Of storedLight().
        bool shadowRays = false;    ///< Direct light is not stored: shadow rays measure it at each hit.
        uint32_t lightSamples = 1;  ///< Of the emissive surfaces and of the environment, at each such hit.
        float nearFieldCells = 0;   ///< Rays shorter than this go on; 0: no ray does.
        uint32_t maxSteps = 3;      ///< That a ray goes on, at most.
        std::optional<uint32_t> storedBounces = {};  ///< Resource::lightBounces of the stored light.
        std::string unlit =
            "hits on unlit faces, % of rays";  ///< What hits are called that no light is stored for.
    };

    /// @param sourceFile in the folder of shade.comp and go_on.comp
    explicit FinalGather(Pass& pass, const char* sourceFile = __builtin_FILE());

    /// @throws Error where texels would get no ray and no filter follows.
    void plan(PassPlan& plan, const Settings& settings);
    /// @param stored bindings of storedLight().
    void record(PassContext& context, const std::vector<Binding>& stored);

 private:
    bool measuresDirect() const { return settings_.shadowRays || settings_.nearFieldCells > 0; }
    void gather(PassContext& context, const std::vector<Binding>& stored, uint32_t batch);
    /// Measures direct light at the hits of a batch where it is asked for, and lets rays go on.
    void follow(PassContext& context, const std::vector<Binding>& stored);
    /// Adds up what the last dispatch counted. @returns its surfels.
    uint32_t takeCounts(CommandStream& stream);
    std::vector<Binding> endBindings(PassContext& context, const std::vector<Binding>& stored,
                                     const Buffer& hits, const Buffer& surfels) const;

    ProgramOwner& owner_;
    Settings settings_;
    In<GBuffer> gbuffer_;
    In<GatherHits> hits_;
    Out<NoisyIrradiance> noisy_;
    Out<FrameImage> indirect_;
    Kernel shade_, reflect_, goOn_, collect_, moments_;
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
    Buffer light_;                              ///< What the rays of a batch bring.
    Buffer counts_;                             ///< Of one dispatch.
    double traced_ = 0, unlit_ = 0;

    // Where direct light is measured at hits, and rays go on from there.
    std::vector<LightSource> sources_;
    std::optional<SurfelLight> hitLight_;
    std::array<Buffer, 2> surfels_;  ///< Of a batch's hits, and of those one step before.
    Buffer goesOn_, direct_, rays_, nextHits_;
};

}  // namespace voxray
