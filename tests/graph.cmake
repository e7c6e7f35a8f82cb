# Tests of the graph, of the passes and of what they share with shaders.
voxray_tests(graph
  SOURCES unit/graph_changes_test.cpp unit/graph_index_test.cpp unit/graph_memory_test.cpp unit/graph_views_test.cpp unit/graph_wiring_test.cpp
  DEPENDS voxray_experiment)

# What follows from where surfaces lie: offsets of rays, counts of voxels, regions.
set(REGION_TESTS physics/region_test.cpp physics/surface_offset_test.cpp physics/voxel_count_test.cpp)
voxray_tests(regions
  SOURCES ${REGION_TESTS} support/watched_device.cpp
  DEPENDS voxray_experiment voxray_passes)

# All others of passes, and the passes that the documentation shows: a new one is found by its place.
file(GLOB CHAIN_TESTS CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
  gpu/*_test.cpp physics/*_test.cpp ../docs/examples/ambient_occlusion/*.cpp ../docs/examples/mutual_visibility/*.cpp)
list(REMOVE_ITEM CHAIN_TESTS ${REGION_TESTS} ${PATH_TRACE_TESTS})
voxray_tests(chain SHARDS 6
  SOURCES ${CHAIN_TESTS} support/brick_octree_count.cpp support/watched_device.cpp
  DEPENDS voxray_experiment voxray_passes)

# The library that denoise_oidn loads, as far as its tests need one.
add_library(oidn_stand_in MODULE support/oidn_stand_in.cpp)
target_link_libraries(oidn_stand_in PRIVATE voxray_options)
add_dependencies(tests_chain oidn_stand_in)
set_source_files_properties(physics/denoise_oidn_test.cpp PROPERTIES
  COMPILE_DEFINITIONS VOXRAY_OIDN_STAND_IN="$<TARGET_FILE:oidn_stand_in>")
