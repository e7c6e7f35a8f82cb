#include "config/yaml.h"

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <unordered_set>

#include "base/files.h"

namespace voxray {
namespace {

constexpr size_t kMaxBytes = 1u << 20;
constexpr size_t kMaxNodes = 100000;
constexpr int kMaxDepth = 64;

/// Turns yaml-cpp's nodes into Values.
class Converter {
 public:
    Converter(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

    Value convert(const YAML::Node& node, int depth, const TextLocation& fallback) {
        // Limits: aliases make a small file large, and a node may contain itself
        const TextLocation where = node.Mark().is_null() ? fallback : locate(node.Mark());
        if (depth > kMaxDepth) throw UsageError(where, "nested more than {} levels deep", kMaxDepth);
        if (++nodes_ > kMaxNodes) throw UsageError(where, "more than {} values", kMaxNodes);
        if (const std::string& tag = node.Tag(); !tag.empty() && tag != "?" && tag != "!")
            throw UsageError(where, "tags such as '{}' are not supported", tag);

        Value value;
        value.where = where;
        switch (node.Type()) {
            case YAML::NodeType::Undefined:
            case YAML::NodeType::Null:
                break;
            case YAML::NodeType::Scalar:
                value.kind = Value::Kind::Scalar;
                value.scalar = node.Scalar();
                value.quoted = node.Tag() == "!";
                if (value.quoted && goesOnInNextLine(node.Mark()))
                    throw UsageError(where,
                                     "a text in quotes goes on in the next line: is a quote left open?");
                break;
            case YAML::NodeType::Sequence:
                value.kind = Value::Kind::List;
                for (const YAML::Node& item : node) value.items.push_back(convert(item, depth + 1, where));
                break;
            case YAML::NodeType::Map:
                convertMap(node, depth, value);
                break;
        }
        return value;
    }

    TextLocation locate(const YAML::Mark& mark) const { return {file_, mark.is_null() ? 0 : mark.line + 1}; }

 private:
    /// Whether a line ends before the quote that ends the text in quotes at `mark`.
    bool goesOnInNextLine(const YAML::Mark& mark) const {
        if (mark.is_null() || size_t(mark.pos) >= text_.size()) return false;
        const char quote = text_[size_t(mark.pos)];
        if (quote != '"' && quote != '\'') return false;
        for (size_t i = size_t(mark.pos) + 1; i < text_.size() && text_[i] != '\n'; ++i) {
            if (quote == '"' && text_[i] == '\\')
                ++i;
            else if (text_[i] == quote && quote == '\'' && i + 1 < text_.size() && text_[i + 1] == quote)
                ++i;
            else if (text_[i] == quote)
                return false;
        }
        return true;
    }

    void convertMap(const YAML::Node& node, int depth, Value& value) {
        value.kind = Value::Kind::Map;
        std::unordered_set<std::string> seen;
        for (const auto& entry : node) {
            const TextLocation where =
                entry.first.Mark().is_null() ? value.where : locate(entry.first.Mark());
            if (!entry.first.IsScalar()) throw UsageError(where, "a key must be a word");
            const std::string& key = entry.first.Scalar();
            if (!seen.insert(key).second) throw UsageError(where, "'{}' appears twice in the same map", key);
            Value member = convert(entry.second, depth + 1, where);
            member.where = where;
            value.members.push_back({key, std::move(member)});
        }
    }

    const std::string& text_;
    std::string file_;
    size_t nodes_ = 0;
};

void checkUtf8(const std::string& text, const std::string& file) {
    try {
        static_cast<void>(nlohmann::json(text).dump());
    } catch (const nlohmann::json::exception&) {
        throw UsageError({file, 0}, "is not UTF-8 text");
    }
}

/// A white space that YAML takes for none.
struct WhiteSpace {
    const char* bytes;
    const char* name;
};
constexpr WhiteSpace kOtherSpaces[] = {{"\t", "a tab"}, {"\u00a0", "a non-breaking space"}};

/// @throws UsageError for the first line that is indented by such a space.
void checkIndentation(const std::string& text, const std::string& file) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        for (const WhiteSpace& space : kOtherSpaces)
            if (line.find(space.bytes) != std::string::npos &&
                line.find(space.bytes) == line.find_first_not_of(' '))
                throw UsageError({file, number}, "bad YAML: {} in the indentation; YAML takes spaces",
                                 space.name);
}

/// Whether a line without braces has a ': ' after its first one.
bool hasSecondColon(const std::string& text, int line) {
    std::istringstream lines(text);
    std::string found;
    for (int number = 0; number <= line; ++number) std::getline(lines, found);
    const size_t first = found.find(": ");
    return first != std::string::npos && found.find(": ", first + 1) != std::string::npos &&
           found.find('{') == std::string::npos;
}

/// What mostly lies behind a message of the parser, or "".
std::string hintOf(const std::string& message) {
    static const std::vector<std::pair<std::string, std::string>> hints{
        {"end of map not found", "is this line, or the one before, indented unlike its neighbours?"},
        {"end of sequence not found", "is this line, or the one before, indented unlike its neighbours?"},
        {"end of map flow not found", "after a '{' before it a comma or the '}' is missing"},
        {"end of sequence flow not found", "after a '[' before it a comma or the ']' is missing"},
        {"illegal map value", "is a ':' missing in the line before?"}};
    for (const auto& [part, hint] : hints)
        if (message == part) return "; " + hint;
    if (message.starts_with("unknown escape character"))
        return "; write paths with '/', or between single quotes";
    return {};
}

}  // namespace

Value parseYaml(const std::string& text, const std::string& fileName) {
    if (text.size() > kMaxBytes) throw UsageError({fileName, 0}, "is larger than 1 MiB; not a config");
    checkUtf8(text, fileName);
    Converter converter(text, fileName);
    try {
        const std::vector<YAML::Node> documents = YAML::LoadAll(text);
        if (documents.size() > 1)
            throw UsageError(converter.locate(documents[1].Mark()),
                             "a second document; one file holds one config");
        if (documents.empty()) return converter.convert(YAML::Node(), 0, {fileName, 1});
        return converter.convert(documents[0], 0, {fileName, 1});
    } catch (const YAML::Exception& error) {
        checkIndentation(text, fileName);
        if (hasSecondColon(text, error.mark.line))
            throw UsageError(converter.locate(error.mark),
                             "bad YAML: a second ': ' in a line; put a text that holds one between quotes");
        throw UsageError(converter.locate(error.mark), "bad YAML: {}{}", error.msg, hintOf(error.msg));
    }
}

Value readYaml(const std::filesystem::path& path) {
    std::string text;
    try {
        text = readTextFile(path);
    } catch (const Error& error) {
        throw UsageError("{}", error.what());
    }
    return parseYaml(text, path.string());
}

}  // namespace voxray
