#include "vulkan/commands.h"

#include "base/error.h"
#include "base/interrupt.h"
#include "vulkan/allocate.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

constexpr uint32_t kTimestampsPerPool = 256;
constexpr uint64_t kSmallBytes = 8 << 10;  ///< Size of a persistent staging buffer.

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

CommandStream::CommandStream(Device& device)
    : device_(device), smallUploads_(device, "small uploads", kSmallBytes, MemoryKind::Upload) {
    if (device_.isHost()) return;
    if (!isMapped(device_, MemoryKind::Device))
        smallReads_ = Buffer(device_, "small reads", kSmallBytes, MemoryKind::Readback);
    pushDescriptors_ = device_.function<PFN_vkCmdPushDescriptorSetKHR>("vkCmdPushDescriptorSetKHR");
    if (device_.hasDebugLabels()) {
        beginLabel_ = device_.function<PFN_vkCmdBeginDebugUtilsLabelEXT>("vkCmdBeginDebugUtilsLabelEXT");
        endLabel_ = device_.function<PFN_vkCmdEndDebugUtilsLabelEXT>("vkCmdEndDebugUtilsLabelEXT");
    }
    auto poolInfo = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.queueFamilyIndex = device_.queueFamily();
    check(vkCreateCommandPool(device_.handle(), &poolInfo, nullptr, pool_.receive(device_.handle())),
          "vkCreateCommandPool");
    auto allocate = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_.handle(), &allocate, &commands_), "vkAllocateCommandBuffers");
    auto fenceInfo = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    check(vkCreateFence(device_.handle(), &fenceInfo, nullptr, fence_.receive(device_.handle())), "vkCreateFence");
}

VkCommandBuffer CommandStream::beginRecording() {
    if (device_.isHost()) throw Error("{}", whyNoDevice({}));
    if (isRecording_) return commands_;
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    isRecording_ = true;

    // Reopen labels that were open at the last finish().
    for (const std::string& name : labels_) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str(), {}};
        beginLabel_(commands_, &label);
    }
    return commands_;
}

