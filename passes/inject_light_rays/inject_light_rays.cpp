#include "passes/inject_light_rays/inject_light_rays.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "passes/common/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays, hits and what they carry to 100 MiB.
constexpr float kPi = 3.14159265f;
enum SourceKind : uint32_t { kPunctual = 0, kEmitters = 1, kEnvironment = 2 };  // As in emit.comp.

struct EmitPush {
    uint32_t kind;
    uint32_t light;
    uint32_t firstRay;
    uint32_t batchRays;
    uint32_t totalRays;
    uint32_t seed;
    uint32_t emitterCount;
    glm::vec3 sceneCentre;
    float sceneRadius;
};

struct ExposePush {
    uint32_t batchRays;
    float voxelSize;
};

struct DepositPush {
    gpu::VoxelGrid grid;
    uint32_t firstRay;
    uint32_t batchRays;
    uint32_t seed;
    uint32_t bounce;
    uint32_t lastBounce;
    float unitsPerWatt;
};

struct ResolvePush {
    uint32_t count;
    float wattsPerUnit;
};

uint64_t fluxValues(uint32_t voxels) {
    return uint64_t(voxels) * kFluxFloats;
}

float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

// The sphere round the scene, from which parallel light and the environment shine.
float sceneRadius(const Geometry& g) {
    return 0.5f * glm::length(g.boundsMax - g.boundsMin) * 1.001f + 1e-6f;
}

}  // namespace

void InjectLightRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectLightRays::plan(PassPlan& plan) {
    if (!plan.device.shaderInt64Atomics)
        throw Error(
            "inject_light_rays: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)",
            plan.device.name);
    const uint64_t batch = std::min(params_.raysPerLight, kBatchRays);
    plan.reserve("rays", batch * (2 * sizeof(Ray) + sizeof(Hit) + 4 * sizeof(float) + sizeof(uint32_t)));
    const uint64_t values = fluxValues(plan.get(voxels_).voxelCount);
    plan.reserve("irradiance (estimated)",
                 (2 * values + uint64_t(plan.get(voxels_).voxelCount) * kAreaFloats) * sizeof(float));
    plan.reserve("sums (estimated)", 2 * values * sizeof(uint64_t));
}

void InjectLightRays::prepare(PassSetup& setup) {
    const uint64_t batch = std::min(params_.raysPerLight, kBatchRays);
    rays_ = Buffer(setup.device, "light rays", batch * sizeof(Ray));
    hits_ = Buffer(setup.device, "light ray hits", batch * sizeof(Hit));
    carried_ = Buffer(setup.device, "light ray flux", batch * 4 * sizeof(float));
    exposureRays_ = Buffer(setup.device, "exposure rays", batch * sizeof(Ray));
    hidden_ = Buffer(setup.device, "exposure results", batch * sizeof(uint32_t));
    expose_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_light_rays/expose.comp"));
    emit_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_light_rays/emit.comp"));
    deposit_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_light_rays/deposit.comp"));
    exposedArea_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/common/exposed_area.comp"));
    resolve_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_light_rays/resolve.comp"));
}

std::vector<InjectLightRays::Source> InjectLightRays::sources(const Frame& frame,
                                                              const GpuScene& scene) const {
    std::vector<Source> all;
    const SceneState& state = *frame.scene;
    const float disc = kPi * sceneRadius(state.geometry) * sceneRadius(state.geometry);
    for (uint32_t i = 0; i < state.lights.size(); ++i) {
        const Light& light = state.lights[i];
        const float solidAngleOrArea = light.type == LightType::Point ? 4 * kPi
                                       : light.type == LightType::Spot
                                           ? 2 * kPi * (1 - std::cos(light.outerConeAngle))
                                           : disc;
        all.push_back({kPunctual, i, largest(light.intensity) * solidAngleOrArea});
    }
    if (scene.emitterCount > 0) {
        float power = 0;
        const Geometry& g = state.geometry;
        for (size_t t = 0; t < g.triangles.size(); ++t) {
            const Material& m = state.scene->materials[g.triangleMaterials[t]];
            const glm::uvec3 v = g.triangles[t];
            const glm::vec3 cross =
                glm::cross(g.positions[v.y] - g.positions[v.x], g.positions[v.z] - g.positions[v.x]);
            power += largest(m.emission) * 0.5f * glm::length(cross) * kPi * (m.doubleSided ? 2.0f : 1.0f);
        }
        all.push_back({kEmitters, 0, power});
    }
    if (scene.hasEnvironment) {
        const Environment& e = state.scene->environment;
        float peak = 1;
        if (e.map) peak = *std::max_element(e.map->data.begin(), e.map->data.end());
        all.push_back({kEnvironment, 0, largest(e.radiance) * peak * 4 * kPi * disc});
    }
    return all;
}

void InjectLightRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    CommandStream& stream = context.stream;
    const uint64_t values = fluxValues(voxels.voxelCount);
    irradiance.direct = Buffer(context.device, "voxel direct flux", values * sizeof(float));
    irradiance.indirect = Buffer(context.device, "voxel indirect flux", values * sizeof(float));
    irradiance.area =
        Buffer(context.device, "voxel area", uint64_t(voxels.voxelCount) * kAreaFloats * sizeof(float));
    stream.dispatch(exposedArea_, {{"voxelMaterials", voxels.materials}, {"area", irradiance.area}},
                    voxels.voxelCount, linearGroups(voxels.voxelCount));
    const Buffer directSums(context.device, "direct flux sums", values * sizeof(uint64_t));
    const Buffer indirectSums(context.device, "indirect flux sums", values * sizeof(uint64_t));
    stream.fill(directSums, 0);
    stream.fill(indirectSums, 0);
    stream.fill(hidden_, 0);

    // Units of the fixed-point sums: all light in one voxel, bounced up to 64 times, stays below 2^63.
    const std::vector<Source> lights = sources(context.frame, context.scene);
    double power = 0;
    for (const Source& source : lights) power += source.power;
    const float unitsPerWatt = power > 0 ? float(std::ldexp(1.0, 56) / power) : 0.0f;

    const Geometry& geometry = context.frame.scene->geometry;
    for (uint32_t s = 0; s < lights.size(); ++s) {
        for (uint32_t first = 0; first < params_.raysPerLight; first += kBatchRays) {
            // Send a batch of the light's rays.
            const uint32_t batch = std::min(kBatchRays, params_.raysPerLight - first);
            const uint32_t seed = uint32_t(context.frame.seed * 0x9e3779b9u) + s * 0x85ebca6bu;
            stream.dispatch(emit_, context.scene.bindings({{"rays", rays_}, {"carried", carried_}}),
                            EmitPush{lights[s].kind, lights[s].light, first, batch, params_.raysPerLight,
                                     seed, context.scene.emitterCount,
                                     0.5f * (geometry.boundsMin + geometry.boundsMax), sceneRadius(geometry)},
                            linearGroups(batch));

            // Trace, deposit, bounce.
            for (uint32_t bounce = 0; bounce <= params_.bounces; ++bounce) {
                context.tracer.closestHit(stream, rays_, hits_, batch);
                if (voxels.exposedOnly) {
                    stream.dispatch(expose_,
                                    context.scene.bindings(
                                        {{"rays", rays_}, {"hits", hits_}, {"exposureRays", exposureRays_}}),
                                    ExposePush{batch, voxels.grid.voxelSize}, linearGroups(batch));
                    context.tracer.occluded(stream, exposureRays_, hidden_, batch);
                }
                stream.dispatch(
                    deposit_,
                    context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                            {"voxelRank", voxels.rank},
                                            {"rays", rays_},
                                            {"hits", hits_},
                                            {"carried", carried_},
                                            {"hidden", hidden_},
                                            {"sums", bounce == 0 ? directSums : indirectSums}}),
                    DepositPush{voxels.grid, first, batch, seed, bounce, params_.bounces, unitsPerWatt},
                    linearGroups(batch));
            }
        }
    }

    // Fixed point to watts.
    const float wattsPerUnit = unitsPerWatt > 0 ? 1.0f / unitsPerWatt : 0.0f;
    stream.dispatch(resolve_, {{"sums", directSums}, {"flux", irradiance.direct}},
                    ResolvePush{uint32_t(values), wattsPerUnit}, linearGroups(values));
    stream.dispatch(resolve_, {{"sums", indirectSums}, {"flux", irradiance.indirect}},
                    ResolvePush{uint32_t(values), wattsPerUnit}, linearGroups(values));
    stream.finish();
}

}  // namespace voxray
