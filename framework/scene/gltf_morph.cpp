#include "scene/gltf_morph.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_keys.h"
#include "scene/gltf_values.h"
#include "scene/morph.h"

namespace voxray {
namespace {

/// One attribute of a target; empty if the target or the mesh has none.
std::vector<glm::vec3> readOffsets(GltfFile& file, const std::map<std::string, int>& target, const char* name,
                                   bool isInMesh, size_t vertexCount, const std::string& what) {
    const auto entry = target.find(name);
    if (entry == target.end() || !isInMesh) return {};
    const size_t count = file.at(file.model().accessors, entry->second, "accessor").count;
    if (count != vertexCount)
        file.fail("{}: its {} has {} elements for {} positions; export the mesh anew", what, name, count, vertexCount);
    const AccessorValues values = readAccessor(file, entry->second, 3, 3, name);
    file.reserve(count, sizeof(glm::vec3));
    std::vector<glm::vec3> offsets(count);
    for (size_t i = 0; i < count; ++i)
        for (uint32_t c = 0; c < 3; ++c) {
            offsets[i][int(c)] = values.get(i, c);
            if (!std::isfinite(offsets[i][int(c)])) file.fail("{}: {} {} is not finite", what, name, i);
        }
    return offsets;
}

}  // namespace

void readMorphTargets(GltfFile& file, const tinygltf::Primitive& primitive, const FixedWeights& weights, Mesh& mesh,
                      const std::string& what) {
    if (weights && std::ranges::all_of(*weights, [](float weight) { return weight == 0; })) return;
    const size_t count = mesh.positions.size();
    for (size_t t = 0; t < primitive.targets.size(); ++t) {
        const std::string name = fmt::format("{}, morph target {}", what, t);
        MorphTarget& target = mesh.morph.targets.emplace_back();
        if (weights && (*weights)[t] == 0) continue;
        for (const auto& [attribute, accessor] : primitive.targets[t])
            if (attribute != "POSITION" && attribute != "NORMAL" && attribute != "TANGENT")
                file.warn("{}: {} is left out; only POSITION, NORMAL and TANGENT are morphed", name,
                          shortLine(attribute));
        const auto read = [&](const char* attribute, bool isInMesh) {
            return readOffsets(file, primitive.targets[t], attribute, isInMesh, count, name);
        };
        target.positions = read("POSITION", true);
        target.normals = read("NORMAL", !mesh.normals.empty());
        target.tangents = read("TANGENT", !mesh.tangents.empty());
    }
    mesh.morph.hasFlatNormals = mesh.normals.empty();
}

void applyMorphTargets(const std::vector<float>& weights, Mesh& mesh) {
    if (mesh.morph.targets.empty()) return;
    MorphedShape shape = morphed(mesh, weights);
    mesh.positions = std::move(shape.positions);
    mesh.normals = std::move(shape.normals);
    mesh.tangents = std::move(shape.tangents);
    mesh.morph = {};
}

MorphReader::MorphReader(GltfFile& file, Scene& scene) : file_(file), scene_(scene) {
    const tinygltf::Model& model = file.model();
    for (size_t a = 0; a < model.animations.size(); ++a) {
        const tinygltf::Animation& animation = model.animations[a];
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            if (channel.target_node < 0 || channel.target_path != "weights") continue;
            const std::string what = fmt::format("animation {} '{}'", a, shortLine(animation.name));
            const int mesh = file.at(model.nodes, channel.target_node, "node").mesh;
            if (mesh < 0 || targetCount(mesh) == 0) {
                file.warn("{}: weights of node {} are left out, because it has no mesh with morph targets", what,
                          channel.target_node);
                continue;
            }
            const Source source{&file.at(animation.samplers, channel.sampler, "animation sampler"), what};
            if (!sources_.try_emplace(channel.target_node, source).second)
                file.warn("{}: weights of node {} are animated twice; the first counts", what, channel.target_node);
        }
    }
}

size_t MorphReader::targetCount(int mesh) const {
    const tinygltf::Mesh& source = file_.at(file_.model().meshes, mesh, "mesh");
    if (source.primitives.empty()) return 0;
    const size_t count = source.primitives[0].targets.size();
    for (const tinygltf::Primitive& primitive : source.primitives)
        if (primitive.targets.size() != count)
            file_.fail("mesh {} '{}': its primitives have {} and {} morph targets; give each as many", mesh,
                       shortLine(source.name), count, primitive.targets.size());
    return count;
}

FixedWeights MorphReader::weights(int node) {
    const tinygltf::Node& source = file_.at(file_.model().nodes, node, "node");
    if (sources_.contains(node)) return std::nullopt;
    const tinygltf::Mesh& mesh = file_.at(file_.model().meshes, source.mesh, "mesh");
    const size_t count = targetCount(source.mesh);
    const std::vector<double>& given = source.weights.empty() ? mesh.weights : source.weights;
    const std::string what = source.weights.empty() ? fmt::format("mesh {} '{}'", source.mesh, shortLine(mesh.name))
                                                    : fmt::format("node {} '{}'", node, shortLine(source.name));
    if (!given.empty() && given.size() != count)
        file_.fail("{}: {} weights for {} morph targets; give one for each, or leave 'weights' out", what, given.size(),
                   count);
    std::vector<float> weights(count);
    for (size_t t = 0; t < given.size(); ++t)
        weights[t] = checkedFloat(file_, given[t], -maxNumber, maxNumber, what + ": weight of a morph target");
    return weights;
}

int32_t MorphReader::channel(int node) {
    const auto found = sources_.find(node);
    if (found == sources_.end()) return -1;
    const auto& [sampler, what] = found->second;
    const size_t count = targetCount(file_.model().nodes[size_t(node)].mesh);
    AnimationKeys keys = readKeys(file_, *sampler, 1, count, what);
    scene_.morphs.push_back({.interpolation = keys.interpolation,
                             .targetCount = uint32_t(count),
                             .timesSeconds = std::move(keys.timesSeconds),
                             .values = std::move(keys.values.data)});
    return int32_t(scene_.morphs.size() - 1);
}

}  // namespace voxray
