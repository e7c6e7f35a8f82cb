#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

#include "base/schema.h"
#include "graph/memory_plan.h"
#include "graph/plan_memo.h"
#include "image/sample_sums.h"
#include "scene/geometry.h"
#include "trace/gpu_scene.h"
#include "trace/ray_tracer.h"
#include "vulkan/commands.h"
#include "vulkan/device.h"
#include "vulkan/memory.h"
#include "vulkan/program.h"

/// What a technique implements. Life of a pass: `declare` its ports (pure) -> the graph is wired and sorted
/// -> `plan` describes its memory, which the graph makes -> `prepare` programs -> `record`, once (build) or
/// per frame.
namespace voxray {

/// An image to look at (AOV), as channels of an EXR file: "P.X" is the channel X of the layer P.
struct Aov {
    const Image* image;                 ///< RGBA32F or RGBA16F.
    std::vector<std::string> channels;  ///< Names of the image's first components.
};

/// What passes hand to each other: a plain struct of buffers and images. The pass that writes it describes
/// them in plan(), or makes them in record() where their size is counted.
struct Resource {
    virtual ~Resource() = default;
    /// False for an output that nothing reads: its producer may leave it empty. Set by the graph, before
    /// plan().
    bool isRead = true;
    /// Bounces of light between a source and the surface that the camera sees, at most, as `bounces` of
    /// path_trace counts them; nullopt where it carries no indirect light or has no such bound. Of stored
    /// light those before it arrives where it is stored. Set in plan().
    std::optional<uint32_t> lightBounces;
    /// Name of the input by which its elements are numbered, such as "voxels"; empty: none. Who reads both
    /// must read the same one as the pass that wrote this.
    virtual std::string basisPort() const { return {}; }
    /// What its elements are numbered by; null where its writer reads no such input. Set by the graph.
    const Resource* basis = nullptr;
    /// Float images and float buffers that are checked for NaN and infinity after the producing pass ran.
    virtual std::vector<const Image*> checkedImages() const { return {}; }
    virtual std::vector<const Buffer*> checkedBuffers() const { return {}; }
    /// What `run --aovs` writes of it, all of one size.
    virtual std::vector<Aov> aovs() const { return {}; }
};

/// Bounces of what surfaces reflect of stored light, from Resource::lightBounces of it.
inline std::optional<uint32_t> oneMore(std::optional<uint32_t> bounces) {
    return bounces ? std::optional(*bounces + 1) : std::nullopt;
}

/// A radiance image of the frame's size: RGBA32F, linear Rec.709, W/(m² sr).
struct FrameImage : Resource {
    Image image;
    /// Of indirect light: whether what specular lobes reflect is in it. Set in plan().
    bool hasSpecularLobes = false;
    std::vector<const Image*> checkedImages() const override { return {&image}; }
};

/// A port of a pass, bound by the graph to a resource: Port<const T> to read it, Port<T> to write it.
template <typename T>
struct Port {
    int index = -1;  ///< Of the pass's own ports.
};

/// When a pass runs: once for a scene and its lights, or in each frame. A pass that reads what is written in
/// each frame runs in each frame.
enum class Phase { Build, Frame };

struct PortInfo {
    std::string name;
    std::string help;
    bool output = false;
    bool optional = false;
    std::type_index type = typeid(void);
    Resource* (*create)() = nullptr;
};

/// Collects the ports of a pass.
class PassBuilder {
 public:
    /// Reads what an earlier pass writes under this name (or under the name that the config's `inputs`
    /// gives).
    template <typename T>
    Port<const T> read(std::string name, std::string help) {
        return add<const T>({std::move(name), std::move(help), false, false, typeid(T)});
    }
    /// The same, but the graph is valid without it; `PassPlan::has` and `PassContext::has` tell.
    template <typename T>
    Port<const T> readOptional(std::string name, std::string help) {
        return add<const T>({std::move(name), std::move(help), false, true, typeid(T)});
    }
    template <typename T>
    Port<T> write(std::string name, std::string help) {
        return add<T>({std::move(name), std::move(help), true, false, typeid(T),
                       []() -> Resource* { return new T(); }});
    }
    const std::vector<PortInfo>& ports() const { return ports_; }

