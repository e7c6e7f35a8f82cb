// Passes on the number of the triangle; the geometry shader reads its vertices.
readonly buffer DrawnTriangles { uint data[]; } drawnTriangles;

layout(location = 0) flat out uint triangle;

void main() {
    triangle = drawnTriangles.data[gl_VertexIndex / 3];
    gl_Position = vec4(0.0);
}
