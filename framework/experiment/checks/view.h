#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "experiment/checks/diagnostic.h"
#include "experiment/scene_setup.h"
#include "image/image.h"
#include "trace/embree_scene.h"

namespace voxray {

/// A radiance of medium brightness in previews, W/(m² sr).
inline constexpr double kPreviewRadiance = 0.2;

/// Path traces a small image on the host, `spp` paths per pixel. 3 channels, W/(m² sr).
using Preview = std::function<ImageF(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                                     uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces)>;

/// A point on a visible surface, offset from it, with the unit normal of the visible side.
struct VisiblePoint {
    glm::vec3 position, normal;
};

/// If surfaces cover a smaller fraction of the view, there is hardly an image to compare.
inline constexpr double kMinSurfaceFraction = 0.01;

/// What a variant's camera sees, by a few rays and a path-traced preview.
struct View {
    const Setup& setup;
    const PreparedScene& prepared;  ///< In the compared frame.
    const EmbreeScene& tracer;      ///< Built from `prepared.state`.
    /// Whether a light on its own lights any visible surface, directly or by reflections.
    std::function<bool(const Light&)> reachesView;
    std::vector<VisiblePoint> points;  ///< Evenly distributed over the image.
    double surfaceFraction = 0;        ///< Fraction of the image that shows surfaces.
    double visibleMetalFraction = 0;   ///< Fraction of these surfaces that is metal.
    bool showsBacks = false;           ///< Whether most of these surfaces show their back sides.
    bool isEmpty = false;              ///< Whether surfaceFraction is below kMinSurfaceFraction.
    ImageF image = {};                 ///< Path traced, 3 channels, W/(m² sr); none if the view is empty.

    const SceneState& state() const { return prepared.state; }
    const SceneSettings& scene() const { return setup.scene; }
    /// The fraction of the image that shows surfaces or a sky, above 0.
    double contentFraction() const;
};

/// The result of kViewChecks for a view.
struct ViewCheck {
    Diagnostics found;
    double visibleMetalFraction = 0;  ///< View::visibleMetalFraction
};

/// Does kViewChecks for a variant's camera. A small image is path traced with few samples and, if it is
/// black, with more.
/// @param preview empty: the only check is whether a surface is in view.
/// @throws UsageError if none is in view, and as kViewChecks.
ViewCheck checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview);

/// Checks each view once, since several variants, profiles and configs may have the same one.
class CameraViewChecks {
 public:
    explicit CameraViewChecks(Preview preview) : preview_(std::move(preview)) {}
    /// Whether new views are traced. Else one is only checked for a surface in view, and not remembered.
    void setTracesNewViews(bool traces) { tracesNewViews_ = traces; }
    /// As checkView(). @param sceneKey SceneLoader::key() of the scene.
    ViewCheck of(const Setup& setup, const std::string& sceneKey, const PreparedScene& prepared);

 private:
    Preview preview_;
    bool tracesNewViews_ = true;
    std::map<std::string, ViewCheck> known_;  ///< By everything that a view depends on.
};

/// Whether a pass of the graph voxelizes the scene.
bool isVoxelized(const Setup& setup);

/// Whether a view is black in previews at an exposure: its mean is less than half a step of their 8 bits.
/// @param view 3 channels, W/(m² sr). @param contentFraction of the view, above 0.
bool isDarkAt(float exposureStops, const ImageF& view, double contentFraction);

bool isBlack(const ImageF& image);

/// "[1, 2.5, 3]".
std::string bracketed(const glm::vec3& v);

TextLocation cameraLocation(const SceneSettings& scene);

/// Advice on how to get a camera that sees the scene. For a scene file it names the config.
std::string cameraAdvice(const SceneSettings& scene);

}  // namespace voxray
