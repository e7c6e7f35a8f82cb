#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

/// Which channels of a file are its picture. Internal to the image layer.
namespace voxray {

/// Channels that belong together: those of an EXR file whose names have one beginning ("View.AO.R" is of the
/// layer "View.AO"), or of a part without such names.
struct Layer {
    std::string name;           ///< Empty for plain channels of a file of one part.
    int part = 0;               ///< Subimage.
    std::vector<int> channels;  ///< Red, green, blue, or one of grey.
    bool isColor = false;       ///< They are called so (R, G, B or Y).
};

/// All layers of one or three channels. @throws Error where a part can't be reached
std::vector<Layer> layersOf(OIIO::ImageInput& input);

/// The layer that is meant: by name (whole, or its last word), else the only one, plain R, G, B, else the one
/// whose last word is Combined, Beauty, RGBA, RGB, Color or Final, as renderers call the whole picture.
/// @throws Error that begins with `file` and lists the layers, where that is none or more than one.
Layer chooseLayer(const std::vector<Layer>& layers, const std::string& wanted, const std::string& file);

}  // namespace voxray
