#include "scene/pbrt/directives.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/suggest.h"
#include "scene/import/spectrum.h"

namespace voxray::pbrt {
namespace {

constexpr int kMaxIncludeDepth = 32;
constexpr size_t kMaxStates = 1000;        ///< Nested AttributeBegin.
constexpr uint64_t kBytesPerShape = 2048;  ///< With its parameters and its share of a state.

/// From the world to the space of a camera whose Z is the direction of view.
/// @throws Error at a place where eye and target are one point
glm::dmat4 lookAtMatrix(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                        const TextLocation& where) {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(up, forward));
    const glm::dvec3 cameraUp = glm::cross(forward, right);
    const glm::dmat4 toWorld(glm::dvec4(right, 0), glm::dvec4(cameraUp, 0), glm::dvec4(forward, 0), glm::dvec4(eye, 1));
    const double determinant = glm::determinant(toWorld);
    if (!(std::abs(determinant) > 0.5))
        throw Error(where, "LookAt looks nowhere: its target is its eye, or it looks along its up vector");
    return glm::inverse(toWorld);
}

}  // namespace

void Parser::attributeBegin(const std::string& directive, const TextLocation& where) {
    if (saved_.size() >= kMaxStates) throw Error(where, "more than {} of {} are nested", kMaxStates, directive);
    saved_.emplace_back("AttributeBegin", state_);
}

void Parser::attributeEnd(const std::string& directive, const TextLocation& where) {
    if (saved_.empty() || saved_.back().first != "AttributeBegin")
        throw Error(where, "{} ends what no AttributeBegin began", directive);
    state_ = std::move(saved_.back().second);
    saved_.pop_back();
}

void Parser::attribute(const std::string& directive, const TextLocation& where) {
    const std::string target = lexer_->takeString(directive);
    static const std::array<const char*, 5> targets{"shape", "light", "material", "medium", "texture"};
    if (std::ranges::find(targets, target) == targets.end())
        throw Error(where, "Attribute is for \"shape\", \"light\", \"material\", \"medium\" or \"texture\", not \"{}\"",
                    target.substr(0, 40));
    Parameters parameters;
    parameters.read(*lexer_, state_.colorSpace);
    auto all = std::make_shared<State::Defaults>(*state_.defaults);
    auto& defaults = (*all)[target];
    // The latest counts
    defaults.insert(defaults.begin(), parameters.all().begin(), parameters.all().end());
    state_.defaults = std::move(all);
}

void Parser::activeTransform(const std::string& directive, const TextLocation& where) {
    const std::string which = lexer_->takeWord(directive);
    if (which != "All" && which != "StartTime" && which != "EndTime")
        throw Error(where, "ActiveTransform is All, StartTime or EndTime, not '{}'", which.substr(0, 40));
    state_.setsStart = which != "EndTime";
    if (which != "All") notes_.add("what moves stands where it is when the shutter opens", shortPlace(where));
}

void Parser::areaLightSource(const std::string& directive, const TextLocation& where) {
    state_.areaLight = takeParameters(directive, where, "light");
    if (state_.areaLight->kind != "diffuse")
        state_.areaLight->fail("AreaLightSource \"{}\" is unknown; pbrt-v4 has \"diffuse\"",
                               state_.areaLight->kind.substr(0, 40));
}

void Parser::camera(const std::string& directive, const TextLocation& where) {
    const glm::dmat4 toWorld = glm::inverse(state_.transform);
    description.camera = {takeParameters(directive, where, ""), toWorld};
    coordinateSystems_["camera"] = toWorld;
}

void Parser::colorSpace(const std::string& directive, const TextLocation& where) {
    state_.colorSpace = lexer_->takeString(directive);
    if (!rec709Of(state_.colorSpace))
        throw Error(where,
                    "ColorSpace \"{}\" is unknown; pbrt-v4 has \"srgb\", \"dci-p3\", \"rec2020\" and "
                    "\"aces2065-1\"",
                    state_.colorSpace.substr(0, 40));
}

