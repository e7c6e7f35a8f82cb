#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiment/measure.h"
#include "experiment/yaml.h"
#include "graph/graph.h"
#include "passes/register_passes.h"
#include "scene/load.h"

namespace voxray::test {

/// One device for all tests of a program, with validation on.
inline Device& device() {
    static Device shared({"", true});
    return shared;
}

/// A graph run once on a built-in scene, for looking at what its passes wrote.
class Chain {
 public:
    Chain(const std::string& scene, const std::string& sceneParameters, const std::string& graphYaml,
          uint32_t width = 32, uint32_t height = 32, uint64_t seed = 1)
        : Chain(std::make_shared<SceneState>(
                    evaluate(makeBuiltinScene(scene, parseYaml(sceneParameters, "scene")), 0.0)),
                graphYaml, width, height, seed) {}

    Chain(std::shared_ptr<const SceneState> state, const std::string& graphYaml, uint32_t width,
          uint32_t height, uint64_t seed)
        : state_(std::move(state)),
          compiler_(VOXRAY_SOURCE_DIR, VOXRAY_TEST_CACHE),
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
        graph_ = std::make_unique<Graph>(registry, parseYaml(graphYaml, "graph"));
        predictedBytes = graph_->plan(frame_, device().info(), device().memoryLimitBytes());
        graph_->prepare(frame_, device(), compiler_, stream_);
        buildSamples = graph_->run(Phase::Build, frame_, device(), stream_, *tracer_, scene_, 0, true);
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// Another frame, seen from elsewhere.
    void runFrameFrom(const glm::vec3& cameraPosition) {
        frame_.camera.position = cameraPosition;
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    /// The build phase and a frame once more, after surfaces have moved within the boxes `changed`; nullopt:
    /// all is new. `state`: the same triangles and bounds, elsewhere.
    void moveTo(std::shared_ptr<const SceneState> state, std::optional<std::vector<Box>> changed) {
        place(std::move(state));
        rebuild(std::move(changed));
    }
    /// The first half of moveTo(): the scene, for passes and rays.
    void place(std::shared_ptr<const SceneState> state) {
        state_ = std::move(state);
        tracer_ = makeRayTracer(TracerKind::Embree, device(), compiler_, *state_);
        scene_ = makeGpuScene(device(), stream_, *state_);
        frame_.scene = state_.get();
    }
    /// The second half: the passes.
    void rebuild(std::optional<std::vector<Box>> changed) {
        frame_.changed = std::move(changed);
        buildSamples = graph_->run(Phase::Build, frame_, device(), stream_, *tracer_, scene_, 0, true);
        frameSamples = graph_->run(Phase::Frame, frame_, device(), stream_, *tracer_, scene_, 0, true);
    }

    const SceneState& state() const { return *state_; }
    const Graph& graph() const { return *graph_; }
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

    std::vector<uint64_t> predictedBytes;
    std::vector<PassSample> buildSamples, frameSamples;

 private:
    std::shared_ptr<const SceneState> state_;
    ShaderCompiler compiler_;
    CommandStream stream_;
    std::unique_ptr<RayTracer> tracer_;
    GpuScene scene_;
    Frame frame_;
    std::unique_ptr<Graph> graph_;
};

/// Mean of all pixels and channels.
inline double mean(const ImageF& image) {
    double sum = 0;
    for (const float value : image.data) sum += value;
    return sum / double(image.data.size());
}

}  // namespace voxray::test
