#pragma once

#include <map>

#include "scene/import/surface.h"
#include "scene/mitsuba/colors.h"

namespace voxray::mitsuba {

/// Turns BSDFs into surfaces, each once. docs/scenes.md lists what becomes of which.
class Surfaces {
 public:
    Surfaces(Colors& colors, ImportNotes& notes) : colors_(colors), notes_(notes) {}

    const Surface& surface(const Plugin& bsdf);

 private:
    Surface make(const Plugin& bsdf);
    Surface nested(const Plugin& bsdf);
    Surface conductor(const Plugin& bsdf);
    Surface plastic(const Plugin& bsdf);
    Surface coating(const Plugin& bsdf);
    Surface dielectric(const Plugin& bsdf);
    Surface phongOrWard(const Plugin& bsdf);
    Surface principled(const Plugin& bsdf);
    Surface blend(const Plugin& bsdf);
    Surface mixture(const Plugin& bsdf);
    Surface mask(const Plugin& bsdf);
    Surface normalMap(const Plugin& bsdf);

    float index(const Plugin& bsdf, const std::string& name, const std::string& fallback);
    float relativeIndex(const Plugin& bsdf, const std::string& inside);
    TexturedColor alpha(const Plugin& bsdf);
    void approximated(const Plugin& bsdf, const std::string& as);

    Colors& colors_;
    ImportNotes& notes_;
    std::map<const Plugin*, Surface> known_;
};

}  // namespace voxray::mitsuba