void Parser::concatTransform(const std::string& directive, const TextLocation&) {
    concat(takeMatrix(directive));
}

void Parser::coordinateSystem(const std::string& directive, const TextLocation&) {
    coordinateSystems_[lexer_->takeString(directive)] = state_.transform;
}

void Parser::coordSysTransform(const std::string& directive, const TextLocation& where) {
    const std::string name = lexer_->takeString(directive);
    const auto found = coordinateSystems_.find(name);
    if (found == coordinateSystems_.end())
        throw Error(where, "no CoordinateSystem \"{}\" was defined before", name.substr(0, 40));
    if (state_.setsStart) state_.transform = found->second;
}

void Parser::film(const std::string& directive, const TextLocation& where) {
    description.film = takeParameters(directive, where, "");
}

void Parser::identity(const std::string&, const TextLocation&) {
    if (state_.setsStart) state_.transform = glm::dmat4(1.0);
}

void Parser::import(const std::string& directive, const TextLocation& where) {
    // An imported file leaves the state as it was
    const State before = state_;
    const size_t depth = saved_.size();
    include(directive, where);
    if (saved_.size() != depth) throw Error(where, "the imported file ends within an attribute or object");
    state_ = before;
}

void Parser::include(const std::string& directive, const TextLocation& where) {
    const std::string name = lexer_->takeString(directive);
    if (depth_ + 1 >= kMaxIncludeDepth)
        throw Error(where, "{} \"{}\" is nested {} deep; does a file include itself?", directive, name.substr(0, 100),
                    kMaxIncludeDepth);
    const std::filesystem::path path = root_.parent_path() / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code))
        throw Error(where, "{} \"{}\": there is no file {}{}", directive, name.substr(0, 100), path.string(),
                    didYouMeanFile(path));
    parseFile(path, depth_ + 1);
}

void Parser::lightSource(const std::string& directive, const TextLocation& where) {
    memory_.reserve(1, kBytesPerShape);
    const auto parameters = takeParameters(directive, where, "light");
    description.lights.push_back({parameters, state_.transform});
}

