#include "base/value.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace voxray {
namespace {

constexpr size_t kShown = 60;  ///< Maximum bytes of a value in a message.

std::string describe(const Value& value) {
    switch (value.kind) {
        case Value::Kind::Null:
            return "nothing";
        case Value::Kind::Scalar:
            return value.quoted ? "the text \"" + oneLine(value.scalar, kShown) + "\", which stands in quotes"
                                : "'" + oneLine(value.scalar, kShown) + "'";
        case Value::Kind::List:
            return "a list";
        case Value::Kind::Map:
            return "a map";
    }
    return {};
}

template <typename T>
bool parseAll(const std::string& text, T& out) {
    const char* begin = text.data();
    const char* end = begin + text.size();
    if (begin != end && *begin == '+') ++begin;
    const auto [last, code] = std::from_chars(begin, end, out);
    return code == std::errc() && last == end;
}

/// ": write '-'..." for a number with a typographic minus or dash, else "".
std::string hyphenAdvice(const Value& value) {
    for (const char* dash : {"\u2212", "\u2013"})
        if (value.isScalar() && value.scalar.starts_with(dash)) return ": write a plain '-' for the minus";
    return {};
}

/// "; a space is missing before '#'" for a comment that was read as part of the value, else "".
std::string commentAdvice(const Value& value) {
    const bool isComment = value.isScalar() && !value.quoted && value.scalar.find('#', 1) != std::string::npos;
    return isComment ? "; a space is missing before '#'" : "";
}

/// ": write 1000000" for a whole number that is written as 1e6 or 1_000_000, else "".
std::string digitsAdvice(const Value& value) {
    if (!value.isScalar() || value.quoted) return {};
    std::string text = value.scalar;
    std::erase(text, '_');
    double number = 0;
    constexpr double kExact = double(1ull << std::numeric_limits<double>::digits);
    if (!parseAll(text, number) || !(std::abs(number) <= kExact) || number != std::floor(number)) return {};
    return fmt::format(": write {}", int64_t(number));
}

std::string quotedJson(const std::string& text) {
    constexpr std::string_view kEscaped = "\"\\\n\t\r", kLetters = "\"\\ntr";
    std::string out = "\"";
    for (const char c : text) {
        if (const size_t i = kEscaped.find(c); i != std::string_view::npos)
            out += {'\\', kLetters[i]};
        else if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", int(c));
        else
            out += c;
    }
    return out + "\"";
}

// A scalar that JSON writes without quotes.
bool isJsonLiteral(const Value& value) {
    if (value.quoted) return false;
    if (value.scalar == "true" || value.scalar == "false") return true;
    double number = 0;
    if (!parseAll(value.scalar, number) || !std::isfinite(number)) return false;
    // JSON allows neither "+1" nor ".5" nor "5." nor "007".
    const std::string& s = value.scalar;
    const size_t first = s[0] == '-' ? 1 : 0;
    if (first >= s.size() || s[first] < '0' || s[first] > '9' || s.back() == '.') return false;
    return !(s[first] == '0' && first + 1 < s.size() && s[first + 1] >= '0' && s[first + 1] <= '9');
}

/// @throws UsageError for 032, which is octal for some YAML parsers.
void checkLeadingZero(const Value& value, std::string_view what) {
    const size_t sign = value.scalar.find_first_of("+-") == 0 ? 1 : 0;
    const size_t digits = std::min(value.scalar.find_first_not_of('0', sign), value.scalar.size() - 1);
    const bool isDigits = value.scalar.find_first_not_of("0123456789", sign) == std::string::npos;
    if (isDigits && digits > sign)
        throw UsageError(value.where, "{}: '{}' begins with a zero: write {}{}", what, oneLine(value.scalar, kShown),
                         value.scalar.substr(0, sign), value.scalar.substr(digits));
}

void writeJson(const Value& value, int indent, int depth, std::string& out) {
    const std::string newline = indent < 0 ? "" : "\n" + std::string(size_t(indent * (depth + 1)), ' ');
    const std::string lastNewline = indent < 0 ? "" : "\n" + std::string(size_t(indent * depth), ' ');
    switch (value.kind) {
        case Value::Kind::Null:
            out += "null";
            return;
        case Value::Kind::Scalar:
            out += isJsonLiteral(value) ? value.scalar : quotedJson(value.scalar);
            return;
        case Value::Kind::List:
            out += "[";
            for (size_t i = 0; i < value.items.size(); ++i) {
                out += (i ? "," : "") + newline;
                writeJson(value.items[i], indent, depth + 1, out);
            }
            out += (value.items.empty() ? "" : lastNewline) + "]";
            return;
        case Value::Kind::Map:
            out += "{";
            for (size_t i = 0; i < value.members.size(); ++i) {
                out += (i ? "," : "") + newline + quotedJson(value.members[i].key) + (indent < 0 ? ":" : ": ");
                writeJson(value.members[i].value, indent, depth + 1, out);
            }
            out += (value.members.empty() ? "" : lastNewline) + "}";
            return;
    }
}

}  // namespace

