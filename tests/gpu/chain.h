#pragma once

#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/measure.h"
#include "experiment/readback.h"
#include "graph/graph.h"
#include "tests/support/all_passes.h"
#include "tests/support/device.h"
#include "tests/support/graph_yaml.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace voxray::test {

/// A graph run once on a built-in scene, for looking at what its passes wrote.
class Chain {
 public:
    Chain(const std::string& scene, const std::string& sceneParameters, const std::string& graphYaml,
          uint32_t width = 32, uint32_t height = 32, uint64_t seed = 1,
          const std::function<void(Registry&)>& addPasses = {}, std::optional<uint64_t> memoryLimitBytes = {})
        : Chain(builtin(scene, sceneParameters), graphYaml, width, height, seed, addPasses, memoryLimitBytes) {}

    /// @param addPasses adds a test's own passes to those of the program.
    /// @param memoryLimitBytes of the graph; none: what the device has.
    Chain(const State& state, const std::string& graphYaml, uint32_t width = 32, uint32_t height = 32,
          uint64_t seed = 1, const std::function<void(Registry&)>& addPasses = {},
          std::optional<uint64_t> memoryLimitBytes = {})
        : state_(std::make_shared<SceneState>(*state)),
          compiler_(test::sourceRoot(), test::shaderCache()),
          stream_(device()),
          tracer_(makeRayTracer(TracerKind::Embree, device(), compiler_, *state_)),
          scene_(makeGpuScene(device(), stream_, *state_)) {
        frame_.scene = state_.get();
        frame_.camera = state_->cameras.at(0);
        frame_.width = width;
        frame_.height = height;
        frame_.seed = seed;
        Registry registry = allPasses();
        if (addPasses) addPasses(registry);
        graph_ = std::make_unique<Graph>(registry, parseYaml(graphYaml, "graph"));
        planned = graph_->plan(frame_, device().info(), memoryLimitBytes.value_or(device().memoryLimitBytes()));
        graph_->prepare(frame_, device(), compiler_, stream_);
        buildSamples = run(Phase::Build);
        frameSamples = run(Phase::Frame);
    }

    Chain(const SceneState& state, const std::string& graphYaml, uint32_t width = 32, uint32_t height = 32,
          uint64_t seed = 1)
        : Chain(std::make_shared<SceneState>(state), graphYaml, width, height, seed) {}

    /// Another frame, seen from elsewhere; `index` as in runFrame().
    void runFrameFrom(const glm::vec3& cameraPosition, uint32_t index = 0) {
        frame_.camera.position = cameraPosition;
        frameSamples = run(Phase::Frame, index);
    }

    /// Frames 1 to `count`, which draw other random numbers than frame 0.
    void runFrames(uint32_t count) {
        for (uint32_t i = 1; i <= count; ++i) runFrame(i);
    }

    /// Frame `index`, which draws its own random numbers.
    void runFrame(uint32_t index) { frameSamples = run(Phase::Frame, index); }

    /// Changes the scene in place, takes over what the change says that it changed, and renders a frame.
    void update(const std::function<std::vector<Box>(SceneState&)>& change) {
        frame_.changedRegions = change(*state_);
        ++frame_.sceneVersion;
        updateGpuScene(stream_, *state_, scene_);
        tracer_->update(stream_);
        updateSamples = run(Phase::Build);
        frameSamples = run(Phase::Frame);
    }

    /// The build phase once more, with everything new.
    void rebuild() {
        frame_.changedRegions.reset();
        buildSamples = run(Phase::Build);
    }

    /// The build phase once more with surfaces as they are: light is injected again.
    void relight() {
        frame_.changedRegions.emplace();
        ++frame_.sceneVersion;
        buildSamples = run(Phase::Build);
    }

    /// Another time of a scene that was evaluated as looping.
    void goTo(double timeSeconds) {
        update([&](SceneState& state) { return advance(state, timeSeconds); });
    }

    const SceneState& state() const { return *state_; }
    const Graph& graph() const { return *graph_; }
    /// What a pass wrote under this name.
    template <typename T>
    const T& get(const std::string& port) const {
        return *graph_->resource<T>(port);
    }
    /// What was written last under this name: three channels, without alpha.
    ImageF image(const std::string& port) { return downloadImage(device(), stream_, *graph_->image(port)); }
    template <typename T>
    std::vector<T> read(const Buffer& buffer) {
        return stream_.readAs<T>(buffer, buffer.bytes() / sizeof(T));
    }

