#pragma once

#include "scenes/scene.h"

namespace fenestra {

/// The scene with all edges at most `longest_edge_m` long, for light that is known at vertices. A
/// longer edge is halved in all its triangles until it is short enough, so that triangles that
/// share an edge still share it. Texture coordinates, colours and normals are interpolated. Closed
/// meshes stay as they are, since their vertices were chosen where the solids were made. Windows
/// stay the same.
///
/// Throws InputError unless the length is positive.
Scene Tessellated(const Scene& scene, double longest_edge_m);

/// A length that splits the scene's surface into about this many triangles [m]; infinite if there
/// are that many already.
double EdgeForTriangles(const Scene& scene, size_t triangles);

}  // namespace fenestra
