#include "scene/compose.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/content_hash.h"
#include "scene/material_change.h"
#include "scene/shapes.h"
#include "scene/subdivide.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

/// A quad on no node, a sphere on a moving node, a light of each kind of placement, a textured material.
std::shared_ptr<const Scene> clock() {
    SceneBuilder b("clock");
    Material painted;
    painted.name = "painted";
    painted.baseColorTexture.texture = 0;
    painted.normalTexture.texture = 1;
    const uint32_t brass = b.lambert("brass", glm::vec3(0.5f));
    b.quad("face", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, b.material(painted));
    Scene& scene = b.scene();
    scene.textures.resize(2);
    scene.textures[0].name = "dial";
    scene.textures[1].name = "bumps";
    scene.nodes.resize(2);
    scene.nodes[1].parent = 0;
    b.place(b.mesh(sphereMesh("bob", {0, -1, 0}, 0.2f, 1, brass, false, true)), 1);
    scene.animation = {{1, AnimatedProperty::Translation, Interpolation::Linear, {0, 1, 2}, {{}, {1, 0, 0, 0}, {}}}};
    b.spotLight({0, 2, 0}, {0, -1, 0}, 10, 20, glm::vec3(3));
    b.pointLight({9, 9, 9}, glm::vec3(1));
    scene.lights[1].node = 1;
    b.camera({0, 0, 5}, {0, 0, 0}, 50);
    return b.finish();
}

const Placement kPlacement{{3, 1, -2}, {90, 20, 135}, {2, -0.5f, 1}};

/// Scale, then rotations about X, Y, Z, then the translation: as matrices, independently of quaternions.
glm::mat4 matrixOf(const Placement& placement) {
    glm::mat4 matrix = glm::translate(glm::mat4(1), placement.translate);
    for (int axis = 2; axis >= 0; --axis) {
        glm::vec3 direction(0);
        direction[axis] = 1;
        matrix = glm::rotate(matrix, glm::radians(placement.rotateDegrees[axis]), direction);
    }
    return glm::scale(matrix, placement.scale);
}

glm::vec3 transformed(const glm::mat4& matrix, const glm::vec3& point) {
    return glm::vec3(matrix * glm::vec4(point, 1));
}

TEST(Compose, GeometryIsTheSumOfTheParts) {
    const auto base = makeBuiltinScene("cornell", {});
    auto composed = std::make_shared<Scene>(*base);
    addScene(*composed, *clock(), kPlacement, "clock");
    addScene(*composed, *clock(), {}, "second");
    for (const double time : {0.0, 0.7}) {
        const SceneState whole = evaluate(composed, time), first = evaluate(base, time);
        const SceneState added = evaluate(clock(), time);
        const Geometry &g = whole.geometry, &a = first.geometry, &b = added.geometry;
        ASSERT_EQ(g.triangles.size(), a.triangles.size() + 2 * b.triangles.size());
        ASSERT_EQ(g.positions.size(), a.positions.size() + 2 * b.positions.size());
        for (size_t i = 0; i < a.positions.size(); ++i) EXPECT_EQ(g.positions[i], a.positions[i]);
        for (size_t i = 0; i < b.positions.size(); ++i) {
            const glm::vec3 once = g.positions[a.positions.size() + i];
            expectNear(once, transformed(matrixOf(kPlacement), b.positions[i]), 2e-6f);
            EXPECT_EQ(g.positions[a.positions.size() + b.positions.size() + i], b.positions[i]);
        }
        for (size_t i = 0; i < g.triangles.size(); ++i) {
            const bool isAdded = i >= a.triangles.size();
            const Material& material = composed->materials[g.triangleMaterials[i]];
            const uint32_t own =
                isAdded ? b.triangleMaterials[(i - a.triangles.size()) % b.triangles.size()] : a.triangleMaterials[i];
            EXPECT_EQ(material.name, (isAdded ? added : first).scene->materials[own].name);
        }
    }
}

