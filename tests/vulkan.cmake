# Tests of vulkan.
voxray_tests(vulkan
  SOURCES
    gpu/vulkan_compiler.cpp gpu/vulkan_compute.cpp gpu/vulkan_device.cpp gpu/vulkan_memory.cpp gpu/vulkan_raster.cpp
    support/watched_device.cpp
  DEPENDS voxray_vulkan)
target_include_directories(tests_vulkan PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
