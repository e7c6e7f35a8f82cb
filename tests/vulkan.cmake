# Tests of vulkan.
voxray_tests(vulkan
  SOURCES gpu/vulkan_compute.cpp gpu/vulkan_device.cpp
  DEPENDS voxray_vulkan)
target_include_directories(tests_vulkan PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