void Parser::lookAt(const std::string& directive, const TextLocation& where) {
    const std::array<double, 9> n = takeNumbers<9>(directive);
    concat(lookAtMatrix({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, where));
}

void Parser::makeNamedMaterial(const std::string& directive, const TextLocation& where) {
    const auto parameters = takeParameters(directive, where, "material");
    if (!description.materials.try_emplace(parameters->kind, parameters).second)
        throw Error(where, "the material \"{}\" is defined twice", parameters->kind.substr(0, 100));
}

void Parser::makeNamedMedium(const std::string& directive, const TextLocation& where) {
    const auto parameters = takeParameters(directive, where, "medium");
    notes_.add("media are left out", fmt::format("{} ({})", parameters->kind, parameters->place()));
}

void Parser::material(const std::string& directive, const TextLocation& where) {
    memory_.reserve(1, kBytesPerShape);
    state_.material = {takeParameters(directive, where, "material"), {}, where};
}

void Parser::mediumInterface(const std::string& directive, const TextLocation& where) {
    const std::string inside = lexer_->takeString(directive);
    std::string outside = inside;
    if (lexer_->peek().kind == TokenKind::String) outside = lexer_->takeString(directive);
    if (!inside.empty() || !outside.empty()) notes_.add("media are left out", shortPlace(where));
}

void Parser::namedMaterial(const std::string& directive, const TextLocation& where) {
    state_.material = {nullptr, lexer_->takeString(directive), where};
}

void Parser::objectBegin(const std::string& directive, const TextLocation& where) {
    const std::string name = lexer_->takeString(directive);
    if (object_) throw Error(where, "ObjectBegin \"{}\" stands within another object", name.substr(0, 100));
    const auto [object, isNew] = description.objects.try_emplace(name);
    if (!isNew) throw Error(where, "the object \"{}\" is defined twice", name.substr(0, 100));
    saved_.emplace_back("ObjectBegin", state_);
    object_ = &object->second;
}

void Parser::objectEnd(const std::string&, const TextLocation& where) {
    if (!object_ || saved_.empty() || saved_.back().first != "ObjectBegin")
        throw Error(where, "ObjectEnd ends what no ObjectBegin began");
    state_ = std::move(saved_.back().second);
    saved_.pop_back();
    object_ = nullptr;
}

void Parser::objectInstance(const std::string& directive, const TextLocation& where) {
    const std::string name = lexer_->takeString(directive);
    if (object_) throw Error(where, "ObjectInstance \"{}\" stands within an object", name.substr(0, 100));
    memory_.reserve(1, kBytesPerShape);
    description.instances.push_back({name, state_.transform, where});
}

void Parser::option(const std::string& directive, const TextLocation&) {
    lexer_->takeString(directive);
    const bool hasBracket = lexer_->takeIf(TokenKind::Open);
    if (lexer_->peek().kind == TokenKind::String)
        lexer_->takeString(directive);
    else
        lexer_->takeWord(directive);
    if (hasBracket) lexer_->takeIf(TokenKind::Close);
}

void Parser::ofRenderer(const std::string& directive, const TextLocation& where) {
    takeParameters(directive, where, "");
}

void Parser::reverseOrientation(const std::string&, const TextLocation&) {
    state_.isReversed = !state_.isReversed;
}

void Parser::rotate(const std::string& directive, const TextLocation& where) {
    const std::array<double, 4> n = takeNumbers<4>(directive);
    const glm::dvec3 axis(n[1], n[2], n[3]);
    if (!(glm::length(axis) > 0)) throw Error(where, "the axis of Rotate is 0");
    concat(glm::rotate(glm::dmat4(1.0), glm::radians(n[0]), axis));
}

void Parser::scale(const std::string& directive, const TextLocation&) {
    const std::array<double, 3> n = takeNumbers<3>(directive);
    concat(glm::scale(glm::dmat4(1.0), {n[0], n[1], n[2]}));
}

void Parser::shape(const std::string& directive, const TextLocation& where) {
    memory_.reserve(1, kBytesPerShape);
    Shape shape{takeParameters(directive, where, "shape"), state_.transform, state_.isReversed, state_.material,
                state_.areaLight};
    if (object_ && shape.areaLight) {
        notes_.add("surfaces of objects do not shine, as in pbrt", shape.parameters->place());
        shape.areaLight = nullptr;
    }
    (object_ ? *object_ : description.shapes).push_back(std::move(shape));
}

void Parser::texture(const std::string& directive, const TextLocation& where) {
    const std::string name = lexer_->takeString(directive);
    const std::string type = lexer_->takeString(directive);
    const auto parameters = takeParameters(directive, where, "texture");
    if (type != "float" && type != "spectrum")
        throw Error(where, "the texture \"{}\" has type \"{}\"; pbrt-v4 has \"float\" and \"spectrum\"",
                    name.substr(0, 100), type.substr(0, 40));
    auto& textures = type == "float" ? description.floatTextures : description.colorTextures;
    if (!textures.try_emplace(name, Texture{parameters, state_.transform}).second)
        throw Error(where, "the {} texture \"{}\" is defined twice", type, name.substr(0, 100));
}

void Parser::transform(const std::string& directive, const TextLocation&) {
    const glm::dmat4 matrix = takeMatrix(directive);
    if (state_.setsStart) state_.transform = matrix;
}

void Parser::transformTimes(const std::string& directive, const TextLocation&) {
    takeNumbers<2>(directive);
}

void Parser::translate(const std::string& directive, const TextLocation&) {
    const std::array<double, 3> n = takeNumbers<3>(directive);
    concat(glm::translate(glm::dmat4(1.0), {n[0], n[1], n[2]}));
}

void Parser::worldBegin(const std::string&, const TextLocation&) {
    state_.transform = glm::dmat4(1.0);
    state_.setsStart = true;
    coordinateSystems_["world"] = state_.transform;
}

}  // namespace voxray::pbrt
