#include "passes/voxelize/light_clipmap.h"

#include <algorithm>

#include "passes/common/dispatch.h"
#include "passes/voxelize/triangle_tiles.h"

namespace voxray {
namespace {

constexpr uint64_t kLitAreaBytes = kAreaFloats * sizeof(uint32_t);

struct LightPush {
    gpu::VoxelGrid grid;
    uint32_t tileCount;
    float unitsPerWatt;
};

struct WindowPush {
    gpu::VoxelGrid grid;
    float emission;
    VoxelBox box;
    uint32_t level;
};

double power(const std::vector<LightSource>& sources) {
    double watts = 0;
    for (const LightSource& source : sources) watts += source.power;
    return watts;
}

}  // namespace

void LightClipmap::declare(PassBuilder& builder) {
    clipmap_ = builder.read<ClipmapVoxels>("clipmap", "surface voxels to light");
    radiance_ = builder.write<RadianceVoxels>("radiance", "light that leaves them, at all scales");
}

void LightClipmap::plan(PassPlan& plan) {
    sources_ = requireViewpoints(*plan.frame.scene, kName);
    const ClipmapVoxels& clipmap = plan.get(clipmap_);
    RadianceVoxels& radiance = plan.get(radiance_);
    radiance.layout = RadianceLayout::Clipmap;
    radiance.grid = clipmap.grid;
    storage_ = RadianceClipmap(clipmap.grid, clipmap.windows.side());
    storage_.plan(plan, kName, radiance);
    ShadowMaps::plan(plan, sources_, params_.shadowResolution);

    // One level at a time
    uint32_t most = 0;
    for (const ClipmapVoxels::Level& level : clipmap.levels) most = std::max(most, level.voxels.voxelCount);
    plan.reserve("light of a level (estimated)",
                 most * (FluxSums::kBytesPerVoxel + kLitAreaBytes) + VoxelIrradiance::bytes(most));
    plan.reserve("tiles of triangles",
                 TriangleTiles::bytes(plan.frame.scene->geometry, clipmap.levels[0].voxels.grid));
}

void LightClipmap::prepare(PassSetup& setup) {
    RadianceVoxels& radiance = setup.get(radiance_);
    storage_.prepare(setup, radiance);
    shadowMaps_ = ShadowMaps(setup, sources_, params_.shadowResolution);
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    light_ = program("passes/voxelize/exact.comp", {{"LIGHT", "1"}});
    area_ = program("passes/voxelize/lit_area.comp", {});
    window_ = program("passes/voxelize/fill_window.comp", radiance.defines());
    level_ = program("passes/voxelize/fill_level.comp", radiance.defines());
    flux_ = FluxSums(setup.device, setup.compiler);
    sceneVersion_.reset();
}

void LightClipmap::record(PassContext& context) {
    const ClipmapVoxels& clipmap = context.get(clipmap_);
    RadianceVoxels& radiance = context.get(radiance_);
    storage_.follow(context, radiance);

    // Where a light or a surface moved, a shadow may have moved anywhere.
    const bool everywhere = sceneVersion_ != context.frame.sceneVersion;
    if (everywhere) shadowMaps_.draw(context, sources_);
    sceneVersion_ = context.frame.sceneVersion;
    for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
        const ClipmapVoxels::Level& level = clipmap.levels[l];
        if (everywhere || !level.renewed.materials)
            fill(context, l, level.voxels,
                 everywhere ? std::vector{heldVoxels(level.voxels.grid)} : level.boxes);
        else
            fill(context, l, level.renewed, level.boxes);
    }

    // Beyond the first level that is held whole each is made of the one below.
    if (!everywhere && clipmap.levels.back().boxes.empty()) return;
    for (uint32_t l = uint32_t(clipmap.levels.size()); l < radiance.grid.levels; ++l) {
        const glm::uvec3 size = radianceResolution(radiance.grid.resolution, l);
        const uint64_t voxels = uint64_t(size.x) * size.y * size.z;
        context.stream.dispatch(level_, radiance.bindings(), l, linearGroups(voxels));
        context.voxelSteps += voxels;
    }
}

void LightClipmap::fill(PassContext& context, uint32_t level, const SurfaceVoxels& voxels,
                        const std::vector<VoxelBox>& boxes) {
    if (boxes.empty()) return;
    CommandStream& stream = context.stream;
    const Geometry& geometry = context.frame.scene->geometry;
    const uint32_t count = std::max(voxels.voxelCount, 1u);

    // What arrives, at the triangles' pieces in the boxes
    const VoxelRegion region(voxels.grid, boxes);
    const TriangleTiles tiles(stream, geometry, voxels.grid, region, region.triangles(geometry));
    const Buffer litArea(context.device, "lit area", count * kLitAreaBytes);
    stream.fill(litArea, 0);
    flux_.begin(context.device, stream, voxels, power(sources_));
    std::vector<Binding> bindings = context.scene.bindings({{"tiles", tiles.buffer()},
                                                            {"voxelOccupancy", voxels.occupancy},
                                                            {"voxelRank", voxels.rank},
                                                            {"litArea", litArea}});
    for (const Binding& binding : flux_.bindings()) bindings.push_back(binding);
    for (const Binding& binding : shadowMaps_.bindings()) bindings.push_back(binding);
    stream.dispatch(light_, bindings, LightPush{voxels.grid, tiles.count(), flux_.unitsPerWatt()},
                    linearGroups(tiles.count()));
    VoxelIrradiance irradiance;
    irradiance.allocate(context.device, count);
    stream.fill(irradiance.indirect, 0);
    flux_.resolve(stream, voxels, irradiance.direct);
    stream.dispatch(
        area_, {{"litArea", litArea}, {"VoxelMaterialsAt", voxels.materials.at()}, {"area", irradiance.area}},
        voxels.voxelCount, linearGroups(voxels.voxelCount));

    // What is reflected
    std::vector<Binding> surfaces{
        {"voxelOccupancy", voxels.occupancy},         {"voxelRank", voxels.rank},
        {"VoxelMaterialsAt", voxels.materials.at()},  {"DirectFluxAt", irradiance.direct.at()},
        {"IndirectFluxAt", irradiance.indirect.at()}, {"voxelArea", irradiance.area}};
    for (const Binding& binding : context.get(radiance_).bindings()) surfaces.push_back(binding);
    for (const VoxelBox& box : boxes) {
        stream.dispatch(window_, surfaces,
                        WindowPush{voxels.grid, params_.emission ? 1.0f : 0.0f, box, level},
                        linearGroups(box.count()));
        context.voxelSteps += box.count();
    }
    stream.finish();
    flux_.end();
}

}  // namespace voxray
