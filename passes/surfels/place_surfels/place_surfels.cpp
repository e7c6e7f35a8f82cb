#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/static_voxels.h"
#include "passes/surfels/surface_points.h"
#include "passes/surfels/surfels.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPoints = Surfels::kMaxChunkSurfels / 2;
constexpr uint64_t kMaxPoints = 1u << 28;

}  // namespace

/// Which sides of surfaces have points.
enum class SurfelSides { Open, All };

template <>
struct EnumNames<SurfelSides> {
    static constexpr std::array names{std::pair{SurfelSides::Open, "open"},
                                      std::pair{SurfelSides::All, "all"}};
};

/// Spreads points evenly over all surfaces and keeps those sides that have open space before them, as far as
/// a voxel: a voxel's irradiance is that of its open sides. `sides: all` keeps covered sides, too, with area
/// 0: they belong to no voxel's irradiance, but light that gets into a gap narrower than a voxel is theirs.
/// Where voxelize probes no exposure, all sides count as open. Where surfaces move, those that stay keep
/// their points, and what moves has as many for its area.
class PlaceSurfels final : public Pass {
 public:
    static constexpr const char* kName = "place_surfels";
    static constexpr const char* kHelp =
        "Spreads points (surfels) evenly over the surfaces. "
        "There inject_voxel_rays and inject_radiosity measure the irradiance of voxels. "
        "Depends on geometry alone. Noisy by: points_per_voxel. "
        "Misses: voxels that hold little surface may get no point.";
    struct Params {
        uint32_t pointsPerVoxel = 4;
        SurfelSides sides = SurfelSides::Open;
        static constexpr auto schema() {
            return std::tuple{
                field("points_per_voxel", &Params::pointsPerVoxel,
                      "Points for each surface voxel, on average; "
                      "where surfaces move, for each of those that what stays passes through.",
                      1u, 256u)
                    .lessNoise(),
                field("sides", &Params::sides,
                      "open: sides with open space before them, as far as a voxel. "
                      "all: covered ones, too, which gather_surfels and links read: "
                      "inside of gaps narrower than a voxel; voxels are lit by open ones alone.")};
        }
    };

    explicit PlaceSurfels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// The same at all times, where anything stays.
    PointDensity density(const Geometry& geometry, const SurfaceVoxels& voxels);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    Out<Surfels> surfels_{*this, "surfels", "points that measure irradiance"};
    Kernel place_{*this, "place.comp"};
    Kernel keep_{*this, "compact_surfels.comp"};
    std::optional<uint32_t> stillVoxels_;  ///< Those that what stays passes through, where surfaces move.
    Buffer triangles_, rays_, occluded_, candidates_, kept_, count_;  ///< Scratch, of a batch of points.
};

PointDensity PlaceSurfels::density(const Geometry& geometry, const SurfaceVoxels& voxels) {
    const SurfaceAreas area = surfaceAreas(geometry);
    const double perVoxel = params_.pointsPerVoxel;
    if (movingInstanceRanges(geometry).empty()) return {perVoxel * voxels.voxelCount, area.still};
    if (!stillVoxels_) stillVoxels_ = countStaticVoxels(geometry, voxels.grid);
    // A plane of the area of one voxel's face passes through |nx| + |ny| + |nz| voxels, at most the root
    // of 3.
    const double known = area.still > 0 ? area.still : area.moving;
    const double most = std::sqrt(3.0) * known / (double(voxels.grid.voxelSize) * voxels.grid.voxelSize);
    return {perVoxel * (area.still > 0 ? std::min(double(*stillVoxels_), most) : most), known};
}

void PlaceSurfels::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan[voxels_];
    Surfels& surfels = plan[surfels_];
    surfels.estimatedCount = 2.0 * params_.pointsPerVoxel * voxels.estimatedCount;
    surfels.hasOccludedSurfels = params_.sides == SurfelSides::All && voxels.unoccludedAreaOnly;
    plan.estimate(surfels.estimatedCount * sizeof(gpu::Surfel));
    plan.scratchBuffer(triangles_, "surfels' triangles", kBatchPoints * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "visibility rays", Surfels::kMaxChunkSurfels * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility results", Surfels::kMaxChunkSurfels * sizeof(uint32_t));
    plan.scratchBuffer(candidates_, "surfel candidates", Surfels::kMaxChunkSurfels * sizeof(gpu::Surfel));
    plan.scratchBuffer(kept_, "surfels kept", Surfels::kMaxChunkSurfels * sizeof(gpu::Surfel));
    plan.scratchBuffer(count_, "number of surfels", sizeof(uint32_t));
}

void PlaceSurfels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    Surfels& surfels = context[surfels_];
    CommandStream& stream = context.stream;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (changed && changed->empty() && !surfels.chunks.empty()) {  // Light alone has changed.
        context.markOutputsUnchanged();
        return;
    }
    surfels.chunks.clear();
    surfels.count = 0;
    const Geometry& geometry = context.frame.scene->geometry;
    PointDensity d = density(geometry, voxels);
    d.points = std::min(d.points, double(kMaxPoints));
    const std::vector<uint32_t> triangles = spreadPoints(geometry, d, kMaxPoints);
    const uint64_t points = surfels.pointCount = triangles.size();
    for (uint64_t first = 0; first < points; first += kBatchPoints) {
        const uint32_t batch = uint32_t(std::min<uint64_t>(kBatchPoints, points - first));
        stream.upload(triangles_, std::as_bytes(std::span(triangles).subspan(first, batch)));
        context.dispatch(place_, batch,
                         {context.scene,
                          voxels,
                          {"pointTriangles", triangles_},
                          {"rays", rays_},
                          {"candidates", candidates_},
                          {"firstPoint", uint32_t(first)},
                          {"points", batch},
                          {"seed", randomSeed(context.frame)}});
        if (voxels.unoccludedAreaOnly)
            context.tracer.occluded(stream, rays_, occluded_, 2 * batch);
        else
            stream.fill(occluded_, 0);
        stream.fill(count_, 0);
        context.dispatch(keep_, 2 * batch,
                         {{"rays", rays_},
                          {"occluded", occluded_},
                          {"candidates", candidates_},
                          {"surfels", kept_},
                          {"count", count_},
                          {"candidateCount", 2 * batch},
                          {"keepCovered", params_.sides == SurfelSides::All}});
        const uint32_t count = stream.readAs<uint32_t>(count_, 1)[0];
        if (count == 0) continue;
        surfels.chunks.push_back({Buffer(context.device, "surfels", count * sizeof(gpu::Surfel)), count});
        stream.copy(kept_, surfels.chunks.back().surfels, count * sizeof(gpu::Surfel));
        surfels.count += count;
    }
    stream.finish();
    if (surfels.chunks.empty())
        throw Error(
            "place_surfels: "
            "every surface has another within one voxel ({:.3g} m) before it, so none is open to light; "
            "raise voxelize's 'resolution', set its 'visibility_rays: 0', or place_surfels's 'sides: all'",
            voxels.grid.voxelSize);
}

VOXRAY_REGISTER_PASS(PlaceSurfels);

}  // namespace voxray
