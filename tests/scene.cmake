# Tests of scene.
voxray_tests(scene
  SOURCES unit/scene_accessor_test.cpp unit/scene_animation_test.cpp unit/scene_builtin_test.cpp
          unit/scene_compose_test.cpp unit/scene_compression_test.cpp unit/scene_export_test.cpp unit/scene_files_test.cpp unit/scene_material_test.cpp
          unit/scene_mesh_test.cpp unit/scene_morph_bounds_test.cpp unit/scene_morph_test.cpp
          unit/scene_motion_test.cpp unit/scene_node_test.cpp unit/scene_reading_test.cpp
          unit/import_mesh_test.cpp unit/mitsuba_lights_test.cpp unit/mitsuba_materials_test.cpp unit/mitsuba_reading_test.cpp
          unit/mitsuba_shapes_test.cpp
          unit/pbrt_lights_test.cpp unit/pbrt_materials_test.cpp unit/pbrt_reading_test.cpp unit/pbrt_shapes_test.cpp
          unit/light_tree_furnace_test.cpp unit/light_tree_test.cpp unit/outliers_test.cpp unit/scene_skin_test.cpp unit/scene_view_test.cpp
  DEPENDS voxray_scene ZLIB::ZLIB draco::draco meshoptimizer::meshoptimizer)
