# Tests of scene.
voxray_tests(scene
  SOURCES unit/scene_builtin_test.cpp
  DEPENDS voxray_scene)
