uint scaled(uint value, uint factor) {
    return value * factor;
}
