#include "config/yaml_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "config/overrides.h"

namespace voxray {
namespace {

/// A nonempty line in block style (without braces).
struct Line {
    int number;     ///< 1-based.
    size_t indent;  ///< Spaces before it.
    size_t inner;   ///< Indentation including the dashes of list entries.
    std::string text;
    std::string key;  ///< The key of "key: value" or "key:"; empty for other lines.
    bool hasValue;    ///< Whether a value follows the key in the same line.

    bool isEntry() const { return inner > indent; }
};

std::optional<Line> readLine(const std::string& text, int number) {
    Line line{number, text.find_first_not_of(' '), 0, text, {}, false};
    if (line.indent == std::string::npos || text[line.indent] == '#') return {};
    line.inner = line.indent;
    while (text.compare(line.inner, 2, "- ") == 0)
        line.inner = std::min(text.find_first_not_of(' ', line.inner + 1), text.size());
    const size_t colon = std::min(text.find(": ", line.inner), text.size() - 1);
    const std::string key = text.substr(line.inner, colon - line.inner);
    if (text[colon] != ':' || key.find_first_of("{[\"'#,") != std::string::npos) return line;
    line.key = key;
    const size_t value = text.find_first_not_of(' ', colon + 1);
    line.hasValue = value != std::string::npos && text[value] != '#';
    return line;
}

/// The nonempty lines up to the one with number `last`.
std::vector<Line> linesUpTo(const std::string& text, int last) {
    std::istringstream stream(text);
    std::vector<Line> lines;
    std::string line;
    for (int number = 1; number <= last && std::getline(stream, line); ++number)
        if (auto read = readLine(line, number)) lines.push_back(std::move(*read));
    return lines;
}

/// A character that looks like a space but is none in YAML.
struct WhiteSpace {
    const char* bytes;
    const char* name;
};
constexpr WhiteSpace kOtherSpaces[] = {{"\t", "a tab"}, {"\u00a0", "a non-breaking space"}};

/// The first line that is indented by such a character.
std::optional<YamlFault> otherSpace(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        for (const WhiteSpace& space : kOtherSpaces)
            if (line.find(space.bytes) != std::string::npos && line.find(space.bytes) == line.find_first_not_of(' '))
                return YamlFault{number, fmt::format("{} in the indentation; YAML takes spaces", space.name)};
    return {};
}

std::string spaces(size_t count) {
    return fmt::format("{} space{}", count, count == 1 ? "" : "s");
}

/// Reports a last line whose key is aligned neither with its neighbors nor below a key without a value.
std::optional<YamlFault> indentation(const std::vector<Line>& lines) {
    if (lines.size() < 2 || lines.back().key.empty() || lines.back().isEntry()) return {};
    const Line &line = lines.back(), &before = lines[lines.size() - 2];
    if (before.hasValue && line.indent > before.inner)
        return YamlFault{line.number, fmt::format("'{}' is indented unlike '{}' in line {}, which has its value: "
                                                  "indent it as far, by {}",
                                                  line.key, before.key, before.number, spaces(before.inner))};

    // A key below the dash of a list entry, or between the dash and its contents
    const auto above = std::find_if(lines.rbegin() + 1, lines.rend(),
                                    [&](const Line& previous) { return previous.indent <= line.indent; });
    if (above == lines.rend() || !above->isEntry() || line.indent >= above->inner) return {};
    if (line.key == above->key)
        return YamlFault{line.number, fmt::format("a dash is missing before '{0}', as in line {1}: write '- {0}: ...'",
                                                  line.key, above->number)};
    const bool isTop = std::ranges::count(configKeys(), line.key) > 0;
    return YamlFault{line.number, fmt::format("'{}' is indented unlike what the dash in line {} begins with: "
                                              "indent it by {}{}",
                                              line.key, above->number, spaces(isTop ? 0 : above->inner),
                                              isTop ? ", as the config's other keys" : "")};
}

/// Whether there is no space after the dash of a list entry.
bool hasNarrowDash(const Line& line) {
    return line.text.find_first_of("{[", line.indent) == line.indent + 1 && line.text[line.indent] == '-';
}

/// The message for a line with a second ': ' before any brace, else "".
std::string secondColon(const Line& line) {
    const size_t brace = line.text.find_first_of("{[", line.inner);
    const std::string head = line.text.substr(line.inner, std::min(brace, line.text.size()) - line.inner);
    const size_t second = head.find(": ", head.find(": ") + 1);
    if (head.find(": ") == std::string::npos || second == std::string::npos) return {};
    const std::string quoted =
        brace == std::string::npos ? "" : fmt::format(", as in \"{}\": ...", head.substr(0, second));
    return "a second ': ' in a line; put a text that holds one between quotes" + quoted;
}

/// Whether the parser stopped at an unexpected key outside of braces.
bool isOfBlocks(const std::string& message) {
    constexpr std::array<std::string_view, 3> kMessages{"end of map not found", "end of sequence not found",
                                                        "illegal map value"};
    return std::ranges::count(kMessages, message) > 0;
}

/// The most common cause of a parser message, or "".
std::string hintOf(const std::string& message) {
    static const std::vector<std::pair<std::string, std::string>> hints{
        {"end of map not found", "is this line, or the one before, indented unlike its neighbors?"},
        {"end of sequence not found", "is this line, or the one before, indented unlike its neighbors?"},
        {"end of map flow not found", "after a '{' before it a comma or the '}' is missing"},
        {"end of sequence flow not found", "after a '[' before it a comma or the ']' is missing"},
        {"illegal map value", "is a ':' missing in the line before?"}};
    for (const auto& [text, hint] : hints)
        if (message == text) return "; " + hint;
    if (message.starts_with("unknown escape character")) return "; write paths with '/', or between single quotes";
    return {};
}

/// An unmatched '{' or '['.
struct OpenBrace {
    char brace;
    int line;
};

/// The innermost brace that is open at the beginning of a line.
std::optional<OpenBrace> openBrace(const std::string& text, int line) {
    std::vector<OpenBrace> open;
    char before = '\n', quote = 0;  // The previous character that is no space; the quote of a text.
    int number = 1;
    for (size_t i = 0; i < text.size() && number < line; ++i) {
        const char c = text[i];
        number += c == '\n';
        const bool beginsValue = std::string_view("\n:-,{[").find(before) != std::string_view::npos;
        if (quote != 0) {
            if (c == '\\' && quote == '"') ++i;
            if (c == quote) quote = 0;
        } else if (c == '#' && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\n')) {
            while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
            continue;
        } else if ((c == '"' || c == '\'') && beginsValue) {
            quote = c;
        } else if ((c == '{' || c == '[') && (beginsValue || !open.empty())) {
            open.push_back({c, number});
        } else if ((c == '}' || c == ']') && !open.empty()) {
            open.pop_back();
        }
        if (c != ' ') before = c;
    }
    return open.empty() ? std::nullopt : std::optional(open.back());
}

/// A hint if a comment contains the closing brace, e.g. because of an unquoted #ff8800; else "".
std::string afterComment(const std::string& text, const OpenBrace& open) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; number <= open.line; ++number) std::getline(lines, line);
    const size_t comment = line.find(" #");
    const bool takesEnd =
        comment != std::string::npos && line.find(open.brace == '{' ? '}' : ']', comment) != std::string::npos;
    return takesEnd ? "; what follows '#' there is a comment" : "";
}

