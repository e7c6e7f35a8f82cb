#include "vulkan/indirect.h"

#include "base/error.h"

namespace voxray {

void dispatchIndirect(CommandStream& stream, const Program& program, const Buffer& groups, uint64_t offset,
                      const Bindings& bindings) {
    if (offset + sizeof(VkDispatchIndirectCommand) > groups.bytes())
        throw Error("{}: buffer '{}' of {} bytes holds no work groups at byte {}", program.name(), groups.name(),
                    groups.bytes(), offset);
    stream.record(program, bindings,
                  [&](VkCommandBuffer commands) { vkCmdDispatchIndirect(commands, groups.handle(), offset); });
}

}  // namespace voxray
