# Tests of image.
voxray_tests(image
  SOURCES unit/image_io_test.cpp unit/image_layers_test.cpp unit/image_metrics_test.cpp unit/image_parity_test.cpp
          unit/image_seed_error_test.cpp unit/image_temporal_test.cpp unit/image_tone_test.cpp
          unit/image_unbiased_test.cpp
  DEPENDS voxray_image PkgConfig::OIIO)
