
layout(local_size_x = 1) in;
uniform sampler2D picture;
writeonly buffer Target {
    vec4 target[];
};
layout(set = 1) uniform sampler2D textures[];

layout(push_constant) uniform Push {
    vec2 uv;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    target[i] = i == 0 ? textureLod(picture, uv, 0.0) : textureLod(textures[nonuniformEXT(i - 1)], uv, 0.0);
}
