#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace voxray {

/// A node of a YAML or JSON document, with its location. Scalars are text until they are read as a type, so
/// that errors can name file, line and type.
struct Value {
    enum class Kind { Null, Scalar, List, Map };
    struct Member;

    Kind kind = Kind::Null;
    std::string scalar;           ///< Text of a scalar.
    bool quoted = false;          ///< A quoted scalar is always a string.
    std::vector<Value> items;     ///< Elements of a list.
    std::vector<Member> members;  ///< Entries of a map, in the file's order; keys are unique.
    TextLocation where;

    static Value fromScalar(std::string text, bool quoted = false);
    static Value list();
    static Value map();

    bool isNull() const { return kind == Kind::Null; }
    bool isScalar() const { return kind == Kind::Scalar; }
    bool isList() const { return kind == Kind::List; }
    bool isMap() const { return kind == Kind::Map; }
    bool isNumber() const;  ///< A scalar that asNumber() accepts.

    /// Entry of a map, or nullptr.
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);

    /// Adds or replaces an entry; turns a null into a map.
    Value& set(std::string_view key, Value value);
    bool erase(std::string_view key);

    /// Typed reads. `what` names the value in the error, e.g. "voxelize.resolution".
    /// @throws UsageError with file and line if the text is not of that type.
    bool asBool(std::string_view what) const;
    int64_t asInteger(std::string_view what) const;
    double asNumber(std::string_view what) const;  ///< Finite only.
    std::string asString(std::string_view what) const;

    /// One-line text in YAML flow style; equal values give equal text.
    std::string text() const;
    /// JSON, numbers and booleans unquoted; `indent` < 0 writes one line.
    std::string json(int indent = 2) const;

    /// Equality of contents; locations are ignored.
    bool operator==(const Value& other) const;
};

/// An entry of a map.
struct Value::Member {
    std::string key;
    Value value;
    bool operator==(const Member&) const = default;
};

}  // namespace voxray
