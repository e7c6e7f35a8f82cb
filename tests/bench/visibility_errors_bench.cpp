// Why voxels and triangles disagree about who sees whom, and what cures it: by where the error is, with exact
// rays near the ends of a shadow ray, with voxels that block in part, and with leaves that hold triangles.
#include <benchmark/benchmark.h>

#include "passes/common/lights/light_sources.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/hybrid_leaves/hybrid_tracer.h"
#include "tests/bench/light_rays.h"
#include "tests/physics/voxels_read.h"

namespace voxray {
namespace {

constexpr size_t kRays = 200000;

/// Random shadow rays of a scene with their exact answers.
struct Disagreement {
    explicit Disagreement(const std::string& scene, uint32_t resolution, const std::string& more = "")
        : chain(litScene(scene, resolution, more)),
          voxels(*chain->graph().resource<SurfaceVoxels>("voxels")),
          rays(lightRays(*chain, kRays)),
          exact(test::hiddenByTriangles(chain->state(), rays.pairs)) {}

    double percent(size_t count) const { return 100 * double(count) / double(kRays); }

    /// Counters of how `seen` (0 to 1, of each ray) differs: of all rays in percent, and the light that
    /// arrives over the exact.
    template <typename Seen>
    void report(benchmark::State& state, const Seen& seen) const {
        double hidden = 0, open = 0, light = 0, right = 0;
        for (size_t i = 0; i < kRays; ++i) {
            const double s = seen(i);
            (exact[i] ? open : hidden) += exact[i] ? s : 1 - s;
            light += s * rays.light[i];
            right += exact[i] ? 0 : rays.light[i];
        }
        state.counters["hidden_wrongly_percent"] = 100 * hidden / double(kRays);
        state.counters["seen_wrongly_percent"] = 100 * open / double(kRays);
        state.counters["light"] = light / right;
    }

