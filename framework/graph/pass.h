#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "base/schema.h"
#include "graph/memory_plan.h"
#include "graph/port.h"
#include "image/sample_sums.h"
#include "scene/geometry.h"
#include "trace/gpu_scene.h"
#include "trace/ray_tracer.h"
#include "vulkan/commands.h"
#include "vulkan/device.h"
#include "vulkan/kernel.h"
#include "vulkan/memory.h"
#include "vulkan/program.h"

/// What a technique implements. Life of a pass: it is constructed with its ports -> the graph is wired and
/// sorted -> `plan` describes its memory -> the graph makes the memory and compiles the pass's programs ->
/// `prepare` fills tables -> `record`, once (build) or per frame.
namespace voxray {

/// When a pass runs: once for a scene and its lights, or in each frame. Readers of frame passes run in each
/// frame.
enum class Phase { Build, Frame };

/// Input of all passes of a graph. Everything outlives the graph.
struct Frame {
    const SceneState* scene = nullptr;
    Camera camera;  ///< World space.
    /// Moves the compared frame's camera to another frame, by its index relative to that one; empty: it rests.
    std::function<void(Camera&, int)> moveCamera;
    uint32_t width = 0;
    uint32_t height = 0;
    uint64_t seed = 0;
    float exposureStops = 0;  ///< Of previews; images that passes write are radiance without it.
    glm::uvec2 pixels() const { return {width, height}; }
    /// Samples per pixel of a pass that writes their sums (ReferenceSums).
    SamplePart samples;
    /// Where surfaces appeared, disappeared or moved since the build phase ran last (old and new bounds, by
    /// instance); nullopt: everything is new.
    std::optional<std::vector<Box>> changedRegions;
    /// Incremented when surfaces or lights change, with `changedRegions`.
    uint64_t sceneVersion = 0;
    /// Called by long passes with their progress, 0 to 1; false asks them to stop with an Error.
    std::function<bool(double)> progress;
};

/// Description of an image of the frame's size and format.
inline ImageDesc frameImageDesc(const Frame& frame) {
    return {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .extent = {frame.width, frame.height, 1}};
}

/// Given to Pass::plan: describes buffers and images (MemoryPlan), before any memory is allocated.
class PassPlan : public PortAccess, public MemoryPlan {
 public:
    PassPlan(const PortOwner& owner, const std::vector<Resource*>& resources, const Frame& f, const DeviceInfo& d,
             Phase p)
        : PortAccess(owner, resources), frame(f), device(d), phase(p) {}
    const Frame& frame;
    const DeviceInfo& device;
    const Phase phase;  ///< In which the pass runs.
    /// Rays to or from lights in one run, if their number is proportional to that of lights.
    uint64_t lightRays = 0;

    /// Describes an output image of the frame's size.
    void frameImage(const Out<FrameImage>& port) {
        image((*this)[port].image, owner_.nameOf(port), frameImageDesc(frame));
    }
};

/// Given to Pass::prepare: fills tables in the described buffers and images.
class PassSetup : public PortAccess {
 public:
    PassSetup(const PortOwner& owner, const std::vector<Resource*>& resources, const Frame& f, Device& d,
              CommandStream& s)
        : PortAccess(owner, resources), frame(f), device(d), stream(s) {}
    const Frame& frame;
    Device& device;
    CommandStream& stream;
};

/// Given to Pass::record.
class PassContext : public PortAccess {
 public:
    /// @param seenVersions of the resources when the pass recorded last; empty in its first run
    /// @param black a texel, for inputs that nothing writes
    PassContext(const PortOwner& owner, const std::vector<Resource*>& resources,
                const std::optional<std::vector<uint64_t>>& seenVersions, const Frame& f, Device& d, CommandStream& s,
                RayTracer& t, const GpuScene& g, const Image& black, uint32_t index)
        : PortAccess(owner, resources),
          frame(f),
          device(d),
          stream(s),
          tracer(t),
          scene(g),
          frameIndex(index),
          seenVersions_(seenVersions),
          black_(black) {}
    const Frame& frame;
    Device& device;
    CommandStream& stream;
    RayTracer& tracer;
    const GpuScene& scene;
    uint32_t frameIndex;

