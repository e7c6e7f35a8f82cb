#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"
#include "passes/probes/update_probes/probe_light.h"

namespace voxray {

enum class ProbeUpdate { Once, EachFrame };
template <>
struct EnumNames<ProbeUpdate> {
    static constexpr std::array names{std::pair{ProbeUpdate::Once, "once"},
                                      std::pair{ProbeUpdate::EachFrame, "each_frame"}};
};

enum class ProbeBackfaces { Dark, Lit };
template <>
struct EnumNames<ProbeBackfaces> {
    static constexpr std::array names{std::pair{ProbeBackfaces::Dark, "dark"}, std::pair{ProbeBackfaces::Lit, "lit"}};
};

/// Defaults are those of Majercik et al. 2019 and 2021 where they name one, else mostly those of the authors' library;
/// docs/probes.md says which and what each costs.
struct UpdateProbesParams {
    ProbeUpdate update = ProbeUpdate::Once;
    ProbeSource source = ProbeSource::Probes;
    uint32_t probes = 16;
    uint32_t cascades = 1;
    uint32_t raysPerProbe = 256;
    uint32_t bounces = 8;
    uint32_t updates = 8;
    uint32_t lightSamples = 1;
    float hysteresis = 0.97f;
    float changeThreshold = 0.25f;
    float resetThreshold = 0.8f;
    uint32_t irradianceTexels = 8;
    uint32_t depthTexels = 16;
    float depthSharpness = 50;
    float encodingGamma = 5;
    float blendGamma = 2;
    bool visibility = true;
    bool wrapWeights = true;
    float crushThreshold = 0.2f;
    float normalBias = 0.045f;
    float viewBias = 0.18f;
    uint32_t relocationSteps = 5;
    bool classification = true;
    float backfaceThreshold = 0.25f;
    float minDistance = 0.1f;
    ProbeBackfaces backfaces = ProbeBackfaces::Dark;

    static constexpr auto schema() {
        using P = UpdateProbesParams;
        return std::tuple{
            field("update", &P::update,
                  "once: a build, which averages all its updates and has light of exactly so many bounces. "
                  "each_frame: as published, an update in each frame blended with those before; "
                  "light of all bounces, a further one in each frame."),
            field("source", &P::source,
                  "Light at the hits of probe rays. probes: shadow rays for direct light, "
                  "and the probes as they were before the update. voxels: faces of surface voxels, "
                  "filled by any injection."),
            field("probes", &P::probes, "Probes along the longest side of the scene's region, or of a cascade.", 1u,
                  128u),
            field("cascades", &P::cascades,
                  "Grids of as many probes: the coarsest covers the scene's region, each finer one has half its "
                  "spacing and is round the camera.",
                  1u, 8u),
            field("rays_per_probe", &P::raysPerProbe, "Rays from each probe in an update.", 8u, 16384u).lessNoise(),
            field("bounces", &P::bounces,
                  "Bounces of light: stages of the build, which light the hits by the probes of the stage before.", 1u,
                  64u)
                .onlyWith(oneOf(&P::update, {ProbeUpdate::Once})),
            field("updates", &P::updates, "Updates of each stage of the build.", 1u, 4096u)
                .lessNoise()
                .onlyWith(oneOf(&P::update, {ProbeUpdate::Once})),
            field("light_samples", &P::lightSamples,
                  "Shadow rays to the emissive surfaces, and to the environment, from each hit.", 1u, 64u)
                .onlyWith(oneOf(&P::source, {ProbeSource::Probes})),
            field("hysteresis", &P::hysteresis,
                  "Part of earlier frames in the light: more for less noise and more lag.", 0.0f, 0.999f)
                .onlyWith(oneOf(&P::update, {ProbeUpdate::EachFrame})),
            field("change_threshold", &P::changeThreshold,
                  "Change of a texel's encoded irradiance, over the larger of the old and the new value, above which "
                  "its hysteresis is lower by 0.15. 1: never. Takes noise above it for a change.",
                  0.0f, 1.0f)
                .onlyWith(oneOf(&P::update, {ProbeUpdate::EachFrame})),
            field("reset_threshold", &P::resetThreshold,
                  "The same change above which a texel forgets earlier frames. 1: never.", 0.0f, 1.0f)
                .onlyWith(oneOf(&P::update, {ProbeUpdate::EachFrame})),
            field("irradiance_texels", &P::irradianceTexels,
                  "Texels along an edge of a probe's irradiance map, without its border.", 2u, 32u),
            field("depth_texels", &P::depthTexels, "Texels along an edge of a probe's depth map, without its border.",
                  2u, 64u),
            field("depth_sharpness", &P::depthSharpness, "Power of the cosine by which rays count for a depth texel.",
                  1.0f, 1000.0f),
            field("encoding_gamma", &P::encodingGamma,
                  "Irradiance is stored, blended over updates and interpolated in a probe's map as its root of this "
                  "degree. Darkens what is noisy or varies; 1: linear.",
                  1.0f, 8.0f),
            field("blend_gamma", &P::blendGamma,
                  "Degree of the root that is interpolated between probes. Darkens where probes differ; 1: linear.",
                  1.0f, 8.0f),
            field("visibility", &P::visibility,
                  "Whether probes that do not see a point count less, by Chebyshev's inequality on depth moments. "
                  "Off: light leaks through walls."),
            field("wrap_weights", &P::wrapWeights,
                  "Whether probes behind a surface count, too: weight ((cosine + 1) / 2)^2 + 0.2. "
                  "Off: the cosine."),
            field("crush_threshold", &P::crushThreshold,
                  "A weight w below it becomes w^3 / crush_threshold^2, against leaks.", 1e-6f, 1.0f),
            field("normal_bias", &P::normalBias,
                  "How far a point is moved along its normal for the visibility test, in spacings. Too little: "
                  "surfaces shadow themselves; too much: leaks.",
                  0.0f, 1.0f),
            field("view_bias", &P::viewBias, "How far it is moved towards the viewer, in spacings.", 0.0f, 1.0f),
            field("relocation_steps", &P::relocationSteps,
                  "Steps in which probes are moved out of surfaces and off them. 0: none.", 0u, 32u),
            field("classification", &P::classification,
                  "Whether probes inside objects, and those without a surface near, are inactive: they trace no rays "
                  "and have no weight."),
            field("backface_threshold", &P::backfaceThreshold,
                  "A probe is inside an object if more than this part of its rays hit back faces.", 0.0f, 1.0f)
                .onlyWith(oneOf(&P::backfaces, {ProbeBackfaces::Dark})),
            field("min_distance", &P::minDistance,
                  "Distance of the outermost probes from the sides of the scene's region, and the least distance from "
                  "surfaces that relocation keeps, in spacings.",
                  0.01f, 0.45f),
            field(
                "backfaces", &P::backfaces,
                "What back faces of single-sided surfaces are. dark: black, and the sign of a probe inside an object, "
                "as published; needs consistent windings. lit: they reflect as front faces do, "
                "as everywhere in Voxray.")};
    }
};

}  // namespace voxray
