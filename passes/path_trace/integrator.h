#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>

#include "passes/path_trace/lights.h"
#include "passes/path_trace/path_tracer.h"
#include "passes/path_trace/sobol.h"
#include "passes/path_trace/surfaces.h"
#include "trace/embree_scene.h"

namespace voxray::path_trace {

/// Sampling strategies. All three have the same mean (mirrors and delta lights apart), which a test shows.
enum class Strategy { Mis, ReflectionOnly, LightsOnly };

/// Radiance of one path, W/(m² sr).
struct PathSample {
    glm::vec3 direct{0.0f};    ///< Emission and direct light at the first hit (no bounce).
    glm::vec3 indirect{0.0f};  ///< All other light.
    uint32_t rays = 0;

    /// Whether the first hit reflects diffusely, and the path scattered there; then the next two are
    /// estimates.
    bool hasIrradiance = false;
    glm::vec3 irradiance{0.0f};  ///< Of indirect light about the first hit's shading normal, W/m².
    float distance = std::numeric_limits<float>::infinity();  ///< First to second hit, m.
};

/// Unidirectional path tracing with next-event estimation (PBRT 13).
class Integrator {
 public:
    /// `state` and `tracer` must outlive this object.
    Integrator(const SceneState& state, const EmbreeScene& tracer, uint32_t bounces, Strategy strategy,
               PathLight light = PathLight::All, ExpectedRays rays = ExpectedRays::Many);

    /// Takes over lights that have changed while surfaces and materials are the same. @param state as before.
    void updateLights(const SceneState& state) { lights_ = LightTable(state, surfaces_); }
    /// Takes over surfaces that advance() has moved, and lights. @param state as before.
    void updateMoving(const SceneState& state);

    /// Traces up to kPacket paths along `cameraRays` (unit directions) that are close together: their first
    /// rays are traced as packets. The caller uses pair 0 of the samplers.
    static constexpr size_t kPacket = EmbreeScene::kPacketRays;
    void trace(std::span<const Ray> cameraRays, std::span<const SobolSampler> samplers,
               std::span<PathSample> samples) const;

 private:
    struct VertexSampler;
    class Path;
    float hitWeight(float bsdfPdf, float lightPdf) const;

    /// Transmittance of the colored panes along a ray, up to tMax.
    glm::vec3 transmittance(Ray ray) const;

    const EmbreeScene& tracer_;
    SurfaceTable surfaces_;
    LightTable lights_;
    /// Panes that absorb light.
    struct Panes {
        explicit Panes(const SceneState& state) : tracer(state), surfaces(state) {}
        EmbreeScene tracer;
        SurfaceTable surfaces;
    };
    std::unique_ptr<const Panes> panes_;  ///< nullptr: none.
    uint32_t bounces_;
    Strategy strategy_;
    PathLight light_;
};

/// As pathTrace(), of the integrator's scene; its bounces and light count, not those of `options`.
PathTraceResult render(const Integrator& integrator, const Camera& camera, const PathTraceOptions& options,
                       const ProgressCallback& progress);
/// As pathTrace(), with any strategy.
PathTraceResult render(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                       const PathTraceOptions& options, const ProgressCallback& progress, Strategy strategy);

}  // namespace voxray::path_trace
