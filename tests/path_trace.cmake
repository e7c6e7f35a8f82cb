# Tests of the CPU tracer and the reference path tracer; benchmarks in bench/.
voxray_tests(embree
  SOURCES unit/embree_scene_test.cpp
  DEPENDS voxray_embree)
file(GLOB PATH_TRACE_TESTS CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
  physics/path_trace_*_test.cpp physics/sealed_rooms_test.cpp)
voxray_tests(path_trace SOURCES ${PATH_TRACE_TESTS} DEPENDS voxray_path_trace voxray_config)
add_subdirectory(${CMAKE_SOURCE_DIR}/tests/bench ${CMAKE_BINARY_DIR}/tests/bench)
