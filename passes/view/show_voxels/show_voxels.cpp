#include <array>
#include <optional>
#include <utility>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/voxel_march/voxel_march.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/view/camera_view.h"
#include "passes/view/show_voxels/lit_faces.h"

namespace voxray {

enum class ShownValue { Albedo, Irradiance, Opacity, Normal, LitFaces, Radiance, RadianceOpacity };

template <>
struct EnumNames<ShownValue> {
    static constexpr std::array names{std::pair{ShownValue::Albedo, "albedo"},
                                      std::pair{ShownValue::Irradiance, "irradiance"},
                                      std::pair{ShownValue::Opacity, "opacity"},
                                      std::pair{ShownValue::Normal, "normal"},
                                      std::pair{ShownValue::LitFaces, "lit_faces"},
                                      std::pair{ShownValue::Radiance, "radiance"},
                                      std::pair{ShownValue::RadianceOpacity, "radiance_opacity"}};
};

/// Renders voxels as cubes, to inspect what other passes read.
class ShowVoxels final : public Pass {
 public:
    static constexpr const char* kName = "show_voxels";
    static constexpr const char* kHelp =
        "Draws voxels as cubes, each in the color of its value. "
        "A pixel shows the first voxel on the ray through its center, without antialiasing: a surface voxel, "
        "or a radiance voxel of some level. For inspection, not for scores. Exact, no noise of its own.";
    struct Params {
        ShownValue show = ShownValue::Albedo;
        uint32_t redAt = 225;
        uint32_t level = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("show", &Params::show,
                      "Of surface voxels. albedo: diffuse reflectance. irradiance: of the visible face, "
                      "as the radiance of a white surface (over pi); magenta where the injection gives no value. "
                      "opacity: 0 to 1. normal: components from -1 to 1 as 0 to 1. "
                      "lit_faces: the number of lit voxel faces in the face's visibility list (cluster_visibility), "
                      "from green for none to red for red_at; "
                      "every lit face of a listed cluster component counts (Cosin and Patow 2022, figure 13); "
                      "magenta where no surfel faces that way. Of radiance voxels, which cones read. "
                      "radiance: what leaves through the visible face. "
                      "radiance_opacity: the fraction of a beam that is blocked there."),
                field("red_at", &Params::redAt, "Number of lit faces from which on a face is shown red.", 1u, 1u << 24)
                    .onlyWith(oneOf(&Params::show, {ShownValue::LitFaces})),
                field("level", &Params::level,
                      "Level of radiance voxels; each level's voxels are twice as wide as those of the level below.",
                      0u, 15u)
                    .onlyWith(oneOf(&Params::show, {ShownValue::Radiance, ShownValue::RadianceOpacity}))};
        }
    };

    explicit ShowVoxels(const Params& params);
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool showsLight() const { return params_.show == ShownValue::Irradiance; }
    bool showsLitFaces() const { return params_.show == ShownValue::LitFaces; }
    bool showsLevel() const {
        return params_.show == ShownValue::Radiance || params_.show == ShownValue::RadianceOpacity;
    }
    /// Brings the values that are shown up to date. @return their binding.
    Binding updateValues(PassContext& context);
    void recordLevel(PassContext& context);

    const Params params_;
    In<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales", showsLevel()};
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels", !showsLevel()};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces", showsLight()};
    In<VoxelPatches> patches_{*this, "patches", "surface groups and patches of voxels", showsLitFaces()};
    In<ClusterVisibility> visibility_{*this, "cluster_visibility", "what each patch sees", showsLitFaces()};
    In<ClusterLight> clusterLight_{*this, "cluster_light", "which patches are lit", showsLitFaces()};
    Out<FrameImage> final_{*this, "final", "voxels, as cubes"};
    Kernel program_{*this, showsLevel() ? "show_levels.comp" : "show_voxels.comp"};
    std::optional<VoxelMarch> march_;      ///< Of surface voxels.
    std::optional<FaceIrradiance> faces_;  ///< With ShownValue::Irradiance.
    std::optional<LitFaces> litFaces_;     ///< With ShownValue::LitFaces.
};

ShowVoxels::ShowVoxels(const Params& params) : params_(params) {
    if (!showsLevel()) march_.emplace(*this, VoxelTraversal::Bricks);
    if (showsLight()) faces_.emplace(*this);
    if (showsLitFaces()) litFaces_.emplace(*this);
}

void ShowVoxels::plan(PassPlan& plan) {
    plan.frameImage(final_);
    if (showsLevel()) {
        const RadianceVoxels& radiance = plan[radiance_];
        if (params_.level >= radiance.grid.levels)
            throw Error("show_voxels.level: there is no level {}; the radiance voxels have 0 to {}", params_.level,
                        radiance.grid.levels - 1);
        program_.define(radiance.defines());
        return;
    }
    const SurfaceVoxels& voxels = plan[voxels_];
    march_->plan(plan, voxels);
    Defines defines = march_->defines();
    if (showsLight()) defines.emplace("SHOW_IRRADIANCE", "1");
    if (showsLitFaces()) defines.emplace("SHOW_LIT_FACES", "1");
    program_.define(defines);
}

void ShowVoxels::record(PassContext& context) {
    if (showsLevel()) return recordLevel(context);
    const SurfaceVoxels& voxels = context[voxels_];
    march_->begin(context.stream, voxels);
    const Binding values = updateValues(context);
    context.dispatch(program_, context.frame.pixels(),
                     {*march_,
                      values,
                      {"result", context[final_].image},
                      {"grid", voxels.grid},
                      {"view", cameraView(context.frame, context.frame.pixels())},
                      {"show", params_.show},
                      {"redAt", params_.redAt}});
    context.marchCounters.push_back(&march_->counts());
}

Binding ShowVoxels::updateValues(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    if (showsLight()) {
        const VoxelIrradiance& light = context[irradiance_];
        if (context.changed(voxels_) || context.changed(irradiance_))
            faces_->update(context.stream, voxels, light.area, light.indirect, &light.direct);
        return faces_->binding();
    }
    if (showsLitFaces()) {
        if (context.changed(visibility_) || context.changed(clusterLight_))
            litFaces_->count(context.stream, voxels.voxelCount, context[patches_], context[visibility_],
                             context[clusterLight_]);
        return {"visibleLitPatches", litFaces_->visibleLitPatches()};
    }
    return {"VoxelMaterialsRef", voxels.materials.ref()};
}

void ShowVoxels::recordLevel(PassContext& context) {
    context.dispatch(program_, context.frame.pixels(),
                     {context[radiance_],
                      {"result", context[final_].image},
                      {"view", cameraView(context.frame, context.frame.pixels())},
                      {"level", params_.level},
                      {"showsOpacity", params_.show == ShownValue::RadianceOpacity}});
}

VOXRAY_REGISTER_PASS(ShowVoxels);

}  // namespace voxray
