#include "config/scene_additions.h"

#include <algorithm>
#include <filesystem>

namespace voxray {
namespace {

const std::vector<std::string> kAdditionKeys{"transform", "material", "swing"};

SceneAddition readAddition(const Value& entry, const std::string& owner) {
    if (!entry.isMap())
        throw UsageError(entry.where, "{}: expected a map such as {{file: dragon.glb}} or {{builtin: plane}}", owner);
    SceneAddition addition;
    addition.source = readSceneSource(entry, owner, kAdditionKeys);
    if (const Value* transform = entry.find("transform"))
        addition.placement = readPlacement(*transform, owner + ".transform");
    if (const Value* material = entry.find("material"); material && !material->isNull())
        addition.material = readParams<MaterialSettings>(*material, owner + ".material");
    if (const Value* swing = entry.find("swing"); swing && !swing->isNull()) {
        addition.swing = readParams<Swing>(*swing, owner + ".swing");
        if (addition.swing->by == glm::vec3(0.0f))
            throw UsageError(swing->where, "{}.swing: moves nothing without 'by', as in {{by: [0.2, 0, 0]}}", owner);
    }
    return addition;
}

/// Location of the later of two values: that of a sweep or the command line, else the lower in the file.
TextLocation laterLocation(const Value& a, const Value& b) {
    if (a.where.file != b.where.file) return a.where.line == 0 ? a.where : b.where;
    return a.where.line > b.where.line ? a.where : b.where;
}

}  // namespace

std::string SceneSource::name() const {
    return file.empty() ? builtin : std::filesystem::path(file).stem().string();
}

SceneSource readSceneSource(const Value& map, const std::string& owner, const std::vector<std::string>& otherKeys) {
    const bool isBuiltin = map.find("builtin") != nullptr;
    const auto isOneOf = [](const std::vector<std::string>& keys, const std::string& key) {
        return std::ranges::count(keys, key) > 0;
    };
    Value source = Value::map(), parameters = Value::map();
    source.where = map.where;
    for (const auto& [key, value] : map.members) {
        // A config's `lights` is a list, a built-in scene's parameter of that name a scalar
        const bool isBuiltinsLights = isBuiltin && key == "lights" && value.isScalar();
        const bool isKnown = isOneOf(fieldNames<SceneSource>(), key) || isOneOf(otherKeys, key);
        if (isBuiltin && (isBuiltinsLights || !isKnown))
            parameters.set(key, value);
        else
            source.set(key, value);
    }
    SceneSource read = readParams<SceneSource>(source, owner, otherKeys);
    read.builtinParameters = parameters;
    read.owner = owner;
    read.otherKeys = otherKeys;

    // Exactly one source
    const bool hasFile = !read.file.empty(), hasBuiltin = !read.builtin.empty();
    if (hasFile && hasBuiltin)
        throw UsageError(laterLocation(*map.find("file"), *map.find("builtin")),
                         "{}: both 'file' and 'builtin' are set; take one out (null removes a key)", owner);
    if (!hasFile && !hasBuiltin) throw UsageError(map.where, "{}: needs 'file' or 'builtin'", owner);
    read.where = map.find(hasFile ? "file" : "builtin")->where;
    return read;
}

Placement readPlacement(const Value& map, const std::string& owner) {
    const Placement placement = readParams<Placement>(map, owner);
    for (int axis = 0; axis < 3; ++axis)
        if (placement.scale[axis] == 0)
            throw UsageError(map.find("scale")->where, "{}.scale: 0 leaves nothing of the scene", owner);
    return placement;
}

std::vector<SceneAddition> readSceneAdditions(const Value& list) {
    if (!list.isList() && !list.isNull())
        throw UsageError(list.where, "scene.add: expected a list of scenes, as in [{{file: dragon.glb}}]");
    std::vector<SceneAddition> additions;
    for (size_t i = 0; i < list.items.size(); ++i)
        additions.push_back(readAddition(list.items[i], fmt::format("scene.add[{}]", i)));
    return additions;
}

std::vector<MaterialOverride> readMaterialOverrides(const Value& map) {
    if (!map.isMap() && !map.isNull())
        throw UsageError(map.where,
                         "scene.override: expected a map of materials by name, as in {{floor: {{roughness: 0}}}}");
    std::vector<MaterialOverride> overrides;
    for (const auto& [name, settings] : map.members) {
        const std::string owner = "scene.override." + name;
        if (!settings.isMap() || settings.members.empty())
            throw UsageError(settings.where, "{}: expected settings of a material, as in {{roughness: 0}}", owner);
        for (const auto& [key, value] : settings.members)
            if (value.isMap())
                throw UsageError(value.where,
                                 "{0}: no setting of a material is called '{1}'; "
                                 "in a path a name with dots stands in double quotes: scene.override.\"{2}.{1}\"",
                                 owner, key, name);
        MaterialOverride change{name, {readParams<MaterialSettings>(settings, owner), {}}, settings.where};
        for (const auto& member : settings.members) change.change.keys.push_back(member.key);
        overrides.push_back(std::move(change));
    }
    return overrides;
}

}  // namespace voxray
