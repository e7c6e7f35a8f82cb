#pragma once

#include "scene/mitsuba/colors.h"

namespace voxray::mitsuba {

/// Adds an emitter that is no shape's: point, spot, directional, constant or envmap. Others are left out, with a note.
void addEmitter(const Plugin& emitter, Colors& colors, SceneImport& import);

}  // namespace voxray::mitsuba
