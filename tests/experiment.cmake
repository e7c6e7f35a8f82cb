# Tests of experiment.
voxray_tests(config
  SOURCES unit/config_scene_test.cpp unit/config_sweep_test.cpp unit/config_test.cpp unit/yaml_test.cpp
  DEPENDS voxray_config)

voxray_tests(experiment
  SOURCES unit/afterglow_test.cpp unit/composed_scene_test.cpp unit/timing_outliers_test.cpp unit/experiment_run_test.cpp unit/experiment_sequence_test.cpp unit/experiment_validate_test.cpp unit/json_text_test.cpp unit/pixel_masks_test.cpp unit/progressive_reference_test.cpp unit/reference_parts_test.cpp unit/scene_checks_test.cpp unit/view_picture_test.cpp
  DEPENDS voxray_experiment)

# Every config that is shipped, against the real passes; the reference's noise.
voxray_tests(configs
  SOURCES unit/experiment_configs_test.cpp unit/families_test.cpp unit/unused_settings_test.cpp unit/noise_parameters_test.cpp unit/progressive_path_trace_test.cpp unit/reference_noise_test.cpp unit/value_sets_test.cpp unit/view_check_test.cpp
  DEPENDS voxray_experiment voxray_passes)
