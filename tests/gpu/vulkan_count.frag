#version 460

layout(set = 0, binding = 0) buffer Counter {
    uint count;
}
counter;

void main() {
    atomicAdd(counter.count, 1u);
}
