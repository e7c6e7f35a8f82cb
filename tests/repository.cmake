# The rules of this repository: who includes whom, formatting, left-overs, documentation.
set(RULES ${CMAKE_CURRENT_SOURCE_DIR}/repository)
foreach(check layers hygiene docs skips)
  add_test(NAME repository.${check} COMMAND /usr/bin/python3 ${RULES}/${check}.py ${CMAKE_SOURCE_DIR})
endforeach()
add_test(NAME repository.commands COMMAND /usr/bin/python3 ${RULES}/commands.py ${CMAKE_SOURCE_DIR})
set_tests_properties(repository.commands PROPERTIES ENVIRONMENT
  "VOXRAY_PROGRAM=$<TARGET_FILE:voxray-cli>;PYTHONDONTWRITEBYTECODE=1")
add_test(NAME repository.format COMMAND /usr/bin/python3 ${RULES}/format.py ${CMAKE_SOURCE_DIR})
set_tests_properties(repository.format PROPERTIES SKIP_RETURN_CODE 77)
add_test(NAME repository.selftest COMMAND /usr/bin/python3 -m unittest -q selftest WORKING_DIRECTORY ${RULES})

# A few files that are fast to parse: docs/dependencies.md says why not all.
add_test(NAME repository.tidy
  COMMAND ${CMAKE_SOURCE_DIR}/scripts/tidy.sh framework/base/suggest.cpp framework/base/value.cpp)
set_tests_properties(repository.tidy PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT VOXRAY_BUILD=${CMAKE_BINARY_DIR})

# The template of docs/writing-a-pass.md, built and run as a real pass.
voxray_tests(template
  SOURCES ../docs/examples/tint/tint.cpp ../docs/examples/tint/tint_test.cpp support/watched_device.cpp
  DEPENDS voxray_graph)
