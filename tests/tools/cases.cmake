# What test files may hold beside values: sweeps, warnings, pictures.
sl_tool_test(sweeps 1 "${sltest} ${here}/sweeps.toml -v" "pass ${here}/sweeps.toml:2: cross product (24 runs|pass ${here}/sweeps.toml:14: |expected 1, got 2 at (0, 0)|[k = 2, uniform arguments]|[k = 2, varying arguments in a loop]|warning: expected \"nothing at all\", got|variable 'unused' is not used [-Wunused]\"|warning: ${here}/sweeps.toml:30: this assigns|pass ${here}/sweeps.toml:34: no warnings|2 of 5 cases failed")
sl_tool_test(bad_sweeps 1 "${sltest} ${here}/bad_sweeps.toml" ":4:11: error: a sweep is a list of values, or {from, to, steps} with 2 to 1000 steps|:9:11: error: a sweep is a list of values, or {from, to, steps}\\n|'options' must be a table|20000 combinations, more than 10000|write expect.image.NAME = \"FILE.exr\"|the name of an image file is missing")
if(ANEMONE_RENDER)
  sl_tool_test(goldens 0 "${CMAKE_COMMAND} -DSLTEST=${sltest} -DINPUT=${here}/golden.toml.in -DFOLDER=${CMAKE_CURRENT_BINARY_DIR}/goldens -P ${here}/goldens.cmake" "pictures are right")
endif()