 private:
    template <typename T>
    Port<T> add(PortInfo info) {
        ports_.push_back(std::move(info));
        return {int(ports_.size()) - 1};
    }
    std::vector<PortInfo> ports_;
};

/// What all passes of a graph share. Everything outlives the graph.
struct Frame {
    const SceneState* scene = nullptr;
    /// What plans found out about `scene`; without it each plan finds out for itself.
    std::shared_ptr<PlanMemo> memo;
    Camera camera;               ///< World space.
    glm::vec3 cameraMove{0.0f};  ///< From this frame to the next, m.
    uint32_t width = 0;
    uint32_t height = 0;
    uint64_t seed = 0;
    /// The part of its samples that a pass takes which writes their sums (ReferenceSums).
    SamplePart samples;
    /// Where surfaces came, went or moved since the build phase ran last (old and new bounds of what moves,
    /// each instance apart); nullopt: everything is new.
    std::optional<std::vector<Box>> changed;
    /// Another one whenever surfaces or lights have changed: one more each time that `changed` is told.
    uint64_t sceneVersion = 0;
    /// Called by passes that take long with the part that is done, 0 to 1; false asks them to stop with an
    /// Error.
    std::function<bool(double)> progress;
};

/// Access to the resources that a pass's ports are bound to.
class PortAccess {
 public:
    explicit PortAccess(const std::vector<Resource*>& resources) : resources_(resources) {}
    template <typename T>
    T& get(Port<T> port) const {
        return static_cast<T&>(*resources_[size_t(port.index)]);
    }
    template <typename T>
    bool has(Port<T> port) const {
        return resources_[size_t(port.index)] != nullptr;
    }

 private:
    const std::vector<Resource*>& resources_;
};

/// For describing buffers and images (MemoryPlan), before any memory is taken.
class PassPlan : public PortAccess, public MemoryPlan {
 public:
    PassPlan(const std::vector<Resource*>& resources, const Frame& f, const DeviceInfo& d, Phase p)
        : PortAccess(resources), frame(f), device(d), phase(p) {}
    const Frame& frame;
    const DeviceInfo& device;
    const Phase phase;  ///< In which the pass runs.
    /// Rays that one run traces to or from lights, where they are so many for each light.
    uint64_t lightRays = 0;

    /// The answer of `find`, which depends on the scene's surfaces and on what `key` names alone: asked once
    /// for all variants of a scene (PlanMemo).
    template <typename Find>
    auto ofScene(const std::string& key, const Find& find) const {
        return frame.memo ? frame.memo->get(key, find) : find();
    }
};

/// For making programs, and for uploading to buffers and images that were described.
class PassSetup : public PortAccess {
 public:
    PassSetup(const std::vector<Resource*>& resources, const Frame& f, Device& d, const ShaderCompiler& c,
              CommandStream& s)
        : PortAccess(resources), frame(f), device(d), compiler(c), stream(s) {}
    const Frame& frame;
    Device& device;
    const ShaderCompiler& compiler;
    CommandStream& stream;
};

/// For running.
class PassContext : public PortAccess {
 public:
    PassContext(const std::vector<Resource*>& resources, const Frame& f, Device& d, CommandStream& s,
                RayTracer& t, const GpuScene& g, uint32_t index)
        : PortAccess(resources), frame(f), device(d), stream(s), tracer(t), scene(g), frameIndex(index) {}
    const Frame& frame;
    Device& device;
    CommandStream& stream;
    RayTracer& tracer;
    const GpuScene& scene;
    uint32_t frameIndex;
    /// What the graph's limit leaves to this pass beyond what all have planned, for parts that it sizes by
    /// what it counts (MemoryPlan::reserveCounted).
    uint64_t spareBytes = 0;
    /// Rays traced outside of `tracer` (the reference traces on its own).
    uint64_t extraRays = 0;
    /// Counts of walks through voxels (shaders/voxel_march), which the graph reads when all passes have run:
    /// two 64-bit numbers, steps and words visited. They become the pass's voxel_steps and the value "voxel
    /// visits".
    std::vector<const Buffer*> voxelCounts;

    struct Value {
        std::string name;
        double value;
    };
    std::vector<Value> reported;
    /// Leaves a finite number for values.csv and the report, under a name in words (with its unit, if any).
    void report(std::string name, double value) { reported.push_back({std::move(name), value}); }
};

/// A stage of a graph. A pass class also has `struct Params` with a schema, a constructor from Params, and
/// `static constexpr const char* kName, *kHelp` (what it does, what biases it, what makes it noisy, its
/// source), and `static constexpr bool kNeedsDevice = false` where it runs without Vulkan, too.
class Pass {
 public:
    virtual ~Pass() = default;
    /// Frame for a pass that depends on the frame itself, such as its camera. Build for all others: they run
    /// once, or in each frame where they read what is written in each frame.
    virtual Phase phase() const { return Phase::Build; }
    /// How many frames have to lead up to one that shows what the pass can: of one that goes on from frame to
    /// frame.
    virtual uint32_t framesBefore() const { return 0; }
    /// Names the ports. No device work.
    virtual void declare(PassBuilder& builder) = 0;
    /// Checks parameters against scene and device, describes outputs and all memory. Runs in graph order.
    /// @throws Error for what this scene or device can't do.
    virtual void plan(PassPlan& plan) = 0;
    /// Makes programs; buffers and images are there. Runs in graph order, after all plans.
    virtual void prepare(PassSetup& setup) = 0;
    /// Records the work.
    virtual void record(PassContext& context) = 0;
};

}  // namespace voxray
