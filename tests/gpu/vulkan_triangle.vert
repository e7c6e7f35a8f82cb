
// The triangle (-1,-1) (1,-1) (-1,1): half of the viewport.
void main() {
    const vec2 corner = vec2(gl_VertexIndex == 1 ? 1.0 : -1.0, gl_VertexIndex == 2 ? 1.0 : -1.0);
    gl_Position = vec4(corner, 0.5, 1.0);
}
