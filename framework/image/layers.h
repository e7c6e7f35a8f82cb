#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

/// Selection of an image file's channels. Internal to the image layer.
namespace voxray {

/// A layer: channels of an EXR file with a common prefix ("View.AO.R" belongs to the layer "View.AO"), or
/// those of a part without prefixes.
struct Layer {
    std::string name;           ///< Empty for plain channels of a file of one part.
    int part = 0;               ///< Subimage.
    std::vector<int> channels;  ///< Red, green, blue, or one of grey.
    bool isColor = false;       ///< Channels are named R, G, B or Y.
};

/// All layers of one or three channels. @throws Error if a part can't be read
std::vector<Layer> layersOf(OIIO::ImageInput& input);

/// Chooses a layer: by name (full, or its last word), else the only one, plain R, G, B, or the one whose last
/// word is Combined, Beauty, RGBA, RGB, Color or Final, renderers' names of the full image.
/// @throws Error that begins with `file` and lists the layers, if none or several match.
Layer chooseLayer(const std::vector<Layer>& layers, const std::string& wanted, const std::string& file);

}  // namespace voxray
