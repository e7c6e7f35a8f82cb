# Tests of vulkan.
file(GLOB VULKAN_TESTS CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} gpu/vulkan_*.cpp)
voxray_tests(vulkan SOURCES ${VULKAN_TESTS} support/watched_device.cpp DEPENDS voxray_vulkan)
target_include_directories(tests_vulkan PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
