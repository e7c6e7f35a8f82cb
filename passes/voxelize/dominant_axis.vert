#version 460
// Numbers the triangles' corners; the geometry shader reads what belongs to them.
layout(location = 0) flat out uint triangle;

void main() {
    triangle = uint(gl_VertexIndex) / 3u;
    gl_Position = vec4(0.0);
}
