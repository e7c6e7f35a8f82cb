#include "passes/place_surfels/place_surfels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPoints = Surfels::kChunk / 2;
constexpr uint64_t kMaxPoints = 1u << 28;

struct PlacePush {
    gpu::VoxelGrid grid;
    uint32_t firstPoint;
    uint32_t points;
    uint32_t seed;
};

struct KeepPush {
    uint32_t candidates;
    uint32_t keepCovered;
};

}  // namespace

void PlaceSurfels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    surfels_ = builder.write<Surfels>("surfels", "points that measure irradiance");
}

PointDensity PlaceSurfels::density(const SurfaceVoxels& voxels, const SurfaceAreas& area) const {
    const double perVoxel = params_.pointsPerVoxel;
    if (!voxels.stillCount) return {perVoxel * voxels.voxelCount, area.still};
    // A plane of the area of one voxel's face passes through |nx| + |ny| + |nz| voxels, at most the root
    // of 3.
    const double known = area.still > 0 ? area.still : area.moving;
    const double most = std::sqrt(3.0) * known / (double(voxels.grid.voxelSize) * voxels.grid.voxelSize);
    return {perVoxel * (area.still > 0 ? std::min(double(*voxels.stillCount), most) : most), known};
}

void PlaceSurfels::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    // What moves may grow.
    const SurfaceAreas area = surfaceAreas(plan.frame.scene->geometry);
    const PointDensity d = density(voxels, area);
    double points = d.points;
    if (voxels.stillCount && d.area > 0) points *= (area.still + 2 * area.moving) / d.area;
    Surfels& surfels = plan.get(surfels_);
    surfels.maxCount = 2 * uint64_t(std::min(points, double(kMaxPoints)));
    surfels.coveredSides = params_.sides == SurfelSides::All && plan.get(voxels_).unoccludedOnly;
    plan.reserve("surfels (estimated)", surfels.maxCount * sizeof(gpu::Surfel));
    plan.scratchBuffer(triangles_, "surfels' triangles", kBatchPoints * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "visibility rays", Surfels::kChunk * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility results", Surfels::kChunk * sizeof(uint32_t));
    plan.scratchBuffer(candidates_, "surfel candidates", Surfels::kChunk * sizeof(gpu::Surfel));
    plan.scratchBuffer(kept_, "surfels kept", Surfels::kChunk * sizeof(gpu::Surfel));
    plan.scratchBuffer(count_, "number of surfels", sizeof(uint32_t));
}

void PlaceSurfels::prepare(PassSetup& setup) {
    place_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/place_surfels/place.comp"));
    keep_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/place_surfels/keep.comp"));
}

void PlaceSurfels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    Surfels& surfels = context.get(surfels_);
    CommandStream& stream = context.stream;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (changed && changed->empty() && !surfels.chunks.empty()) return;  // Light alone has changed.
    surfels.chunks.clear();
    // No more than planned: the number of voxels was estimated.
    const Geometry& geometry = context.frame.scene->geometry;
    PointDensity d = density(voxels, surfaceAreas(geometry));
    if (!voxels.stillCount) d.points = std::min(d.points, double(surfels.maxCount / 2));
    const std::vector<uint32_t> triangles = spreadPoints(geometry, d, surfels.maxCount / 2);
    const uint64_t points = triangles.size();
    for (uint64_t first = 0; first < points; first += kBatchPoints) {
        const uint32_t batch = uint32_t(std::min<uint64_t>(kBatchPoints, points - first));
        stream.upload(triangles_, std::as_bytes(std::span(triangles).subspan(first, batch)));
        stream.dispatch(place_,
                        voxels.bindings(context.scene.bindings(
                            {{"pointTriangles", triangles_}, {"rays", rays_}, {"candidates", candidates_}})),
                        PlacePush{voxels.grid, uint32_t(first), batch, randomSeed(context.frame)},
                        linearGroups(batch));
        if (voxels.unoccludedOnly)
            context.tracer.occluded(stream, rays_, occluded_, 2 * batch);
        else
            stream.fill(occluded_, 0);
        stream.fill(count_, 0);
        stream.dispatch(keep_,
                        {{"rays", rays_},
                         {"occluded", occluded_},
                         {"candidates", candidates_},
                         {"surfels", kept_},
                         {"count", count_}},
                        KeepPush{2 * batch, params_.sides == SurfelSides::All ? 1u : 0u},
                        linearGroups(2 * batch));
        const uint32_t count = stream.readAs<uint32_t>(count_, 1)[0];
        if (count == 0) continue;
        surfels.chunks.push_back({Buffer(context.device, "surfels", count * sizeof(gpu::Surfel)), count});
        stream.copy(kept_, surfels.chunks.back().surfels, count * sizeof(gpu::Surfel));
    }
    stream.finish();
    if (surfels.chunks.empty())
        throw Error(
            "place_surfels: every surface has another within one voxel ({:.3g} m) before it, so none is open "
            "to "
            "light; raise voxelize's 'resolution', set its 'visibility_rays: 0', or place_surfels's 'sides: "
            "all'",
            voxels.grid.voxelSize);
}

}  // namespace voxray
