#include "passes/path_trace/integrator.h"

#include <cmath>
#include <limits>

namespace voxray::path_trace {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Shadow rays end this part of their way before the light.
constexpr float kShadowEnd = 1.0f - 4e-6f;
/// Vertices before Russian roulette starts.
constexpr uint32_t kSureVertices = 3;

/// What each vertex draws numbers for; the camera uses number 0.
enum Use : uint32_t { kLightPoint = 1, kLightChoice, kReflection, kLobe, kRoulette, kUses = 8 };

}  // namespace

/// The numbers of one vertex of a path.
struct Integrator::VertexSampler {
    const SobolSampler& sampler;
    uint32_t vertex;

    glm::vec2 pair(Use use) const { return sampler.pair(vertex * kUses + use); }
    float one(Use use) const { return sampler.one(vertex * kUses + use); }
};

Integrator::Integrator(const SceneState& state, const EmbreeScene& tracer, uint32_t bounces,
                       Strategy strategy, PathLight light)
    : tracer_(tracer),
      surfaces_(state),
      lights_(state, surfaces_),
      bounces_(bounces),
      strategy_(strategy),
      light_(light) {}

float Integrator::weightOfHit(float reflectionPdf, float lightPdf) const {
    switch (strategy_) {
        case Strategy::Mis:
            return misWeight(reflectionPdf, lightPdf);
        case Strategy::ReflectionOnly:
            return 1.0f;
        case Strategy::LightsOnly:
            break;
    }
    return lightPdf > 0.0f ? 0.0f : 1.0f;
}

glm::vec3 Integrator::lightAt(const SurfacePoint& point, const glm::vec3& out, const VertexSampler& sampler,
                              PathSample& path) const {
    // Draw a light and weigh what it sends here.
    const glm::vec3 origin = point.rayOrigin();
    const float choice = lights_.isSingle() ? 0.0f : sampler.one(kLightChoice);
    const LightSample light = lights_.sample(origin, choice, sampler.pair(kLightPoint));
    if (!(light.pdf > 0.0f) || !(glm::dot(light.direction, point.faceNormal) > 0.0f)) return glm::vec3(0.0f);
    const BsdfValue reflection = point.bsdf.evaluate(out, light.direction, point.shadingNormal);
    glm::vec3 value = reflection.fCos * light.radiance / light.pdf;
    if (!light.isDelta) {
        if (strategy_ == Strategy::ReflectionOnly) return glm::vec3(0.0f);
        if (strategy_ == Strategy::Mis) value *= misWeight(light.pdf, reflection.pdf);
    }
    if (!(maxComponent(value) > 0.0f)) return glm::vec3(0.0f);

    // Look whether it arrives.
    ++path.rays;
    const Ray shadow = light.isInfinite ? Ray{origin, 0.0f, light.direction, kInfinity}
                                        : Ray{origin, 0.0f, light.target - origin, kShadowEnd};
    return tracer_.occluded(shadow) ? glm::vec3(0.0f) : value;
}

PathSample Integrator::trace(const Ray& cameraRay, const SobolSampler& sampler) const {
    PathSample path;
    Ray ray = cameraRay;
    glm::vec3 throughput(1.0f);
    glm::vec3 irradianceThroughput(0.0f);  // The same with the first hit's reflection left out.
    float reflectionPdf = 0.0f;
    bool isMirrored =
        true;  // The camera, as a mirror, has no density: only the ray itself finds what it sees.

    for (uint32_t vertex = 0;; ++vertex) {
        // Light that reaches the path here or that it runs into. Beyond the second vertex the latter is
        // indirect.
        const auto add = [&](bool isDirect, const glm::vec3& light, float weight) {
            (isDirect ? path.direct : path.indirect) += throughput * light * weight;
            if (!isDirect) path.irradiance += irradianceThroughput * light * weight;
        };
        const bool wantsFound = vertex > 1 || light_ == PathLight::All;
        const Hit hit = tracer_.closestHit(ray);
        ++path.rays;
        if (vertex == 1 && hit.triangle != Hit::kMiss) path.distance = hit.t;
        if (hit.triangle == Hit::kMiss) {
            const EnvironmentLight& environment = lights_.environment();
            if (wantsFound && !environment.isBlack()) {
                const float weight =
                    isMirrored ? 1.0f : weightOfHit(reflectionPdf, lights_.pdfOfEnvironment(ray.direction));
                add(vertex <= 1, environment.radiance(ray.direction), weight);
            }
            return path;
        }
        const SurfaceTriangle& triangle = surfaces_.triangle(hit.triangle);
        if (wantsFound && triangle.light != kNoLight && surfaces_.emitsTowards(triangle, -ray.direction)) {
            const float weight =
                isMirrored ? 1.0f
                           : weightOfHit(reflectionPdf, lights_.pdfOfHit(triangle, ray.direction, hit.t));
            add(vertex <= 1, surfaces_.emission(hit.triangle, hit.u, hit.v), weight);
        }
        if (vertex > bounces_) return path;

        // Direct light at this vertex.
        const VertexSampler vertexSampler{sampler, vertex};
        const SurfacePoint point = surfaces_.at(hit, ray.direction);
        if (vertex == 0) path.hasIrradiance = maxComponent(point.bsdf.diffuse) > 0.0f;
        if (!lights_.empty() && (vertex > 0 || light_ == PathLight::All))
            add(vertex == 0, lightAt(point, -ray.direction, vertexSampler, path), 1.0f);
        if (vertex == bounces_ && !lights_.canBeHit()) return path;

        // Scatter; rays that a shading normal sends below the surface are lost.
        const float lobe = point.bsdf.hasSpecular() ? vertexSampler.one(kLobe) : 0.0f;
        const BsdfSample next =
            point.bsdf.sample(-ray.direction, point.shadingNormal, vertexSampler.pair(kReflection), lobe);
        throughput *= next.weight;
        if (vertex > 0)
            irradianceThroughput *= next.weight;
        else if (next.pdf > 0.0f)
            irradianceThroughput = glm::vec3(glm::dot(point.shadingNormal, next.direction) / next.pdf);
        const float strength = maxComponent(throughput);
        if (!(strength > 0.0f) || !(glm::dot(next.direction, point.faceNormal) > 0.0f)) return path;

        // Russian roulette by the root of the throughput: shorter paths, more noise; the mean stays.
        if (vertex + 1 >= kSureVertices && strength < 1.0f) {
            const float survival = std::sqrt(strength);
            if (vertexSampler.one(kRoulette) >= survival) return path;
            throughput /= survival;
            irradianceThroughput /= survival;
        }
        ray = {point.rayOrigin(), 0.0f, next.direction, kInfinity};
        reflectionPdf = next.pdf;
        isMirrored = next.mirror;
    }
}

}  // namespace voxray::path_trace
