#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/pbrt/lexer.h"

namespace voxray::pbrt {

/// A parameter of a directive: "TYPE NAME" and its values.
struct Parameter {
    std::string type;
    std::string name;
    TextLocation where;
    std::string colorSpace;            ///< Of the state in which it was written; see rec709Of().
    std::vector<double> numbers;       ///< Of all types but the next two.
    std::vector<std::string> strings;  ///< Also "true" and "false".
    mutable bool isUsed = false;
};

/// A directive that takes a kind and parameters, as `Shape "sphere" "float radius" 2`.
class Parameters {
 public:
    std::string directive;  ///< "Shape".
    std::string kind;       ///< "sphere".
    TextLocation where;

    /// Reads parameters as long as strings follow.
    void read(Lexer& lexer, const std::string& colorSpace);
    /// Parameters of `Attribute`, which count where the directive has none of the name.
    void addDefaults(const std::vector<std::shared_ptr<const Parameter>>& defaults);
    std::vector<std::shared_ptr<const Parameter>>& all() { return parameters_; }

    /// Parameter by name, whatever its type; nullptr: none. It counts as used.
    const Parameter* find(const std::string& name) const;

    /// One value, or the default if there is none. @throws Error for another type or number of values
    double number(const std::string& name, double otherwise) const;
    /// A whole number from 0 to a bound.
    uint32_t count(const std::string& name, uint32_t otherwise, uint32_t most) const;
    bool flag(const std::string& name, bool otherwise) const;
    std::string text(const std::string& name, const std::string& otherwise) const;
    glm::dvec3 point(const std::string& name, const glm::dvec3& otherwise) const;
    /// Names of a list, as of the two materials of a mix.
    std::vector<std::string> texts(const std::string& name) const;

    /// Lists; empty if there is none. @throws Error for numbers that don't make whole vectors
    std::vector<double> numbers(const std::string& name) const;
    std::vector<glm::vec2> points2(const std::string& name) const;
    std::vector<glm::vec3> points3(const std::string& name) const;

    /// Marks parameters that change nothing here as used.
    void ignore(std::initializer_list<const char*> names) const;
    /// Names of parameters that nobody looked up, with their places.
    std::vector<const Parameter*> unused() const;
    /// Whether any parameter was looked up.
    bool isTouched() const { return unused().size() < parameters_.size(); }

    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
        throw Error(where, "{}", fmt::format(text, std::forward<Args>(args)...));
    }
    /// "'sphere' (scene.pbrt:12)", for notes.
    std::string place() const;

 private:
    const Parameter* findNumbers(const std::string& name, size_t each) const;

    std::vector<std::shared_ptr<const Parameter>> parameters_;
};

/// "scene.pbrt:12" without folders.
std::string shortPlace(const TextLocation& where);

}  // namespace voxray::pbrt
