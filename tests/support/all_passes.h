#pragma once

#include "passes/common/families.h"

namespace voxray::test {

inline Registry allPasses() {
    Registry registry;
    registerPasses(registry);
    return registry;
}

}  // namespace voxray::test