Value Value::fromScalar(std::string text, bool quoted) {
    Value value;
    value.kind = Kind::Scalar;
    value.scalar = std::move(text);
    value.quoted = quoted;
    return value;
}

Value Value::list() {
    Value value;
    value.kind = Kind::List;
    return value;
}

Value Value::map() {
    Value value;
    value.kind = Kind::Map;
    return value;
}

const Value* Value::find(std::string_view key) const {
    for (const Member& member : members)
        if (member.key == key) return &member.value;
    return nullptr;
}

Value* Value::find(std::string_view key) {
    return const_cast<Value*>(std::as_const(*this).find(key));
}

Value& Value::set(std::string_view key, Value value) {
    if (kind == Kind::Null) kind = Kind::Map;
    if (Value* existing = find(key)) return *existing = std::move(value);
    members.push_back({std::string(key), std::move(value)});
    return members.back().value;
}

bool Value::erase(std::string_view key) {
    return std::erase_if(members, [&](const Member& member) { return member.key == key; }) > 0;
}

bool Value::asBool(std::string_view what) const {
    if (isScalar() && !quoted) {
        if (scalar == "true") return true;
        if (scalar == "false") return false;
    }
    throw UsageError(where, "{}: expected true or false, not {}{}", what, describe(*this), commentAdvice(*this));
}

int64_t Value::asInteger(std::string_view what) const {
    int64_t number = 0;
    if (isScalar() && !quoted && parseAll(scalar, number)) {
        checkLeadingZero(*this, what);
        return number;
    }
    if (isScalar() && !quoted && !scalar.empty() && scalar.find_first_not_of("0123456789") == std::string::npos)
        throw UsageError(where, "{}: {} is out of range, at most {}", what, scalar,
                         std::numeric_limits<int64_t>::max());
    throw UsageError(where, "{}: expected a whole number, not {}{}{}{}", what, describe(*this), digitsAdvice(*this),
                     hyphenAdvice(*this), commentAdvice(*this));
}

bool Value::isNumber() const {
    double number = 0;
    return isScalar() && !quoted && parseAll(scalar, number) && std::isfinite(number);
}

double Value::asNumber(std::string_view what) const {
    double number = 0;
    if (isNumber() && parseAll(scalar, number)) return number;
    throw UsageError(where, "{}: expected a number, not {}{}{}", what, describe(*this), hyphenAdvice(*this),
                     commentAdvice(*this));
}

std::string Value::asString(std::string_view what) const {
    if (isScalar()) return scalar;
    throw UsageError(where, "{}: expected text, not {}", what, describe(*this));
}

std::string Value::text() const {
    switch (kind) {
        case Kind::Null:
            return "null";
        case Kind::Scalar:
            return quoted ? quotedJson(scalar) : scalar;
        case Kind::List: {
            std::string out = "[";
            for (size_t i = 0; i < items.size(); ++i) out += (i ? ", " : "") + items[i].text();
            return out + "]";
        }
        case Kind::Map: {
            std::string out = "{";
            for (size_t i = 0; i < members.size(); ++i)
                out += (i ? ", " : "") + members[i].key + ": " + members[i].value.text();
            return out + "}";
        }
    }
    return {};
}

std::string Value::json(int indent) const {
    std::string out;
    writeJson(*this, indent, 0, out);
    return out;
}

bool Value::operator==(const Value& other) const {
    return kind == other.kind && scalar == other.scalar && items == other.items && members == other.members;
}

}  // namespace voxray
