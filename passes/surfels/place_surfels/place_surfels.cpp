#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/static_voxels.h"
#include "passes/surfels/surface_points.h"
#include "passes/surfels/surfel_points.h"
#include "passes/surfels/surfels.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPoints = Surfels::kMaxChunkSurfels / 2;
constexpr uint64_t kMaxPoints = 1u << 28;
constexpr uint32_t kSideBits = 2;  // Of a surfel, in SurfelPoints::sides; words of batches are whole.
static_assert(2 * kBatchPoints * kSideBits % 32 == 0);

}  // namespace

/// Sides of surfaces that have surfels.
enum class SurfelSides { Open, All };

template <>
struct EnumNames<SurfelSides> {
    static constexpr std::array names{std::pair{SurfelSides::Open, "open"}, std::pair{SurfelSides::All, "all"}};
};

/// Distributes points evenly over all surfaces, with a surfel on each side that is unoccluded: no other
/// surface lies within a voxel before it. A voxel's irradiance is that of these sides. `sides: all` adds
/// occluded sides with area 0, for light in gaps narrower than a voxel. Without voxelize's visibility rays
/// all sides count as unoccluded. Where surfaces move, static ones keep their points, and moving ones get as
/// many per area.
class PlaceSurfels final : public Pass {
 public:
    static constexpr const char* kName = "place_surfels";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Distributes points (surfels) evenly over both sides of the surfaces. "
        "There inject_voxel_rays and inject_radiosity measure the irradiance of voxels. Depends on geometry alone. "
        "Noisy by: points_per_voxel. Misses: voxels that hold little surface may get no point.";
    struct Params {
        uint32_t pointsPerVoxel = 4;
        SurfelSides sides = SurfelSides::Open;
        static constexpr auto schema() {
            return std::tuple{field("points_per_voxel", &Params::pointsPerVoxel,
                                    "Mean number of points per surface voxel; "
                                    "where surfaces move, per voxel that static surfaces pass through.",
                                    1u, 256u)
                                  .lessNoise(),
                              field("sides", &Params::sides,
                                    "open: the sides of surfaces without another surface within a voxel before them. "
                                    "all: also the others, as in gaps narrower than a voxel, "
                                    "which gather_surfels and link_surfels read; voxels are lit by open sides alone.")};
        }
    };

    explicit PlaceSurfels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Constant over time where some surfaces are static.
    PointDensity density(const Geometry& geometry, const SurfaceVoxels& voxels);
    /// Stores which surfels of a batch of points exist and which of them are occluded, and counts them.
    void storeSides(PassContext& context, uint32_t firstPoint, uint32_t batch) const;
    /// Stores the surfels of the batch. @return the number of those that exist.
    uint32_t storeSurfels(PassContext& context, uint32_t batch) const;

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    Out<Surfels> surfels_{*this, "surfels", "points that measure irradiance"};
    Out<SurfelPoints> points_{*this, "surfel_points", "the same, to be evaluated where they are read"};
    Kernel place_{*this, "place.comp"};
    Kernel storeSides_{*this, "store_sides.comp"};
    Kernel compact_{*this, "compact_surfels.comp"};
    std::optional<uint32_t> staticVoxels_;                     ///< Voxels with static surfaces, where others move.
    std::vector<uint32_t> triangles_;                          ///< Of all points in the last frame, where some move.
    Buffer rays_, occluded_, candidates_, compacted_, count_;  ///< Scratch, of a batch of points.
    Buffer existing_;                                          ///< Scratch: number of surfels whose sides are stored.
};

PointDensity PlaceSurfels::density(const Geometry& geometry, const SurfaceVoxels& voxels) {
    const SurfaceAreas areas = surfaceAreas(geometry);
    const double perVoxel = params_.pointsPerVoxel;
    PointDensity density{perVoxel * voxels.voxelCount, areas.ofStatic};
    if (!movingInstanceRanges(geometry).empty()) {
        if (!staticVoxels_) staticVoxels_ = countStaticVoxels(geometry, voxels.grid);
        // A plane with the area of a voxel's face passes through |nx| + |ny| + |nz| voxels, at most sqrt(3)
        density.area = areas.ofStatic > 0 ? areas.ofStatic : areas.ofMoving;
        const double maxVoxels =
            std::sqrt(3.0) * density.area / (double(voxels.grid.voxelSize) * voxels.grid.voxelSize);
        density.points = perVoxel * (areas.ofStatic > 0 ? std::min(double(*staticVoxels_), maxVoxels) : maxVoxels);
    }
    const double points = density.points / density.area * (areas.ofStatic + areas.ofMoving);
    if (points > double(kMaxPoints))
        throw Error("{}: {:.3g} points are more than {}; lower 'points_per_voxel' or voxelize's 'resolution'", kName,
                    points, kMaxPoints);
    return density;
}