    /// Texels of an image as its format packs them.
    template <typename T>
    std::vector<T> readImage(const Image& image) {
        const size_t texels = size_t(image.desc().extent.x) * image.desc().extent.y;
        const Buffer buffer(device(), image.name() + " readback", texels * sizeof(T), MemoryKind::Readback);
        stream_.copy(image, buffer);
        return stream_.readAs<T>(buffer, texels);
    }

    std::vector<PassMemory> planned;
    std::vector<PassSample> buildSamples, updateSamples, frameSamples;

 private:
    std::vector<PassSample> run(Phase phase, uint32_t index = 0) {
        return graph_->run(phase, frame_, device(), stream_, *tracer_, scene_, index, true);
    }

    std::shared_ptr<SceneState> state_;
    ShaderCompiler compiler_;
    CommandStream stream_;
    std::unique_ptr<RayTracer> tracer_;
    GpuScene scene_;
    Frame frame_;
    std::unique_ptr<Graph> graph_;
};

/// Moves a scene's first light, for Chain::update().
inline std::vector<Box> moveLight(SceneState& state) {
    state.lights.at(0).position.x += 0.4f;
    return {};
}

/// What a pass reported under a name. @throws Error where it didn't.
inline double reported(const PassSample& sample, const std::string& name) {
    for (const PassContext::Value& value : sample.reported)
        if (value.name == name) return value.value;
    throw Error("no value '{}' was reported", name);
}

/// A graph run on a scene at one of its times.
inline std::unique_ptr<Chain> chainAt(const std::shared_ptr<const Scene>& scene, double seconds,
                                      const std::string& graphYaml) {
    return std::make_unique<Chain>(evaluated(scene, seconds, Playback::Looping), graphYaml, 16, 16);
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

inline constexpr double kPi = std::numbers::pi;

/// Mean of all pixels and channels.
inline double mean(const ImageF& image) {
    double sum = 0;
    for (const float value : image.data) sum += value;
    return sum / double(image.data.size());
}

/// Indirect light by the path tracer; of a built-in scene once in a program.
inline ImageF pathTraced(const State& state, int samples, int bounces, uint32_t width = 32, uint32_t height = 32) {
    const std::string pass = fmt::format("path_trace, spp: {}, bounces: {}", samples, bounces);
    return Chain(state, graphYaml({pass}), width, height).image("indirect");
}
// Names by value: GCC 13 and later warn of a dangling reference where a function of temporary arguments returns one.
inline const ImageF& pathTraced(std::string_view scene, std::string_view parameters, int samples, int bounces,
                                uint32_t width = 32, uint32_t height = 32) {
    static std::map<std::string, ImageF> images;
    ImageF& image = images[fmt::format("{} {} {} {} {} {}", scene, parameters, samples, bounces, width, height)];
    if (image.data.empty())
        image = pathTraced(builtin(std::string(scene), std::string(parameters)), samples, bounces, width, height);
    return image;
}

/// Mean difference of two images over the mean of the second.
inline double meanDifference(const ImageF& a, const ImageF& b) {
    if (a.data.size() != b.data.size()) throw Error("images of {} and {} values", a.data.size(), b.data.size());
    double total = 0;
    for (size_t i = 0; i < b.data.size(); ++i) total += std::abs(double(a.data[i]) - double(b.data[i]));
    return total / double(b.data.size()) / mean(b);
}

/// Indirect light that a graph brings to the image of a scene.
inline ImageF indirectLight(const std::string& scene, const std::string& parameters, const std::string& graphYaml,
                            uint32_t width = 32, uint32_t height = 32) {
    return Chain(scene, parameters, graphYaml, width, height).image("indirect");
}
inline double meanIndirect(const SceneState& state, const std::string& graphYaml, uint32_t width = 32,
                           uint32_t height = 32) {
    return mean(Chain(state, graphYaml, width, height).image("indirect"));
}
inline double meanIndirect(const std::string& scene, const std::string& parameters, const std::string& graphYaml,
                           uint32_t width = 32, uint32_t height = 32) {
    return mean(indirectLight(scene, parameters, graphYaml, width, height));
}

}  // namespace voxray::test
