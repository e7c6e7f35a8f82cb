#include "vulkan/commands.h"

#include <algorithm>

#include "base/error.h"
#include "base/interrupt.h"
#include "vulkan/allocate.h"
#include "vulkan/commands_impl.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

constexpr uint32_t kTimestampsPerPool = 256;
constexpr uint64_t kSmallBytes = 8 << 10;  ///< Of a persistent staging buffer, for counters and parameters.

void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 dstStage, VkAccessFlags2 dstAccess) {
    auto barrier = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = dstStage;
    barrier.dstAccessMask = dstAccess;
    auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

void fullBarrier(VkCommandBuffer commands) {
    memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                  VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
}

CommandStream::Impl::Impl(Device& d)
    : device(d), smallUploads(d, "small uploads", kSmallBytes, MemoryKind::Upload) {
    if (device.isHost()) return;
    if (!isMapped(device, MemoryKind::Device))
        smallReads = Buffer(device, "small reads", kSmallBytes, MemoryKind::Readback);
    pushDescriptors = device.function<PFN_vkCmdPushDescriptorSetKHR>("vkCmdPushDescriptorSetKHR");
    if (device.hasDebugLabels()) {
        beginLabel = device.function<PFN_vkCmdBeginDebugUtilsLabelEXT>("vkCmdBeginDebugUtilsLabelEXT");
        endLabel = device.function<PFN_vkCmdEndDebugUtilsLabelEXT>("vkCmdEndDebugUtilsLabelEXT");
    }
    auto poolInfo = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.queueFamilyIndex = device.queueFamily();
    check(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool), "vkCreateCommandPool");
    auto allocate = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &allocate, &commands), "vkAllocateCommandBuffers");
    auto fenceInfo = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    check(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence), "vkCreateFence");
}

CommandStream::Impl::~Impl() {
    if (device.isHost()) return;
    for (VkQueryPool queries : queryPools) vkDestroyQueryPool(device.handle(), queries, nullptr);
    vkDestroyFence(device.handle(), fence, nullptr);
    vkDestroyCommandPool(device.handle(), pool, nullptr);
}

VkCommandBuffer CommandStream::Impl::beginRecording() {
    if (device.isHost()) throw Error("{}", whyNoDevice({}));
    if (recording) return commands;
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    recording = true;

    // Reopen labels that were open at the last finish().
    for (const std::string& name : labels) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str(), {}};
        beginLabel(commands, &label);
    }
    return commands;
}

VkCommandBuffer CommandStream::Impl::recordAfterBarrier() {
    beginRecording();
    fullBarrier(commands);
    return commands;
}

void CommandStream::Impl::finish() {
    if (interruptRequested()) throw Interrupted();
    if (!recording) return;
    for (size_t i = 0; i < labels.size(); ++i) endLabel(commands);
    memoryBarrier(commands, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    recording = false;
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(device.queue(), 1, &submit, fence), "vkQueueSubmit");
    ++counts.waits;
    check(vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    check(vkResetFences(device.handle(), 1, &fence), "vkResetFences");
    check(vkResetCommandPool(device.handle(), pool, 0), "vkResetCommandPool");
    staging.clear();
    stagingBytes = smallUploadBytes = 0;
}

void CommandStream::Impl::discard() {
    if (!device.isHost()) check(vkResetCommandPool(device.handle(), pool, 0), "vkResetCommandPool");
    recording = false;
    labels.clear();
    staging.clear();
    stagingBytes = smallUploadBytes = 0;
    timestamps = 0;
}

CommandStream::CommandStream(Device& device) : impl_(std::make_unique<Impl>(device)) {}
CommandStream::~CommandStream() = default;

Device& CommandStream::device() {
    return impl_->device;
}

void CommandStream::finish() {
    impl_->finish();
}

const StreamCounts& CommandStream::counts() const {
    return impl_->counts;
}

void CommandStream::discard() {
    impl_->discard();
}

void CommandStream::dispatch(const Program& program, const Invocations& invocations,
                             const Bindings& bindings) {
    const glm::uvec3 groups = invocations.groups(program.localSize());
    if (groups.x == 0 || groups.y == 0 || groups.z == 0) return;
    const uint32_t* limit = impl_->device.properties().limits.maxComputeWorkGroupCount;
    if (groups.x > limit[0] || groups.y > limit[1] || groups.z > limit[2])
        throw Error("{}: {}x{}x{} work groups; device '{}' allows {}x{}x{} in one dispatch", program.name(),
                    groups.x, groups.y, groups.z, impl_->device.info().name, limit[0], limit[1], limit[2]);
    const VkCommandBuffer commands = impl_->recordAfterBarrier();
    impl_->bind(commands, program, bindings.all());
    vkCmdDispatch(commands, groups.x, groups.y, groups.z);
    ++impl_->counts.dispatches;
}

void CommandStream::record(const std::function<void(VkCommandBuffer)>& commands) {
    commands(impl_->recordAfterBarrier());
    ++impl_->counts.dispatches;
}

void CommandStream::record(const Program& program, const Bindings& bindings,
                           const std::function<void(VkCommandBuffer)>& commands) {
    const VkCommandBuffer buffer = impl_->recordAfterBarrier();
    impl_->bind(buffer, program, bindings.all());
    commands(buffer);
    ++impl_->counts.dispatches;
}

void CommandStream::draw(const Program& program, const RasterTargets& targets, uint32_t vertexCount,
                         const Bindings& bindings, uint32_t instanceCount) {
    const VkCommandBuffer commands = impl_->recordAfterBarrier();
    impl_->bind(commands, program, bindings.all());

    // Attachments: cleared or loaded, always stored.
    const auto attach = [&](const Image& image) {
        if (image.desc().extent.x < targets.extent.x || image.desc().extent.y < targets.extent.y)
            throw Error("{}: target '{}' is smaller than the viewport of {}x{}", program.name(), image.name(),
                        targets.extent.x, targets.extent.y);
        auto attachment = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
        attachment.imageView = image.levelView(0);
        attachment.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
        attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        return attachment;
    };
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const RasterTargets::Color& color : targets.colors) {
        colors.push_back(attach(*color.image));
        if (!color.clear) continue;
        colors.back().loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        colors.back().clearValue.color = *color.clear;
    }
    auto depth = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    if (targets.depth) {
        depth = attach(*targets.depth);
        depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        depth.clearValue.depthStencil.depth = targets.depthClear;
    }

    const VkRect2D area{{0, 0}, {targets.extent.x, targets.extent.y}};
    const VkViewport viewport{0, 0, float(targets.extent.x), float(targets.extent.y), 0, 1};
    auto rendering = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    rendering.renderArea = area;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = uint32_t(colors.size());
    rendering.pColorAttachments = colors.data();
    rendering.pDepthAttachment = targets.depth ? &depth : nullptr;
    vkCmdBeginRendering(commands, &rendering);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
    vkCmdDraw(commands, vertexCount, instanceCount, 0, 0);
    vkCmdEndRendering(commands);
    ++impl_->counts.dispatches;
}

