#include "experiment/config_schema.h"

#include "config/overrides.h"
#include "config/settings.h"
#include "graph/graph.h"
#include "scene/load.h"

namespace voxray {
namespace {

Value text(const std::string& content) {
    return Value::fromScalar(content, true);
}
Value literal(const std::string& content) {
    return Value::fromScalar(content);
}

Value object(std::initializer_list<std::pair<const char*, Value>> members) {
    Value map = Value::map();
    for (const auto& [key, value] : members) map.set(key, value);
    return map;
}

Value listOf(const std::vector<std::string>& words, Value (*toValue)(const std::string&) = text) {
    Value list = Value::list();
    for (const std::string& word : words) list.items.push_back(toValue(word));
    return list;
}

Value anyOf(std::initializer_list<Value> choices) {
    Value list = Value::list();
    list.items = choices;
    return object({{"anyOf", list}});
}

/// Parses "[a, b, c]" into a list of numbers.
Value numbers(const std::string& triple) {
    Value list = Value::list();
    std::string number;
    for (const char c : triple + ",") {
        if (c == ',' || c == ']') {
            if (!number.empty()) list.items.push_back(literal(number));
            number.clear();
        } else if (c != '[' && c != ' ') {
            number += c;
        }
    }
    return list;
}

Value vectorSchema() {
    return object({{"type", text("array")},
                   {"items", object({{"type", text("number")}})},
                   {"minItems", literal("3")},
                   {"maxItems", literal("3")}});
}

Value rgbSchema() {
    return anyOf({object({{"type", text("number")}}), vectorSchema()});
}

Value parameterSchema(const ParameterDoc& doc) {
    const bool isNumber = doc.type == "integer" || doc.type == "number";
    const bool isTriple = doc.type == "rgb" || doc.type == "vector";
    Value schema = doc.type == "rgb" ? rgbSchema() : doc.type == "vector" ? vectorSchema() : Value::map();
    const bool isWords = doc.type == "words";
    if (doc.type == "choice")
        schema.set("enum", listOf(doc.choices));
    else if (isWords)
        schema = object({{"type", text("array")}, {"items", object({{"type", text("string")}})}});
    else if (!isTriple)
        schema.set("type", text(doc.type));
    schema.set("description", text(doc.help));
    if (isNumber && !doc.choices.empty()) schema.set("enum", listOf(doc.choices, literal));
    if (isNumber && !doc.min.empty()) {
        schema.set("minimum", literal(doc.min));
        schema.set("maximum", literal(doc.max));
    }
    if (!doc.conditions.empty()) {
        // An extension of JSON Schema that editors ignore and `voxray explain` uses
        Value conditions = Value::list();
        for (const ParameterDoc::Condition& condition : doc.conditions)
            conditions.items.push_back(object({{"parameter", text(condition.parameter)},
                                               {condition.isOneOf ? "in" : "not_in", listOf(condition.values)}}));
        schema.set("x-only-with", conditions);
    }
    if (isWords) return schema;
    if (isTriple)
        schema.set("default", numbers(doc.defaults));
    else if (isNumber || doc.type == "boolean")
        schema.set("default", literal(doc.defaults));
    else if (!doc.defaults.empty())
        schema.set("default", text(doc.defaults));
    return schema;
}

Value mapSchema(const std::vector<ParameterDoc>& docs, Value properties = Value::map()) {
    for (const ParameterDoc& doc : docs) properties.set(doc.name, parameterSchema(doc));
    return object({{"type", text("object")}, {"properties", properties}, {"additionalProperties", literal("false")}});
}

Value withRequired(Value schema, const std::vector<std::string>& keys) {
    schema.set("required", listOf(keys));
    return schema;
}

Value passSchema(const PassKind& kind) {
    Value properties = Value::map(), inputs = Value::map();
    properties.set("pass", object({{"const", text(kind.name)}, {"description", text(kind.help)}}));
    properties.set("id", object({{"type", text("string")},
                                 {"description", text("Name in this graph; by default the pass's own.")}}));
    for (const PortInfo& port : kind.ports)
        if (!port.output) inputs.set(port.name, object({{"type", text("string")}, {"description", text(port.help)}}));
    properties.set("inputs", object({{"type", text("object")},
                                     {"properties", inputs},
                                     {"additionalProperties", literal("false")},
                                     {"description", text("Port: the id of the pass that writes it, or id.port.")}}));
    return withRequired(mapSchema(kind.parameters, properties), {"pass"});
}

/// Adds the properties of a scene's source, which include the parameters of all built-in scenes.
void addSource(Value& schema) {
    Value& properties = *schema.find("properties");
    for (const ParameterDoc& doc : describeParams<SceneSource>()) properties.set(doc.name, parameterSchema(doc));
    properties.find("builtin")->set("enum", listOf(builtinSceneNames()));
    for (const std::string& name : builtinSceneNames())
        for (const ParameterDoc& doc : describeBuiltinScene(name))
            if (!properties.find(doc.name)) {
                Value parameter = parameterSchema(doc);
                parameter.erase("default");
                properties.set(doc.name, parameter);
            }
}

Value additionSchema() {
    Value schema = mapSchema({});
    Value& properties = *schema.find("properties");
    properties.set("transform", mapSchema(describeParams<Placement>()));
    properties.set("material", mapSchema(describeParams<MaterialSettings>()));
    properties.set("swing", mapSchema(describeParams<Swing>()));
    addSource(schema);
    return schema;
}

Value overrideSchema() {
    Value schema = mapSchema(describeParams<MaterialSettings>());
    for (auto& member : schema.find("properties")->members) member.value.erase("default");
    return schema;
}

Value sceneSchema() {
    Value camera = withRequired(mapSchema(describeParams<CameraSettings>()), {"position", "target"});
    camera.find("properties")
        ->set("path",
              object({{"type", text("array")},
                      {"items", withRequired(mapSchema(describeParams<CameraKey>()), {"frame", "position", "target"})},
                      {"description", text("Where the camera is in later frames, in place of `move`: between two "
                                           "keys position and target go along straight lines by equal steps.")}}));
    Value lights = Value::list();
    lights.items = {withRequired(mapSchema(describeParams<DirectionalLightSettings>()), {"directional"}),
                    withRequired(mapSchema(describeParams<PointLightSettings>()), {"point"}),
                    withRequired(mapSchema(describeParams<SpotLightSettings>()), {"spot"})};
    const Value string = object({{"type", text("string")}});
    const Value lightList =
        object({{"type", text("array")},
                {"items", object({{"oneOf", lights}})},
                {"description", text("Added to the scene's own; a word is the built-in scene's parameter.")}});

    Value schema = mapSchema(describeParams<SceneOptions>());
    Value& properties = *schema.find("properties");
    properties.set("moving_spheres", mapSchema(describeParams<MovingSpheres>()));
    properties.set("transform", mapSchema(describeParams<Placement>()));
    properties.set("region", withRequired(mapSchema(describeParams<RegionSettings>()), {"min", "max"}));
    properties.set("camera", anyOf({string, camera}));
    properties.set("lights", anyOf({string, lightList}));
    properties.set("environment", anyOf({string, rgbSchema(),
                                         withRequired(mapSchema(describeParams<EnvironmentSettings>()), {"map"})}));
    properties.set("add", object({{"type", text("array")},
                                  {"items", additionSchema()},
                                  {"description", text("Scenes that are added to this one.")}}));
    properties.set("override", object({{"type", text("object")},
                                       {"additionalProperties", overrideSchema()},
                                       {"description", text("Name of a material: its new settings.")}}));
    const Value names = object({{"type", text("array")},
                                {"items", string},
                                {"description", text("Names of nodes, meshes or materials: "
                                                     "what goes by one of them is left out of the scene.")}});
    properties.set("hide", anyOf({string, names}));
    addSource(schema);
    return schema;
}

}  // namespace

Value configJsonSchema(const Registry& registry) {
    Value passes = Value::list();
    for (const PassKind& kind : registry.kinds()) passes.items.push_back(passSchema(kind));
    const Value pass = object({{"oneOf", passes}});

    Value properties = Value::map();
    for (const ParameterDoc& doc : describeParams<GeneralSettings>()) properties.set(doc.name, parameterSchema(doc));
    properties.set("scene", sceneSchema());
    properties.set("image", mapSchema(describeParams<ImageSettings>()));
    Value metrics = Value::map();
    metrics.set("metrics", object({{"type", text("array")},
                                   {"items", object({{"enum", listOf(metricNames())}})},
                                   {"minItems", literal("1")},
                                   {"uniqueItems", literal("true")},
                                   {"description", text("Metrics that are written; all by default.")}}));
    metrics.set("masks", object({{"type", text("object")},
                                 {"additionalProperties", mapSchema(describeParams<MaskSettings>())},
                                 {"description", text("Name: conditions. Pixels that are scored on their own.")}}));
    properties.set("measure", mapSchema(describeParams<MeasureSettings>(), metrics));
    properties.set("graph", object({{"type", text("array")}, {"items", pass}, {"minItems", literal("1")}}));
    properties.set("reference", anyOf({object({{"type", text("null")}}), pass}));
    properties.set(
        "sweep",
        object({{"type", text("object")},
                {"minProperties", literal("1")},
                {"additionalProperties", anyOf({object({{"type", text("array")}, {"minItems", literal("1")}}),
                                                object({{"type", text("object")}, {"minProperties", literal("1")}})})},
                {"description", text("Path: values, or names with values; all combinations are rendered.")}}));
    properties.set("profiles", object({{"type", text("object")},
                                       {"additionalProperties", object({{"type", text("object")}})},
                                       {"description", text("Name: overrides that --profile applies.")}}));
    return object({{"$schema", text("https://json-schema.org/draft/2020-12/schema")},
                   {"title", text("Voxray experiment")},
                   {"type", text("object")},
                   {"properties", properties},
                   {"required", listOf({"name", "scene", "graph"})},
                   {"additionalProperties", literal("false")}});
}

}  // namespace voxray
