#include "passes/probes/update_probes/probe_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 16;  ///< Bounds what a batch takes to 12 MiB, light at its hits included.

/// Uniform over all rotations (Shoemake 1992).
glm::quat randomRotation(uint32_t seed) {
    std::mt19937 bits(seed);
    const auto random = [&] { return float(bits() >> 8) * 0x1p-24f; };
    const float u = random(), a = 2 * std::numbers::pi_v<float> * random(),
                b = 2 * std::numbers::pi_v<float> * random();
    const float r = std::sqrt(1 - u), s = std::sqrt(u);
    return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

/// Spherical Fibonacci set (Keinert et al. 2015).
glm::vec3 fibonacciDirection(uint32_t i, uint32_t count) {
    const double turn = std::fmod(double(i) * (std::numbers::phi - 1), 1.0) * 2 * std::numbers::pi;
    const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z);
    return {float(r * std::cos(turn)), float(r * std::sin(turn)), float(z)};
}

}  // namespace

ProbeRays::ProbeRays(ProgramOwner& owner) : generate_(owner, "generate_probe_rays.comp") {}

void ProbeRays::plan(PassPlan& plan, uint32_t raysPerProbe, uint32_t maxProbes) {
    raysPerProbe_ = raysPerProbe;
    batchProbes_ = std::clamp(kBatchRays / raysPerProbe, 1u, maxProbes);
    plan.buffer(list_, "list of probes", maxProbes * sizeof(uint32_t));
    plan.buffer(directions_, "directions of probe rays", raysPerProbe * sizeof(glm::vec3));
    plan.buffer(rays_, "probe rays", batchRays() * sizeof(Ray));
    plan.buffer(hits_, "hits of probe rays", batchRays() * sizeof(Hit));
}

void ProbeRays::setList(CommandStream& stream, const std::vector<uint32_t>& list) {
    listed_ = uint32_t(list.size());
    if (listed_ > 0) stream.upload(list_, list);
}

void ProbeRays::trace(PassContext& context, const Probes& probes, uint32_t seed,
                      const std::function<void(const ProbeBatch&)>& use) {
    const glm::quat rotation = seed == 0 ? glm::quat(1, 0, 0, 0) : randomRotation(seed);
    std::vector<glm::vec3> directions;
    for (uint32_t i = 0; i < raysPerProbe_; ++i)
        directions.push_back(glm::normalize(rotation * fibonacciDirection(i, raysPerProbe_)));
    context.stream.upload(directions_, directions);
    for (uint32_t first = 0; first < listed_; first += batchProbes_) {
        const uint32_t count = std::min(batchProbes_, listed_ - first);
        const ProbeBatch batch{first, count, count * raysPerProbe_};
        context.dispatch(generate_, batch.rays,
                         {probes,
                          {"list", list_},
                          {"directions", directions_},
                          {"rays", rays_},
                          {"first", first},
                          {"rayCount", batch.rays},
                          {"raysPerProbe", raysPerProbe_}});
        context.tracer.closestHit(context.stream, rays_, hits_, batch.rays);
        use(batch);
    }
}

std::vector<Binding> ProbeRays::bindings() const {
    return {ifUsed({"list", list_}), ifUsed({"directions", directions_}), ifUsed({"rays", rays_}),
            ifUsed({"hits", hits_}), ifUsed({"raysPerProbe", raysPerProbe_})};
}

}  // namespace voxray
