// Ways to find virtual point lights that matter to what the camera sees: those that paths of light leave,
// some chosen out of many of these, cuts through a tree of them, and points that rays from what the camera
// sees hit.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "passes/common/lights/light_sources.h"
#include "passes/vpls/select_vpls/systematic_resampling.h"
#include "tests/bench/light_rays.h"
#include "tests/bench/light_tree.h"

namespace voxray {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr size_t kTexels = 256;  // That errors are measured at.
constexpr size_t kCandidates = 32768;
constexpr size_t kRightLights = 131072;
constexpr int kSeeds = 4;

/// One bounce of a scene's first light, point or directional, with all surfaces white: what counts is where
/// virtual lights are.
class OneBounce {
 public:
    explicit OneBounce(const std::string& scene)
        : chain_(litScene(scene, 16)), geometry_(chain_->state().geometry), embree_(chain_->state()) {
        const GBuffer& gbuffer = *chain_->graph().resource<GBuffer>("gbuffer");
        const auto positions = chain_->readImage<glm::vec4>(gbuffer.position);
        const auto normals = chain_->readImage<glm::u16vec4>(gbuffer.geometricNormal);
        for (size_t i = 0; i < positions.size(); ++i)
            if (positions[i].w > 0)
                seen_.push_back({glm::vec3(positions[i]), glm::normalize(glm::vec3(glm::unpackHalf(normals[i]))), 0});
    }

    const std::vector<LightPoint>& seen() const { return seen_; }
    /// m²: a bound on squared distances as gather_vpls has it for so many paths, the same for all ways.
    void setBound(size_t paths) { bound_ = surfaceArea(geometry_) / (kPi * double(paths)); }
    double bound() const { return bound_; }

    std::vector<LightPoint> lightPaths(size_t count, std::mt19937& random) const {
        const Light& light = chain_->state().lights.at(0);
        const BoundingSphere sphere = boundingSphere(geometry_);
        std::vector<LightPoint> points;
        for (size_t i = 0; i < count; ++i) {
            Ray ray{light.position, 0, direction(random), 1e30f};
            double power = 4 * kPi * double(light.intensity.y);
            if (light.type == LightType::Directional) {
                const glm::vec3 on = sphere.radius * disc(random, light.direction);
                ray = {sphere.center - sphere.radius * light.direction + on, 0, light.direction, 1e30f};
                power = kPi * double(sphere.radius * sphere.radius * light.intensity.y);
            }
            LightPoint at;
            if (hit(ray, at)) points.push_back({at.position, at.normal, power / double(count)});
        }
        return points;
    }

    /// Points that rays by cosine from random texels hit. What reaches a point directly it reflects; its
    /// density is the mean of what one watt there would bring to texels, were it unbounded, of `tried` of
    /// them.
    std::vector<LightPoint> cameraPoints(size_t count, size_t tried, std::mt19937& random) const {
        const Light& light = chain_->state().lights.at(0);
        std::vector<LightPoint> points;
        for (size_t i = 0; i < count; ++i) {
            const LightPoint& from = seen_[random() % seen_.size()];
            LightPoint at;
            const glm::vec3 way = glm::normalize(from.normal + 0.9999f * direction(random));
            if (!hit({raised(from), 0, way, 1e30f}, at)) continue;
            const bool isSun = light.type == LightType::Directional;
            const glm::vec3 to = isSun ? -light.direction * 1e4f : light.position - raised(at);
            const float distance_ = glm::length(to);
            const double cosine = double(glm::dot(at.normal, to) / distance_);
            if (cosine <= 0 || embree_.occluded({raised(at), 0, to, isSun ? 1e6f : 1})) continue;
            const double arrives = double(light.intensity.y) * cosine / (isSun ? 1 : double(distance_ * distance_));
            at.flux = 1;
            // The texel that the ray comes from is one of those tried
            double density = arriving(from, at, 0);
            for (size_t t = 1; t < tried; ++t) {
                const LightPoint& texel = seen_[random() % seen_.size()];
                const double brought = arriving(texel, at, 0);
                if (brought > 0 && sees(texel, at)) density += brought;
            }
            at.flux = arrives * double(tried) / (density * double(count));
            points.push_back(at);
        }
        return points;
    }

    /// Irradiance from a point, W/m², were nothing in the way.
    double arriving(const LightPoint& texel, const LightPoint& from, double bound) const {
        const glm::dvec3 way = from.position - texel.position;
        const double squared = glm::dot(way, way);
        const double cosines = glm::dot(glm::dvec3(texel.normal), way) * -glm::dot(glm::dvec3(from.normal), way);
        if (glm::dot(glm::dvec3(texel.normal), way) <= 0 || cosines <= 0) return 0;
        return from.flux * cosines / (squared * kPi * std::max(squared, bound));
    }
    bool sees(const LightPoint& texel, const LightPoint& from) const {
        ++rays;
        return !embree_.occluded({raised(texel), 0, raised(from) - raised(texel), 1});
    }
    double irradiance(const LightPoint& texel, const std::vector<LightPoint>& points) const {
        double sum = 0;
        for (const LightPoint& p : points) {
            const double brought = arriving(texel, p, bound_);
            if (brought > 0 && sees(texel, p)) sum += brought;
        }
        return sum;
    }

    mutable size_t rays = 0;  ///< Shadow rays so far.

