#include "passes/path_trace/integrator.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "scene/panes.h"

namespace voxray::path_trace {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Shadow rays end at this fraction of the distance to the light.
constexpr float kShadowEnd = 1.0f - 4e-6f;
/// Maximum panes that a ray crosses.
constexpr uint32_t kMaxPanes = 64;
/// Vertices before Russian roulette.
constexpr uint32_t kMinRouletteVertices = 3;

constexpr Ray kNoRay{{}, 0.0f, {0.0f, 0.0f, 1.0f}, -1.0f};

/// Sobol pairs of each vertex; the camera uses pair 0.
enum Dimension : uint32_t { kLightPoint = 1, kLightChoice, kReflection, kLobe, kRoulette, kDimensions = 8 };

}  // namespace

/// Random numbers of a path vertex.
struct Integrator::VertexSampler {
    const SobolSampler& sampler;
    uint32_t vertex;

    std::array<glm::vec2, 2> get2Dx2(Dimension a, Dimension b) const {
        return sampler.get2Dx2(vertex * kDimensions + a, vertex * kDimensions + b);
    }
    float get1D(Dimension dimension) const { return sampler.get1D(vertex * kDimensions + dimension); }
};

Integrator::Integrator(const SceneState& state, const EmbreeScene& tracer, uint32_t bounces, Strategy strategy,
                       PathLight light, ExpectedRays rays)
    : tracer_(tracer),
      surfaces_(state, rays),
      lights_(state, surfaces_),
      panes_(dimsLight(state) ? std::make_unique<const Panes>(*state.panes) : nullptr),
      bounces_(bounces),
      strategy_(strategy),
      light_(light) {}

void Integrator::updateMoving(const SceneState& state) {
    surfaces_.updateMoving();
    if (panes_) panes_ = std::make_unique<const Panes>(*state.panes);
    updateLights(state);
}

glm::vec3 Integrator::transmittance(Ray ray) const {
    glm::vec3 product(1.0f);
    for (uint32_t pane = 0; panes_ && pane < kMaxPanes; ++pane) {
        const Hit hit = panes_->tracer.closestHit(ray);
        if (hit.triangle == Hit::kMiss) break;
        const SurfaceTable& surfaces = panes_->surfaces;
        product *= surfaces.material(surfaces.triangle(hit.triangle)).transmission *
                   surfaces.pointAt(hit, glm::normalize(ray.direction)).bsdf.diffuse;
        // Step past this pane's rounding error
        ray.tMin = hit.t * (1 + 1e-5f);
    }
    return product;
}

float Integrator::hitWeight(float bsdfPdf, float lightPdf) const {
    if (strategy_ == Strategy::Mis) return misWeight(bsdfPdf, lightPdf);
    return strategy_ == Strategy::LightsOnly && lightPdf > 0.0f ? 0.0f : 1.0f;
}

/// State of a path. For each vertex: shadeHit(), addLightSample(), scatter().
class Integrator::Path {
 public:
    Path(const Integrator& integrator, const Ray& cameraRay, const SobolSampler& sampler)
        : integrator_(integrator), sampler_(sampler), ray_(cameraRay) {}

    const Ray& ray() const { return ray_; }
    /// Towards the sampled light; inactive (tMax < tMin) without one.
    const Ray& shadowRay() const { return shadowRay_; }
    const PathSample& sample() const { return sample_; }

    /// Adds light at the ray's hit, and samples a light there. @return whether the path continues with
    /// addLightSample().
    bool shadeHit(const Hit& hit);
    /// Adds the sampled light.
    void addLightSample(bool isOccluded) {
        if (shadowRay_.tMax >= shadowRay_.tMin && !isOccluded)
            add(vertex_ == 0, light_ * integrator_.transmittance(shadowRay_));
    }
    /// @return whether the path continues, along ray().
    bool scatter();

