#include "scene/gltf_skin.h"

#include "scene/gltf_accessor.h"
#include "scene/gltf_values.h"

namespace voxray {
namespace {

/// Normalizes weights to sum to 1 at each vertex. @return vertices without weights
size_t normalizeWeights(std::vector<SkinWeights>& sets, size_t vertexCount) {
    size_t without = 0;
    for (size_t v = 0; v < vertexCount; ++v) {
        float sum = 0;
        for (SkinWeights& set : sets)
            for (int i = 0; i < 4; ++i) {
                float& weight = set.weights[v][i];
                if (!(weight > 0 && weight <= float(maxNumber))) weight = 0;
                sum += weight;
            }
        if (sum == 0) {
            ++without;
            sets[0].weights[v].x = sum = 1;
        }
        for (SkinWeights& set : sets) set.weights[v] /= sum;
    }
    return without;
}

}  // namespace

void readSkinWeights(GltfFile& file, const tinygltf::Primitive& primitive, Mesh& mesh, const std::string& what) {
    const size_t count = mesh.positions.size();
    for (int set = 0;; ++set) {
        const auto joints = primitive.attributes.find(fmt::format("JOINTS_{}", set));
        const auto weights = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
        if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) break;
        const AccessorValues jointValues = readAccessor(file, joints->second, 4, 4, "JOINTS");
        const bool fractions =
            file.at(file.model().accessors, weights->second, "accessor").componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
        const AccessorValues weightValues = readAccessor(file, weights->second, 4, 4, "WEIGHTS", fractions);
        if (jointValues.count != count || weightValues.count != count)
            file.fail("{}: {} JOINTS and {} WEIGHTS for {} positions", what, jointValues.count, weightValues.count,
                      count);
        file.reserve(count, sizeof(glm::uvec4) + sizeof(glm::vec4));
        SkinWeights& out = mesh.skinWeights.emplace_back();
        out.joints.resize(count);
        out.weights.resize(count);
        for (size_t v = 0; v < count; ++v)
            for (uint32_t i = 0; i < 4; ++i) {
                const float number = jointValues.get(v, i);
                if (!(number >= 0 && number <= 65535))
                    file.fail("{}: joint {} is not a number from 0 to 65535", what, number);
                out.joints[v][int(i)] = uint32_t(number);
                out.weights[v][int(i)] = weightValues.get(v, i);
            }
    }
    if (mesh.skinWeights.empty()) return;
    if (const size_t without = normalizeWeights(mesh.skinWeights, count); without > 0)
        file.warn("{}: {} vertices have no WEIGHTS; their first joint carries them", what, without);
}

SkinReader::SkinReader(GltfFile& file, const std::vector<int>& fileNodes, Scene& scene)
    : file_(file), scene_(scene), sceneNodes_(file.model().nodes.size(), -1) {
    for (size_t i = 0; i < fileNodes.size(); ++i) sceneNodes_[size_t(fileNodes[i])] = int32_t(i);
}

int32_t SkinReader::skin(int index) {
    if (const auto known = skins_.find(index); known != skins_.end()) return known->second;
    const tinygltf::Skin& source = file_.at(file_.model().skins, index, "skin");
    const std::string what = fmt::format("skin {} '{}'", index, shortLine(source.name));
    if (source.joints.empty()) file_.fail("{}: it has no joints", what);
    Skin skin;
    for (const int joint : source.joints) {
        const int32_t node = file_.at(sceneNodes_, joint, "node");
        if (node < 0) {
            file_.warn("{}: joint node {} is not in the scene; meshes are placed by their nodes", what, joint);
            return skins_[index] = -1;
        }
        skin.joints.push_back(uint32_t(node));
    }
    skin.inverseBindMatrices.assign(skin.joints.size(), glm::mat4(1.0f));
    if (source.inverseBindMatrices >= 0) {
        const AccessorValues matrices = readAccessor(file_, source.inverseBindMatrices, 16, 16, "inverseBindMatrices");
        if (matrices.count < skin.joints.size())
            file_.fail("{}: {} inverseBindMatrices for {} joints", what, matrices.count, skin.joints.size());
        for (size_t j = 0; j < skin.joints.size(); ++j)
            for (uint32_t i = 0; i < 16; ++i)
                skin.inverseBindMatrices[j][int(i / 4)][int(i % 4)] = checkedFloat(
                    file_, double(matrices.get(j, i)), -maxNumber, maxNumber, what + ": inverseBindMatrices");
    }
    scene_.skins.push_back(std::move(skin));
    return skins_[index] = int32_t(scene_.skins.size() - 1);
}

void SkinReader::check(const Mesh& mesh, int32_t skin, const std::string& what) const {
    const size_t count = scene_.skins[size_t(skin)].joints.size();
    for (const SkinWeights& set : mesh.skinWeights)
        for (size_t v = 0; v < set.joints.size(); ++v)
            for (int i = 0; i < 4; ++i)
                if (set.weights[v][i] > 0 && set.joints[v][i] >= count)
                    file_.fail("{}: mesh '{}' has joint {}, its skin has {}", what, mesh.name, set.joints[v][i], count);
}

}  // namespace voxray