VkCommandBuffer CommandStream::recordAfterBarrier() {
    beginRecording();
    memoryBarrier(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                  VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
    return commands_;
}

void CommandStream::finish() {
    if (interruptRequested()) throw Interrupted();
    if (!isRecording_) return;
    for (size_t i = 0; i < labels_.size(); ++i) endLabel_(commands_);
    memoryBarrier(commands_, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    isRecording_ = false;
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    check(vkQueueSubmit(device_.queue(), 1, &submit, fence_), "vkQueueSubmit");
    ++counts_.waits;
    const VkFence fence = fence_;
    check(vkWaitForFences(device_.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    check(vkResetFences(device_.handle(), 1, &fence), "vkResetFences");
    check(vkResetCommandPool(device_.handle(), pool_, 0), "vkResetCommandPool");
    staging_.clear();
    stagingBytes_ = smallUploadBytes_ = 0;
}

void CommandStream::discard() {
    if (!device_.isHost()) check(vkResetCommandPool(device_.handle(), pool_, 0), "vkResetCommandPool");
    isRecording_ = false;
    labels_.clear();
    staging_.clear();
    stagingBytes_ = smallUploadBytes_ = 0;
    timestamps_ = 0;
}

void CommandStream::dispatch(const Program& program, const Invocations& invocations, const Bindings& bindings) {
    const glm::uvec3 local = program.localSize();
    if (invocations.isLinear() && (local.y != 1 || local.z != 1))
        throw Error(
            "{}: dispatched by a number of elements, but its work groups are {}x{}x{}: leave out local_size_y "
            "and local_size_z, or dispatch it by pixels",
            program.name(), local.x, local.y, local.z);
    const glm::uvec3 groups = invocations.groups(local);
    if (groups.x == 0 || groups.y == 0 || groups.z == 0) return;
    const uint32_t* limit = device_.properties().limits.maxComputeWorkGroupCount;
    if (groups.x > limit[0] || groups.y > limit[1] || groups.z > limit[2])
        throw Error("{}: {}x{}x{} work groups; device '{}' allows {}x{}x{} in one dispatch", program.name(), groups.x,
                    groups.y, groups.z, device_.info().name, limit[0], limit[1], limit[2]);
    const VkCommandBuffer commands = recordAfterBarrier();
    bind(commands, program, bindings.all());
    vkCmdDispatch(commands, groups.x, groups.y, groups.z);
    ++counts_.dispatches;
}

void CommandStream::record(const std::function<void(VkCommandBuffer)>& commands) {
    commands(recordAfterBarrier());
    ++counts_.dispatches;
}

void CommandStream::record(const Program& program, const Bindings& bindings,
                           const std::function<void(VkCommandBuffer)>& commands) {
    const VkCommandBuffer buffer = recordAfterBarrier();
    bind(buffer, program, bindings.all());
    commands(buffer);
    ++counts_.dispatches;
}

void CommandStream::draw(const Program& program, const RasterTargets& targets, uint32_t vertexCount,
                         const Bindings& bindings, uint32_t instanceCount) {
    const VkCommandBuffer commands = recordAfterBarrier();
    bind(commands, program, bindings.all());

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
    std::vector<VkViewport> viewports;
    std::vector<VkRect2D> scissors;
    const auto addViewport = [&](glm::uvec2 extent) {
        viewports.push_back({0, 0, float(extent.x), float(extent.y), 0, 1});
        scissors.push_back({{0, 0}, {extent.x, extent.y}});
    };
    for (const glm::uvec2& extent : targets.viewports) addViewport(extent);
    if (viewports.empty()) addViewport(targets.extent);
    auto rendering = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    rendering.renderArea = area;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = uint32_t(colors.size());
    rendering.pColorAttachments = colors.data();
    rendering.pDepthAttachment = targets.depth ? &depth : nullptr;
    vkCmdBeginRendering(commands, &rendering);
    vkCmdSetViewport(commands, 0, uint32_t(viewports.size()), viewports.data());
    vkCmdSetScissor(commands, 0, uint32_t(scissors.size()), scissors.data());
    vkCmdDraw(commands, vertexCount, instanceCount, 0, 0);
    vkCmdEndRendering(commands);
    ++counts_.dispatches;
}

void CommandStream::beginLabel(const std::string& name) {
    if (!beginLabel_) return;
    const VkCommandBuffer commands = beginRecording();
    labels_.push_back(name);
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str(), {}};
    beginLabel_(commands, &label);
}

void CommandStream::endLabel() {
    if (!beginLabel_) return;
    if (labels_.empty()) throw Error("endLabel() without beginLabel()");
    endLabel_(beginRecording());
    labels_.pop_back();
}

uint32_t CommandStream::timestamp() {
    const uint32_t index = timestamps_++;
    if (device_.isHost()) {
        hostTimestamps_.resize(index);
        hostTimestamps_.push_back(std::chrono::steady_clock::now());
        return index;
    }
    const uint32_t pool = index / kTimestampsPerPool, query = index % kTimestampsPerPool;
    if (pool == queryPools_.size()) {
        auto create = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
        create.queryType = VK_QUERY_TYPE_TIMESTAMP;
        create.queryCount = kTimestampsPerPool;
        check(
            vkCreateQueryPool(device_.handle(), &create, nullptr, queryPools_.emplace_back().receive(device_.handle())),
            "vkCreateQueryPool");
    }
    const VkCommandBuffer commands = recordAfterBarrier();
    if (query == 0) vkCmdResetQueryPool(commands, queryPools_[pool], 0, kTimestampsPerPool);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queryPools_[pool], query);
    return index;
}

double CommandStream::millisecondsBetween(uint32_t first, uint32_t second) const {
    for (const uint32_t index : {first, second})
        if (index >= timestamps_) throw Error("there is no time stamp {}", index);
    if (device_.isHost())
        return std::chrono::duration<double, std::milli>(hostTimestamps_[second] - hostTimestamps_[first]).count();
    const auto ticks = [&](uint32_t index) {
        uint64_t value = 0;
        const VkResult result =
            vkGetQueryPoolResults(device_.handle(), queryPools_[index / kTimestampsPerPool], index % kTimestampsPerPool,
                                  1, sizeof value, &value, sizeof value, VK_QUERY_RESULT_64_BIT);
        check(result, "reading a time stamp (is the stream finished?)");
        return value;
    };
    // Counters may wrap at fewer than 64 bits.
    const uint32_t bits = device_.timestampBits();
    const uint64_t mask = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    const uint64_t difference = (ticks(second) - ticks(first)) & mask;
    return double(difference) * double(device_.properties().limits.timestampPeriod) * 1e-6;
}

}  // namespace voxray
