#include "passes/path_trace/integrator.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "scene/panes.h"

namespace voxray::path_trace {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Shadow rays end this part of their way before the light.
constexpr float kShadowEnd = 1.0f - 4e-6f;
/// Panes that one ray crosses, at most.
constexpr uint32_t kMaxPanes = 64;
/// Vertices before Russian roulette starts.
constexpr uint32_t kSureVertices = 3;

constexpr Ray kNoRay{{}, 0.0f, {0.0f, 0.0f, 1.0f}, -1.0f};

/// What each vertex draws numbers for; the camera uses number 0.
enum Use : uint32_t { kLightPoint = 1, kLightChoice, kReflection, kLobe, kRoulette, kUses = 8 };

}  // namespace

/// The numbers of one vertex of a path.
struct Integrator::VertexSampler {
    const SobolSampler& sampler;
    uint32_t vertex;

    std::array<glm::vec2, 2> pairs(Use a, Use b) const {
        return sampler.pairs(vertex * kUses + a, vertex * kUses + b);
    }
    float one(Use use) const { return sampler.one(vertex * kUses + use); }
};

Integrator::Integrator(const SceneState& state, const EmbreeScene& tracer, uint32_t bounces,
                       Strategy strategy, PathLight light, RaysToCome rays)
    : tracer_(tracer),
      surfaces_(state, rays),
      lights_(state, surfaces_),
      panes_(dimsLight(state) ? std::make_unique<const Panes>(*state.panes) : nullptr),
      bounces_(bounces),
      strategy_(strategy),
      light_(light) {}

glm::vec3 Integrator::transmittance(Ray ray) const {
    glm::vec3 all(1.0f);
    for (uint32_t pane = 0; panes_ && pane < kMaxPanes; ++pane) {
        const Hit hit = panes_->tracer.closestHit(ray);
        if (hit.triangle == Hit::kMiss) break;
        const SurfaceTable& surfaces = panes_->surfaces;
        all *= surfaces.material(surfaces.triangle(hit.triangle)).transmission *
               surfaces.at(hit, glm::normalize(ray.direction)).bsdf.diffuse;
        // The next one is farther by more than a distance rounds off.
        ray.tMin = hit.t * (1 + 1e-5f);
    }
    return all;
}

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

/// A path on its way. For each vertex: arrive() at a hit, addLight() of it, scatter() on.
class Integrator::Path {
 public:
    Path(const Integrator& integrator, const Ray& cameraRay, const SobolSampler& sampler)
        : in_(integrator), sampler_(sampler), ray_(cameraRay) {}

    const Ray& ray() const { return ray_; }
    /// To the light that was drawn; tMax < tMin where none is.
    const Ray& shadowRay() const { return shadow_; }
    const PathSample& sample() const { return path_; }

    /// Adds what the ray runs into, and draws a light. @return whether the path goes on to addLight().
    bool arrive(const Hit& hit);
    /// Adds what the light that was drawn sends here.
    void addLight(bool isOccluded) {
        if (shadow_.tMax >= shadow_.tMin && !isOccluded)
            add(vertex_ == 0, light_ * in_.transmittance(shadow_));
    }
    /// @return whether the path goes on, along ray().
    bool scatter();

 private:
    // Light that reaches the path here or that it runs into. Beyond the second vertex the latter is indirect.
    void add(bool isDirect, const glm::vec3& light, float weight = 1.0f) {
        (isDirect ? path_.direct : path_.indirect) += throughput_ * light * weight;
        if (!isDirect) path_.irradiance += irradianceThroughput_ * light * weight;
    }
    /// Light that the ray runs into `distance` away. What the camera sees, in mirrors too, panes leave as it
    /// is.
    void addFound(const glm::vec3& light, float weight, float distance) {
        const bool isSeen = isMirrored_ || vertex_ == 0;
        const Ray way{ray_.origin, ray_.tMin, ray_.direction, distance};
        add(vertex_ <= 1, isSeen ? light : light * in_.transmittance(way), weight);
    }
    void drawLight();

    const Integrator& in_;
    const SobolSampler& sampler_;
    PathSample path_;
    Ray ray_, shadow_{};
    uint32_t vertex_ = 0;
    SurfacePoint point_;
    std::array<glm::vec2, 2> places_;  ///< Random numbers for a point of a light and for a direction.
    glm::vec3 light_{0.0f};            ///< That the shadow ray brings unless something is in its way.
    glm::vec3 throughput_{1.0f};
    glm::vec3 irradianceThroughput_{0.0f};  ///< The same with the first hit's reflection left out.
    float reflectionPdf_ = 0.0f;
    bool isMirrored_ =
        true;  ///< The camera, as a mirror, has no density: only the ray itself finds what it sees.
};

