#include "scene/pbrt/textures.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/lower_case.h"
#include "scene/pbrt/spectra.h"

namespace voxray::pbrt {
namespace {

glm::vec3 grey(const glm::vec3& color) {
    return glm::vec3((color.x + color.y + color.z) / 3);
}

/// Constants in place of procedural textures: about their means.
std::optional<glm::vec3> proceduralMean(const std::string& kind) {
    if (kind == "marble") return glm::vec3(0.79f, 0.79f, 0.82f);
    if (kind == "fbm" || kind == "wrinkled" || kind == "windy" || kind == "ptex") return glm::vec3(0.5f);
    return {};
}

}  // namespace

TexturedColor Textures::color(const Parameters& parameters, const std::string& name, const glm::vec3& otherwise) {
    const Parameter* parameter = parameters.find(name);
    if (!parameter) return otherwise;
    return parameter->type == "texture" ? named(*parameter, true) : reflectanceOf(*parameter, folder_);
}

TexturedColor Textures::number(const Parameters& parameters, const std::string& name, float otherwise) {
    const Parameter* parameter = parameters.find(name);
    if (!parameter) return glm::vec3(otherwise);
    if (parameter->type == "texture") return named(*parameter, false);
    return glm::vec3(float(parameters.number(name, double(otherwise))));
}

float Textures::plainNumber(const Parameters& parameters, const std::string& name, float otherwise) {
    const TexturedColor value = number(parameters, name, otherwise);
    return grey(mean(value, parameters, "the mean of an image is taken where a number is wanted")).x;
}

TexturedColor Textures::named(const Parameter& parameter, bool isColor) {
    if (parameter.strings.size() != 1) throw Error(parameter.where, "'{}' wants one texture", parameter.name);
    const std::string& name = parameter.strings[0];
    const auto& textures = isColor ? description_.colorTextures : description_.floatTextures;
    const auto found = textures.find(name);
    if (found == textures.end())
        throw Error(parameter.where, "'{}' names the {} texture \"{}\", which is not defined", parameter.name,
                    isColor ? "spectrum" : "float", name.substr(0, 100));
    const Parameters* texture = found->second.parameters.get();
    const auto known = made_.find(texture);
    if (known != made_.end()) return known->second;
    constexpr size_t kMaxDepth = 100;
    if (inWork_.size() >= kMaxDepth || !inWork_.insert(texture).second)
        throw Error(parameter.where, "the texture \"{}\" refers to itself, or textures are nested more than {} deep",
                    name.substr(0, 100), kMaxDepth);
    TexturedColor color = made(*texture, isColor);
    inWork_.erase(texture);
    return made_[texture] = std::move(color);
}

TexturedColor Textures::argument(const Parameters& texture, const std::string& name, float otherwise, bool isColor) {
    return isColor ? color(texture, name, glm::vec3(otherwise)) : number(texture, name, otherwise);
}

TexturedColor Textures::made(const Parameters& texture, bool isColor) {
    const std::string& kind = texture.kind;
    if (kind == "constant") return argument(texture, "value", 1, isColor);
    if (kind == "imagemap") return imageMap(texture, isColor);
    if (kind == "checkerboard") return checkerboard(texture, isColor);
    if (kind == "scale") return product(argument(texture, "tex", 1, isColor), number(texture, "scale", 1), texture);
    if (kind == "mix") return mix(texture, isColor);
    if (const auto constant = proceduralMean(kind)) {
        import_.notes().add("'" + kind + "' textures are a constant, about their mean", texture.place());
        texture.ignore({"filename", "octaves", "roughness", "scale", "variation", "encoding"});
        return isColor ? *constant : grey(*constant);
    }
    const auto between = [&](const char* a, const char* b, float first, float second) {
        import_.notes().add("'" + kind + "' textures are a constant, their mean", texture.place());
        const char* what = "the mean of an image is taken within such a texture";
        return TexturedColor(0.5f * (mean(argument(texture, a, first, isColor), texture, what) +
                                     mean(argument(texture, b, second, isColor), texture, what)));
    };
    if (kind == "directionmix") return between("tex1", "tex2", 0, 1);
    if (kind == "dots") return between("inside", "outside", 1, 0);
    if (kind == "bilerp") {
        texture.ignore({"v01", "v10"});
        return between("v00", "v11", 0, 1);
    }
    texture.fail(
        "the texture \"{}\" is unknown; pbrt-v4 has bilerp, checkerboard, constant, directionmix, dots, fbm, "
        "imagemap, marble, mix, ptex, scale, windy and wrinkled",
        kind.substr(0, 40));
}

glm::vec3 Textures::mean(const TexturedColor& color, const Parameters& texture, const char* what) {
    if (color.image) import_.notes().add(what, texture.place());
    return color.mean();
}

TexturedColor Textures::mapped(const TexturedColor& color, const std::function<glm::vec3(const glm::vec3&)>& change) {
    if (color.image) import_.memory().reserve(color.image->pixels->data.size(), sizeof(float));
    return color.mapped(change);
}

void Textures::setMapping(const Parameters& texture, ColorImage& image, const glm::vec2& scale, bool fromTop) {
    const std::string mapping = texture.text("mapping", "uv");
    if (mapping != "uv") {
        import_.notes().add("'" + mapping + "' mapping of textures is by the (u, v) of shapes", texture.place());
        texture.ignore({"v1", "v2"});
    }
    const auto su = float(texture.number("uscale", 1)), sv = float(texture.number("vscale", 1));
    const auto du = float(texture.number("udelta", 0)), dv = float(texture.number("vdelta", 0));
    image.transform[0] = scale.x * glm::vec3(su, 0, du);
    // pbrt's v goes up
    image.transform[1] = fromTop ? scale.y * glm::vec3(0, sv, dv) : glm::vec3(0, -scale.y * sv, 1 - scale.y * dv);
}

std::shared_ptr<ColorImage> Textures::image(const std::string& file, ColorImages::Stored stored) {
    auto image = std::make_shared<ColorImage>();
    image->pixels = import_.images().read(folder_ / file, stored);
    if (!image->pixels) return nullptr;
    image->name = std::filesystem::path(file).filename().string();
    image->transform = {glm::vec3(1, 0, 0), glm::vec3(0, -1, 1)};
    return image;
}

TexturedColor Textures::imageMap(const Parameters& texture, bool isColor) {
    const std::string file = texture.text("filename", "");
    if (file.empty()) texture.fail("an imagemap needs a 'filename'");
    const std::string encoding = texture.text("encoding", "sRGB");
    // pbrt decodes other 8-bit images than PNG as sRGB, whatever the parameter says
    const bool isPng = lowerCase(std::filesystem::path(file).extension().string()) == ".png";
    const bool isLinear = encoding == "linear" && isPng;
    if (encoding.starts_with("gamma")) import_.notes().add("images with a gamma are read as sRGB", texture.place());
    const auto scale = float(texture.number("scale", 1));
    const bool inverts = texture.flag("invert", false);
    const std::string filter = texture.text("filter", "bilinear"), wrap = texture.text("wrap", "repeat");
    texture.ignore({"maxanisotropy"});

    TexturedColor color;
    const auto image = this->image(file, isLinear ? ColorImages::Stored::Linear : ColorImages::Stored::Srgb);
    if (!image) {
        texture.ignore({"mapping", "uscale", "vscale", "udelta", "vdelta", "v1", "v2"});
        return glm::vec3(0.5f);
    }
    setMapping(texture, *image, glm::vec2(1), false);
    image->filter = filter == "point" ? TexelFilter::Nearest : TexelFilter::Linear;
    image->wrapU = image->wrapV = wrap == "clamp" || wrap == "black" ? Wrap::ClampToEdge : Wrap::Repeat;
    if (wrap == "black" || wrap == "octahedralsphere")
        import_.notes().add("'" + wrap + "' wrapping of textures is replaced", texture.place());
    color.image = image;
    color.value = glm::vec3(scale);
    if (inverts) color = mapped(color, [](const glm::vec3& c) { return glm::max(1.0f - c, glm::vec3(0)); });
    return isColor ? color : mapped(color, grey);
}

TexturedColor Textures::checkerboard(const Parameters& texture, bool isColor) {
    const char* what = "a checkerboard of images is one of their means";
    const glm::vec3 first = mean(argument(texture, "tex1", 1, isColor), texture, what);
    const glm::vec3 second = mean(argument(texture, "tex2", 0, isColor), texture, what);
    if (texture.count("dimension", 2, 3) != 2) {
        import_.notes().add("checkerboards of three dimensions are a constant, their mean", texture.place());
        return 0.5f * (first + second);
    }
    auto pixels = std::make_shared<ImageF>(2u, 2u, 3u);
    for (uint32_t i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) pixels->pixel(i % 2, i / 2)[c] = (i == 0 || i == 3 ? first : second)[c];
    auto image = std::make_shared<ColorImage>();
    image->name = "checkerboard " + texture.place();
    image->pixels = std::move(pixels);
    image->filter = TexelFilter::Nearest;
    // A cell is one unit wide; the image is two cells
    setMapping(texture, *image, glm::vec2(0.5f), true);
    TexturedColor color;
    color.image = std::move(image);
    return color;
}

TexturedColor Textures::mix(const Parameters& texture, bool isColor) {
    const TexturedColor first = argument(texture, "tex1", 0, isColor), second = argument(texture, "tex2", 1, isColor);
    const TexturedColor amount = number(texture, "amount", 0.5f);
    if (amount.image) {
        const char* what = "a mix of images by an image takes the means of the first two";
        const glm::vec3 a = mean(first, texture, what), b = mean(second, texture, what);
        return mapped(amount, [&](const glm::vec3& t) { return glm::mix(a, b, t); });
    }
    const glm::vec3& t = amount.value;
    if (!second.image) return mapped(first, [&](const glm::vec3& c) { return glm::mix(c, second.value, t); });
    const glm::vec3 a = mean(first, texture, "a mix of two images takes the mean of the first");
    return mapped(second, [&](const glm::vec3& c) { return glm::mix(a, c, t); });
}

TexturedColor Textures::product(const TexturedColor& a, const TexturedColor& b, const Parameters& texture) {
    TexturedColor result = a.image ? a : b;
    result.value = a.value * b.value;
    // Of two images the first stays
    if (a.image && b.image)
        result.value = a.value * mean(b, texture, "a product of two images takes the mean of the second");
    return result;
}

}  // namespace voxray::pbrt
