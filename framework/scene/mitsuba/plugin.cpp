#include "scene/mitsuba/plugin.h"

#include <filesystem>

#include "scene/import/numbers.h"

namespace voxray::mitsuba {
namespace {

const std::string& valueOf(const Property& property, const std::string& name) {
    const auto entry = property.of.find("value");
    if (entry == property.of.end()) throw Error(property.where, "'{}' has no value", name);
    return entry->second;
}

std::vector<double> numbersAt(const std::string& text, const TextLocation& where) {
    try {
        return readNumbers(text);
    } catch (const Error& error) {
        throw Error(where, "{}", error.what());
    }
}

}  // namespace

double oneNumber(const std::string& text, const TextLocation& where) {
    const std::vector<double> numbers = numbersAt(text, where);
    if (numbers.size() != 1) throw Error(where, "expected one number, not '{}'", oneLine(text, 60));
    return numbers[0];
}

glm::dvec3 threeNumbers(const std::map<std::string, std::string>& of, double fallback, const TextLocation& where) {
    glm::dvec3 result(fallback);
    if (const auto value = of.find("value"); value != of.end()) {
        const std::vector<double> numbers = numbersAt(value->second, where);
        if (numbers.size() != 1 && numbers.size() != 3)
            throw Error(where, "expected one or three numbers, not '{}'", oneLine(value->second, 60));
        for (int c = 0; c < 3; ++c) result[c] = numbers[numbers.size() == 3 ? size_t(c) : 0];
        return result;
    }
    constexpr const char* names[] = {"x", "y", "z"};
    for (int c = 0; c < 3; ++c)
        if (const auto entry = of.find(names[c]); entry != of.end()) result[c] = oneNumber(entry->second, where);
    return result;
}

const Property* Plugin::find(const std::string& name) const {
    const auto entry = properties.find(name);
    if (entry == properties.end()) return nullptr;
    entry->second.isUsed = true;
    return &entry->second;
}

double Plugin::number(const std::string& name, double fallback) const {
    const Property* property = find(name);
    if (!property) return fallback;
    const std::string& text = valueOf(*property, name);
    if (property->tag == "boolean") return flag(name, fallback != 0) ? 1 : 0;
    return oneNumber(text, property->where);
}

bool Plugin::flag(const std::string& name, bool fallback) const {
    const Property* property = find(name);
    if (!property) return fallback;
    const std::string& text = valueOf(*property, name);
    if (text == "true" || text == "True" || text == "1") return true;
    if (text == "false" || text == "False" || text == "0") return false;
    throw Error(property->where, "{}: expected true or false, not '{}'", name, oneLine(text, 60));
}

std::string Plugin::text(const std::string& name, const std::string& fallback) const {
    const Property* property = find(name);
    return property ? valueOf(*property, name) : fallback;
}

glm::dvec3 Plugin::vector(const std::string& name, const glm::dvec3& fallback) const {
    const Property* property = find(name);
    return property ? threeNumbers(property->of, 0, property->where) : fallback;
}

glm::dmat4 Plugin::transform(const std::string& name) const {
    const Property* property = find(name);
    return property ? property->transform : glm::dmat4(1.0);
}

const Plugin* Plugin::child(const std::string& name) const {
    for (const Child& of : children)
        if (of.name == name) return of.plugin.get();
    return nullptr;
}

std::vector<const Plugin*> Plugin::childrenOf(const std::string& wanted) const {
    std::vector<const Plugin*> found;
    for (const Child& of : children)
        if (of.plugin->tag == wanted) found.push_back(of.plugin.get());
    return found;
}

std::string Plugin::name() const {
    const std::string place = fmt::format("{}:{}", std::filesystem::path(where.file).filename().string(), where.line);
    return id.empty() ? place : id + " (" + place + ")";
}

}  // namespace voxray::mitsuba
