#include "scene/mitsuba/transform.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "scene/import/numbers.h"
#include "scene/mitsuba/plugin.h"

namespace voxray::mitsuba {
namespace {

const std::string& attribute(const Attributes& of, const char* name, const std::string& element,
                             const TextLocation& where) {
    const auto entry = of.find(name);
    if (entry == of.end()) throw Error(where, "<{}> has no '{}'", element, name);
    return entry->second;
}

std::vector<double> numbersOf(const std::string& text, const TextLocation& where) {
    try {
        return readNumbers(text);
    } catch (const Error& error) {
        throw Error(where, "{}", error.what());
    }
}

glm::dvec3 vectorOf(const std::string& text, const TextLocation& where) {
    const std::vector<double> numbers = numbersOf(text, where);
    if (numbers.size() != 3) throw Error(where, "expected three numbers, not '{}'", oneLine(text, 60));
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dmat4 matrixOf(const std::string& text, const TextLocation& where) {
    const std::vector<double> numbers = numbersOf(text, where);
    const size_t size = numbers.size() == 9 ? 3 : 4;
    if (numbers.size() != size * size) throw Error(where, "a matrix has 9 or 16 numbers, not {}", numbers.size());
    glm::dmat4 matrix(1.0);
    for (size_t i = 0; i < numbers.size(); ++i) matrix[int(i % size)][int(i / size)] = numbers[i];
    return matrix;
}

/// Looks along +Z, +Y up, +X to the left.
glm::dmat4 lookAt(const Attributes& of, const TextLocation& where) {
    const glm::dvec3 origin = vectorOf(attribute(of, "origin", "lookat", where), where);
    const glm::dvec3 target = vectorOf(attribute(of, "target", "lookat", where), where);
    const glm::dvec3 forward = glm::normalize(target - origin);
    const auto given = of.find("up");
    glm::dvec3 up = given == of.end() ? glm::dvec3(0) : vectorOf(given->second, where);
    // Without an up vector any one will do
    if (glm::length(up) == 0) up = std::abs(forward.y) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 left = glm::normalize(glm::cross(up, forward));
    if (!(glm::length(left) > 0)) throw Error(where, "<lookat>: its up vector is along the view, or it looks nowhere");
    return glm::dmat4(glm::dvec4(left, 0), glm::dvec4(glm::cross(forward, left), 0), glm::dvec4(forward, 0),
                      glm::dvec4(origin, 1));
}

}  // namespace

glm::dmat4 transformOf(const std::string& element, const Attributes& of, const TextLocation& where) {
    const glm::dmat4 identity(1.0);
    if (element == "translate") return glm::translate(identity, threeNumbers(of, 0, where));
    if (element == "scale") return glm::scale(identity, threeNumbers(of, 1, where));
    if (element == "rotate") {
        const glm::dvec3 axis = threeNumbers(of, 0, where);
        const double angle = oneNumber(attribute(of, "angle", element, where), where);
        if (!(glm::length(axis) > 0)) throw Error(where, "<rotate> has no axis: give x, y or z");
        return glm::rotate(identity, glm::radians(angle), axis);
    }
    if (element == "matrix") return matrixOf(attribute(of, "value", element, where), where);
    if (element == "lookat" || element == "look_at") return lookAt(of, where);
    throw Error(where, "<{}> is no transform: expected translate, rotate, scale, lookat or matrix",
                oneLine(element, 60));
}

}  // namespace voxray::mitsuba
