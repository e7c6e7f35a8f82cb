#include "tests/support/device.h"

namespace voxray::test {

Device& device() {
    static Device shared;
    return shared;
}

}  // namespace voxray::test
