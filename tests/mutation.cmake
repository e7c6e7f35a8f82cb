# The readers of outside bytes (glTF, other scenes and YAML) over mutated input. Their layers are compiled once more, under
# AddressSanitizer and UndefinedBehaviorSanitizer whatever the build type; all else is linked as it is. Whole layers,
# since a batch of the plain ones would bring what is there twice.
set(SANITIZERS -fsanitize=address,undefined -fno-sanitize-recover=undefined)
set(READERS "")
foreach(layer base scene config)
  get_target_property(sources voxray_${layer} SOURCES)
  list(TRANSFORM sources PREPEND ${CMAKE_SOURCE_DIR}/framework/${layer}/)
  list(APPEND READERS ${sources})
endforeach()
add_library(sanitized_readers OBJECT ${READERS})
voxray_batches(sanitized_readers)
set_source_files_properties(${CMAKE_SOURCE_DIR}/framework/scene/tiny_gltf.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_link_libraries(sanitized_readers PRIVATE voxray_options fmt::fmt glm::glm TBB::tbb Vulkan::Headers
  draco::draco meshoptimizer::meshoptimizer nlohmann_json::nlohmann_json pugixml::pugixml ZLIB::ZLIB yaml-cpp PkgConfig::XXHASH)
# Not optimized: the compiler takes longer than the test.
target_compile_options(sanitized_readers PRIVATE ${SANITIZERS} -fno-omit-frame-pointer -O0 -g1)
target_precompile_headers(sanitized_readers PRIVATE ${CMAKE_SOURCE_DIR}/framework/precompiled.h)

voxray_tests(mutation SHARDS 3
  SOURCES unit/config_mutation_test.cpp unit/mitsuba_mutation_test.cpp unit/pbrt_mutation_test.cpp
          unit/scene_mutation_test.cpp
  DEPENDS sanitized_readers voxray_config voxray_scene draco::draco meshoptimizer::meshoptimizer ZLIB::ZLIB)
target_link_options(tests_mutation PRIVATE ${SANITIZERS})
