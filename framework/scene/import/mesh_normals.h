#pragma once

#include "scene/scene.h"

namespace voxray {

/// Fronts and normals to the other side.
void reverseFronts(Mesh& mesh);

/// Turns each triangle so that its front is on the side of its vertices' normals, if it has some.
void frontsTowardsNormals(Mesh& mesh);

/// Normals at shared vertices: means of the triangles', weighted by their angles there (Thürmer and Wüthrich 1998).
void makeSmoothNormals(Mesh& mesh);

}  // namespace voxray
