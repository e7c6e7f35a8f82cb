# Tests of base.
voxray_tests(base
  SOURCES unit/base_test.cpp unit/child_process_test.cpp unit/one_line_test.cpp unit/process_lock_test.cpp
  DEPENDS voxray_base)