void CommandStream::beginLabel(const std::string& name) {
    if (!impl_->beginLabel) return;
    const VkCommandBuffer commands = impl_->beginRecording();
    impl_->labels.push_back(name);
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str(), {}};
    impl_->beginLabel(commands, &label);
}

void CommandStream::endLabel() {
    if (!impl_->beginLabel) return;
    if (impl_->labels.empty()) throw Error("endLabel() without beginLabel()");
    impl_->endLabel(impl_->beginRecording());
    impl_->labels.pop_back();
}

uint32_t CommandStream::timestamp() {
    const uint32_t index = impl_->timestamps++;
    if (impl_->device.isHost()) {
        impl_->hostTimestamps.resize(index);
        impl_->hostTimestamps.push_back(std::chrono::steady_clock::now());
        return index;
    }
    const uint32_t pool = index / kTimestampsPerPool, slot = index % kTimestampsPerPool;
    if (pool == impl_->queryPools.size()) {
        auto create = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
        create.queryType = VK_QUERY_TYPE_TIMESTAMP;
        create.queryCount = kTimestampsPerPool;
        VkQueryPool queries = VK_NULL_HANDLE;
        check(vkCreateQueryPool(impl_->device.handle(), &create, nullptr, &queries), "vkCreateQueryPool");
        impl_->queryPools.push_back(queries);
    }
    const VkCommandBuffer commands = impl_->recordAfterBarrier();
    if (slot == 0) vkCmdResetQueryPool(commands, impl_->queryPools[pool], 0, kTimestampsPerPool);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, impl_->queryPools[pool], slot);
    return index;
}

double CommandStream::millisecondsBetween(uint32_t first, uint32_t second) const {
    for (const uint32_t index : {first, second})
        if (index >= impl_->timestamps) throw Error("there is no time stamp {}", index);
    if (impl_->device.isHost())
        return std::chrono::duration<double, std::milli>(impl_->hostTimestamps[second] -
                                                         impl_->hostTimestamps[first])
            .count();
    const auto ticks = [&](uint32_t index) {
        uint64_t value = 0;
        const VkResult result = vkGetQueryPoolResults(
            impl_->device.handle(), impl_->queryPools[index / kTimestampsPerPool], index % kTimestampsPerPool,
            1, sizeof value, &value, sizeof value, VK_QUERY_RESULT_64_BIT);
        check(result, "reading a time stamp (is the stream finished?)");
        return value;
    };
    // Counters may wrap at fewer than 64 bits.
    const uint32_t bits = impl_->device.timestampBits();
    const uint64_t mask = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    const uint64_t difference = (ticks(second) - ticks(first)) & mask;
    return double(difference) * double(impl_->device.properties().limits.timestampPeriod) * 1e-6;
}

void CommandStream::resetTimestamps() {
    impl_->timestamps = 0;
}

}  // namespace voxray
