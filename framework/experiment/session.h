#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/pixel_masks.h"
#include "experiment/reference.h"
#include "experiment/scene_setup.h"
#include "experiment/study.h"

namespace voxray {

/// A variant's scene on the device.
struct SceneOnDevice {
    std::string key;
    PreparedScene prepared;
    GpuScene gpu;
    std::unique_ptr<RayTracer> tracer;
};

/// What the variants of a run share: the device, the shader compiler, scenes, references.
class Session {
 public:
    Session(const DeviceOptions& device, const std::filesystem::path& sourceRoot,
            std::vector<std::filesystem::path> sceneFolders);

    Device& device() { return device_; }
    CommandStream& stream() { return stream_; }
    ShaderCompiler& compiler() { return compiler_; }
    SceneLoader& loader() { return loader_; }

    /// The backend that a variant gets. @throws Error where the device lacks what it needs.
    std::string tracerName(const Setup& setup) const;

    /// The variant's scene in the compared frame; the last one stays on the device until another is asked
    /// for.
    SceneOnDevice& scene(const Setup& setup);
    /// Where coordinates of the scene on the device count from, m.
    glm::vec3 origin() const { return scene_ ? scene_->prepared.origin : glm::vec3(0.0f); }
    /// Takes the scene on the device, and a frame of it, to a frame counted from the compared one.
    void goToFrame(const Setup& setup, Frame& frame, int fromCompared);

    /// A frame of the scene's sequence, counted from frame 0, with the scene on the device taken to it. To
    /// whoever begins there everything is new.
    Frame enterFrame(const Setup& setup, uint32_t number, uint64_t seed);

    /// Plans a graph: checks it against scene and device and sums up its memory, bytes by pass.
    /// @param limitMb the config's limit for the graph in MiB, 0: none.
    std::vector<PassMemory> plan(Graph& graph, const Frame& frame, uint64_t limitMb);

    /// A folder of parts that references are merged from where the cache hasn't them.
    void takeParts(ReferenceParts parts) { parts_ = std::move(parts); }
    /// The reference of a variant: from memory, from the cache on disk, from its parts, or rendered now.
    /// A reference that failed fails again at once. @throws Error, Interrupted.
    const ReferenceImages& reference(const Study& study, const Setup& setup,
                                     const std::function<void(double)>& progress);
    /// The reference of another frame of a sequence (see standsStill); likewise, not kept in memory.
    ReferenceImages frameReference(const Study& study, const Setup& setup, uint32_t number,
                                   const std::function<void(double)>& progress);
    /// Renders a part of a reference, or takes the whole out of the cache. @throws Error, Interrupted.
    RenderedPart referencePart(const Study& study, const Setup& setup, uint32_t number, SamplePart samples,
                               const std::function<void(double)>& progress);
    /// Whether a reference can be had without rendering it.
    bool hasReference(const std::string& hash) const;
    /// A reference's hash, "" where the experiment has none.
    std::string referenceHashOf(const Study& study, const Setup& setup, uint32_t number = 0);

    /// The pixels that the experiment's masks select in a frame; of the compared one Study::masks knows them.
    std::vector<PixelSelection> selectPixels(const Study& study, const Setup& setup, uint32_t number);

    /// What went wrong without failing a variant, a line each.
    std::vector<std::string> warnings() const;

 private:
    std::optional<ReferenceImages> stored(const std::string& hash, const Setup& setup);
    RenderedPart renderPart(const Study& study, const Setup& setup, uint32_t number, SamplePart samples,
                            const std::function<void(double)>& progress);
    ReferenceImages makeReference(const std::string& hash, const Study& study, const Setup& setup,
                                  uint32_t number, const std::function<void(double)>& progress);
    void store(const ReferenceImages& reference);

    Device device_;
    CommandStream stream_;
    std::string cacheError_;  ///< Why nothing more is stored on disk, or "".
    ShaderCompiler compiler_;
    SceneLoader loader_;
    ReferenceCache cache_;
    std::optional<ReferenceParts> parts_;
    std::optional<SceneOnDevice> scene_;
    bool sceneMoved_ = false;  ///< Out of the compared frame.
    std::optional<ReferenceImages> reference_;
    std::map<std::string, std::string> failedReferences_;  ///< Hash -> error.
    std::vector<std::string> warnings_;
};

/// Whether all frames of a sequence show the same: nothing moves, the camera neither. They then share one
/// reference.
bool standsStill(const SceneSettings& settings);

/// A frame of a variant on its scene; the scene must outlive it.
Frame frameOf(const Setup& setup, const PreparedScene& prepared, uint64_t seed);

}  // namespace voxray
