#pragma once

#include "vulkan/commands.h"

namespace voxray {

/// Dispatches a compute program along one axis, by the work groups that a VkDispatchIndirectCommand at `offset`
/// bytes of a buffer tells when the commands run. @throws Error as CommandStream::dispatch().
void dispatchIndirect(CommandStream& stream, const Program& program, const Buffer& groups, uint64_t offset,
                      const Bindings& bindings);

}  // namespace voxray
