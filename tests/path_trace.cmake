# Tests of the CPU tracer and the reference path tracer; benchmarks in bench/.
voxray_tests(embree
  SOURCES unit/embree_scene_test.cpp
  DEPENDS voxray_embree)
