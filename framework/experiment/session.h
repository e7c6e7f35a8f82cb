#pragma once

#include <functional>
#include <list>
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
    std::string key;         ///< Of everything it depends on.
    std::string cameraless;  ///< The same without the camera.
    uint64_t version = 0;    ///< Another one whenever a scene is loaded or anything but the camera moves.
    PreparedScene prepared;
    GpuScene gpu;
    std::unique_ptr<RayTracer> tracer;
    bool isMoved = false;      ///< Whether it is not in the compared frame.
    double tracerBuildMs = 0;  ///< Time to make the tracer: BVHs, its copies of the scene, its programs.
};

/// Resources that the variants of a run share: the device, the shader compiler, scenes, references.
class Session {
 public:
    Session(const DeviceOptions& device, const std::filesystem::path& sourceRoot,
            std::vector<std::filesystem::path> sceneFolders);

    Device& device() { return device_; }
    CommandStream& stream() { return stream_; }
    ShaderCompiler& compiler() { return compiler_; }
    SceneLoader& loader() { return loader_; }

    /// SceneOnDevice::cameraless
    std::string cameralessKey(const Setup& setup);
    /// The ray-tracing backend of a variant. @throws Error if the device lacks its features.
    std::string tracerName(const Setup& setup) const;

    /// How many scenes stay on the device if their memory suffices: the last requested ones. 1 unless it is set.
    void keepScenes(size_t count);
    /// The variant's scene in the compared frame. It stays on the device until keepScenes() others are requested.
    SceneOnDevice& scene(const Setup& setup);
    /// Gives a scene on the device the variant's camera, if they differ in nothing else and the camera is one of the
    /// config. @return whether the scene, now the last requested one, is the variant's.
    bool moveCamera(const Setup& setup);
    /// Origin of the coordinates of the last requested scene, m.
    glm::vec3 origin() const { return scenes_.empty() ? glm::vec3(0.0f) : scenes_.front().prepared.origin; }
    /// Updates the last requested scene and `frame` to a frame whose index is relative to the compared one.
    void goToFrame(const Setup& setup, Frame& frame, int fromCompared);

    /// A frame of the scene's sequence by its index; the scene on the device is updated to it. Frame::changedRegions
    /// is not set, since it is the first frame of a graph.
    Frame enterFrame(const Setup& setup, uint32_t number, uint64_t seed);

    /// Plans a graph: checks it against scene and device. @return the memory of its passes.
    /// @param limitMb the config's limit of memory in MiB, 0: none.
    std::vector<PassMemory> plan(Graph& graph, const Frame& frame, uint64_t limitMb);

    /// Sets the parts from which references are merged if they are not in the cache.
    void setReferenceParts(ReferenceParts parts) { parts_ = std::move(parts); }
    /// The reference of a variant: from memory, from the cache on disk, from its parts, or rendered now. The
    /// error of a reference that failed is thrown again. @throws Error, Interrupted.
    const ReferenceImages& reference(const Study& study, const Setup& setup,
                                     const std::function<void(double)>& progress);
    /// The same for another frame of a sequence (see isStatic), without caching it in memory.
    ReferenceImages frameReference(const Study& study, const Setup& setup, uint32_t number,
                                   const std::function<void(double)>& progress);
    /// Renders a part of a reference, or loads the whole from the cache. @throws Error, Interrupted.
    RenderedPart referencePart(const Study& study, const Setup& setup, uint32_t number, SamplePart samples,
                               const std::function<void(double)>& progress);
    /// A whole reference from the cache on disk or from its parts.
    std::optional<ReferenceImages> storedReference(const std::string& hash, const Setup& setup);
    /// Writes a whole reference to the cache on disk, if that can be written.
    void storeReference(const ReferenceImages& reference);
    /// Whether a reference is available without rendering it.
    bool hasReference(const std::string& hash) const;
    /// Hash of a variant's reference; "" if the experiment has none.
    std::string referenceHashOf(const Study& study, const Setup& setup, uint32_t number = 0);

    /// The pixels that the experiment's masks select in a frame; Study::masks has those of frame 0.
    std::vector<PixelSelection> selectPixels(const Study& study, const Setup& setup, uint32_t number);

    /// Problems that did not fail a variant.
    std::vector<std::string> warnings() const;

 private:
    /// Loads a scene onto the device, in front of the others. @throws SizeError if they don't fit together.
    void loadScene(const Setup& setup, const std::string& sceneKey);
    RenderedPart renderPart(const Study& study, const Setup& setup, uint32_t number, SamplePart samples,
                            const std::function<void(double)>& progress);

    Device device_;
    CommandStream stream_;
    std::string cacheError_;  ///< Why nothing is stored on disk any more; "": no error.
    ShaderCompiler compiler_;
    SceneLoader loader_;
    ReferenceCache cache_;
    std::optional<ReferenceParts> parts_;
    size_t keptScenes_ = 1;
    std::list<SceneOnDevice> scenes_;  ///< The last requested one first.
    uint64_t sceneVersions_ = 0;
    std::optional<ReferenceImages> reference_;
    std::map<std::string, std::string> failedReferences_;  ///< Hash -> error.
    std::vector<std::string> warnings_;
};

/// Whether nothing moves or changes, including the camera, so that all frames share one reference.
bool isStatic(const SceneSettings& settings);

/// The compared frame of a variant on its scene, which must outlive it.
Frame frameOf(const Setup& setup, const PreparedScene& prepared, uint64_t seed);

}  // namespace voxray