 private:
    // Adds light to the sample's components.
    void add(bool isDirect, const glm::vec3& light, float weight = 1.0f) {
        (isDirect ? sample_.direct : sample_.indirect) += throughput_ * light * weight;
        if (!isDirect) sample_.irradiance += irradianceThroughput_ * light * weight;
    }
    /// Adds a light that the ray hits at `distance`: indirect light beyond the second vertex. Panes do not
    /// absorb it where the camera sees it, directly or in mirrors.
    void addHitLight(const glm::vec3& light, float weight, float distance) {
        const bool isSeenDirectly = isSpecularBounce_ || vertex_ == 0;
        const Ray segment{ray_.origin, ray_.tMin, ray_.direction, distance};
        add(vertex_ <= 1, isSeenDirectly ? light : light * integrator_.transmittance(segment), weight);
    }
    void sampleLight();
    /// The last vertex, for which lights are sampled.
    LightTable::Receiver receiver() const { return {point_.rayOrigin(), point_.faceNormal}; }

    const Integrator& integrator_;
    const SobolSampler& sampler_;
    PathSample sample_;
    Ray ray_, shadowRay_{};
    uint32_t vertex_ = 0;
    SurfacePoint point_;
    std::array<glm::vec2, 2> u_;  ///< For a point on a light, and for a direction.
    glm::vec3 light_{0.0f};       ///< Unoccluded, along the shadow ray.
    glm::vec3 throughput_{1.0f};
    glm::vec3 irradianceThroughput_{0.0f};  ///< Throughput without the first hit's BSDF.
    float bsdfPdf_ = 0.0f;
    /// Light sampling can't find what the ray hits: after a mirror, and for camera rays.
    bool isSpecularBounce_ = true;
};

bool Integrator::Path::shadeHit(const Hit& hit) {
    const bool countsHitLight = vertex_ > 1 || integrator_.light_ == PathLight::All;
    ++sample_.rays;
    shadowRay_ = kNoRay;
    if (vertex_ == 1 && hit.triangle != Hit::kMiss) sample_.distance = hit.t;
    if (hit.triangle == Hit::kMiss) {
        const EnvironmentLight& environment = integrator_.lights_.environment();
        if (countsHitLight && !environment.isBlack()) {
            const float weight =
                isSpecularBounce_
                    ? 1.0f
                    : integrator_.hitWeight(bsdfPdf_, integrator_.lights_.environmentPdf(receiver(), ray_.direction));
            addHitLight(environment.radiance(ray_.direction), weight, hit.t);
        }
        return false;
    }
    const SurfaceTriangle triangle = integrator_.surfaces_.triangle(hit.triangle);
    if (countsHitLight && triangle.light != kNoLight && integrator_.surfaces_.emitsTowards(triangle, -ray_.direction)) {
        const float weight =
            isSpecularBounce_ ? 1.0f
                              : integrator_.hitWeight(
                                    bsdfPdf_, integrator_.lights_.hitPdf(receiver(), triangle, ray_.direction, hit.t));
        addHitLight(integrator_.surfaces_.emission(hit.triangle, hit.u, hit.v), weight, hit.t);
    }
    if (vertex_ > integrator_.bounces_) return false;

    point_ = integrator_.surfaces_.pointAt(hit, ray_.direction);
    u_ = VertexSampler{sampler_, vertex_}.get2Dx2(kLightPoint, kReflection);
    if (vertex_ == 0) sample_.hasIrradiance = maxComponent(point_.bsdf.diffuse) > 0.0f;
    if (!integrator_.lights_.empty() && (vertex_ > 0 || integrator_.light_ == PathLight::All)) sampleLight();
    return true;
}

void Integrator::Path::sampleLight() {
    const VertexSampler sampler{sampler_, vertex_};
    const LightTable::Receiver to = receiver();
    const glm::vec3& origin = to.position;
    const float uLight = integrator_.lights_.isSingle() ? 0.0f : sampler.get1D(kLightChoice);
    const LightSample light = integrator_.lights_.sample(to, uLight, u_[0]);
    if (!(light.pdf > 0.0f) || !(glm::dot(light.direction, point_.faceNormal) > 0.0f)) return;
    const BsdfValue bsdfValue = point_.bsdf.evaluate(-ray_.direction, light.direction, point_.shadingNormal);
    light_ = bsdfValue.fCos * light.radiance / light.pdf;
    if (!light.isDelta) {
        if (integrator_.strategy_ == Strategy::ReflectionOnly) return;
        if (integrator_.strategy_ == Strategy::Mis) light_ *= misWeight(light.pdf, bsdfValue.pdf);
    }
    if (!(maxComponent(light_) > 0.0f)) return;
    ++sample_.rays;
    shadowRay_ = light.isInfinite ? Ray{origin, 0.0f, light.direction, kInfinity}
                                  : Ray{origin, 0.0f, light.target - origin, kShadowEnd};
}

