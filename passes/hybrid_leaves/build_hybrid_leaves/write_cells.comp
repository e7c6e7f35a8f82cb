// Stores the material of each clipped fragment in its cell; the last one stays (Seok 2021, section 3.2: "a simple write
// operation", which flickers).
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_surface.glsl"
#include "shaders/scene/specular.glsl"

void processFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;
    storeGridCell(s.cellIndex, GridCell(s.material.normal, dot(s.material.normal, s.point), s.material.albedo, 0.0));
    if (hybridLeaves.shape.cellWords == GRID_CELL_WORDS) return;
    const FragmentMaterial f = s.material;
    const GpuMaterial m = sceneMaterials.data[f.point.material];
    const Specular lobe = makeSpecular(f.base, f.metallic, f.roughness, m.specular, m.specularColor, m.ior);
    storeExtendedCell(s.cellIndex, ExtendedCell(emission(m, f.point, s.emissionLevel), m.doubleSided != 0u, lobe.f0,
                                                lobe.f90, lobe.roughness));
}
