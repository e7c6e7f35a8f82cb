#include "passes/common/families.h"

#include <string>

namespace voxray {

void registerPasses(Registry& registry) {
    for (const Family& family : kFamilies) {
        const std::string folder(family.folder);
        addRegistered(registry, "passes/" + folder + "/", folder);
    }
}

}  // namespace voxray
