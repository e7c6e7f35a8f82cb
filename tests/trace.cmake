# Tests of trace.
voxray_tests(trace
  SOURCES gpu/trace_backends.cpp gpu/trace_counted.cpp gpu/trace_update.cpp support/watched_device.cpp unit/tracing_order_test.cpp
  DEPENDS voxray_trace)
target_include_directories(tests_trace PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})

# Throughput of the three backends and how far they agree; run by hand or by `voxray bench`.
add_executable(bench_trace_backends ${CMAKE_CURRENT_SOURCE_DIR}/gpu/trace_bench.cpp)
target_link_libraries(bench_trace_backends PRIVATE voxray_trace tests_places benchmark::benchmark benchmark::benchmark_main)
target_include_directories(bench_trace_backends PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
