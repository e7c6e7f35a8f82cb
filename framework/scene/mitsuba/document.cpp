#include "scene/mitsuba/document.h"

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "base/files.h"
#include "base/interrupt.h"
#include "base/lower_case.h"
#include "scene/mitsuba/transform.h"

namespace voxray::mitsuba {
namespace fs = std::filesystem;

namespace {

constexpr int kMaxIncludes = 15;       ///< Files within files.
constexpr int kMaxElements = 64;       ///< Elements within elements.
constexpr size_t kMaxFiles = 1000;     ///< In all: a file may include another one many times.
constexpr size_t kMaxValue = 1 << 20;  ///< Bytes of an attribute after the replacement of $names.
/// What an element and its node, property or plugin take at most, bytes without text.
constexpr size_t kBytesPerElement = 1000;

const std::set<std::string>& pluginTags() {
    static const std::set<std::string> tags{"bsdf",       "shape",          "emitter",    "sensor", "texture", "film",
                                            "sampler",    "rfilter",        "integrator", "medium", "phase",   "volume",
                                            "subsurface", "reconstruction", "luminaire",  "camera"};
    return tags;
}

const std::set<std::string>& propertyTags() {
    static const std::set<std::string> tags{"float",     "integer",   "boolean",   "string",   "rgb",
                                            "srgb",      "color",     "point",     "spectrum", "vector",
                                            "animation", "blackbody", "transform", "tensor"};
    return tags;
}

/// A plugin before its references are resolved.
struct Draft {
    std::shared_ptr<Plugin> plugin;
    struct Reference {
        size_t child;  ///< Place among the children of the plugin.
        std::string id;
        TextLocation where;
    };
    std::vector<Reference> references;
};

class Reader {
 public:
    Reader(ImportNotes& notes, MemoryBudget& memory) : notes_(notes), memory_(memory) {}

    Document read(const fs::path& path) {
        auto scene = std::make_shared<Plugin>();
        scene->tag = scene->type = "scene";
        drafts_.push_back({scene, {}});
        try {
            readFileInto(path, 0, 0);
            resolveReferences();
        } catch (...) {
            // Plugins that refer to each other keep each other alive
            for (const Draft& draft : drafts_) draft.plugin->children.clear();
            throw;
        }
        return {scene, folders_};
    }

 private:
    /// A file that is being read.
    struct File {
        std::string name;
        std::vector<size_t> lineStarts;
        int includes = 0;  ///< Files around it.

        TextLocation at(const pugi::xml_node& node) const { return at(node.offset_debug()); }
        TextLocation at(ptrdiff_t offset) const {
            const auto line = std::ranges::upper_bound(lineStarts, size_t(std::max<ptrdiff_t>(offset, 0)));
            return {name, int(line - lineStarts.begin())};
        }
    };