bool Integrator::Path::scatter() {
    if (vertex_ == integrator_.bounces_ && !integrator_.lights_.canBeHit()) return false;

    // Directions below the surface are absorbed
    const VertexSampler sampler{sampler_, vertex_};
    const float uLobe = point_.bsdf.hasSpecular() ? sampler.get1D(kLobe) : 0.0f;
    const BsdfSample next = point_.bsdf.sample(-ray_.direction, point_.shadingNormal, u_[1], uLobe);
    throughput_ *= next.weight;
    if (vertex_ > 0)
        irradianceThroughput_ *= next.weight;
    else if (next.pdf > 0.0f)
        irradianceThroughput_ = glm::vec3(glm::dot(point_.shadingNormal, next.direction) / next.pdf);
    const float maxThroughput = maxComponent(throughput_);
    if (!(maxThroughput > 0.0f) || !(glm::dot(next.direction, point_.faceNormal) > 0.0f)) return false;

    // Russian roulette by the square root of the throughput: shorter paths, more noise, the same mean
    if (vertex_ + 1 >= kMinRouletteVertices && maxThroughput < 1.0f) {
        const float survival = std::sqrt(maxThroughput);
        if (sampler.get1D(kRoulette) >= survival) return false;
        throughput_ /= survival;
        irradianceThroughput_ /= survival;
    }
    ray_ = {point_.rayOrigin(), 0.0f, next.direction, kInfinity};
    bsdfPdf_ = next.pdf;
    isSpecularBounce_ = next.isMirror;
    ++vertex_;
    return true;
}

void Integrator::trace(std::span<const Ray> cameraRays, std::span<const SobolSampler> samplers,
                       std::span<PathSample> samples) const {
    // First hits of adjacent pixels are coherent, and so are their shadow rays to one light
    const size_t count = cameraRays.size();
    std::array<Hit, kPacket> hits;
    tracer_.closestHitPacket(cameraRays, std::span(hits).first(count));
    surfaces_.prefetch(std::span(hits).first(count));
    std::array<std::optional<Path>, kPacket> paths;
    std::array<bool, kPacket> isAlive{};
    std::array<Ray, kPacket> shadows;
    std::array<uint32_t, kPacket> occluded;
    bool hasShadows = false;
    for (size_t i = 0; i < count; ++i) {
        paths[i].emplace(*this, cameraRays[i], samplers[i]);
        isAlive[i] = paths[i]->shadeHit(hits[i]);
        shadows[i] = paths[i]->shadowRay();
        hasShadows = hasShadows || shadows[i].tMax >= shadows[i].tMin;
    }
    if (hasShadows) tracer_.occludedPacket(std::span(shadows).first(count), std::span(occluded).first(count));
    for (size_t i = 0; i < count; ++i)
        if (isAlive[i]) paths[i]->addLightSample(occluded[i] != 0);

    // Later rays are incoherent. All paths take a step before the next one, so that they wait for memory together
    for (bool goesOn = true; goesOn;) {
        goesOn = false;
        for (size_t i = 0; i < count; ++i) {
            isAlive[i] = isAlive[i] && paths[i]->scatter();
            hits[i] = isAlive[i] ? tracer_.closestHit(paths[i]->ray()) : Hit{0.0f, Hit::kMiss, 0.0f, 0.0f};
            goesOn = goesOn || isAlive[i];
        }
        surfaces_.prefetch(std::span(hits).first(count));
        for (size_t i = 0; i < count; ++i) isAlive[i] = isAlive[i] && paths[i]->shadeHit(hits[i]);
        for (size_t i = 0; i < count; ++i) {
            if (!isAlive[i]) continue;
            const Ray& shadow = paths[i]->shadowRay();
            if (shadow.tMax >= shadow.tMin) paths[i]->addLightSample(tracer_.occluded(shadow));
        }
    }
    for (size_t i = 0; i < count; ++i) samples[i] = paths[i]->sample();
}

}  // namespace voxray::path_trace