bool Integrator::Path::arrive(const Hit& hit) {
    const bool wantsFound = vertex_ > 1 || in_.light_ == PathLight::All;
    ++path_.rays;
    shadow_ = kNoRay;
    if (vertex_ == 1 && hit.triangle != Hit::kMiss) path_.distance = hit.t;
    if (hit.triangle == Hit::kMiss) {
        const EnvironmentLight& environment = in_.lights_.environment();
        if (wantsFound && !environment.isBlack()) {
            const float weight =
                isMirrored_ ? 1.0f
                            : in_.weightOfHit(reflectionPdf_, in_.lights_.pdfOfEnvironment(ray_.direction));
            addFound(environment.radiance(ray_.direction), weight, hit.t);
        }
        return false;
    }
    const SurfaceTriangle triangle = in_.surfaces_.triangle(hit.triangle);
    if (wantsFound && triangle.light != kNoLight && in_.surfaces_.emitsTowards(triangle, -ray_.direction)) {
        const float weight =
            isMirrored_
                ? 1.0f
                : in_.weightOfHit(reflectionPdf_, in_.lights_.pdfOfHit(triangle, ray_.direction, hit.t));
        addFound(in_.surfaces_.emission(hit.triangle, hit.u, hit.v), weight, hit.t);
    }
    if (vertex_ > in_.bounces_) return false;

    point_ = in_.surfaces_.at(hit, ray_.direction);
    places_ = VertexSampler{sampler_, vertex_}.pairs(kLightPoint, kReflection);
    if (vertex_ == 0) path_.hasIrradiance = maxComponent(point_.bsdf.diffuse) > 0.0f;
    if (!in_.lights_.empty() && (vertex_ > 0 || in_.light_ == PathLight::All)) drawLight();
    return true;
}

void Integrator::Path::drawLight() {
    const VertexSampler sampler{sampler_, vertex_};
    const glm::vec3 origin = point_.rayOrigin();
    const float choice = in_.lights_.isSingle() ? 0.0f : sampler.one(kLightChoice);
    const LightSample light = in_.lights_.sample(origin, choice, places_[0]);
    if (!(light.pdf > 0.0f) || !(glm::dot(light.direction, point_.faceNormal) > 0.0f)) return;
    const BsdfValue reflection = point_.bsdf.evaluate(-ray_.direction, light.direction, point_.shadingNormal);
    light_ = reflection.fCos * light.radiance / light.pdf;
    if (!light.isDelta) {
        if (in_.strategy_ == Strategy::ReflectionOnly) return;
        if (in_.strategy_ == Strategy::Mis) light_ *= misWeight(light.pdf, reflection.pdf);
    }
    if (!(maxComponent(light_) > 0.0f)) return;
    ++path_.rays;
    shadow_ = light.isInfinite ? Ray{origin, 0.0f, light.direction, kInfinity}
                               : Ray{origin, 0.0f, light.target - origin, kShadowEnd};
}

bool Integrator::Path::scatter() {
    if (vertex_ == in_.bounces_ && !in_.lights_.canBeHit()) return false;

    // Rays that a shading normal sends below the surface are lost.
    const VertexSampler sampler{sampler_, vertex_};
    const float lobe = point_.bsdf.hasSpecular() ? sampler.one(kLobe) : 0.0f;
    const BsdfSample next = point_.bsdf.sample(-ray_.direction, point_.shadingNormal, places_[1], lobe);
    throughput_ *= next.weight;
    if (vertex_ > 0)
        irradianceThroughput_ *= next.weight;
    else if (next.pdf > 0.0f)
        irradianceThroughput_ = glm::vec3(glm::dot(point_.shadingNormal, next.direction) / next.pdf);
    const float strength = maxComponent(throughput_);
    if (!(strength > 0.0f) || !(glm::dot(next.direction, point_.faceNormal) > 0.0f)) return false;

    // Russian roulette by the root of the throughput: shorter paths, more noise; the mean stays.
    if (vertex_ + 1 >= kSureVertices && strength < 1.0f) {
        const float survival = std::sqrt(strength);
        if (sampler.one(kRoulette) >= survival) return false;
        throughput_ /= survival;
        irradianceThroughput_ /= survival;
    }
    ray_ = {point_.rayOrigin(), 0.0f, next.direction, kInfinity};
    reflectionPdf_ = next.pdf;
    isMirrored_ = next.mirror;
    ++vertex_;
    return true;
}

void Integrator::trace(std::span<const Ray> cameraRays, std::span<const SobolSampler> samplers,
                       std::span<PathSample> samples) const {
    // The first hits of neighbours lie close together, and so do the rays from there to one light.
    const size_t count = cameraRays.size();
    std::array<Hit, kPacket> hits;
    tracer_.closestHitPacket(cameraRays, std::span(hits).first(count));
    std::array<std::optional<Path>, kPacket> paths;
    std::array<bool, kPacket> goesOn;
    std::array<Ray, kPacket> shadows;
    std::array<uint32_t, kPacket> occluded;
    bool hasShadows = false;
    for (size_t i = 0; i < count; ++i) {
        paths[i].emplace(*this, cameraRays[i], samplers[i]);
        goesOn[i] = paths[i]->arrive(hits[i]);
        shadows[i] = paths[i]->shadowRay();
        hasShadows = hasShadows || shadows[i].tMax >= shadows[i].tMin;
    }
    if (hasShadows) tracer_.occludedPacket(std::span(shadows).first(count), std::span(occluded).first(count));

    // From there on they part.
    for (size_t i = 0; i < count; ++i) {
        Path& path = *paths[i];
        if (goesOn[i]) {
            path.addLight(occluded[i] != 0);
            while (path.scatter() && path.arrive(tracer_.closestHit(path.ray()))) {
                const Ray& shadow = path.shadowRay();
                if (shadow.tMax >= shadow.tMin) path.addLight(tracer_.occluded(shadow));
            }
        }
        samples[i] = path.sample();
    }
}

}  // namespace voxray::path_trace