void PlaceSurfels::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan[voxels_];
    Surfels& surfels = plan[surfels_];
    SurfelPoints& points = plan[points_];
    surfels.estimatedCount = 2.0 * params_.pointsPerVoxel * voxels.estimatedCount;
    surfels.hasOccludedSurfels = params_.sides == SurfelSides::All && voxels.areasAreUnoccluded;
    points.hasOccludedSurfels = surfels.hasOccludedSurfels;
    storeSides_.compileIf(points.isRead);
    if (points.isRead) plan.scratchBuffer(existing_, "number of surfels that exist", sizeof(uint32_t));
    compact_.compileIf(surfels.isRead);
    surfels.areIndexedById = !movingInstanceRanges(plan.frame.scene->geometry).empty();
    if (surfels.areIndexedById) compact_.define({{"ALL", "1"}});
    if (surfels.isRead) place_.define({{"SURFELS", "1"}});
    if (surfels.isRead) plan.estimate(surfels.estimatedCount * sizeof(gpu::Surfel));
    if (points.isRead) plan.estimate(surfels.estimatedCount / 2 * (sizeof(uint32_t) + 0.5));
    plan.scratchBuffer(rays_, "visibility rays", Surfels::kMaxChunkSurfels * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility results", Surfels::kMaxChunkSurfels * sizeof(uint32_t));
    if (surfels.isRead) {
        plan.scratchBuffer(candidates_, "surfel candidates", Surfels::kMaxChunkSurfels * sizeof(gpu::Surfel));
        plan.scratchBuffer(compacted_, "surfels of a batch", Surfels::kMaxChunkSurfels * sizeof(gpu::Surfel));
    }
    plan.scratchBuffer(count_, "number of surfels", sizeof(uint32_t));
}

void PlaceSurfels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    Surfels& surfels = context[surfels_];
    SurfelPoints& points = context[points_];
    CommandStream& stream = context.stream;
    const std::optional<std::vector<Box>>& changed = context.frame.changedRegions;
    if (changed && changed->empty() && !context.isFirstRun()) {  // Light alone has changed.
        context.markOutputsUnchanged();
        return;
    }
    surfels.chunks.clear();
    surfels.count = 0;
    points.triangles = {}, points.sides = {};
    const Geometry& geometry = context.frame.scene->geometry;
    std::vector<uint32_t> triangles = distributePoints(geometry, density(geometry, voxels));
    points.count = uint32_t(surfels.pointCount = triangles.size());
    points.seed = randomSeed(context.frame);
    points.triangles = LargeBuffer(context.device, "triangles of points", uintBytes(points.count));
    if (points.count > 0) stream.upload(points.triangles, triangles);
    surfels.keepPoints = triangles == triangles_;
    if (surfels.areIndexedById) triangles_ = std::move(triangles);
    if (points.isRead)
        points.sides =
            LargeBuffer(context.device, "sides of points", uintBytes(bitWords(2 * kSideBits * uint64_t(points.count))));
    if (points.isRead) stream.fill(existing_, 0);
    uint64_t count = 0;
    for (uint32_t first = 0; first < points.count; first += kBatchPoints) {
        const uint32_t batch = std::min(kBatchPoints, points.count - first);
        context.dispatch(place_, batch,
                         {context.scene,
                          voxels,
                          points,
                          {"rays", rays_},
                          ifUsed({"candidates", candidates_}),
                          {"firstPoint", first},
                          {"points", batch}});
        if (voxels.areasAreUnoccluded)
            context.tracer.occluded(stream, rays_, occluded_, 2 * batch);
        else
            stream.fill(occluded_, 0);
        if (points.isRead) storeSides(context, first, batch);
        if (surfels.isRead) count += storeSurfels(context, batch);
    }
    stream.finish();
    if (points.isRead)
        count = stream.readAs<uint32_t>(existing_, 1)[0];
    else
        points.triangles = {};
    if (count == 0)
        throw Error(
            "place_surfels: "
            "every surface has another within one voxel ({:.3g} m) before it, so none is open to light; "
            "raise voxelize's 'resolution', set its 'visibility_rays: 0', or place_surfels's 'sides: all'",
            voxels.grid.voxelSize);
}

void PlaceSurfels::storeSides(PassContext& context, uint32_t firstPoint, uint32_t batch) const {
    context.dispatch(storeSides_, bitWords(2 * kSideBits * uint64_t(batch)),
                     {{"rays", rays_},
                      {"occluded", occluded_},
                      {"SidesRef", context[points_].sides.ref()},
                      {"count", existing_},
                      {"firstWord", 2 * firstPoint * kSideBits / 32},
                      {"candidateCount", 2 * batch},
                      {"includeOccluded", params_.sides == SurfelSides::All}});
}

uint32_t PlaceSurfels::storeSurfels(PassContext& context, uint32_t batch) const {
    Surfels& surfels = context[surfels_];
    CommandStream& stream = context.stream;
    stream.fill(count_, 0);
    context.dispatch(compact_, 2 * batch,
                     {{"rays", rays_},
                      {"occluded", occluded_},
                      {"candidates", candidates_},
                      {"surfels", compacted_},
                      {"count", count_},
                      {"candidateCount", 2 * batch},
                      {"includeOccluded", params_.sides == SurfelSides::All}});
    const uint32_t existing = stream.readAs<uint32_t>(count_, 1)[0];
    const uint32_t count = surfels.areIndexedById ? 2 * batch : existing;
    if (count == 0) return 0;
    surfels.chunks.push_back(
        {Buffer(context.device, "surfels", count * sizeof(gpu::Surfel)), count, uint32_t(surfels.count)});
    stream.copy(compacted_, surfels.chunks.back().surfels, count * sizeof(gpu::Surfel));
    surfels.count += count;
    return existing;
}

VOXRAY_REGISTER_PASS(PlaceSurfels);

}  // namespace voxray
