# What the tests of the package share. Both work in WORK_DIR, on the project in SOURCE_DIR.

# run(COMMAND ARGUMENT...): stops with all that a command said if it fails; leaves its answer in `output`.
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK_DIR}
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE messages)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}${messages}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Writes the program of tests/install/consumer to WORK_DIR/consumer, with the README's example as its source.
function(write_consumer)
  file(READ ${SOURCE_DIR}/README.md readme)
  if(NOT readme MATCHES "```cpp\n([^`]*)```")
    message(FATAL_ERROR "README.md has no C++ example")
  endif()
  set(example "${CMAKE_MATCH_1}")
  file(COPY ${SOURCE_DIR}/tests/install/consumer DESTINATION ${WORK_DIR})
  file(WRITE ${WORK_DIR}/consumer/main.cc "${example}")
endfunction()
