#pragma once

#include <string>

#include "scene/load.h"
#include "scene_texts.h"

/// Small pbrt scenes.
namespace voxray::test {

/// A triangle in the plane z = 0, front to +Z.
inline const std::string kTriangle =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]\n";
/// A camera at (0, 0, 5) that looks along -Z in a right-handed world.
inline const std::string kCamera =
    "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" [100]\n"
    "Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40\n";

/// Loads a file of this text.
inline std::shared_ptr<const Scene> loadPbrtText(const TemporaryFolder& folder, const std::string& text) {
    writeText(folder / "scene.pbrt", text);
    return loadPbrt(folder / "scene.pbrt");
}

/// Loads a scene of these directives behind WorldBegin, with that camera.
inline std::shared_ptr<const Scene> loadWorld(const TemporaryFolder& folder, const std::string& world) {
    return loadPbrtText(folder, kCamera + "WorldBegin\n" + world);
}

}  // namespace voxray::test
