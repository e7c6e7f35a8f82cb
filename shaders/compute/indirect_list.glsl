// A list that one program fills, in any order, and another one takes from. It starts as a VkDispatchIndirectCommand over
// groups of 64, so that the second program runs for its items alone (dispatchIndirect()). Filled with ones it is empty.
#ifndef VOXRAY_INDIRECT_LIST_GLSL
#define VOXRAY_INDIRECT_LIST_GLSL
#extension GL_KHR_shader_subgroup_ballot : require

layout(scalar) buffer IndirectList {
    uint groups, one, alsoOne;
    uint countPlusOne;
    uint items[];
} indirectList;

// @param invocations of the second program for each item.
void appendItem(uint item, uint invocations) {
    // One addition for all invocations of a subgroup
    const uvec4 appending = subgroupBallot(true);
    uint first = 0u;
    if (subgroupElect()) {
        const uint count = subgroupBallotBitCount(appending);
        first = atomicAdd(indirectList.countPlusOne, count) - 1u;
        atomicMax(indirectList.groups, ((first + count) * invocations + 63u) / 64u);
    }
    indirectList.items[subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(appending)] = item;
}

uint listedItems() { return indirectList.countPlusOne - 1u; }

#endif
