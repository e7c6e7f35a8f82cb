# The readers of outside bytes (glTF and YAML) over mutated input. Their sources are compiled once more, under
# AddressSanitizer and UndefinedBehaviorSanitizer whatever the build type; all else is linked as it is.
set(BASE ${CMAKE_SOURCE_DIR}/framework/base)
set(SCENE ${CMAKE_SOURCE_DIR}/framework/scene)
set(CONFIG ${CMAKE_SOURCE_DIR}/framework/config)
set(SANITIZERS -fsanitize=address,undefined -fno-sanitize-recover=undefined)
add_library(sanitized_readers OBJECT
  ${BASE}/files.cpp ${BASE}/suggest.cpp ${BASE}/value.cpp
  ${SCENE}/animation.cpp ${SCENE}/geometry.cpp ${SCENE}/gltf_accessor.cpp ${SCENE}/gltf_animation.cpp
  ${SCENE}/gltf_check.cpp ${SCENE}/gltf_data.cpp ${SCENE}/gltf_deform.cpp ${SCENE}/gltf_draco.cpp
  ${SCENE}/gltf_file.cpp ${SCENE}/gltf_json.cpp ${SCENE}/gltf_material.cpp ${SCENE}/gltf_mesh.cpp
  ${SCENE}/gltf_meshopt.cpp ${SCENE}/gltf_nodes.cpp ${SCENE}/gltf_repair.cpp ${SCENE}/gltf_uri.cpp ${SCENE}/load.cpp ${SCENE}/mesh_repair.cpp ${SCENE}/tiny_gltf.cpp
  ${CONFIG}/config.cpp ${CONFIG}/measure_settings.cpp ${CONFIG}/overrides.cpp ${CONFIG}/scene_additions.cpp
  ${CONFIG}/scene_settings.cpp ${CONFIG}/sweep.cpp ${CONFIG}/value_labels.cpp ${CONFIG}/yaml.cpp
  ${CONFIG}/yaml_faults.cpp)
target_link_libraries(sanitized_readers PRIVATE voxray_options fmt::fmt glm::glm TBB::tbb Vulkan::Headers
  draco::draco meshoptimizer::meshoptimizer nlohmann_json::nlohmann_json yaml-cpp PkgConfig::XXHASH)
# Not optimized: the compiler takes longer than the test.
target_compile_options(sanitized_readers PRIVATE ${SANITIZERS} -fno-omit-frame-pointer -O0 -g1)
target_precompile_headers(sanitized_readers PRIVATE ${CMAKE_SOURCE_DIR}/framework/precompiled.h)

voxray_tests(mutation SHARDS 3
  SOURCES unit/config_mutation_test.cpp unit/scene_mutation_test.cpp
  DEPENDS sanitized_readers voxray_config voxray_scene draco::draco meshoptimizer::meshoptimizer)
target_link_options(tests_mutation PRIVATE ${SANITIZERS})
