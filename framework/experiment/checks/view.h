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

/// A radiance that previews show well, W/(m² sr).
inline constexpr double kWellSeen = 0.2;

/// Path traces a small image of what a camera sees, on the host: `spp` paths a pixel, of up to `bounces`
/// bounces. 3 channels, W/(m² sr).
using Preview = std::function<ImageF(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                                     uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces)>;

/// A point off a surface that the camera sees, with the unit normal of the side that it sees.
struct SeenPoint {
    glm::vec3 position, normal;
};

/// Where surfaces fill less of the view there is hardly an image to compare.
inline constexpr double kMinSeen = 0.01;

/// What a look through a variant's camera shows before anything is rendered there.
struct View {
    const Setup& setup;
    const PreparedScene& prepared;  ///< In the compared frame.
    const EmbreeScene& tracer;      ///< Of its state.
    /// Whether a light alone lights anything that is seen, be it by reflections.
    std::function<bool(const Light&)> isFound;
    std::vector<SeenPoint> points;  ///< Of the image, evenly.
    double filled = 0;              ///< Part of it that shows surfaces.
    double metal = 0;               ///< Part of these that is metal.
    bool showsBacks = false;        ///< Mostly, of surfaces.
    bool isEmpty = false;           ///< Surfaces fill less than kMinSeen of it.
    ImageF image = {};              ///< Path traced, 3 channels, W/(m² sr); none where the view is empty.

    const SceneState& state() const { return prepared.state; }
    const SceneSettings& scene() const { return setup.scene; }
    /// The part of the image that shows surfaces or a sky, above 0.
    double lit() const;
};

/// What kViewChecks found of a view.
struct ViewCheck {
    Diagnostics found;
    double metal = 0;  ///< View::metal
};

/// Looks at a scene through a variant's camera and does kViewChecks: a small path-traced image of few
/// samples, and while that is black of more.
/// @param preview empty: nothing is looked at but whether a surface lies in view.
/// @throws UsageError where none does, and as kViewChecks.
ViewCheck checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview);

/// Checks each view once: other variants, profiles and configs show the same ones.
class ViewChecks {
 public:
    explicit ViewChecks(Preview preview) : preview_(std::move(preview)) {}
    /// As checkView(). @param sceneKey SceneLoader::key() of the scene.
    const ViewCheck& of(const Setup& setup, const std::string& sceneKey, const PreparedScene& prepared);

 private:
    Preview preview_;
    std::map<std::string, ViewCheck> known_;  ///< By all that a view depends on.
};

/// Whether a pass of the graph voxelizes the scene.
bool isVoxelized(const Setup& setup);

/// Whether previews show what a camera sees black at an exposure: on average it is less than half a step of
/// their 8 bits.
/// @param view 3 channels, W/(m² sr). @param filled the part of it that shows surfaces or a sky, above 0.
bool isDarkAt(float exposureStops, const ImageF& view, double filled);

bool isBlack(const ImageF& image);

/// "[1, 2.5, 3]".
std::string bracketed(const glm::vec3& v);

TextLocation cameraPlace(const SceneSettings& scene);

/// What gives a camera that sees the scene; a file is found from its config's folder, so by way of that.
std::string cameraAdvice(const SceneSettings& scene);

}  // namespace voxray
