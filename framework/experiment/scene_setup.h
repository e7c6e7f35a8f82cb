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

/// Where coordinates count from. Floats are dense near 0 alone: a room of 2 m at 10 km has 2000 of them along
/// an edge.
enum class Origin {
    World,  ///< The world's origin.
    Scene   ///< The scene's center, where that is far from the world's origin for the scene's size.
};

/// A scene as a variant renders it.
struct PreparedScene {
    glm::vec3 origin{0.0f};  ///< Coordinates of state and camera count from there, m.
    bool isFarAway = false;  ///< Whether they had better count from the scene's center.
    SceneState state;        ///< Its lights are those that shine, its only camera is `camera`.
    Camera camera;
};

/// Loads scenes, composes what a config adds and overrides, and puts its camera, lights, environment and
/// material mode on them. Keeps every scene it loaded, as it was loaded.
class SceneLoader {
 public:
    explicit SceneLoader(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

    /// Looks in other folders from now on, as for another config.
    void searchIn(std::vector<std::filesystem::path> folders) { folders_ = std::move(folders); }

    /// A file or a built-in scene, as it is. @throws UsageError for one that isn't there or takes other
    /// parameters, Error for a broken file.
    std::shared_ptr<const Scene> load(const SceneSource& source);

    /// Hash of everything that the prepared scene depends on, file contents included.
    /// @throws UsageError for a scene, parameter, file or overridden material that isn't there, Error for a
    /// broken file.
    std::string key(const SceneSettings& settings);

    /// @throws as key(), and UsageError for a camera that the scene lacks.
    PreparedScene prepare(const SceneSettings& settings, Origin origin = Origin::World);

    /// As prepare(), or what that made before: the last few scenes are kept, fewer where they are large.
    /// @param key that of `settings`. @return what stays as long as no other scene is prepared so.
    const PreparedScene& prepareOnce(const SceneSettings& settings, const std::string& key);
    /// As prepare() with Origin::Scene, for one who keeps it: what prepareOnce() made, where its coordinates
    /// do. Frees all else that is kept.
    PreparedScene takePrepared(const SceneSettings& settings, const std::string& key);

    /// Takes a prepared scene to a frame, counted from the compared one: animation, lights, and a camera on
    /// an animated node. A camera's own `move` is not applied.
    /// @return where surfaces moved, as `advance`. @throws Error for a light that is left without direction.
    static std::vector<Box> goToFrame(PreparedScene& prepared, const SceneSettings& settings, int frame);

    /// What loading left out and composing changed, a line each, of all scenes.
    std::vector<std::string> warnings() const;

 private:
    /// @throws UsageError for an overridden material that no scene has.
    void checkOverrides(const SceneSettings& settings);
    /// Takes what `hide` names out of a scene. @throws UsageError for a name that nothing goes by.
    static void hideObjects(const SceneSettings& settings, Scene& scene);
    /// The scene with all that is added, overridden and hidden.
    std::shared_ptr<const Scene> compose(const SceneSettings& settings);
    std::shared_ptr<const ImageF> loadMap(const SceneSettings& settings);

    std::vector<std::filesystem::path> folders_;
    std::map<std::string, std::shared_ptr<const Scene>>
        scenes_;  ///< By file or built-in scene and parameters.
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const ImageF>>
        maps_;                              ///< By path and layer.
    std::vector<std::string> mapWarnings_;  ///< Which layers were taken, where a map has several.
    std::set<std::string> changes_;         ///< What composing changed.
    std::list<std::pair<std::string, PreparedScene>> prepared_;  ///< By key, the last one first.
};

}  // namespace voxray
