#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "scene/builtin.h"
#include "scene/shapes.h"
#include "scene/uniform_random.h"

namespace voxray {
namespace {

struct Clutter {
    static constexpr const char* name = "clutter";
    uint32_t count = 18;
    float thickness = 0.02f;
    uint32_t seed = 1;
    static constexpr auto schema() {
        return std::tuple{
            field("count", &Clutter::count, "Number of tables, chairs and shelves in the room.", 0u, 30u),
            field("thickness", &Clutter::thickness, "Thickness of their boards and legs, m.", 0.001f, 0.1f),
            field("seed", &Clutter::seed, "Seed of their kinds, positions, sizes and colours.")};
    }
};

/// Furniture of boards and legs of equal thickness round a point of the floor, rotated about +Y.
class Furniture {
 public:
    Furniture(SceneBuilder& builder, const glm::vec3& origin, float angleRadians, float thickness, uint32_t material)
        : builder_(builder), origin_(origin), angle_(angleRadians), t_(thickness), material_(material) {}

    void table(const glm::vec3& size) {
        addBox({0, size.y - t_, 0}, {size.x, t_, size.z});
        legs(size, size.y - t_);
    }

    /// A seat at half of the height; three bars at its back.
    void chair(const glm::vec3& size) {
        const float seat = 0.5f * size.y, back = 0.5f * (size.z - t_);
        addBox({0, seat, 0}, {size.x, t_, size.z});
        legs(size, seat);
        for (const float side : {-0.5f, 0.5f})
            addBox({side * (size.x - t_), seat + t_, -back}, {t_, size.y - seat - t_, t_});
        for (const float height : {0.25f, 0.5f, 0.75f})
            addBox({0, glm::mix(seat, size.y, height), -back}, {size.x - 2 * t_, t_, t_});
    }

    /// Boards between two sides, open at front and back.
    void shelf(const glm::vec3& size, uint32_t boards) {
        for (const float side : {-0.5f, 0.5f}) addBox({side * (size.x - t_), 0, 0}, {t_, size.y, size.z});
        for (uint32_t i = 0; i < boards; ++i) {
            const float height = (size.y - t_) * float(i + 1) / float(boards);
            addBox({0, height, 0}, {size.x - 2 * t_, t_, size.z});
        }
    }

 private:
    void legs(const glm::vec3& size, float height) {
        for (const float x : {-0.5f, 0.5f})
            for (const float z : {-0.5f, 0.5f}) addBox({x * (size.x - t_), 0, z * (size.z - t_)}, {t_, height, t_});
    }

    /// A box on `base`, in the furniture's space.
    void addBox(const glm::vec3& base, const glm::vec3& size) {
        const float c = std::cos(angle_), s = std::sin(angle_);
        const glm::vec3 rotated(c * base.x + s * base.z, base.y, c * base.z - s * base.x);
        builder_.box("furniture", origin_ + rotated, size, angle_, material_);
    }

    SceneBuilder& builder_;
    glm::vec3 origin_;
    float angle_;
    float t_;
    uint32_t material_;
};

/// A closed room of 6 m x 2.8 m x 5 m, furniture at random in cells of 1 m, and a point light below the
/// ceiling.
std::shared_ptr<const Scene> make(const Clutter& params) {
    SceneBuilder b(Clutter::name);
    const uint32_t white = b.lambert("white", glm::vec3(0.75f));
    const uint32_t wood = b.lambert("wood", {0.5f, 0.33f, 0.2f});
    b.room({-3, 0, -2.5f}, {3, 2.8f, 2.5f}, {white, white, wood, white, white, white});

    // One cell per piece of furniture.
    constexpr uint32_t columns = 6, rows = 5;
    UniformRandom uniform(params.seed);
    std::array<uint32_t, columns * rows> cells;
    for (uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;
    for (uint32_t i = uint32_t(cells.size()) - 1; i > 0; --i) std::swap(cells[i], cells[uniform.below(i + 1)]);

    for (uint32_t i = 0; i < params.count; ++i) {
        const glm::vec2 cell(cells[i] % columns, cells[i] / columns);
        const glm::vec3 origin(cell.x - 2.5f, 0, cell.y - 2.0f);
        const float angle = uniform(0, 6.2831853f);
        const glm::vec3 albedo{uniform(0.1f, 0.8f), uniform(0.1f, 0.8f), uniform(0.1f, 0.8f)};
        Furniture furniture(b, origin, angle, params.thickness, b.lambert("furniture", albedo));
        switch (uniform.below(3)) {
            case 0:
                furniture.table({uniform(0.5f, 0.8f), uniform(0.4f, 0.75f), uniform(0.4f, 0.5f)});
                break;
            case 1:
                furniture.chair({0.42f, uniform(0.8f, 1.0f), 0.42f});
                break;
            default:
                const uint32_t boards = 3 + uniform.below(3);
                furniture.shelf({uniform(0.5f, 0.8f), uniform(0.8f, 1.5f), 0.3f}, boards);
        }
    }
    b.pointLight({0, 2.5f, 0}, glm::vec3(8.0f));
    b.camera({-2.8f, 2.4f, 2.3f}, {0.4f, 0.4f, -0.8f}, 65);
    return b.finish();
}

}  // namespace

std::vector<BuiltinScene> clutterScenes() {
    return {builtinScene<Clutter>()};
}

}  // namespace voxray
