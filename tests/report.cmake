# The report needs Debian's Python with numpy, pandas, matplotlib and Jinja2, which is not always the first on PATH. Parts of `browser`,
# `explain`, `large`, `pareto_browser`, `tune` and `viewer` look at the page in Chromium.
foreach(part browser explain large noise page pareto pareto_browser ranking reading selection stability tune viewer)
  add_test(NAME report.${part}
    COMMAND /usr/bin/python3 -m unittest -v report_${part}_test
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}/tests/unit)
endforeach()
foreach(script claims compare_builds device_paths growth image_sheet mirror_borders raise_capacity rivals_table setup trials tune)
  add_test(NAME scripts.${script}
    COMMAND /usr/bin/python3 -m unittest -q ${script}_test
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/unit)
endforeach()