/// Whether the parser stopped within braces.
bool isOfBraces(const std::string& message) {
    constexpr std::array<std::string_view, 3> kMessages{"end of map flow not found", "end of sequence flow not found",
                                                        "illegal block entry"};
    return std::ranges::count(kMessages, message) > 0;
}

}  // namespace

YamlFault yamlFault(const std::string& text, int line, const std::string& message) {
    if (const auto fault = otherSpace(text)) return *fault;
    if (const auto open = isOfBraces(message) ? openBrace(text, line) : std::nullopt)
        return {open->line,
                fmt::format("the '{}' in this line is not closed: a '{}' is missing, or a comma before line {}{}",
                            open->brace, open->brace == '{' ? '}' : ']', line, afterComment(text, *open))};
    const std::vector<Line> lines = linesUpTo(text, line);
    const bool isThere = !lines.empty() && lines.back().number == line;
    if (const auto fault = isThere && isOfBlocks(message) ? indentation(lines) : std::nullopt) return *fault;
    if (isThere && hasNarrowDash(lines.back()))
        return {line, "a space is missing after the dash of a list's entry: write '- '"};
    if (const std::string text = isThere ? secondColon(lines.back()) : ""; !text.empty()) return {line, text};
    return {line, message + hintOf(message)};
}

}  // namespace voxray
