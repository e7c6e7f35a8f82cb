
buffer Counter {
    uint count;
}
counter;

void main() {
    atomicAdd(counter.count, 1u);
}