 private:
    static glm::vec3 direction(std::mt19937& random) {
        std::normal_distribution<float> normal;
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    }
    static glm::vec3 disc(std::mt19937& random, glm::vec3 axis) {
        std::uniform_real_distribution<float> uniform(-1, 1);
        const glm::vec3 u = glm::normalize(std::abs(axis.x) < 0.5f ? glm::cross(axis, glm::vec3(1, 0, 0))
                                                                   : glm::cross(axis, glm::vec3(0, 1, 0)));
        glm::vec2 p(1);
        while (glm::dot(p, p) > 1) p = {uniform(random), uniform(random)};
        return p.x * u + p.y * glm::cross(axis, u);
    }
    static glm::vec3 raised(const LightPoint& p) { return p.position + 1e-4f * p.normal; }
    bool hit(const Ray& ray, LightPoint& at) const {
        const Hit h = embree_.closestHit(ray);
        if (h.triangle == Hit::kMiss) return false;
        const glm::uvec3 t = geometry_.triangles[h.triangle];
        const glm::vec3 a = geometry_.positions[t.x];
        at.normal = glm::normalize(glm::cross(geometry_.positions[t.y] - a, geometry_.positions[t.z] - a));
        if (glm::dot(at.normal, ray.direction) > 0) at.normal = -at.normal;
        at.position = ray.origin + h.t * ray.direction;
        return true;
    }

    std::unique_ptr<test::Chain> chain_;
    const Geometry& geometry_;
    EmbreeScene embree_;
    std::vector<LightPoint> seen_;
    double bound_ = 0;
};

/// Those that stay of many, each tried on `tried` random texels, a tenth of them by flux alone (select_vpls).
std::vector<LightPoint> chosen(const OneBounce& scene, const std::vector<LightPoint>& points, size_t count,
                               size_t tried, std::mt19937& random) {
    std::vector<double> brings(points.size()), probabilities(points.size());
    for (size_t i = 0; i < points.size(); ++i)
        for (size_t t = 0; t < tried; ++t) {
            const LightPoint& texel = scene.seen()[random() % scene.seen().size()];
            const double brought = scene.arriving(texel, points[i], scene.bound());
            if (brought > 0 && scene.sees(texel, points[i])) brings[i] += brought;
        }
    const double sum = std::accumulate(brings.begin(), brings.end(), 0.0);
    for (size_t i = 0; i < points.size(); ++i) probabilities[i] = 0.9 * brings[i] / sum + 0.1 / double(points.size());
    const Resampled kept = systematicResampling(probabilities, uint32_t(count), double(random() % 1024) / 1024);
    std::vector<LightPoint> stay;
    for (size_t i = 0; i < kept.indices.size(); ++i) {
        stay.push_back(points[kept.indices[i]]);
        stay.back().flux *= double(kept.weights[i]);
    }
    return stay;
}

/// nRMSE and mean ratio of irradiance at random texels, the mean over a few seeds, with some 1024 shadow rays
/// of each texel; and shadow rays before the first texel. 0: paths of light. 1: chosen of 32768. 2: cuts
/// through a tree of 32768. 3 and 4: points that rays from texels hit, their density by 32 or by 1024 texels.
void vplSchemes(benchmark::State& state, const std::string& name) {
    constexpr size_t kLights = 1024;
    OneBounce scene(name);
    scene.setBound(kLights);
    std::mt19937 random(1);
    std::vector<LightPoint> texels;
    while (texels.size() < kTexels) texels.push_back(scene.seen()[random() % scene.seen().size()]);
    const std::vector<LightPoint> many = scene.lightPaths(kRightLights, random);
    std::vector<double> right;
    for (const LightPoint& texel : texels) right.push_back(scene.irradiance(texel, many));
    const double mean = std::accumulate(right.begin(), right.end(), 0.0) / double(kTexels);

    double squared = 0, sum = 0;
    size_t before = 0, rays = 0;
    for (auto _ : state)
        for (int seed = 0; seed < kSeeds; ++seed) {
            std::mt19937 numbers(uint32_t(100 + seed));
            scene.rays = 0;
            const size_t paths = state.range(0) == 1 || state.range(0) == 2 ? kCandidates : kLights;
            std::vector<LightPoint> points =
                state.range(0) < 3 ? scene.lightPaths(paths, numbers)
                                   : scene.cameraPoints(kLights, state.range(0) == 3 ? 32 : 1024, numbers);
            if (state.range(0) == 1) points = chosen(scene, points, kLights, 32, numbers);
            std::optional<LightTree> tree;
            if (state.range(0) == 2) tree.emplace(std::move(points), numbers);
            before += scene.rays;
            for (size_t i = 0; i < kTexels; ++i) {
                scene.rays = 0;
                const double found =
                    tree ? tree->irradiance(scene, texels[i], kLights, 0.02) : scene.irradiance(texels[i], points);
                rays += scene.rays;
                squared += (found - right[i]) * (found - right[i]);
                sum += found;
            }
        }
    const double samples = double(kSeeds) * double(kTexels);
    state.counters["nRMSE"] = std::sqrt(squared / samples) / mean;
    state.counters["mean_ratio"] = sum / samples / mean;
    state.counters["rays_a_texel"] = double(rays) / samples;
    state.counters["rays_before"] = double(before) / kSeeds;
}

#define VPL_SCHEMES(scene)                       \
    BENCHMARK_CAPTURE(vplSchemes, scene, #scene) \
        ->ArgName("scheme")                      \
        ->DenseRange(0, 4)                       \
        ->Iterations(1)                          \
        ->Unit(benchmark::kMillisecond)
VPL_SCHEMES(sponza);
VPL_SCHEMES(sibenik);
VPL_SCHEMES(conference);
VPL_SCHEMES(cornell);

}  // namespace
}  // namespace voxray
