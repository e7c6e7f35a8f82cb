#pragma once

// Differences between Embree 3 and Embree 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "trace/ray.h"

namespace voxray {

/// Ray queries of one thread: closest hit and occlusion, of single rays or packets of sixteen (active: -1).
class EmbreeQuery {
 public:
    explicit EmbreeQuery(Coherence coherence);
    EmbreeQuery(const EmbreeQuery&) = delete;
    EmbreeQuery& operator=(const EmbreeQuery&) = delete;

    void intersect(RTCScene scene, RTCRayHit& ray);
    void intersect(const int* active, RTCScene scene, RTCRayHit16& rays);
    void occluded(RTCScene scene, RTCRay& ray);
    void occluded(const int* active, RTCScene scene, RTCRay16& rays);

 private:
#if RTC_VERSION_MAJOR >= 4
    RTCRayQueryContext context_;
    RTCIntersectArguments intersect_;
    RTCOccludedArguments occluded_;
#else
    RTCIntersectContext context_;
#endif
};

#if RTC_VERSION_MAJOR >= 4

inline EmbreeQuery::EmbreeQuery(Coherence coherence) {
    rtcInitRayQueryContext(&context_);
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.context = occluded_.context = &context_;
    if (coherence == Coherence::Coherent) intersect_.flags = occluded_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
}

inline void EmbreeQuery::intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &intersect_);
}

inline void EmbreeQuery::intersect(const int* active, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(active, scene, &rays, &intersect_);
}

inline void EmbreeQuery::occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &occluded_);
}

inline void EmbreeQuery::occluded(const int* active, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(active, scene, &rays, &occluded_);
}

#else

inline EmbreeQuery::EmbreeQuery(Coherence coherence) {
    rtcInitIntersectContext(&context_);
    if (coherence == Coherence::Coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

inline void EmbreeQuery::intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &context_, &ray);
}

inline void EmbreeQuery::intersect(const int* active, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(active, scene, &context_, &rays);
}

inline void EmbreeQuery::occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &context_, &ray);
}

inline void EmbreeQuery::occluded(const int* active, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(active, scene, &context_, &rays);
}

#endif

}  // namespace voxray
