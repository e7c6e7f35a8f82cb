#include "passes/light_clipmap/light_clipmap.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_tint.h"

namespace voxray {
namespace {

constexpr uint64_t kLitAreaBytes = kFaces * sizeof(uint32_t);

struct WindowPush {
    gpu::VoxelGrid grid;
    glm::ivec3 boxFirst;
    glm::uvec3 boxSize;
    uint32_t level;
};

}  // namespace

void LightClipmap::declare(PassBuilder& builder) {
    clipmap_ = builder.read<ClipmapVoxels>("clipmap", "surface voxels to light");
    radiance_ = builder.write<RadianceVoxels>("radiance", "light that leaves them, at all scales");
}

void LightClipmap::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    if (!plan.device.shaderInt64Atomics)
        throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", kName,
                    plan.device.name);
    sources_ = requireViewpoints(*plan.frame.scene, kName);
    const ClipmapVoxels& clipmap = plan.get(clipmap_);
    RadianceVoxels& radiance = plan.get(radiance_);
    radiance.lightBounces = params_.bounces + 1;
    radiance.layout = RadianceLayout(params_.layout);
    radiance.euclidean = params_.levelDistance == LevelDistance::Euclidean;
    radiance.grid = clipmap.grid;
    radiance.grid.unit = radianceUnit(*plan.frame.scene);
    storage_ = RadianceClipmap(clipmap.grid, clipmap.windows.side());
    storage_.plan(plan, kName, radiance);
    shadowMaps_.plan(plan, sources_, params_.shadowResolution);

    // One level at a time; with bounces all of them
    uint64_t largest = 0, sum = 0;
    for (const ClipmapVoxels::Level& level : clipmap.levels) {
        largest = std::max<uint64_t>(largest, level.voxels.voxelCount);
        sum += level.voxels.voxelCount;
    }
    plan.reserveScratch("light of a level (estimated)",
                        largest * (FluxAccumulator::kBytesPerVoxel + kLitAreaBytes));
    plan.reserveScratch("irradiance (estimated)",
                        VoxelIrradiance::bytes(uint32_t(params_.bounces > 0 ? sum : largest)));
    if (params_.bounces > 0) bounces_.plan(plan, sum, false);
    walk_->plan(plan, clipmap.levels[0].voxels.grid);
}

void LightClipmap::prepare(PassSetup& setup) {
    RadianceVoxels& radiance = setup.get(radiance_);
    storage_.prepare(setup, radiance);
    shadowMaps_.prepare(setup);
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    walk_->prepare(setup);
    light_ = walk_->compileVisitor(setup, "passes/light_clipmap/light_voxels");
    area_ = program("passes/light_clipmap/lit_area.comp", {});
    window_ = program("passes/light_clipmap/fill_window.comp", radiance.defines());
    level_ = program("passes/light_clipmap/fill_level.comp", radiance.defines());
    flux_ = FluxAccumulator(setup.device, setup.compiler);
    if (params_.bounces > 0) bounces_.prepare(setup, radiance);
    sceneVersion_.reset();
}

void LightClipmap::record(PassContext& context) {
    const ClipmapVoxels& clipmap = context.get(clipmap_);
    RadianceVoxels& radiance = context.get(radiance_);
    storage_.follow(context, radiance);

    // Where a light or a surface moved, a shadow may have moved anywhere. What bounces comes from anywhere,
    // too.
    const bool moved = sceneVersion_ != context.frame.sceneVersion;
    if (moved) shadowMaps_.draw(context, sources_);
    sceneVersion_ = context.frame.sceneVersion;
    const bool updated = std::ranges::any_of(
        clipmap.levels, [](const ClipmapVoxels::Level& level) { return !level.boxes.empty(); });
    updatedVoxels_ = 0;
    if (moved || updated) relight(context, moved);
    context.report(kUpdatedVoxels, double(updatedVoxels_));
}

