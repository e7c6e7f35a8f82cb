# Tests of trace.
voxray_tests(trace
  SOURCES gpu/trace_backends.cpp
  DEPENDS voxray_trace)
target_include_directories(tests_trace PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
