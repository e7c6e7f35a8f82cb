# The built program, from the outside. What takes longest starts first (COST): a long test that starts last keeps a
# single core busy.
foreach(part bench_gpu commands compare counterparts disk explain external gallery generality look look_page look_passes look_reference mistakes notebooks pack packs parts plan python random_scenes resume run scene_files session stability still_frames threads tune)
  add_test(NAME cli.${part}
    COMMAND /usr/bin/python3 -m unittest -v ${part}_test
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/cli)
  set_tests_properties(cli.${part} PROPERTIES COST 100 ENVIRONMENT
    "VOXRAY_PROGRAM=$<TARGET_FILE:voxray-cli>;VOXRAY_SOURCE=${CMAKE_SOURCE_DIR};VOXRAY_CACHE=${CMAKE_BINARY_DIR}/tests/cli-cache;PYTHONDONTWRITEBYTECODE=1")
endforeach()
