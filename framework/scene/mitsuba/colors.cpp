#include "scene/mitsuba/colors.h"

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "base/lower_case.h"
#include "base/srgb.h"
#include "scene/import/numbers.h"
#include "scene/import/spectrum.h"

namespace voxray::mitsuba {
namespace {

constexpr float kMissing = 0.5f;  ///< Of each channel of a texture that can't be read.

glm::vec3 blackbody(double kelvin, double scale, const TextLocation& where) {
    if (!(kelvin > 0)) throw Error(where, "a black body has a temperature above 0 K");
    return rgbOfXyz(xyzOfBlackbody(kelvin) * scale);
}

/// "a, b, c" and "x, y, z" as "a:x b:y c:z", for 'irregular' spectra.
std::string pairedText(const std::string& wavelengths, const std::string& values, const TextLocation& where) {
    const std::vector<double> a = readNumbers(wavelengths), b = readNumbers(values);
    if (a.size() != b.size()) throw Error(where, "{} wavelengths for {} values", a.size(), b.size());
    std::string text;
    for (size_t i = 0; i < a.size(); ++i) text += fmt::format("{} {} ", a[i], b[i]);
    return text;
}

/// The same for values at equal distances.
std::string pairedText(double from, double to, const std::string& values) {
    const std::vector<double> b = readNumbers(values);
    std::string text;
    for (size_t i = 0; i < b.size(); ++i)
        text += fmt::format("{} {} ", from + (to - from) * double(i) / double(std::max<size_t>(b.size() - 1, 1)), b[i]);
    return text;
}

std::optional<Wrap> wrapOf(const std::string& name) {
    if (name == "repeat") return Wrap::Repeat;
    if (name == "mirror") return Wrap::MirroredRepeat;
    if (name == "clamp" || name == "zero" || name == "one") return Wrap::ClampToEdge;
    return {};
}

/// Rows of uv' = transform * (u, v, 1): `to_uv`, or the factors and offsets of version 0.x.
std::array<glm::vec3, 2> uvTransform(const Plugin& texture) {
    const glm::dmat4 m = texture.transform("to_uv");
    const double scale = texture.number("uvscale", 1);
    const glm::dvec2 factor(texture.number("uscale", scale), texture.number("vscale", scale));
    const glm::dvec2 offset(texture.number("uoffset", 0), texture.number("voffset", 0));
    std::array<glm::vec3, 2> rows;
    for (int r = 0; r < 2; ++r)
        rows[size_t(r)] = glm::vec3(m[0][r] * factor[r], m[1][r] * factor[r], m[3][r] * factor[r] + offset[r]);
    for (const glm::vec3& row : rows)
        if (!std::isfinite(row.x + row.y + row.z)) throw Error(texture.where, "its transform is not finite");
    return rows;
}

}  // namespace

TexturedColor Colors::color(const Plugin& plugin, const std::string& name, const glm::vec3& fallback, Meaning meaning) {
    if (const Plugin* child = plugin.child(name)) return texture(*child, meaning);
    const Property* given = plugin.find(name);
    return given ? property(*given, meaning) : fallback;
}

glm::vec3 Colors::plain(const Plugin& plugin, const std::string& name, const glm::vec3& fallback, Meaning meaning) {
    const TexturedColor found = color(plugin, name, fallback, meaning);
    if (found.image)
        import_.notes().add(fmt::format("the texture of '{}' of {}s is taken as its mean", name, plugin.type),
                            plugin.name());
    return found.mean();
}

float Colors::number(const Plugin& plugin, const std::string& name, float fallback) {
    const glm::vec3 of = plain(plugin, name, glm::vec3(fallback), Meaning::Quantity);
    return (of.x + of.y + of.z) / 3;
}

bool Colors::takeUsesVertexColors() {
    return std::exchange(usesVertexColors_, false);
}

glm::vec3 Colors::property(const Property& given, Meaning meaning) {
    if (given.tag == "spectrum" || given.tag == "blackbody") return spectrum(given, meaning);
    const auto entry = given.of.find("value");
    if (entry == given.of.end()) throw Error(given.where, "<{}> has no value", given.tag);
    if (const auto hex = rgbOfHex(entry->second)) return *hex;
    const glm::vec3 color(threeNumbers(given.of, 0, given.where));
    return given.tag == "srgb" ? glm::vec3(srgbDecode(color.x), srgbDecode(color.y), srgbDecode(color.z)) : color;
}

glm::vec3 Colors::pointsAsColor(const std::string& text, Meaning meaning, const TextLocation& where) {
    try {
        const SpectrumPoints points = readSpectrumPoints(text);
        if (meaning == Meaning::Reflectance) return rgbOfReflectance(points);
        return meaning == Meaning::Quantity ? rgbOfQuantity(points) : rgbOfXyz(xyzOfEmission(points));
    } catch (const Error& error) {
        throw Error(where, "{}", error.what());
    }
}

glm::vec3 Colors::spectrum(const Property& given, Meaning meaning) {
    const auto get = [&](const char* name) {
        const auto entry = given.of.find(name);
        return entry == given.of.end() ? std::string() : entry->second;
    };
    if (given.tag == "blackbody") {
        std::string temperature = get("temperature");
        if (temperature.ends_with('K') || temperature.ends_with('k')) temperature.pop_back();
        const std::string scale = get("scale");
        return blackbody(oneNumber(temperature, given.where), scale.empty() ? 1 : oneNumber(scale, given.where),
                         given.where);
    }
    if (const std::string file = get("filename"); !file.empty())
        return pointsAsColor(readTextFile(document_.resolve(file)), meaning, given.where);
    const std::string value = get("value");
    if (const auto hex = rgbOfHex(value)) return *hex;
    if (value.find(':') != std::string::npos) return pointsAsColor(value, meaning, given.where);
    // One number is a constant; three are RGB, as version 0.x writes it
    return glm::vec3(threeNumbers(given.of, 0, given.where));
}

std::optional<glm::vec3> Colors::spectrumPlugin(const Plugin& plugin, Meaning meaning) {
    if (plugin.type == "uniform") return glm::vec3(float(plugin.number("value", 1)));
    if (plugin.type == "d65") {
        const glm::vec3 color = plain(plugin, "color", glm::vec3(1), Meaning::Reflectance);
        return color * float(plugin.number("scale", 1));
    }
    if (plugin.type == "srgb" || plugin.type == "rgb") return plain(plugin, "color", glm::vec3(1), meaning);
    if (plugin.type == "blackbody")
        return blackbody(plugin.number("temperature", 5000), plugin.number("scale", 1), plugin.where);
    if (plugin.type == "irregular")
        return pointsAsColor(pairedText(plugin.text("wavelengths", ""), plugin.text("values", ""), plugin.where),
                             meaning, plugin.where);
    if (plugin.type == "regular")
        return pointsAsColor(pairedText(plugin.number("wavelength_min", 360), plugin.number("wavelength_max", 830),
                                        plugin.text("values", "")),
                             meaning, plugin.where);
    return {};
}

TexturedColor Colors::texture(const Plugin& of, Meaning meaning) {
    if (const auto color = spectrumPlugin(of, meaning)) return *color;
    if (of.type == "bitmap") return bitmap(of);
    if (of.type == "checkerboard") return checkerboard(of, meaning);
    if (of.type == "scale") {
        const std::vector<const Plugin*> nested = of.childrenOf("texture");
        TexturedColor scaled = nested.empty() ? TexturedColor(glm::vec3(1)) : texture(*nested.front(), meaning);
        scaled.value *= of.find("scale") ? property(*of.find("scale"), meaning) : glm::vec3(1);
        return scaled;
    }
    const bool isVertexColor = of.type == "mesh_attribute" && of.text("name", "") == "vertex_color";
    if (isVertexColor || of.type == "vertexcolors") {
        usesVertexColors_ = true;
        return glm::vec3(float(of.number("scale", 1)));
    }
    import_.notes().add(fmt::format("{} are not known and become grey, 0.5", of.what() + "s"), of.name());
    return glm::vec3(kMissing);
}

std::shared_ptr<const ImageF> Colors::pixels(const Plugin& bitmap, bool isRaw) {
    const std::string file = bitmap.text("filename", "");
    if (file.empty()) throw Error(bitmap.where, "a bitmap has no filename");
    const double gamma = bitmap.number("gamma", -1);
    const bool isLinear = isRaw || gamma == 1;
    if (gamma > 0 && gamma != 1)
        import_.notes().add("'gamma' of bitmaps other than 1 is taken as sRGB, and has no effect on floats",
                            bitmap.name());
    return import_.images().read(document_.resolve(file),
                                 isLinear ? ColorImages::Stored::Linear : ColorImages::Stored::Srgb);
}

TexturedColor Colors::bitmap(const Plugin& of) {
    auto image = std::make_shared<ColorImage>();
    image->pixels = pixels(of, of.flag("raw", false));
    if (!image->pixels) return glm::vec3(kMissing);
    image->name = std::filesystem::path(of.text("filename", "")).filename().string();
    const std::string both = lowerCase(of.text("wrap_mode", "repeat"));
    for (const auto& [name, wrap] :
         {std::pair("wrap_mode_u", &image->wrapU), std::pair("wrap_mode_v", &image->wrapV)}) {
        const std::string mode = lowerCase(of.text(name, both));
        *wrap = wrapOf(mode).value_or(Wrap::Repeat);
        if (!wrapOf(mode) || mode == "zero" || mode == "one")
            import_.notes().add("wrap modes of bitmaps other than repeat, mirror and clamp are approximated",
                                of.name());
    }
    if (lowerCase(of.text("filter_type", "bilinear")) == "nearest") image->filter = TexelFilter::Nearest;
    image->transform = uvTransform(of);
    TexturedColor result;
    result.image = std::move(image);
    return result;
}

TexturedColor Colors::checkerboard(const Plugin& of, Meaning meaning) {
    const glm::vec3 colors[] = {plain(of, "color0", glm::vec3(0.4f), meaning),
                                plain(of, "color1", glm::vec3(0.2f), meaning)};
    auto pixels = std::make_shared<ImageF>(2u, 2u, 3u);
    for (uint32_t y = 0; y < 2; ++y)
        for (uint32_t x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c) pixels->pixel(x, y)[c] = std::max(colors[x == y ? 0 : 1][c], 0.0f);
    auto image = std::make_shared<ColorImage>();
    image->name = "checkerboard";
    image->pixels = std::move(pixels);
    image->filter = TexelFilter::Nearest;
    image->transform = uvTransform(of);
    TexturedColor result;
    result.image = std::move(image);
    return result;
}

}  // namespace voxray::mitsuba
