#include "passes/final_gather/stored_light/stored_light.h"

namespace voxray {

StoredLight::StoredLight(Pass& pass, const StoredLightParams& params)
    : source_(params.source),
      readsVoxelDirect_(params.directAtHits == DirectAtHits::Voxels),
      minSamples_(params.minSamples),
      voxels_(pass, "voxels", "surface voxels", source_ == GatherSource::Voxels || source_ == GatherSource::HitFaces),
      irradiance_(pass, "irradiance", "light that arrives at the voxels' surfaces", source_ == GatherSource::Voxels),
      tree_(pass, "irradiance_tree", "light of merged voxels", source_ == GatherSource::MergedVoxels),
      cache_(pass, "radiance_cache", "light that arrives at surfaces, by hashed cells",
             source_ == GatherSource::RadianceCache),
      hitFaces_(pass, "hit_face_light", "light of the faces that rays hit", source_ == GatherSource::HitFaces) {
    if (source_ == GatherSource::Voxels) faces_.emplace(pass);
}

bool StoredLight::holdsDirect(const PassPlan& plan) const {
    if (source_ == GatherSource::MergedVoxels) return plan[tree_].holdsDirect;
    return source_ != GatherSource::Voxels || readsVoxelDirect_;
}

std::optional<uint32_t> StoredLight::bounces(const PassPlan& plan) const {
    if (source_ == GatherSource::MergedVoxels) return plan[tree_].lightBounces;
    if (source_ == GatherSource::RadianceCache) return plan[cache_].lightBounces;
    if (source_ == GatherSource::HitFaces) return plan[hitFaces_].lightBounces;
    return plan[irradiance_].lightBounces;
}

Defines StoredLight::defines() const {
    if (source_ == GatherSource::MergedVoxels) return {{"STORED_IN_MERGED_VOXELS", "1"}};
    if (source_ == GatherSource::RadianceCache)
        return {{"STORED_IN_RADIANCE_CACHE", "1"}, {"MIN_SAMPLES", std::to_string(minSamples_)}};
    if (source_ == GatherSource::HitFaces) return {{"STORED_IN_HIT_FACES", "1"}};
    return {{"STORED_IN_VOXELS", "1"}};
}

const char* StoredLight::unlitName() const {
    return source_ == GatherSource::RadianceCache ? "hits without a cell, % of rays" : "hits on unlit faces, % of rays";
}

std::vector<Binding> StoredLight::update(PassContext& context) {
    if (source_ == GatherSource::MergedVoxels) return context[tree_].bindings();
    if (source_ == GatherSource::RadianceCache) return context[cache_].bindings();
    if (source_ == GatherSource::HitFaces) return context[voxels_].bindings(context[hitFaces_].bindings());

    const VoxelLevels& voxels = context[voxels_];
    if (context.changed(voxels_) || context.changed(irradiance_)) {
        const VoxelIrradiance& light = context[irradiance_];
        faces_->update(context.stream, voxels, light.area, light.indirect, readsVoxelDirect_ ? &light.direct : nullptr);
    }
    return voxels.bindings({faces_->binding()});
}

}  // namespace voxray
