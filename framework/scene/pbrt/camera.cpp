#include "scene/pbrt/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace voxray::pbrt {
namespace {

constexpr uint32_t kMaxPixels = 1 << 20;  ///< Along a side.

/// Width over height of the image, pbrt's default without a film.
double aspectOf(const Description& description) {
    if (!description.film) return 1280.0 / 720;
    const Parameters& film = *description.film;
    const uint32_t width = film.count("xresolution", 1280, kMaxPixels);
    const uint32_t height = film.count("yresolution", 720, kMaxPixels);
    if (width == 0 || height == 0) film.fail("its resolution is 0");
    return double(width) / height;
}

/// How many times as bright as the radiance pbrt's image is: exposure time times ISO over 100.
void noteExposure(const Description& description, const Parameters& camera, ImportNotes& notes) {
    const double open = camera.number("shutteropen", 0), close = camera.number("shutterclose", 1);
    const double iso = description.film ? description.film->number("iso", 100) : 100;
    const double time = std::abs(close - open);
    const double ratio = (time > 0 ? time : 1) * iso / 100;
    if (!(ratio > 0) || std::abs(ratio - 1) < 1e-6) return;
    notes.add("pbrt's image is the radiance times its film's exposure, which is not applied; as image.exposure_stops",
              fmt::format("{:.3f} stops", std::log2(ratio)));
}

void noteFilm(const Parameters& film, ImportNotes& notes) {
    const std::string sensor = film.text("sensor", "cie1931");
    if (sensor != "cie1931") notes.add("the colors of a film's sensor are left out", sensor);
    film.ignore({"filename", "diagonal", "savefp16", "iso"});
    for (const char* crop : {"cropwindow", "pixelbounds"})
        if (film.find(crop)) notes.add("a film's crop is left out: the whole image is shown", film.place());
}

}  // namespace

bool showsMirrored(const Description& description) {
    return description.camera && glm::determinant(glm::dmat3(description.camera->toWorld)) > 0;
}

void addCamera(const Description& description, SceneImport& import) {
    ImportNotes& notes = import.notes();
    if (description.film) noteFilm(*description.film, notes);
    if (!description.camera) return;
    const Parameters& camera = *description.camera->parameters;
    noteExposure(description, camera, notes);
    if (camera.kind != "perspective") {
        if (camera.kind != "orthographic" && camera.kind != "realistic" && camera.kind != "spherical")
            camera.fail("the camera \"{}\" is unknown; pbrt-v4 has orthographic, perspective, realistic and spherical",
                        camera.kind.substr(0, 40));
        notes.add("'" + camera.kind + "' cameras are left out", camera.place());
        for (const auto& parameter : camera.unused()) parameter->isUsed = true;
        return;
    }
    if (camera.number("lensradius", 0) > 0) notes.add("depth of field is left out", camera.place());
    camera.ignore({"focaldistance"});

    const double aspect = camera.number("frameaspectratio", aspectOf(description));
    if (!(aspect > 0)) camera.fail("'frameaspectratio' is {}; it is above 0", aspect);
    // The field of view is that of the shorter side, from -1 to 1 of the screen
    std::vector<double> screen = camera.numbers("screenwindow");
    if (screen.empty())
        screen = aspect > 1 ? std::vector<double>{-aspect, aspect, -1, 1}
                            : std::vector<double>{-1, 1, -1 / aspect, 1 / aspect};
    if (screen.size() != 4) camera.fail("'screenwindow' has {} numbers; it wants 4", screen.size());
    const double width = std::abs(screen[1] - screen[0]), height = std::abs(screen[3] - screen[2]);
    if (std::abs(screen[0] + screen[1]) > 1e-4 * width || std::abs(screen[2] + screen[3]) > 1e-4 * height)
        notes.add("a screen window that is off the axis is centered", camera.place());
    const double fov = camera.number("fov", 90);
    if (!(fov > 0 && fov < 180)) camera.fail("'fov' is {}; it is above 0 and below 180 degrees", fov);
    const double vertical = 2 * std::atan(std::tan(glm::radians(fov) / 2) * height / 2);
    import.addCamera("camera", description.camera->toWorld, float(vertical));
}

}  // namespace voxray::pbrt
