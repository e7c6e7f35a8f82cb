#pragma once

#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

/// A Mitsuba scene as plugins with properties, names as Mitsuba 3 writes them (snake_case).
namespace voxray::mitsuba {

/// <float name="alpha" value="0.1"/> and others.
struct Property {
    std::string tag;                        ///< float, integer, boolean, string, rgb, spectrum, point, transform …
    std::map<std::string, std::string> of;  ///< Its attributes, but for the name; $names are replaced.
    glm::dmat4 transform{1.0};              ///< Of a transform.
    TextLocation where;
    mutable bool isUsed = false;
};

struct Plugin;
using PluginPtr = std::shared_ptr<const Plugin>;

/// <bsdf type="diffuse" id="white"> and others.
struct Plugin {
    struct Child {
        std::string name;  ///< Empty: without one.
        PluginPtr plugin;
    };

    std::string tag;   ///< scene, bsdf, shape, emitter, texture, sensor …
    std::string type;  ///< Lower case.
    std::string id;
    TextLocation where;
    std::map<std::string, Property> properties;
    std::vector<Child> children;  ///< In the order of the file; <ref> is replaced.

    const Property* find(const std::string& name) const;
    /// A number, an integer or a boolean as a number. @throws Error for something else
    double number(const std::string& name, double fallback) const;
    bool flag(const std::string& name, bool fallback) const;
    std::string text(const std::string& name, const std::string& fallback) const;
    /// A point or vector. @throws Error for something else
    glm::dvec3 vector(const std::string& name, const glm::dvec3& fallback) const;
    glm::dmat4 transform(const std::string& name) const;
    /// The child of this name; nullptr: none.
    const Plugin* child(const std::string& name) const;
    /// The children of this tag.
    std::vector<const Plugin*> childrenOf(const std::string& tag) const;

    /// "ID (FILE:LINE)", without an id "FILE:LINE": for notes.
    std::string name() const;
    /// "'TYPE' TAG": for messages.
    std::string what() const { return "'" + type + "' " + tag; }
};

/// Three numbers of a property: attributes x, y, z (missing ones are the fallback), or `value` with one or three.
glm::dvec3 threeNumbers(const std::map<std::string, std::string>& of, double fallback, const TextLocation& where);
/// The only number in a text. @throws Error
double oneNumber(const std::string& text, const TextLocation& where);

}  // namespace voxray::mitsuba
