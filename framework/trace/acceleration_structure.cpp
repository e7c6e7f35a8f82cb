#include "trace/acceleration_structure.h"

#include <algorithm>
#include <span>

#include "trace/uploaded.h"
#include "vulkan/structure.h"

namespace voxray {

void destroyAccelerationStructure(VkDevice device, VkAccelerationStructureKHR structure,
                                  const VkAllocationCallbacks* allocator) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyAccelerationStructureKHR>(
        vkGetDeviceProcAddr(device, "vkDestroyAccelerationStructureKHR"));
    destroy(device, structure, allocator);
}

AccelerationStructure::AccelerationStructure(Device& device, const char* name, VkAccelerationStructureTypeKHR type,
                                             uint64_t bytes)
    : buffer_(device, name, bytes, MemoryKind::Device, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR) {
    auto create =
        structure<VkAccelerationStructureCreateInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR);
    create.buffer = buffer_.handle();
    create.size = bytes;
    create.type = type;
    check(device.function<PFN_vkCreateAccelerationStructureKHR>("vkCreateAccelerationStructureKHR")(
              device.handle(), &create, nullptr, handle_.receive(device.handle())),
          "vkCreateAccelerationStructureKHR");
    auto info = structure<VkAccelerationStructureDeviceAddressInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR);
    info.accelerationStructure = handle_;
    address_ = device.function<PFN_vkGetAccelerationStructureDeviceAddressKHR>(
        "vkGetAccelerationStructureDeviceAddressKHR")(device.handle(), &info);
}

namespace {

/// Build of a structure from one geometry of `primitives` elements.
struct Build {
    VkAccelerationStructureTypeKHR type;
    VkAccelerationStructureGeometryKHR geometry;
    uint32_t primitives;
};

VkAccelerationStructureBuildGeometryInfoKHR describe(const Build& build) {
    auto info = structure<VkAccelerationStructureBuildGeometryInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR);
    info.type = build.type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = 1;
    info.pGeometries = &build.geometry;
    return info;
}

/// Builds a structure and waits, so that one scratch buffer exists at a time. Creates `result` if it is
/// empty; otherwise rebuilds it in place, with the same number of primitives.
void run(Device& device, CommandStream& stream, const char* name, const Build& build, AccelerationStructure& result) {
    VkAccelerationStructureBuildGeometryInfoKHR info = describe(build);
    auto sizes = structure<VkAccelerationStructureBuildSizesInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR);
    device.function<PFN_vkGetAccelerationStructureBuildSizesKHR>("vkGetAccelerationStructureBuildSizesKHR")(
        device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &build.primitives, &sizes);
    if (!result.handle()) result = AccelerationStructure(device, name, build.type, sizes.accelerationStructureSize);

    // The scratch address must be aligned.
    const uint64_t alignment = device.accelerationStructureProperties().minAccelerationStructureScratchOffsetAlignment;
    const Buffer scratch(device, "acceleration structure scratch", sizes.buildScratchSize + alignment);
    info.dstAccelerationStructure = result.handle();
    info.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
    const VkAccelerationStructureBuildRangeInfoKHR range{build.primitives, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    const auto function =
        device.function<PFN_vkCmdBuildAccelerationStructuresKHR>("vkCmdBuildAccelerationStructuresKHR");
    stream.record([&](VkCommandBuffer commands) { function(commands, 1, &info, &ranges); });
    stream.finish();
}

Build trianglesBuild(const Buffer& positions, uint32_t vertexCount, const Buffer& indices, uint32_t first,
                     uint32_t count, bool opaque) {
    Build build{VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, {}, count};
    build.geometry =
        structure<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
    build.geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    build.geometry.flags = opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
    auto& triangles = build.geometry.geometry.triangles;
    triangles = structure<VkAccelerationStructureGeometryTrianglesDataKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR);
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = positions.address();
    triangles.vertexStride = sizeof(glm::vec3);
    triangles.maxVertex = vertexCount - 1;
    triangles.indexType = VK_INDEX_TYPE_UINT32;
    triangles.indexData.deviceAddress = indices.address() + uint64_t(first) * sizeof(glm::uvec3);
    return build;
}

