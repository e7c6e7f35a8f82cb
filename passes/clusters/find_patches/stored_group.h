// The group of a surfel, stored for the next update. Shared by C++ (group_update_cache.cpp) and GLSL.
#ifndef VOXRAY_STORED_GROUP_H
#define VOXRAY_STORED_GROUP_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct StoredGroup {
    uint group;    // Index within its voxel, in the order in which groups were found.
    float height;  // That of GroupedSurfel.
};

VOXRAY_SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer StoredGroups {
    StoredGroup data[];
};
#endif

#endif
