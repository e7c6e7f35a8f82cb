#include "config/camera_path.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace voxray {
namespace {

/// The smallest length on the way from a to b, by equal steps.
float shortest(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 way = b - a;
    const float squared = glm::dot(way, way);
    const float nearest = squared > 0 ? glm::clamp(-glm::dot(a, way) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::length(a + nearest * way);
}

}  // namespace

void readCameraPath(const Value& list, CameraSettings& settings) {
    constexpr const char* kPath = "scene.camera.path";
    if (!list.isList())
        throw UsageError(list.where,
                         "{}: expected a list such as [{{frame: 30, position: [0, 1, 3], target: [0, 1, 0]}}]", kPath);
    if (settings.move != glm::vec3(0.0f))
        throw UsageError(list.where, "{}: the camera has a 'move', too; leave one of them out", kPath);
    CameraKey last{0, settings.position, settings.target};
    const glm::vec3 up = glm::normalize(settings.up);
    for (size_t i = 0; i < list.items.size(); ++i) {
        const Value& item = list.items[i];
        const std::string what = fmt::format("{}[{}]", kPath, i);
        const auto key = readParams<CameraKey>(item, what);
        for (const char* name : {"frame", "position", "target"})
            if (!item.find(name)) throw UsageError(item.where, "{}: '{}' is missing", what, name);
        if (key.frame <= last.frame)
            throw UsageError(item.where, "{}: frame {} does not come after frame {}", what, key.frame, last.frame);
        const auto across = [&](const CameraKey& at) { return glm::cross(at.target - at.position, up); };
        const float length = std::min(glm::length(last.target - last.position), glm::length(key.target - key.position));
        if (!(shortest(across(last), across(key)) > 1e-4f * length))
            throw UsageError(item.where,
                             "{}: on the way there from frame {} the camera looks along its own 'up', or nowhere; "
                             "give another key between them",
                             what, last.frame);
        settings.path.push_back(last = key);
    }
}

bool cameraMoves(const CameraSettings& settings) {
    return settings.move != glm::vec3(0.0f) || !settings.path.empty();
}

CameraSettings cameraOnPath(const CameraSettings& settings, int frame) {
    CameraSettings at = settings;
    at.path.clear();
    CameraKey before{0, settings.position, settings.target};
    for (const CameraKey& key : settings.path) {
        const float part = glm::clamp(float(frame - int(before.frame)) / float(key.frame - before.frame), 0.0f, 1.0f);
        at.position = glm::mix(before.position, key.position, part);
        at.target = glm::mix(before.target, key.target, part);
        if (frame <= int(key.frame)) break;
        before = key;
    }
    return at;
}

}  // namespace voxray