TEST(Compose, TexturesLightsAndAnimationFollow) {
    Scene composed = *clock();
    addScene(composed, *clock(), kPlacement, "clock");
    ASSERT_EQ(composed.materials.size(), 4u);
    const Material& painted = composed.materials[composed.meshes[2].material];
    EXPECT_EQ(composed.textures[size_t(painted.baseColorTexture.texture)].name, "dial");
    EXPECT_EQ(painted.baseColorTexture.texture, 2);
    EXPECT_EQ(painted.normalTexture.texture, 3);
    EXPECT_EQ(painted.emissiveTexture.texture, -1);

    // Cameras of what is added stay away
    ASSERT_EQ(composed.lights.size(), 4u);
    EXPECT_EQ(composed.cameras.size(), 1u);
    const SceneState state = evaluate(std::make_shared<Scene>(composed), 0.7);
    const glm::mat4 matrix = matrixOf(kPlacement);
    expectNear(state.lights[2].position, transformed(matrix, {0, 2, 0}), 2e-6f);
    expectNear(state.lights[2].direction, glm::normalize(glm::mat3(matrix) * glm::vec3(0, -1, 0)), 2e-6f);
    EXPECT_EQ(state.lights[2].intensity, glm::vec3(3));
    expectNear(state.lights[3].position, transformed(matrix, {0.7f, 0, 0}), 2e-6f);

    // One of two animations that loop together moves each
    const SceneState moving = evaluate(std::make_shared<Scene>(composed), 0.7, Playback::Looping);
    EXPECT_FALSE(moving.geometry.instances[2].moves);
    EXPECT_TRUE(moving.geometry.instances[3].moves);
}

TEST(Compose, APlacedSceneTakesItsLightsAndCamerasAlong) {
    auto before = std::make_shared<Scene>(*clock());
    Camera onNode;
    onNode.name = "on the bob";
    onNode.node = 1;
    before->cameras.push_back(onNode);
    before->environment.radiance = glm::vec3(2);
    const Placement placement{{3, 1, -2}, {0, 90, 17}, glm::vec3(2)};
    const SceneState was = evaluate(before, 0.7);
    const SceneState is = evaluate(std::make_shared<Scene>(placedScene(*before, placement)), 0.7);
    const glm::mat4 matrix = matrixOf(placement);
    const auto rotated = [&](const glm::vec3& v) { return glm::normalize(glm::mat3(matrix) * v); };
    ASSERT_EQ(is.geometry.positions.size(), was.geometry.positions.size());
    for (size_t i = 0; i < was.geometry.positions.size(); ++i)
        expectNear(is.geometry.positions[i], transformed(matrix, was.geometry.positions[i]), 4e-6f);
    EXPECT_EQ(is.geometry.triangleMaterials, was.geometry.triangleMaterials);
    ASSERT_EQ(is.lights.size(), was.lights.size());
    for (size_t i = 0; i < was.lights.size(); ++i) {
        expectNear(is.lights[i].position, transformed(matrix, was.lights[i].position), 4e-6f);
        if (was.lights[i].type != LightType::Point)
            expectNear(is.lights[i].direction, rotated(was.lights[i].direction), 2e-6f);
        EXPECT_EQ(is.lights[i].intensity, was.lights[i].intensity);
    }
    ASSERT_EQ(is.cameras.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        expectNear(is.cameras[i].position, transformed(matrix, was.cameras[i].position), 4e-6f);
        expectNear(is.cameras[i].forward, rotated(was.cameras[i].forward), 2e-6f);
        expectNear(is.cameras[i].up, rotated(was.cameras[i].up), 2e-6f);
        EXPECT_EQ(is.cameras[i].verticalFovRadians, was.cameras[i].verticalFovRadians);
    }
    EXPECT_EQ(is.scene->environment.radiance, glm::vec3(2));
}

TEST(Compose, OneMaterialStandsInForAll) {
    Scene composed = *makeBuiltinScene("cornell", {});
    const size_t materials = composed.materials.size();
    const Material gold = makeMaterial("gold", {.baseColor = {1, 0.8f, 0.3f}, .metallic = 1, .roughness = 0.25f});
    addScene(composed, *clock(), {}, "clock", &gold);
    ASSERT_EQ(composed.materials.size(), materials + 1);
    EXPECT_TRUE(composed.textures.empty());
    const Material& made = composed.materials.back();
    EXPECT_EQ(made.name, "gold");
    EXPECT_EQ(made.baseColor, glm::vec4(1, 0.8f, 0.3f, 1));
    EXPECT_EQ(made.metallic, 1);
    EXPECT_EQ(made.roughness, 0.25f);
    EXPECT_EQ(made.emission, glm::vec3(0));
    for (size_t i = composed.instances.size() - 2; i < composed.instances.size(); ++i)
        EXPECT_EQ(composed.meshes[composed.instances[i].mesh].material, materials);
}

