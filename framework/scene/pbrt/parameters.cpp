#include "scene/pbrt/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/suggest.h"

namespace voxray::pbrt {
namespace {

/// Types of pbrt-v4, with how many numbers make a value; 0: strings.
struct TypeOf {
    const char* name;
    size_t numbers;
};
constexpr std::array<TypeOf, 13> kTypes{{{"integer", 1},
                                         {"float", 1},
                                         {"point2", 2},
                                         {"vector2", 2},
                                         {"point3", 3},
                                         {"vector3", 3},
                                         {"normal", 3},
                                         {"rgb", 3},
                                         {"blackbody", 1},
                                         {"spectrum", 2},
                                         {"string", 0},
                                         {"texture", 0},
                                         {"bool", 0}}};

/// Types of pbrt-v3, which `pbrt --upgrade` replaces.
constexpr std::array<const char*, 4> kOldTypes{"point", "vector", "color", "xyz"};

const TypeOf& typeNamed(const std::string& name, const TextLocation& where) {
    for (const TypeOf& type : kTypes)
        if (name == type.name) return type;
    if (std::ranges::find(kOldTypes, name) != kOldTypes.end())
        throw Error(where, "'{}' is a type of pbrt-v3; convert the scene by `pbrt --upgrade`", name);
    throw Error(where,
                "'{}' is no type of a parameter: integer, float, point2, vector2, point3, vector3, normal, rgb, "
                "blackbody, spectrum, string, texture or bool",
                name.substr(0, 40));
}

/// "float radius": type and name.
std::pair<std::string, std::string> splitDeclaration(std::string_view text, const TextLocation& where) {
    std::vector<std::string> words;
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        if (text.empty()) break;
        const size_t length = std::min(text.find_first_of(" \t"), text.size());
        words.emplace_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    if (words.size() < 2)
        throw Error(where, "\"{}\" stands where a parameter is declared: \"TYPE NAME\"",
                    words.empty() ? "" : words[0].substr(0, 40));
    return {words[0], words[1]};
}

void addValue(Parameter& parameter, const Token& token, const TextLocation& where, bool wantsNumbers) {
    const bool isNumber = token.kind == TokenKind::Word && token.text != "true" && token.text != "false";
    if (isNumber && (wantsNumbers || parameter.type == "spectrum"))
        parameter.numbers.push_back(numberOf(token.text, where, "parameter '" + parameter.name + "'"));
    else if (!isNumber && (!wantsNumbers || (parameter.type == "spectrum" && token.kind == TokenKind::String)))
        parameter.strings.emplace_back(token.text);
    else
        throw Error(where, "'{}' stands where parameter '{}' wants a value of type {}", token.text.substr(0, 40),
                    parameter.name, parameter.type);
}

std::shared_ptr<const Parameter> takeParameter(Lexer& lexer, const std::string& colorSpace) {
    const Token declaration = lexer.take();
    auto parameter = std::make_shared<Parameter>();
    parameter->where = lexer.where(declaration);
    parameter->colorSpace = colorSpace;
    std::tie(parameter->type, parameter->name) = splitDeclaration(declaration.text, parameter->where);
    const TypeOf& type = typeNamed(parameter->type, parameter->where);

    const bool isList = lexer.takeIf(TokenKind::Open);
    do {
        const Token token = lexer.take();
        if (token.kind == TokenKind::Close && isList) break;
        if (token.kind != TokenKind::Word && token.kind != TokenKind::String)
            throw Error(lexer.where(token), "the values of parameter '{}' {}", parameter->name,
                        token.kind == TokenKind::End ? "have no end; a ] is missing" : "hold a bracket");
        addValue(*parameter, token, lexer.where(token), type.numbers > 0);
    } while (isList);
    if (type.numbers > 0 && parameter->numbers.size() % type.numbers != 0)
        throw Error(parameter->where, "parameter '{}' has {} numbers; a {} has {}", parameter->name,
                    parameter->numbers.size(), parameter->type, type.numbers);
    return parameter;
}

}  // namespace

std::string shortPlace(const TextLocation& where) {
    return TextLocation{std::filesystem::path(where.file).filename().string(), where.line}.str();
}

std::string Parameters::place() const {
    return shortPlace(where);
}

void Parameters::read(Lexer& lexer, const std::string& colorSpace) {
    while (lexer.peek().kind == TokenKind::String) parameters_.push_back(takeParameter(lexer, colorSpace));
}

void Parameters::addDefaults(const std::vector<std::shared_ptr<const Parameter>>& defaults) {
    parameters_.insert(parameters_.end(), defaults.begin(), defaults.end());
}

const Parameter* Parameters::find(const std::string& name) const {
    const Parameter* found = nullptr;
    for (const auto& parameter : parameters_) {
        if (parameter->name != name) continue;
        parameter->isUsed = true;
        if (!found) found = parameter.get();
    }
    return found;
}

const Parameter* Parameters::findNumbers(const std::string& name, size_t each) const {
    const Parameter* parameter = find(name);
    if (!parameter) return nullptr;
    if (parameter->numbers.size() % each != 0 || (parameter->numbers.empty() && !parameter->strings.empty()))
        throw Error(parameter->where, "parameter '{}' of {} \"{}\" has type {}; it wants numbers, {} for each value",
                    name, directive, kind, parameter->type, each);
    return parameter;
}

double Parameters::number(const std::string& name, double otherwise) const {
    const Parameter* parameter = findNumbers(name, 1);
    if (!parameter) return otherwise;
    if (parameter->numbers.size() != 1)
        throw Error(parameter->where, "parameter '{}' has {} values; it wants one", name, parameter->numbers.size());
    return parameter->numbers[0];
}

uint32_t Parameters::count(const std::string& name, uint32_t otherwise, uint32_t most) const {
    const double value = number(name, otherwise);
    if (!(value >= 0 && value <= most) || value != std::floor(value))
        throw Error(find(name)->where, "parameter '{}' is {}; it is a whole number from 0 to {}", name, value, most);
    return uint32_t(value);
}

bool Parameters::flag(const std::string& name, bool otherwise) const {
    const Parameter* parameter = find(name);
    if (!parameter) return otherwise;
    if (parameter->strings.size() != 1 || (parameter->strings[0] != "true" && parameter->strings[0] != "false"))
        throw Error(parameter->where, "parameter '{}' is neither true nor false", name);
    return parameter->strings[0] == "true";
}

std::vector<std::string> Parameters::texts(const std::string& name) const {
    const Parameter* parameter = find(name);
    if (!parameter) return {};
    if (!parameter->numbers.empty()) throw Error(parameter->where, "parameter '{}' wants a string", name);
    return parameter->strings;
}

std::string Parameters::text(const std::string& name, const std::string& otherwise) const {
    const std::vector<std::string> values = texts(name);
    if (values.empty()) return otherwise;
    if (values.size() != 1) throw Error(find(name)->where, "parameter '{}' wants one string", name);
    return values[0];
}

glm::dvec3 Parameters::point(const std::string& name, const glm::dvec3& otherwise) const {
    const Parameter* parameter = findNumbers(name, 3);
    if (!parameter) return otherwise;
    if (parameter->numbers.size() != 3)
        throw Error(parameter->where, "parameter '{}' has {} numbers; it wants 3", name, parameter->numbers.size());
    return {parameter->numbers[0], parameter->numbers[1], parameter->numbers[2]};
}

std::vector<double> Parameters::numbers(const std::string& name) const {
    const Parameter* parameter = findNumbers(name, 1);
    return parameter ? parameter->numbers : std::vector<double>();
}

std::vector<glm::vec2> Parameters::points2(const std::string& name) const {
    std::vector<glm::vec2> points;
    const Parameter* parameter = findNumbers(name, 2);
    if (!parameter) return points;
    const std::vector<double>& n = parameter->numbers;
    points.reserve(n.size() / 2);
    for (size_t i = 0; i + 1 < n.size(); i += 2) points.emplace_back(float(n[i]), float(n[i + 1]));
    return points;
}

std::vector<glm::vec3> Parameters::points3(const std::string& name) const {
    std::vector<glm::vec3> points;
    const Parameter* parameter = findNumbers(name, 3);
    if (!parameter) return points;
    const std::vector<double>& n = parameter->numbers;
    points.reserve(n.size() / 3);
    for (size_t i = 0; i + 2 < n.size(); i += 3) points.emplace_back(float(n[i]), float(n[i + 1]), float(n[i + 2]));
    return points;
}

void Parameters::ignore(std::initializer_list<const char*> names) const {
    for (const char* name : names) find(name);
}

std::vector<const Parameter*> Parameters::unused() const {
    std::vector<const Parameter*> unused;
    for (const auto& parameter : parameters_)
        if (!parameter->isUsed) unused.push_back(parameter.get());
    return unused;
}

}  // namespace voxray::pbrt
