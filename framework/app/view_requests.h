#pragma once

#include <filesystem>

#include "base/value.h"
#include "experiment/shown_state.h"

namespace voxray {

/// Name, shape, type and quantity of a view (docs/session.md).
Value describe(const ViewInfo& info);
/// A list of all views of a state's last rendering. @throws UsageError if nothing is rendered.
Value listViews(ShownState& state);
/// @param parameters of show_voxels, a map; null: none. @throws UsageError
ViewChoice viewChoice(const std::string& name, const Value* parameters, uint64_t maxValues);
/// Reads a view, writes it into a folder, and describes it. @param withPicture writes a PNG file, too.
/// @throws UsageError, Error
Value writeView(ShownState& state, const ViewChoice& choice, bool withPicture, const std::filesystem::path& folder);
/// Adds the meaning of a picture's colors.
void describe(Value& answer, const ViewPicture& picture);

}  // namespace voxray
