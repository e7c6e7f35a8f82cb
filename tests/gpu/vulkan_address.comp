
layout(local_size_x = 1) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words {
    uint word[];
};
layout(push_constant, scalar) uniform Push {
    Words words;
    uint index;
    uint value;
};

void main() {
    words.word[index] = value;
}
