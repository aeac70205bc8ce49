# The installed package as its users meet it. Stops with an error at the first thing that is wrong.
# usage: cmake -D BUILD_DIR= -D SOURCE_DIR= -D WORK_DIR= -D CXX_COMPILER= -D CXX_FLAGS= -D GENERATOR=
#              -P install_test.cmake
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

# A public header that the list in CMakeLists.txt leaves out would be missing for users only.
file(GLOB_RECURSE in_source RELATIVE ${SOURCE_DIR}/include ${SOURCE_DIR}/include/*.h)
file(GLOB_RECURSE installed RELATIVE ${prefix}/include ${prefix}/include/*.h)
if(NOT in_source STREQUAL installed)
  message(FATAL_ERROR "include/ holds\n${in_source}\nbut installed are\n${installed}")
endif()

file(READ ${SOURCE_DIR}/README.md readme)
if(NOT readme MATCHES "```cpp\n([^`]*)```")
  message(FATAL_ERROR "README.md has no C++ example")
endif()
set(example "${CMAKE_MATCH_1}")
file(COPY ${SOURCE_DIR}/tests/install/consumer DESTINATION ${WORK_DIR})
file(WRITE ${WORK_DIR}/consumer/main.cc "${example}")

run(${CMAKE_COMMAND} -S ${WORK_DIR}/consumer -B ${WORK_DIR}/build -G ${GENERATOR}
    -D CMAKE_BUILD_TYPE=Debug -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)

set(command ${prefix}/bin/reprise)
run(${command} synth ${WORK_DIR}/takes --takes 2 --seconds 3 --subjects 1)
run(${command} ingest ${WORK_DIR}/library.rpz ${WORK_DIR}/takes)
run(${command} list ${WORK_DIR}/library.rpz --json)
string(JSON name GET "${output}" takes 0 name)
run(${WORK_DIR}/build/consumer ${WORK_DIR}/library.rpz ${name} ${WORK_DIR}/out.bvh)
if(NOT output MATCHES "${name}: [0-9]")
  message(FATAL_ERROR "the example did not list ${name}:\n${output}")
endif()
run(${command} compare ${WORK_DIR}/takes/${name}.bvh ${WORK_DIR}/out.bvh --json)
string(JSON missing GET "${output}" missing_frames)
if(NOT missing EQUAL 0)
  message(FATAL_ERROR "the example's file lacks ${missing} frames")
endif()
