#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/yaml.h"
#include "experiment/measure.h"
#include "graph/graph.h"
#include "passes/common/families.h"
#include "scene/load.h"
#include "tests/support/device.h"
#include "tests/support/graph_yaml.h"
#include "tests/support/places.h"

namespace voxray::test {

/// A graph run once on a built-in scene, for looking at what its passes wrote.
class Chain {
 public:
    Chain(const std::string& scene, const std::string& sceneParameters, const std::string& graphYaml,
          uint32_t width = 32, uint32_t height = 32, uint64_t seed = 1,
          const std::function<void(Registry&)>& addPasses = {}, std::optional<uint64_t> memoryLimitBytes = {})
        : Chain(std::make_shared<SceneState>(
                    evaluate(makeBuiltinScene(scene, parseYaml(sceneParameters, "scene")), 0.0)),
                graphYaml, width, height, seed, addPasses, memoryLimitBytes) {}

    /// @param addPasses adds a test's own passes to those of the program.
    /// @param memoryLimitBytes of the graph; none: what the device has.
    Chain(const std::shared_ptr<const SceneState>& state, const std::string& graphYaml, uint32_t width,
          uint32_t height, uint64_t seed, const std::function<void(Registry&)>& addPasses = {},
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
        Registry registry;
        registerPasses(registry);
        if (addPasses) addPasses(registry);
        graph_ = std::make_unique<Graph>(registry, parseYaml(graphYaml, "graph"));
        planned =
            graph_->plan(frame_, device().info(), memoryLimitBytes.value_or(device().memoryLimitBytes()));
        graph_->prepare(frame_, device(), compiler_, stream_);
        buildSamples = graph_->run(Phase::Build, frame_, device(), stream_, *tracer_, scene_, 0, true);
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// Another frame, seen from elsewhere.
    void runFrameFrom(const glm::vec3& cameraPosition) {
        frame_.camera.position = cameraPosition;
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// Frames 1 to `count`, which draw other random numbers than frame 0.
    void runFrames(uint32_t count) {
        for (uint32_t i = 1; i <= count; ++i) runFrame(i);
    }

    /// Frame `index`, which draws its own random numbers.
    void runFrame(uint32_t index) {
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, index, true);
    }

    /// Changes the scene in place, takes over what the change says that it changed, and renders a frame.
    void update(const std::function<std::vector<Box>(SceneState&)>& change) {
        frame_.changed = change(*state_);
        ++frame_.sceneVersion;
        updateGpuScene(stream_, *state_, scene_);
        tracer_->update(stream_);
        updateSamples = graph_->run(Phase::Build, frame_, device(), stream_, *tracer_, scene_, 0, true);
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// The build phase once more, with everything new.
    void rebuild() {
        frame_.changed.reset();
        buildSamples = graph_->run(Phase::Build, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// The build phase once more with surfaces as they are: light is injected again.
    void relight() {
        frame_.changed.emplace();
        ++frame_.sceneVersion;
        buildSamples = graph_->run(Phase::Build, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// Another time of a scene that was evaluated as looping.
    void goTo(double timeSeconds) {
        update([&](SceneState& state) { return advance(state, timeSeconds); });
    }

    const SceneState& state() const { return *state_; }
    const Graph& graph() const { return *graph_; }
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
    std::shared_ptr<SceneState> state_;
    ShaderCompiler compiler_;
    CommandStream stream_;
    std::unique_ptr<RayTracer> tracer_;
    GpuScene scene_;
    Frame frame_;
    std::unique_ptr<Graph> graph_;
};

/// What a pass reported under a name. @throws Error where it didn't.
inline double reported(const PassSample& sample, const std::string& name) {
    for (const PassContext::Value& value : sample.reported)
        if (value.name == name) return value.value;
    throw Error("no value '{}' was reported", name);
}

/// Mean of all pixels and channels.
inline double mean(const ImageF& image) {
    double sum = 0;
    for (const float value : image.data) sum += value;
    return sum / double(image.data.size());
}

}  // namespace voxray::test