void LightClipmap::relight(PassContext& context, bool moved) {
    const ClipmapVoxels& clipmap = context.get(clipmap_);
    const RadianceVoxels& radiance = context.get(radiance_);
    const bool everywhere = moved || params_.bounces > 0;

    // Direct light
    std::vector<VoxelIrradiance> lights(clipmap.levels.size());
    for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
        const ClipmapVoxels::Level& level = clipmap.levels[l];
        const SurfaceVoxels& voxels = everywhere || !level.updated.materials ? level.voxels : level.updated;
        const std::vector<VoxelBox> boxes = everywhere ? std::vector{heldVoxels(voxels.grid)} : level.boxes;
        if (boxes.empty()) continue;
        VoxelIrradiance direct = light(context, voxels, boxes);
        reflect(context, l, voxels, boxes, direct, direct.indirect);
        if (params_.bounces > 0) lights[l] = std::move(direct);
    }
    if (everywhere || !clipmap.levels.back().boxes.empty()) filter(context);

    // Each bounce carries all light of the last one on: one more of each order. Of all levels before any is
    // filled.
    for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) {
        std::vector<LargeBuffer> flux(clipmap.levels.size());
        for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
            const SurfaceVoxels& voxels = clipmap.levels[l].voxels;
            if (voxels.voxelCount == 0) continue;
            bounces_.gather(context, voxels, lights[l], radiance);
            flux[l] = bounces_.takeFlux();
        }
        for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
            const SurfaceVoxels& voxels = clipmap.levels[l].voxels;
            if (voxels.voxelCount == 0) continue;
            reflect(context, l, voxels, {heldVoxels(voxels.grid)}, lights[l], flux[l]);
        }
        filter(context);
    }
    if (params_.bounces > 0) bounces_.release(context.stream);
}

VoxelIrradiance LightClipmap::light(PassContext& context, const SurfaceVoxels& voxels,
                                    const std::vector<VoxelBox>& boxes) {
    CommandStream& stream = context.stream;
    const Geometry& geometry = context.frame.scene->geometry;
    const uint32_t count = std::max(voxels.voxelCount, 1u);

    // Light that arrives at the clipped fragments in the boxes
    const VoxelRegion region(voxels.grid, boxes);
    walk_->select(context, voxels.grid, region, region.triangles(geometry));
    const Buffer litArea(context.device, "lit area", count * kLitAreaBytes);
    stream.fill(litArea, 0);
    flux_.begin(context.device, stream, voxels, totalPower(sources_));
    std::vector<Binding> bindings = voxels.bindings({{"litArea", litArea}});
    for (const Binding& binding : flux_.bindings()) bindings.push_back(binding);
    for (const Binding& binding : shadowMaps_.bindings()) bindings.push_back(binding);
    walk_->run(context, light_, voxels.grid, bindings, flux_.unitsPerWatt());
    VoxelIrradiance irradiance;
    irradiance.allocate(context.device, count);
    stream.fill(irradiance.indirect, 0);
    flux_.resolve(stream, voxels, irradiance.direct);
    stream.dispatch(
        area_, {{"litArea", litArea}, {"VoxelMaterialsAt", voxels.materials.at()}, {"area", irradiance.area}},
        voxels.voxelCount, linearGroups(voxels.voxelCount));

    stream.finish();
    walk_->release();
    flux_.end();
    return irradiance;
}

void LightClipmap::reflect(PassContext& context, uint32_t level, const SurfaceVoxels& voxels,
                           const std::vector<VoxelBox>& boxes, const VoxelIrradiance& light,
                           const LargeBuffer& indirect) {
    std::vector<Binding> surfaces = voxels.bindings(
        {{"DirectFluxAt", light.direct.at()}, {"IndirectFluxAt", indirect.at()}, {"voxelArea", light.area}});
    for (const Binding& binding : context.get(radiance_).fillBindings()) surfaces.push_back(binding);
    for (const VoxelBox& box : boxes) {
        context.stream.dispatch(window_, surfaces, WindowPush{voxels.grid, box.first, box.size, level},
                                linearGroups(box.count()));
        updatedVoxels_ += box.count();
    }
    context.stream.finish();
}

void LightClipmap::filter(PassContext& context) {
    const RadianceVoxels& radiance = context.get(radiance_);
    for (uint32_t l = storage_.windows().firstWhole() + 1; l < radiance.grid.levels; ++l) {
        const glm::uvec3 size = levelResolution(radiance.grid.resolution, l);
        const uint64_t voxels = uint64_t(size.x) * size.y * size.z;
        context.stream.dispatch(level_, radiance.fillBindings(), l, linearGroups(voxels));
        updatedVoxels_ += voxels;
    }
}

}  // namespace voxray