TEST(Compose, ContentTellsPlacesAndMaterialsApart) {
    const auto hashOf = [](const Placement& placement, const Material* material) {
        Scene composed = *makeBuiltinScene("cornell", {});
        addScene(composed, *clock(), placement, "clock", material);
        return hashScene(composed);
    };
    const Material white = makeMaterial("white", {}), black = makeMaterial("white", {.baseColor = glm::vec3(0)});
    EXPECT_EQ(hashOf({}, &white), hashOf({}, &white));
    EXPECT_NE(hashOf({}, &white), hashOf(kPlacement, &white));
    EXPECT_NE(hashOf({}, &white), hashOf({}, &black));
    EXPECT_NE(hashOf({}, &white), hashOf({}, nullptr));
}

TEST(MaterialChange, ReplacesWhatIsGivenAndTheTexturesThatWouldMultiplyIt) {
    Material before;
    before.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
    before.alphaMode = AlphaMode::Mask;
    for (TextureRef* ref :
         {&before.baseColorTexture, &before.metallicRoughnessTexture, &before.normalTexture, &before.emissiveTexture})
        ref->texture = 7;
    const auto changed = [&](const MaterialSettings& settings, const std::vector<std::string>& keys) {
        Material material = before;
        changeMaterial(material, {settings, keys});
        return material;
    };

    const Material mirror = changed({.metallic = 1, .roughness = 0}, {"metallic", "roughness"});
    EXPECT_EQ(mirror.metallic, 1);
    EXPECT_EQ(mirror.roughness, 0);
    EXPECT_EQ(mirror.metallicRoughnessTexture.texture, -1);
    EXPECT_EQ(mirror.baseColor, before.baseColor);
    EXPECT_EQ(mirror.baseColorTexture.texture, 7);
    EXPECT_EQ(mirror.normalTexture.texture, 7);
    EXPECT_EQ(mirror.alphaMode, AlphaMode::Mask);

    const Material lamp = changed({.baseColor = glm::vec3(0), .emission = glm::vec3(5)}, {"base_color", "emission"});
    EXPECT_EQ(lamp.baseColor, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(lamp.emission, glm::vec3(5));
    EXPECT_EQ(lamp.baseColorTexture.texture, -1);
    EXPECT_EQ(lamp.emissiveTexture.texture, -1);
    EXPECT_EQ(lamp.metallicRoughnessTexture.texture, 7);
    EXPECT_EQ(lamp.alphaMode, AlphaMode::Opaque);

    // Every setting of the schema does something
    for (const std::string& key : fieldNames<MaterialSettings>()) {
        const MaterialSettings other{glm::vec3(0.5f), 0.5f, 0.5f, 0.5f, glm::vec3(0.5f), 0.5f, true};
        Scene one, two;
        one.materials = {before};
        two.materials = {changed(other, {key})};
        EXPECT_NE(hashScene(one), hashScene(two)) << key;
    }
}

TEST(Subdivide, KeepsSurfacesOfMoreTriangles) {
    const Scene before = *clock();
    Scene after = before;
    subdivide(after, 2);
    for (size_t i = 0; i < before.meshes.size(); ++i) {
        const Mesh &a = before.meshes[i], &b = after.meshes[i];
        EXPECT_EQ(b.triangles.size(), 16 * a.triangles.size());
        EXPECT_EQ(b.normals.size(), b.positions.size());
        const auto area = [](const Mesh& mesh) {
            double sum = 0;
            for (const glm::uvec3 t : mesh.triangles)
                sum += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                    mesh.positions[t.z] - mesh.positions[t.x]));
            return sum;
        };
        EXPECT_NEAR(area(b), area(a), 1e-5 * area(a));
    }
    // Midpoints are those of both triangles at an edge: far fewer than three for each triangle.
    const Mesh &a = before.meshes[1], &b = after.meshes[1];
    EXPECT_LT(b.positions.size(), 16 * a.positions.size() + 1);
    for (const glm::vec3& n : b.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
    EXPECT_ERROR("subdivide less", subdivide(after, 14));
}

}  // namespace
}  // namespace voxray::test
