// Numbers the triangles' corners; the geometry shader reads what belongs to them.
readonly buffer DrawnTriangles { uint data[]; } drawnTriangles;

layout(location = 0) flat out uint triangle;

void main() {
    triangle = drawnTriangles.data[gl_VertexIndex / 3];
    gl_Position = vec4(0.0);
}