    /// Whether the pass records for the first time.
    bool isFirstRun() const { return !seenVersions_; }
    /// Whether the contents of an input changed since the pass recorded last; true in its first run, false
    /// for an optional input that nothing writes. @throws Error for a resource that is no input of the pass.
    bool changed(const Resource& input) const;
    bool changed(const Port& input) const {
        const Resource* resource = bound(input);
        return resource && changed(*resource);
    }
    /// Whether the contents of any input changed. If not, this marks the outputs as unchanged: the pass
    /// should return without writing them.
    bool inputsChanged();
    /// Tells the graph that this run leaves the outputs unchanged.
    void markOutputsUnchanged() { outputsUnchanged_ = true; }
    bool outputsUnchanged() const { return outputsUnchanged_; }

    /// Runs a compute program (CommandStream::dispatch).
    void dispatch(const Program& program, const Invocations& invocations, const Bindings& bindings) {
        stream.dispatch(program, invocations, bindings);
    }
    /// One black texel.
    const Image& black() const { return black_; }
    /// The image of an input, or one black texel where nothing writes it.
    const Image& orBlack(const InOptional<FrameImage>& port) const {
        const FrameImage* image = (*this)[port];
        return image ? image->image : black_;
    }
    /// Rays traced without `tracer` (by the reference).
    uint64_t extraRays = 0;
    /// Counters of voxel marches (shaders/voxel_march), read when all passes have run: two 64-bit numbers,
    /// steps and words read. They become the pass's voxel_steps and the value "voxel visits".
    std::vector<const Buffer*> marchCounters;

    struct Value {
        std::string name;
        double value;
    };
    std::vector<Value> reported;
    /// Reports a finite number in values.csv and the report. @param name in words, with its unit, if any.
    void report(std::string name, double value) { reported.push_back({std::move(name), value}); }

    /// A time that the pass tells in place of the device's time stamps before and after it.
    struct ToldTime {
        double milliseconds;
        std::string clock;  ///< Who measured it, in words.
    };
    std::optional<ToldTime> toldTime;
    /// For work that other programs do, and that a pass need not do again in each run to know how long it takes.
    void tellTime(double milliseconds, std::string clock) { toldTime = {milliseconds, std::move(clock)}; }

 private:
    const std::optional<std::vector<uint64_t>>& seenVersions_;
    const Image& black_;
    bool outputsUnchanged_ = false;
};

/// A stage of a graph. A pass class also has `struct Params` with a schema, a constructor from Params,
/// `static constexpr const char* kName, *kHelp` (what it does, what biases it, what makes it noisy, its
/// source), `static constexpr bool kNeedsDevice = false` if it runs without Vulkan, too,
/// `static constexpr bool kDependsOnLight = false` if its outputs stay where lights alone change, and, if it denoises
/// what another pass made, `static constexpr const char* kFilterLabel` (PassKind::filterLabel).
class Pass : public PortOwner, public ProgramOwner {
 public:
    virtual ~Pass() = default;
    /// Frame for a pass that depends on the frame itself, such as its camera. Build for all others, which
    /// still run in each frame if they read a frame pass.
    virtual Phase phase() const { return Phase::Build; }
    /// Whether it reads the frame's camera or size, though it runs in the build phase.
    virtual bool buildReadsView() const { return false; }
    /// Frames until the result of a pass with temporal history has converged.
    virtual uint32_t warmupFrames() const { return 0; }
    /// Checks parameters against scene and device, describes outputs and all memory. Runs in graph order.
    /// @throws Error if the scene or the device doesn't support it.
    virtual void plan(PassPlan& plan) = 0;
    /// Uploads tables to buffers and images. Runs in graph order, after all plans.
    virtual void prepare(PassSetup&) {}
    /// Records dispatches and draws.
    virtual void record(PassContext& context) = 0;
};

}  // namespace voxray
