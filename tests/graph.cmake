# Tests of the graph, of the passes and of what they share with shaders.
voxray_tests(graph
  SOURCES unit/graph_memory_test.cpp unit/graph_basis_test.cpp unit/graph_wiring_test.cpp
  DEPENDS voxray_experiment)
voxray_tests(chain SHARDS 12
  SOURCES gpu/compute_test.cpp gpu/shared_structs_test.cpp physics/accumulate_test.cpp physics/accumulate_vpls_test.cpp physics/awkward_views_test.cpp physics/brick_octree_count_test.cpp physics/camera_rays_test.cpp
           physics/clipmap_test.cpp physics/clipmap_textures_test.cpp physics/clipmap_voxels_test.cpp physics/cluster_normals_test.cpp physics/clusters_test.cpp physics/compare_voxels_test.cpp
           physics/cone_bounces_test.cpp physics/cone_tracing_test.cpp physics/filter_irradiance_test.cpp physics/final_gather_test.cpp physics/gather_clusters_test.cpp physics/hybrid_leaves_test.cpp physics/hybrid_levels_test.cpp physics/hybrid_rays_test.cpp physics/many_lights_maps_test.cpp physics/many_lights_rsm_test.cpp physics/many_lights_test.cpp physics/masked_lamp_test.cpp physics/select_vpls_test.cpp physics/surfel_distance_test.cpp physics/vpl_visibility_test.cpp
           physics/gather_mirror_leaves_test.cpp physics/gather_mirror_test.cpp physics/gbuffer_test.cpp physics/injection_test.cpp physics/light_paths_test.cpp physics/lit_points_test.cpp
           physics/memory_test.cpp physics/merged_voxels_test.cpp physics/packed_voxels_test.cpp physics/panes_test.cpp physics/published_octree_test.cpp
           physics/moving_clusters_test.cpp physics/moving_scene_test.cpp physics/moving_voxels_test.cpp physics/octree_test.cpp
           physics/radiance_cache_test.cpp physics/radiance_voxels_test.cpp physics/radiosity_test.cpp
           physics/seen_points_test.cpp physics/shadow_map_test.cpp physics/specular_cones_test.cpp
           physics/show_voxels_test.cpp physics/stable_light_test.cpp physics/svo_bricks_layout_test.cpp physics/svo_layout_test.cpp physics/textures_layout_test.cpp physics/thin_walls_test.cpp
           physics/voxel_accumulator_test.cpp
           physics/voxel_ends_test.cpp physics/voxel_march_test.cpp physics/voxel_visibility_test.cpp physics/voxel_packing_test.cpp
           physics/voxelize_exact_test.cpp physics/voxelize_material_test.cpp
           physics/voxelize_methods_test.cpp physics/voxelize_test.cpp house/march/mutual_visibility.cpp
           house/march/mutual_visibility_test.cpp house/occlusion/ambient_occlusion.cpp
           house/occlusion/ambient_occlusion_test.cpp support/watched_device.cpp
  DEPENDS voxray_experiment voxray_passes)

# What follows from where surfaces lie: offsets of rays, counts of voxels, regions.
voxray_tests(regions
  SOURCES physics/region_test.cpp physics/surface_offset_test.cpp physics/voxel_count_test.cpp support/watched_device.cpp
  DEPENDS voxray_experiment voxray_passes)
