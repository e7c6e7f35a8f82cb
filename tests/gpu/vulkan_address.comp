#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

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