void buildChunk(Device& device, CommandStream& stream, const TracingOrder& order, size_t chunk, SceneStructure& scene) {
    const uint32_t first = order.chunkFirst[chunk], count = order.chunkEnd(chunk) - first;
    const uint32_t vertexCount = uint32_t(scene.positions.bytes() / sizeof(glm::vec3));
    const Build build =
        trianglesBuild(scene.positions, vertexCount, scene.corners, first, count, first < order.opaqueCount);
    run(device, stream, "bottom-level acceleration structures", build, scene.chunks[chunk]);
}

void buildTop(Device& device, CommandStream& stream, SceneStructure& scene) {
    // Identity transforms, since triangles are in world space. No culling.
    std::vector<VkAccelerationStructureInstanceKHR> instances;
    for (uint32_t i = 0; i < scene.chunks.size(); ++i) {
        VkAccelerationStructureInstanceKHR instance{};
        for (int axis = 0; axis < 3; ++axis) instance.transform.matrix[axis][axis] = 1.0f;
        instance.instanceCustomIndex = i & 0xffffffu;
        instance.mask = 0xff;
        instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
        instance.accelerationStructureReference = scene.chunks[i].address();
        instances.push_back(instance);
    }
    const Buffer buffer(device, "acceleration structure instances",
                        std::max<size_t>(instances.size(), 1) * sizeof(VkAccelerationStructureInstanceKHR));
    stream.upload(buffer, instances);
    Build build{VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, {}, uint32_t(instances.size())};
    build.geometry =
        structure<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
    build.geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    build.geometry.geometry.instances = structure<VkAccelerationStructureGeometryInstancesDataKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR);
    build.geometry.geometry.instances.data.deviceAddress = buffer.address();
    run(device, stream, "top-level acceleration structure", build, scene.top);
}

}  // namespace

uint64_t SceneStructure::bytes() const {
    uint64_t sum = top.bytes();
    for (const AccelerationStructure& chunk : chunks) sum += chunk.bytes();
    return sum;
}

uint32_t trianglesPerChunk(const Device& device) {
    constexpr uint64_t kMax = 1u << 22;  // Bounds the scratch memory of a build.
    return uint32_t(std::min(kMax, device.accelerationStructureProperties().maxPrimitiveCount));
}

SceneStructure buildSceneStructure(Device& device, CommandStream& stream, const SceneState& state,
                                   const TracingOrder& order) {
    // Inputs in tracing order.
    const Geometry& geometry = state.geometry;
    std::vector<glm::uvec3> indices;
    indices.reserve(order.triangles.size());
    for (uint32_t t : order.triangles) indices.push_back(geometry.triangles[t]);
    SceneStructure scene;
    scene.positions = uploaded(device, stream, "acceleration structure vertices", geometry.positions);
    scene.corners = uploaded(device, stream, "acceleration structure indices", indices);

    // A bottom-level structure for each chunk, and the top-level one.
    scene.opaqueCount = order.opaqueCount;
    scene.chunks.resize(order.chunkFirst.size());
    for (size_t chunk = 0; chunk < scene.chunks.size(); ++chunk) buildChunk(device, stream, order, chunk, scene);
    buildTop(device, stream, scene);
    scene.chunkFirst = uploaded(device, stream, "acceleration structure chunks", order.chunkFirst);
    scene.triangleIds = uploaded(device, stream, "acceleration structure triangle numbers", order.triangles);
    stream.finish();
    return scene;
}

void updateSceneStructure(Device& device, CommandStream& stream, const SceneState& state, const TracingOrder& order,
                          SceneStructure& scene) {
    const Geometry& geometry = state.geometry;
    for (const InstanceRange& range : movingInstanceRanges(geometry))
        stream.upload(scene.positions,
                      std::as_bytes(std::span(geometry.positions).subspan(range.firstVertex, range.vertexCount)),
                      range.firstVertex * sizeof(glm::vec3));
    for (const TracingOrder::Range& range : order.moving) {
        const auto triangles = std::span(order.triangles).subspan(range.first, range.end - range.first);
        std::vector<glm::uvec3> corners;
        for (const uint32_t t : triangles) corners.push_back(geometry.triangles[t]);
        stream.upload(scene.corners, std::as_bytes(std::span(corners)), range.first * sizeof(glm::uvec3));
        stream.upload(scene.triangleIds, std::as_bytes(triangles), range.first * sizeof(uint32_t));
    }
    for (size_t chunk = 0; chunk < scene.chunks.size(); ++chunk)
        if (order.moves(chunk)) buildChunk(device, stream, order, chunk, scene);
    buildTop(device, stream, scene);
}

}  // namespace voxray
