# Tests of base.
voxray_tests(base
  SOURCES unit/base_test.cpp unit/one_line_test.cpp
  DEPENDS voxray_base)
