# Tests of experiment.
voxray_tests(config
  SOURCES unit/config_test.cpp unit/config_sweep_test.cpp
  DEPENDS voxray_config)

# The config reader over mutated files, with sanitizers whatever the build type: its sources are few.
set(CONFIG_FOLDER ${CMAKE_SOURCE_DIR}/framework/experiment)
set(BASE_FOLDER ${CMAKE_SOURCE_DIR}/framework/base)
voxray_tests(config_mutation
  SOURCES unit/config_mutation_test.cpp
    ${CONFIG_FOLDER}/config.cpp ${CONFIG_FOLDER}/overrides.cpp ${CONFIG_FOLDER}/scene_settings.cpp
    ${CONFIG_FOLDER}/sweep.cpp ${CONFIG_FOLDER}/yaml.cpp
    ${BASE_FOLDER}/files.cpp ${BASE_FOLDER}/suggest.cpp ${BASE_FOLDER}/value.cpp
  DEPENDS voxray_options fmt::fmt glm::glm Vulkan::Headers yaml-cpp nlohmann_json::nlohmann_json PkgConfig::XXHASH)
set(SANITIZERS -fsanitize=address,undefined -fno-sanitize-recover=undefined)
target_compile_options(tests_config_mutation PRIVATE ${SANITIZERS} -O1 -g)
target_link_options(tests_config_mutation PRIVATE ${SANITIZERS})
set_target_properties(tests_config_mutation PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)

voxray_tests(experiment
  SOURCES unit/experiment_run_test.cpp unit/experiment_validate_test.cpp
  DEPENDS voxray_experiment nlohmann_json::nlohmann_json)

# Every config that is shipped, against the real passes.
voxray_tests(configs
  SOURCES unit/experiment_configs_test.cpp
  DEPENDS voxray_experiment voxray_passes)