    void readFileInto(const fs::path& path, int includes, size_t target) {
        if (++files_ > kMaxFiles) throw Error("{}: more than {} files are included", path.string(), kMaxFiles);
        const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
        if (std::ranges::find(folders_, folder) == folders_.end()) folders_.push_back(folder);
        const std::string text = readTextFile(path);
        memory_.reserve(text.size(), 4);
        File file{path.string(), {0}, includes};
        for (size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') file.lineStarts.push_back(i + 1);

        pugi::xml_document document;
        const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
        if (!result) throw Error(file.at(result.offset), "it is no XML: {}", result.description());
        const pugi::xml_node root = document.document_element();
        const std::string name = root.name();
        if (name == "scene") {
            if (std::string_view(root.attribute("version").value()).empty())
                throw Error(file.at(root), "<scene> has no version, such as version=\"3.0.0\"");
            readChildren(root, file, target, 0);
        } else if (includes > 0) {
            readElement(root, file, target, 0);
        } else {
            throw Error(file.at(root), "it is no Mitsuba scene: its first element is <{}>, not <scene>",
                        oneLine(name, 60));
        }
    }

    void readChildren(const pugi::xml_node& node, const File& file, size_t target, int depth) {
        for (const pugi::xml_node& child : node.children())
            if (child.type() == pugi::node_element) readElement(child, file, target, depth + 1);
    }

    void readElement(const pugi::xml_node& node, const File& file, size_t target, int depth) {
        const TextLocation where = file.at(node);
        if (depth > kMaxElements) throw Error(where, "more than {} elements are within each other", kMaxElements);
        if (interruptRequested()) throw Interrupted();
        memory_.reserve(1, kBytesPerElement);
        const std::string element = node.name();
        const Attributes of = attributesOf(node, where);
        const auto get = [&](const char* name) {
            const auto entry = of.find(name);
            return entry == of.end() ? std::string() : entry->second;
        };
        if (element == "default") {
            defaults_.try_emplace(get("name"), get("value"));
        } else if (element == "path") {
            const fs::path folder = fs::path(file.name).parent_path() / get("value");
            folders_.push_back(folder.lexically_normal());
        } else if (element == "include") {
            readInclude(get("filename"), file, target, where);
        } else if (element == "alias") {
            aliases_[get("as")] = get("id");
        } else if (element == "ref") {
            Draft& draft = drafts_[target];
            draft.references.push_back({draft.plugin->children.size(), get("id"), where});
            draft.plugin->children.push_back({snakeCase(get("name")), nullptr});
        } else if (pluginTags().contains(element) || (propertyTags().contains(element) && of.contains("type"))) {
            readPlugin(node, of, file, target, depth);
        } else if (propertyTags().contains(element)) {
            readProperty(node, of, file, target);
        } else if (element != "null") {
            notes_.add("unknown elements are left out", "<" + element + "> (" + where.str() + ")");
        }
    }

    void readInclude(const std::string& name, const File& file, size_t target, const TextLocation& where) {
        if (file.includes + 1 > kMaxIncludes)
            throw Error(where, "more than {} files include each other: is there a loop?", kMaxIncludes);
        const fs::path path = find(name);
        std::error_code code;
        if (name.empty() || !fs::is_regular_file(path, code))
            throw Error(where, "<include>: there is no file '{}'", oneLine(name, 200));
        readFileInto(path, file.includes + 1, target);
    }

    void readPlugin(const pugi::xml_node& node, const Attributes& of, const File& file, size_t target, int depth) {
        auto plugin = std::make_shared<Plugin>();
        plugin->where = file.at(node);
        plugin->tag = node.name();
        if (plugin->tag == "luminaire") plugin->tag = "emitter";
        if (plugin->tag == "camera") plugin->tag = "sensor";
        const auto get = [&](const char* name) {
            const auto entry = of.find(name);
            return entry == of.end() ? std::string() : entry->second;
        };
        plugin->type = lowerCase(get("type"));
        plugin->id = get("id");
        if (!plugin->id.empty()) ids_[plugin->id] = plugin;
        drafts_[target].plugin->children.push_back({snakeCase(get("name")), plugin});
        drafts_.push_back({plugin, {}});
        readChildren(node, file, drafts_.size() - 1, depth);
    }

    void readProperty(const pugi::xml_node& node, const Attributes& of, const File& file, size_t target) {
        Property property{node.name(), of, glm::dmat4(1.0), file.at(node)};
        if (property.tag == "transform") {
            for (const pugi::xml_node& child : node.children()) {
                if (child.type() != pugi::node_element) continue;
                const TextLocation where = file.at(child);
                property.transform =
                    transformOf(lowerCase(child.name()), attributesOf(child, where), where) * property.transform;
            }
        } else if (property.tag == "animation") {
            notes_.add("animation is left out", property.where.str());
        }
        const auto name = of.find("name");
        if (name == of.end()) throw Error(property.where, "<{}> has no name", property.tag);
        drafts_[target].plugin->properties[snakeCase(name->second)] = std::move(property);
    }

    Attributes attributesOf(const pugi::xml_node& node, const TextLocation& where) const {
        Attributes of;
        for (const pugi::xml_attribute& attribute : node.attributes())
            of[attribute.name()] = replaced(attribute.value(), where);
        return of;
    }

    /// The text with the values of <default> for $names: the longest name that fits.
    std::string replaced(std::string_view text, const TextLocation& where) const {
        std::string result;
        while (true) {
            const size_t dollar = text.find('$');
            result += text.substr(0, dollar);
            if (result.size() > kMaxValue) throw Error(where, "a value is longer than {} bytes", kMaxValue);
            if (dollar == std::string_view::npos) return result;
            text.remove_prefix(dollar + 1);
            const size_t length = nameLength(text);
            if (length == 0)
                throw Error(where, "'${0}' has no value: add <default name=\"{0}\" value=\"…\"/> before it",
                            oneLine(text.substr(0, 60), 60));
            result += defaults_.at(std::string(text.substr(0, length)));
            text.remove_prefix(length);
        }
    }

    /// Length of the longest name of a <default> at the front of a text; 0: none.
    size_t nameLength(std::string_view text) const {
        size_t length = 0;
        while (length < std::min<size_t>(text.size(), 100) &&
               (std::isalnum(uint8_t(text[length])) || text[length] == '_'))
            ++length;
        while (length > 0 && !defaults_.contains(std::string(text.substr(0, length)))) --length;
        return length;
    }

    void resolveReferences() {
        for (const Draft& draft : drafts_)
            for (const Draft::Reference& reference : draft.references) {
                std::string id = reference.id;
                for (size_t i = 0; i <= aliases_.size() && !ids_.contains(id) && aliases_.contains(id); ++i)
                    id = aliases_.at(id);
                const auto entry = ids_.find(id);
                if (entry == ids_.end())
                    throw Error(reference.where, "<ref>: nothing has the id '{}'", oneLine(reference.id, 100));
                draft.plugin->children[reference.child].plugin = entry->second;
            }
        std::map<const Plugin*, int> heights;
        for (const Draft& draft : drafts_) height(*draft.plugin, 0, heights);
    }

    /// Plugins below each other, itself included. @param heights of those that are known, 0: of those above
    static int height(const Plugin& plugin, int depth, std::map<const Plugin*, int>& heights) {
        const auto [known, isNew] = heights.try_emplace(&plugin, 0);
        if (!isNew && known->second == 0) throw Error(plugin.where, "{} refers to itself", plugin.what());
        if (!isNew) return known->second;
        int most = 0;
        if (depth < kMaxElements)
            for (const Plugin::Child& child : plugin.children)
                most = std::max(most, height(*child.plugin, depth + 1, heights));
        if (depth + most >= kMaxElements)
            throw Error(plugin.where, "more than {} elements refer to each other", kMaxElements);
        return heights[&plugin] = most + 1;
    }

    fs::path find(const std::string& name) const { return Document{nullptr, folders_}.resolve(name); }

    ImportNotes& notes_;
    MemoryBudget& memory_;
    size_t files_ = 0;
    std::vector<fs::path> folders_;
    std::map<std::string, std::string> defaults_, aliases_;
    std::map<std::string, PluginPtr> ids_;
    std::vector<Draft> drafts_;
};

}  // namespace

fs::path Document::resolve(const std::string& name) const {
    std::error_code code;
    if (fs::path(name).is_absolute()) return name;
    for (const fs::path& folder : folders)
        if (fs::exists(folder / name, code)) return folder / name;
    if (name.find('\\') != std::string::npos) {
        std::string other = name;  // As Windows writes paths
        std::ranges::replace(other, '\\', '/');
        return resolve(other);
    }
    return folders.empty() ? fs::path(name) : folders.front() / name;
}

Document readDocument(const fs::path& path, ImportNotes& notes, MemoryBudget& memory) {
    return Reader(notes, memory).read(path);
}

std::string snakeCase(const std::string& name) {
    std::string result;
    for (size_t i = 0; i < name.size(); ++i) {
        const bool isUpper = std::isupper(uint8_t(name[i])) != 0;
        if (isUpper && i > 0 && std::isupper(uint8_t(name[i - 1])) == 0 && name[i - 1] != '_') result += '_';
        result += char(std::tolower(uint8_t(name[i])));
    }
    return result;
}

}  // namespace voxray::mitsuba
