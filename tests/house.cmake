# The house's own rules: who includes whom, formatting, left-overs, documentation.
set(HOUSE ${CMAKE_CURRENT_SOURCE_DIR}/house)
foreach(check layers hygiene docs skips)
  add_test(NAME house.${check} COMMAND /usr/bin/python3 ${HOUSE}/${check}.py ${CMAKE_SOURCE_DIR})
endforeach()
add_test(NAME house.commands COMMAND /usr/bin/python3 ${HOUSE}/commands.py ${CMAKE_SOURCE_DIR})
set_tests_properties(house.commands PROPERTIES ENVIRONMENT
  "VOXRAY_PROGRAM=$<TARGET_FILE:voxray-cli>;PYTHONDONTWRITEBYTECODE=1")
add_test(NAME house.format COMMAND /usr/bin/python3 ${HOUSE}/format.py ${CMAKE_SOURCE_DIR})
set_tests_properties(house.format PROPERTIES SKIP_RETURN_CODE 77)
add_test(NAME house.selftest COMMAND /usr/bin/python3 -m unittest -q selftest WORKING_DIRECTORY ${HOUSE})

# A few files that are fast to parse: docs/dependencies.md says why not all.
add_test(NAME house.tidy
  COMMAND ${CMAKE_SOURCE_DIR}/scripts/tidy.sh framework/base/suggest.cpp framework/base/value.cpp)
set_tests_properties(house.tidy PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT VOXRAY_BUILD=${CMAKE_BINARY_DIR})

# The template of docs/writing-a-pass.md, built and run as a real pass.
voxray_tests(template
  SOURCES ../docs/examples/tint/tint.cpp ../docs/examples/tint/tint_test.cpp support/watched_device.cpp
  DEPENDS voxray_graph)
