# Tests of the CPU tracer and the reference path tracer; benchmarks in bench/.
if(NOT TARGET voxray_path_trace)
  add_subdirectory(${CMAKE_SOURCE_DIR}/passes/path_trace ${CMAKE_BINARY_DIR}/passes/path_trace)
endif()
voxray_tests(embree
  SOURCES unit/embree_scene_test.cpp
  DEPENDS voxray_embree)
add_subdirectory(${CMAKE_SOURCE_DIR}/tests/bench ${CMAKE_BINARY_DIR}/tests/bench)
