#pragma once

#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace voxray {

/// The origin of coordinates. Floats are precise only near 0: a room of 2 m at a distance of 10 km has 2000
/// different coordinates along an edge.
enum class Origin {
    World,  ///< The world's origin.
    Scene   ///< The scene's center if it is far from the world's origin compared with the scene's size.
};

/// A scene as a variant renders it.
struct PreparedScene {
    glm::vec3 origin{0.0f};  ///< Origin of the coordinates of state and camera in the world, m.
    bool isFarAway = false;  ///< Whether Origin::Scene differs from Origin::World.
    SceneState state;        ///< With the lights of the scene and the config; its only camera is `camera`.
    Camera camera;
};

/// Converts the settings of a camera.
Camera cameraOf(const CameraSettings& settings);

/// Loads scenes, applies additions and overrides of a config, and sets its camera, lights, environment and
/// material mode. All loaded scenes are cached as they were loaded.
class SceneLoader {
 public:
    explicit SceneLoader(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

    /// Sets other folders, as for another config.
    void searchIn(std::vector<std::filesystem::path> folders) { folders_ = std::move(folders); }

    /// A file or a built-in scene, unchanged. @throws UsageError for one that doesn't exist or has no such
    /// parameters, Error for a broken file.
    std::shared_ptr<const Scene> load(const SceneSource& source);

    /// Hash of everything that the prepared scene depends on, including the contents of files.
    /// @throws UsageError for a scene, parameter, file or overridden material that doesn't exist, Error for a
    /// broken file.
    std::string key(const SceneSettings& settings);

    /// @throws as key(), and UsageError for a camera that the scene lacks.
    PreparedScene prepare(const SceneSettings& settings, Origin origin = Origin::World);

    /// As prepare(), with a cache of the last few scenes; of fewer if they are large.
    /// @param key that of `settings`. @return a reference that is valid until another scene is prepared here.
    const PreparedScene& prepareCached(const SceneSettings& settings, const std::string& key);
    /// As prepare() with Origin::Scene, or moved out of the cache of prepareCached() if both origins are the
    /// same. Clears the cache.
    PreparedScene takeCached(const SceneSettings& settings, const std::string& key);
    /// Lets prepareCached() return a scene that was taken, while it is in the compared frame. nullptr: none any more.
    void setTaken(const PreparedScene* scene, const std::string& key);

    /// Updates animation, lights, and a camera on an animated node for another frame, whose index is relative
    /// to the compared one. The config's `camera.move` is not applied.
    /// @return boxes in which surfaces moved, as `advance`. @throws Error for a light without direction.
    static std::vector<Box> goToFrame(PreparedScene& prepared, const SceneSettings& settings, int frame);

    /// Sets the camera of a prepared scene; the settings' is one of the config.
    static void setCamera(PreparedScene& prepared, const SceneSettings& settings);

    /// Warnings of all scenes: what is not supported in files, and what was changed.
    std::vector<std::string> warnings() const;

 private:
    /// @throws UsageError for an overridden material that no scene has.
    void checkOverrides(const SceneSettings& settings);
    /// The scene with additions, overrides and hidden objects of the config.
    std::shared_ptr<const Scene> compose(const SceneSettings& settings);
    std::shared_ptr<const ImageF> loadMap(const SceneSettings& settings);

    std::vector<std::filesystem::path> folders_;
    /// By file, or by built-in scene and parameters.
    std::map<std::string, std::shared_ptr<const Scene>> scenes_;
    /// By path and layer.
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const ImageF>> maps_;
    std::vector<std::string> mapWarnings_;  ///< Layers that were selected in maps with several ones.
    std::set<std::string> changes_;         ///< Warnings of compose().
    /// By key, the most recently used one first.
    std::list<std::pair<std::string, PreparedScene>> prepared_;
    std::string takenKey_;
    const PreparedScene* taken_ = nullptr;
};

}  // namespace voxray
