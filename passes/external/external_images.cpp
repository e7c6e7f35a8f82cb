#include "passes/external/external_images.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"

namespace voxray {
namespace {

ImageF readFrame(const std::filesystem::path& path, uint32_t width, uint32_t height) {
    if (!std::filesystem::is_regular_file(path)) throw Error("{} is missing", path.string());
    ImageF image = readImage(path);
    if (image.width != width || image.height != height)
        throw Error("{} has {} x {} pixels, the config's image {} x {}", path.string(), image.width, image.height,
                    width, height);
    size_t wrong = 0, first = 0;
    for (size_t i = 0; i < image.data.size(); ++i)
        if (!std::isfinite(image.data[i]) && wrong++ == 0) first = i / image.channels;
    if (wrong > 0)
        throw Error("{}: {} values are NaN or infinite, the first in column {}, row {}", path.string(), wrong,
                    first % width, first / width);
    return image;
}

std::optional<double> readTime(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) return std::nullopt;
    constexpr const char* kKey = "render_seconds";
    const nlohmann::json json = nlohmann::json::parse(readTextFile(path), nullptr, false);
    if (!json.is_object() || !json.contains(kKey) || !json[kKey].is_number() || !(json[kKey].get<double>() > 0))
        throw Error("{}: expected {{\"{}\": SECONDS}}, with more than 0 seconds", path.string(), kKey);
    return json[kKey].get<double>();
}

}  // namespace

ExternalImages readExternalImages(const std::filesystem::path& folder, ExternalLight light, uint32_t width,
                                  uint32_t height) {
    ExternalImages images;
    if (light == ExternalLight::Total) {
        images.final = readFrame(folder / kTotalFile, width, height);
    } else {
        images.final = readFrame(folder / kDirectFile, width, height);
        images.indirect = readFrame(folder / kIndirectFile, width, height);
        for (size_t i = 0; i < images.final.data.size(); ++i) images.final.data[i] += images.indirect.data[i];
    }
    images.renderSeconds = readTime(folder / kTimeFile);
    return images;
}

}  // namespace voxray
