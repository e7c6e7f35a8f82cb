# Tests of the CPU tracer and the reference path tracer; benchmarks in bench/.
voxray_tests(embree
  SOURCES unit/embree_scene_test.cpp
  DEPENDS voxray_embree)
voxray_tests(path_trace
  SOURCES physics/path_trace_closed_form_test.cpp physics/path_trace_masked_lamp_test.cpp physics/path_trace_parts_test.cpp physics/path_trace_reflection_test.cpp
          physics/path_trace_sampling_test.cpp physics/sealed_rooms_test.cpp
  DEPENDS voxray_path_trace)
add_subdirectory(${CMAKE_SOURCE_DIR}/tests/bench ${CMAKE_BINARY_DIR}/tests/bench)