    std::unique_ptr<test::Chain> chain;
    const SurfaceVoxels& voxels;
    LightRays rays;
    std::vector<uint32_t> exact;
};

/// A ray between two points without the first `begin` and the last `end` metres; inactive where nothing is
/// left.
Ray between(glm::vec3 a, glm::vec3 b, float begin, float end) {
    const float length = glm::distance(a, b);
    if (length <= begin + end) return {a, 0, glm::vec3(0, 0, 1), -1};
    const glm::vec3 direction = (b - a) / length;
    return {a + begin * direction, 0, direction, length - begin - end};
}

std::vector<Hit> closestHits(RayTracer& tracer, const std::vector<Ray>& rays) {
    CommandStream stream(test::device());
    const Buffer in(test::device(), "rays", rays.size() * sizeof(Ray));
    const Buffer out(test::device(), "hits", rays.size() * sizeof(Hit));
    stream.upload(in, rays);
    tracer.closestHit(stream, in, out, uint32_t(rays.size()));
    return stream.readAs<Hit>(out, rays.size());
}

/// What blocks the parts of the ways that voxels look at, without the first `begin` and last `end` voxels.
std::vector<Hit> voxelsBetween(const Disagreement& d, const std::vector<test::BetweenVoxels>& ways, float begin,
                               float end) {
    CommandStream stream(test::device());
    test::TestPrograms programs;
    VoxelTracer tracer(programs, VoxelTraversal::Bricks);
    test::prepare(programs, tracer, d.voxels);
    tracer.begin(stream, d.voxels);
    const float size = d.voxels.grid.voxelSize;
    std::vector<Ray> rays;
    for (const test::BetweenVoxels& way : ways) rays.push_back(between(way.from, way.to, begin * size, end * size));
    return closestHits(tracer, rays);
}

/// Errors by place, of all rays in percent. Hidden wrongly by voxels within eight of the start, of the end,
/// at both, or farther off: there by voxels along whose surfaces the ray runs (less than 15 degrees from
/// their mean normal's plane), whose normals differ (mean shorter than 1/2), or past whose edge it goes. Seen
/// wrongly where nothing is traced, or past what is within eight voxels of an end.
void voxelErrorsByPlace(benchmark::State& state, const std::string& scene) {
    constexpr float kNear = 8;
    const Disagreement d(scene, uint32_t(state.range(0)));
    const std::vector<gpu::VoxelMaterial> materials = test::readMaterials(*d.chain, d.voxels);
    const EmbreeScene embree(d.chain->state());
    std::vector<test::BetweenVoxels> ways;
    for (auto _ : state) ways = test::betweenVoxels(d.voxels, d.rays.pairs);
    const std::vector<Hit> offStart = voxelsBetween(d, ways, kNear, 0), offEnd = voxelsBetween(d, ways, 0, kNear),
                           offBoth = voxelsBetween(d, ways, kNear, kNear);
    size_t start = 0, end = 0, both = 0, along = 0, spread = 0, past = 0;
    size_t untraced = 0, nearStart = 0, nearEnd = 0, farSeen = 0;
    for (size_t i = 0; i < kRays; ++i) {
        if (bool(ways[i].isHidden) == bool(d.exact[i])) continue;
        const test::SurfacePair& p = d.rays.pairs[i];
        const glm::vec3 direction = glm::normalize(p.b - p.a);
        if (ways[i].isHidden) {
            const bool start_ = offStart[i].triangle == Hit::kMiss, end_ = offEnd[i].triangle == Hit::kMiss;
            if (const uint32_t number = offBoth[i].triangle; number != Hit::kMiss) {
                const glm::vec3 normal = materials[number].normal;
                const float length = glm::length(normal);
                if (length < 0.5f)
                    ++spread;
                else
                    ++(std::abs(glm::dot(normal, direction)) < 0.26f * length ? along : past);
            } else {
                ++(start_ && !end_ ? start : end_ && !start_ ? end : both);
            }
        } else if (ways[i].from == ways[i].to) {
            ++untraced;
        } else {
            const float reach = kNear * d.voxels.grid.voxelSize, length = glm::distance(p.a, p.b);
            const auto hides = [&](glm::vec3 from, glm::vec3 way) {
                return embree.occluded({from, 0, way, std::min(reach, length - 2e-4f)});
            };
            if (hides(p.a + 1e-4f * p.normalA, direction))
                ++nearStart;
            else
                ++(hides(p.b + 1e-4f * p.normalB, -direction) ? nearEnd : farSeen);
        }
    }
    for (const auto& [name, count] :
         {std::pair{"hidden_start", start}, std::pair{"hidden_end", end}, std::pair{"hidden_either", both},
          std::pair{"hidden_along", along}, std::pair{"hidden_spread", spread}, std::pair{"hidden_past", past},
          std::pair{"seen_untraced", untraced}, std::pair{"seen_start", nearStart}, std::pair{"seen_end", nearEnd},
          std::pair{"seen_far", farSeen}})
        state.counters[name] = d.percent(count);
}

/// Exact rays within so many voxels of each end, voxels in between.
void voxelsWithExactEnds(benchmark::State& state, const std::string& scene) {
    const Disagreement d(scene, 256);
    const EmbreeScene embree(d.chain->state());
    const float reach = float(state.range(0)) * d.voxels.grid.voxelSize;
    const std::vector<test::BetweenVoxels> ways = test::betweenVoxels(d.voxels, d.rays.pairs);
    std::vector<uint32_t> hidden(kRays);
    CommandStream stream(test::device());
    test::TestPrograms programs;
    VoxelTracer tracer(programs, VoxelTraversal::Bricks);
    test::prepare(programs, tracer, d.voxels);
    tracer.begin(stream, d.voxels);
    for (auto _ : state) {
        // What lies farther than `reach` from both points, and between the ends that voxels want
        std::vector<Ray> rays;
        for (size_t i = 0; i < kRays; ++i) {
            const test::SurfacePair& p = d.rays.pairs[i];
            const float begin = std::max(0.0f, reach - glm::distance(p.a, ways[i].from)),
                        end = std::max(0.0f, reach - glm::distance(p.b, ways[i].to));
            rays.push_back(between(ways[i].from, ways[i].to, begin, end));
        }
        const std::vector<Hit> hits = closestHits(tracer, rays);
        for (size_t i = 0; i < kRays; ++i) {
            const test::SurfacePair& p = d.rays.pairs[i];
            const glm::vec3 a = p.a + 1e-4f * p.normalA, b = p.b + 1e-4f * p.normalB;
            const float length = glm::distance(a, b), near = std::min(reach, length);
            const glm::vec3 direction = (b - a) / length;
            hidden[i] =
                hits[i].triangle != Hit::kMiss ||
                (near > 0 && (embree.occluded({a, 0, direction, near}) || embree.occluded({b, 0, -direction, near})));
        }
    }
    d.report(state, [&](size_t i) { return hidden[i] ? 0.0 : 1.0; });
}

/// Leaves that list their triangles, up to so many, and hold grids of 16³ where there are more.
void hybridLeafVisibility(benchmark::State& state, const std::string& scene) {
    const Disagreement d(scene, 256,
                         fmt::format(", {{pass: build_hybrid_leaves, primitives: {}, grid: 16}}", state.range(0)));
    const HybridLeaves& leaves = *d.chain->graph().resource<HybridLeaves>("hybrid_leaves");
    CommandStream stream(test::device());
    const GpuScene scene_ = makeGpuScene(test::device(), stream, d.chain->state());
    test::TestPrograms programs;
    HybridTracer tracer(programs, HybridTraversal::Hierarchical);
    test::prepare(programs, tracer, d.voxels);
    tracer.begin(stream, scene_, d.voxels, leaves);
    std::vector<Ray> rays;
    std::vector<gpu::RayStart> starts;
    for (const test::SurfacePair& p : d.rays.pairs) {
        rays.push_back(between(p.a + 1e-4f * p.normalA, p.b + 1e-4f * p.normalB, 0, 0));
        starts.push_back({p.normalA, 0, 0});
    }
    const Buffer in(test::device(), "rays", kRays * sizeof(Ray));
    const Buffer from(test::device(), "starts", kRays * sizeof(gpu::RayStart));
    const Buffer out(test::device(), "answers", kRays * sizeof(uint32_t));
    stream.upload(in, rays);
    stream.upload(from, starts);
    tracer.setStarts(&from);
    for (auto _ : state) {
        tracer.occluded(stream, in, out, kRays);
        stream.finish();
    }
    const std::vector<uint32_t> hidden = stream.readAs<uint32_t>(out, kRays);
    d.report(state, [&](size_t i) { return hidden[i] ? 0.0 : 1.0; });
    state.counters["leaves_KiB"] = double(leaves.structureBytes() + leaves.listBytes() + leaves.gridBytes()) / 1024;
}

/// Voxels that let light through in part: each voxel on the way takes what its surfaces cover of it as the
/// ray sees it, area x cosine over the voxel's own projection; the mean normal's cosine, and 1/2, the mean of
/// random ones, for what it lacks in length. 0: what voxels let through is multiplied. 1: what they take
/// along a run of occupied voxels, times the way in each over the mean way through one, is added up, to 1 at
/// most.
void voxelsThatBlockInPart(benchmark::State& state, const std::string& scene) {
    Disagreement d(scene, 256);
    const test::Voxels voxels(*d.chain);
    const bool adds = state.range(0) == 1;
    const std::vector<test::BetweenVoxels> ways = test::betweenVoxels(d.voxels, d.rays.pairs);
    std::vector<double> seen(kRays, 1);
    const auto walk = [&](glm::dvec3 from, glm::dvec3 to) {
        const glm::dvec3 way = to - from;
        const double length = glm::length(way), l1 = glm::dot(glm::abs(way), glm::dvec3(1)) / length;
        glm::ivec3 at(glm::floor(from));
        double open = 1, run = 0, enters = 0;
        for (int i = 0; i < 4096 && enters < 1; ++i) {
            int axis = 0;
            double leaves = 1e30;
            for (int k = 0; k < 3; ++k) {
                if (way[k] == 0) continue;
                const double t = (at[k] + (way[k] > 0 ? 1 : 0) - from[k]) / way[k];
                if (t < leaves) leaves = t, axis = k;
            }
            const bool isInside = glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) &&
                                  glm::all(glm::lessThan(at, glm::ivec3(voxels.grid.resolution)));
            if (isInside && voxels.occupied(at)) {
                const gpu::VoxelMaterial& m = voxels.at(at);
                const double cosine = std::abs(glm::dot(glm::dvec3(m.normal), way)) / length +
                                      0.5 * std::max(0.0, 1 - double(glm::length(m.normal)));
                // A voxel's projection has l1 faces' area, and a way through it the mean length 1 / l1
                const double covered = std::min(1.0, double(m.area) * cosine / l1);
                if (adds)
                    run += double(m.area) * cosine / l1 * (std::min(leaves, 1.0) - enters) * length * l1;
                else
                    open *= 1 - covered;
            } else if (adds) {
                open *= 1 - std::min(run, 1.0);
                run = 0;
            }
            enters = std::max(enters, leaves);
            at[axis] += way[axis] > 0 ? 1 : -1;
        }
        return open * (1 - std::min(run, 1.0));
    };
    for (auto _ : state)
        for (size_t i = 0; i < kRays; ++i)
            if (ways[i].from != ways[i].to)
                seen[i] = walk((ways[i].from - voxels.grid.origin) / voxels.grid.voxelSize,
                               (ways[i].to - voxels.grid.origin) / voxels.grid.voxelSize);
    d.report(state, [&](size_t i) { return seen[i]; });
    size_t differ = 0;
    for (size_t i = 0; i < kRays; ++i) differ += (seen[i] < 0.5) != bool(d.exact[i]);
    state.counters["differ_from_half_on_percent"] = d.percent(differ);
}

/// Two cascades: voxels of 512³ within a quarter of the scene's radius of the camera, of 128³ beyond. A way
/// that ends in one and begins in the other passes through both.
void voxelCascades(benchmark::State& state, const std::string& scene) {
    const Disagreement fine(scene, 512), coarse(scene, 128);
    const glm::vec3 eye = fine.chain->state().cameras.at(0).position;
    const float radius = 0.25f * boundingSphere(fine.chain->state().geometry).radius;
    const std::vector<test::BetweenVoxels> fineWays = test::betweenVoxels(fine.voxels, fine.rays.pairs),
                                           coarseWays = test::betweenVoxels(coarse.voxels, fine.rays.pairs);
    CommandStream stream(test::device());
    const auto hits = [&](const Disagreement& d, const std::vector<Ray>& rays) {
        test::TestPrograms programs;
        VoxelTracer tracer(programs, VoxelTraversal::Bricks);
        test::prepare(programs, tracer, d.voxels);
        tracer.begin(stream, d.voxels);
        return closestHits(tracer, rays);
    };
    // Each end by the cascade that it lies in; the way is parted where it leaves the sphere round the camera
    std::vector<Ray> inside, outside;
    for (size_t i = 0; i < kRays; ++i) {
        const test::SurfacePair& p = fine.rays.pairs[i];
        const auto isNear = [&](glm::vec3 at) { return glm::distance(at, eye) < radius; };
        const glm::vec3 from = (isNear(p.a) ? fineWays : coarseWays)[i].from,
                        to = (isNear(p.b) ? fineWays : coarseWays)[i].to;
        const float length = glm::distance(from, to);
        const glm::vec3 direction = length > 0 ? (to - from) / length : glm::vec3(0, 0, 1), off = from - eye;
        const float half = -glm::dot(direction, off), root = half * half - glm::dot(off, off) + radius * radius;
        const float enters = root > 0 ? glm::clamp(half - std::sqrt(root), 0.0f, length) : length,
                    leaves = root > 0 ? glm::clamp(half + std::sqrt(root), 0.0f, length) : length;
        inside.push_back({from + enters * direction, 0, direction, leaves > enters ? leaves - enters : -1});
        outside.push_back({from, 0, direction, enters > 0 ? enters : -1});
        outside.push_back({from + leaves * direction, 0, direction, length > leaves ? length - leaves : -1});
    }
    std::vector<Hit> near, far;
    for (auto _ : state) {
        near = hits(fine, inside);
        far = hits(coarse, outside);
    }
    fine.report(state, [&](size_t i) {
        return near[i].triangle == Hit::kMiss && far[2 * i].triangle == Hit::kMiss &&
                       far[2 * i + 1].triangle == Hit::kMiss
                   ? 1.0
                   : 0.0;
    });
}

#define ONCE MeasureProcessCPUTime()->Iterations(1)->Unit(benchmark::kMillisecond)
#define VISIBILITY_ERRORS(scene)                                                                    \
    BENCHMARK_CAPTURE(voxelErrorsByPlace, scene, #scene)->ONCE->ArgName("resolution")->Arg(256);    \
    BENCHMARK_CAPTURE(voxelsWithExactEnds, scene, #scene)                                           \
        ->ONCE->ArgName("voxels")                                                                   \
        ->Arg(2)                                                                                    \
        ->Arg(4)                                                                                    \
        ->Arg(8)                                                                                    \
        ->Arg(16)                                                                                   \
        ->Arg(32);                                                                                  \
    BENCHMARK_CAPTURE(voxelCascades, scene, #scene)->ONCE;                                          \
    BENCHMARK_CAPTURE(voxelsThatBlockInPart, scene, #scene)->ONCE->ArgName("adds")->Arg(0)->Arg(1); \
    BENCHMARK_CAPTURE(hybridLeafVisibility, scene, #scene)->ONCE->ArgName("primitives")->Arg(8)->Arg(64)->Arg(1 << 20)
VISIBILITY_ERRORS(sponza);
VISIBILITY_ERRORS(sibenik);
VISIBILITY_ERRORS(conference);
VISIBILITY_ERRORS(living_room);
VISIBILITY_ERRORS(kitchen);
VISIBILITY_ERRORS(cornell);

}  // namespace
}  // namespace voxray
