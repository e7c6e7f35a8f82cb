#include "passes/gather_rays/gather_rays.h"

#include "base/error.h"
#include "passes/common/camera_matrix.h"
#include "passes/common/dispatch.h"
#include "passes/common/frame_image.h"

namespace voxray {
namespace {

struct ShadePush {
    gpu::VoxelGrid grid;
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t batchBlocks;
};

struct FilterPush {
    glm::vec3 camera;
    float texelAngle;
    int32_t step;
    float strictness;
};

ImageDesc texelImage(const GatherHits& hits, VkFormat format) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {hits.layout.texels.x, hits.layout.texels.y, 1};
    return desc;
}

}  // namespace

void GatherRays::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    hits_ = builder.read<GatherHits>("gather_hits", "where the gather rays hit");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
}

void GatherRays::plan(PassPlan& plan) {
    const GatherHits& hits = plan.get(hits_);
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    if (hits.layout.raysPerBlock < texelsPerBlock && (1u << params_.filter) < hits.layout.blockSize * 2)
        throw Error(
            "gather_rays: blocks of {0}x{0} texels have {1} rays, which leaves texels without any; raise "
            "'filter' of gather_rays, or 'rays' of trace_gather_rays to {2}",
            hits.layout.blockSize, hits.layout.raysPerBlock, texelsPerBlock);
    plan.reserve("indirect image", imageBytes(frameImageDesc(plan.frame)));
    plan.reserve("gathered irradiance", 3 * imageBytes(texelImage(hits, VK_FORMAT_R32G32B32A32_SFLOAT)) +
                                            imageBytes(texelImage(hits, VK_FORMAT_R32G32_SFLOAT)));
    plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(plan.get(voxels_).voxelCount));
}

void GatherRays::prepare(PassSetup& setup) {
    const GatherHits& hits = setup.get(hits_);
    setup.get(indirect_).image = Image(setup.device, "indirect", frameImageDesc(setup.frame));
    const ImageDesc wide = texelImage(hits, VK_FORMAT_R32G32B32A32_SFLOAT);
    gathered_ = Image(setup.device, "gathered irradiance", wide);
    filtered_ = Image(setup.device, "filtered irradiance", wide);
    moments_ = Image(setup.device, "moments", wide);
    surroundings_ = Image(setup.device, "surroundings", texelImage(hits, VK_FORMAT_R32G32_SFLOAT));
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    shade_ = program("passes/gather_rays/shade.comp");
    surroundRows_ = program("passes/gather_rays/surroundings.comp");
    surround_ = program("passes/gather_rays/surroundings.comp", {{"COLUMNS", "1"}});
    filter_ = program("passes/gather_rays/filter.comp");
    resolve_ = program("passes/gather_rays/resolve.comp");
    faces_ = FaceIrradiance(setup.device, setup.compiler);
    sampler_ = texelSampler(setup.device);
}

void GatherRays::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const GatherHits& hits = context.get(hits_);
    const glm::uvec2 texels = hits.layout.texels;
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    CommandStream& stream = context.stream;

    // Shade the hits with the voxels' irradiance.
    faces_.update(stream, voxels, context.get(irradiance_));
    for (uint32_t b = 0; b < hits.batches.size(); ++b)
        stream.dispatch(shade_,
                        context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                                {"voxelRank", voxels.rank},
                                                {"faceIrradiance", faces_.buffer()},
                                                {"hits", hits.batches[b]},
                                                {"position", gbuffer.position, sampler_},
                                                {"gathered", gathered_},
                                                {"moments", moments_}}),
                        ShadePush{voxels.grid, hits.layout, b * hits.blocksPerBatch, hits.batchBlocks(b)},
                        linearGroups(uint64_t(hits.batchBlocks(b)) * texelsPerBlock));

    // Share irradiance between texels that see much the same.
    const Image *from = &gathered_, *to = &filtered_;
    const CameraRays camera = cameraRays(context.frame.camera, texels.x, texels.y);
    const float texelAngle = 2 * glm::length(camera.up) / float(texels.y);
    if (params_.filter > 0) {
        const int32_t radius = int32_t(hits.layout.blockSize);
        const glm::uvec3 groups = pixelGroups(texels.x, texels.y);
        stream.dispatch(surroundRows_, {{"moments", moments_, sampler_}, {"rowSums", filtered_}}, radius,
                        groups);
        stream.dispatch(surround_, {{"moments", filtered_, sampler_}, {"surroundings", surroundings_}},
                        radius, groups);
    }
    for (uint32_t level = 0; level < params_.filter; ++level, std::swap(from, to))
        stream.dispatch(filter_,
                        {{"position", gbuffer.position, sampler_},
                         {"normal", gbuffer.normal, sampler_},
                         {"source", *from, sampler_},
                         {"surroundings", surroundings_, sampler_},
                         {"result", *to}},
                        FilterPush{camera.origin, texelAngle, 1 << level, params_.strictness},
                        pixelGroups(texels.x, texels.y));

    stream.dispatch(resolve_,
                    {{"irradiance", *from, sampler_},
                     {"albedo", gbuffer.albedo, sampler_},
                     {"result", context.get(indirect_).image}},
                    int32_t(gbuffer.samples), pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
