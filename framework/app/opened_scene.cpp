#include "app/opened_scene.h"

namespace voxray {

OpenedScene openScene(SceneLoader& loader, SceneSettings settings) {
    OpenedScene opened;
    opened.cameras = evaluate(loader.load(settings.source), settings.options.time).cameras;
    opened.hasCamera = settings.camera || !opened.cameras.empty();
    if (!opened.hasCamera) settings.camera.emplace().target = {0, 0, -1};  // A scene is not prepared without one
    opened.prepared = loader.prepare(settings);
    return opened;
}

}  // namespace voxray
