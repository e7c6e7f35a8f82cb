// The length of a stream of rays that the device counts, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_STREAM_COUNT_H
#define VOXRAY_SHARED_STREAM_COUNT_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// An indirect dispatch of groups of STREAM_GROUP invocations, and an indirect launch of ray pipelines.
struct StreamCount {
    uint groups;  // Of `count` invocations.
    uint groupsY;  // 1
    uint groupsZ;  // 1
    uint count;
    uint countY;  // 1
    uint countZ;  // 1
};

VOXRAY_SHARED_END

#define STREAM_GROUP 64u

#endif
