# Tests of image.
voxray_tests(image
  SOURCES unit/image_io_test.cpp
  DEPENDS voxray_image)
