// A list that one program fills, in any order, and another one takes from. It starts as a VkDispatchIndirectCommand over
// groups of 64, so that the second program runs for its items alone (dispatchIndirect()). Filled with ones it is empty.
#ifndef VOXRAY_INDIRECT_LIST_GLSL
#define VOXRAY_INDIRECT_LIST_GLSL

layout(scalar) buffer IndirectList {
    uint groups, one, alsoOne;
    uint countPlusOne;
    uint items[];
} indirectList;

// @param invocations of the second program for each item.
void appendItem(uint item, uint invocations) {
    const uint i = atomicAdd(indirectList.countPlusOne, 1u) - 1u;
    indirectList.items[i] = item;
    atomicMax(indirectList.groups, ((i + 1u) * invocations + 63u) / 64u);
}

uint listedItems() { return indirectList.countPlusOne - 1u; }

#endif
