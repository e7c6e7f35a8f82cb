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

/// How light is found; all three have the same mean (mirrors and delta lights apart), which a test shows.
enum class Strategy { Mis, ReflectionOnly, LightsOnly };

/// What one path brought, W/(m² sr).
struct PathSample {
    glm::vec3 direct{0.0f};    ///< Emission and direct light at the first hit: N = 0.
    glm::vec3 indirect{0.0f};  ///< Everything else.
    uint32_t rays = 0;

    /// Whether the path scattered at a first hit that reflects diffusely; if so, the next two are estimates.
    bool hasIrradiance = false;
    glm::vec3 irradiance{0.0f};  ///< Of indirect light, about the first hit's shading normal, W/m².
    float distance = std::numeric_limits<float>::infinity();  ///< From the first hit to the second, m.
};

/// The light transport equation's estimator: unidirectional paths with next-event estimation.
class Integrator {
 public:
    /// Both arguments must outlive this object.
    Integrator(const SceneState& state, const EmbreeScene& tracer, uint32_t bounces, Strategy strategy,
               PathLight light = PathLight::All, RaysToCome rays = RaysToCome::Many);

    /// Follows up to kPacket paths that start along `cameraRays` (unit directions) and lie close together:
    /// they share the packets of their first rays. Pair 0 of samplers is the caller's.
    static constexpr size_t kPacket = EmbreeScene::kPacketRays;
    void trace(std::span<const Ray> cameraRays, std::span<const SobolSampler> samplers,
               std::span<PathSample> samples) const;

 private:
    struct VertexSampler;
    class Path;
    float weightOfHit(float reflectionPdf, float lightPdf) const;

    /// What a ray's light loses to the colour of panes on its way up to tMax.
    glm::vec3 transmittance(Ray ray) const;

    const EmbreeScene& tracer_;
    SurfaceTable surfaces_;
    LightTable lights_;
    /// Panes that dim light.
    struct Panes {
        explicit Panes(const SceneState& state) : tracer(state), surfaces(state) {}
        EmbreeScene tracer;
        SurfaceTable surfaces;
    };
    std::unique_ptr<const Panes> panes_;  ///< nullptr: there are none.
    uint32_t bounces_;
    Strategy strategy_;
    PathLight light_;
};

/// Renders as `pathTrace` does, with any strategy.
PathTraceResult render(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                       const PathTraceOptions& options, const ProgressCallback& progress, Strategy strategy);

}  // namespace voxray::path_trace
