# The installed package as its users meet it. Stops with an error at the first thing that is wrong.
# usage: cmake -D BUILD_DIR= -D SOURCE_DIR= -D WORK_DIR= -D CXX_COMPILER= -D CXX_FLAGS= -D GENERATOR=
#              -P install_test.cmake
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})

include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

# A public header that the list in CMakeLists.txt leaves out would be missing for users only.
file(GLOB_RECURSE in_source RELATIVE ${SOURCE_DIR}/include ${SOURCE_DIR}/include/*.h)
file(GLOB_RECURSE installed RELATIVE ${prefix}/include ${prefix}/include/*.h)
if(NOT in_source STREQUAL installed)
  message(FATAL_ERROR "include/ holds\n${in_source}\nbut installed are\n${installed}")
endif()

write_consumer()
run(${CMAKE_COMMAND} -S ${WORK_DIR}/consumer -B ${WORK_DIR}/build -G ${GENERATOR}
    -D CMAKE_BUILD_TYPE=Debug -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)

# The README's worked example, line by line.
file(STRINGS ${SOURCE_DIR}/README.md lines REGEX "^[$] reprise ")
foreach(line IN LISTS lines)
  string(SUBSTRING "${line}" 10 -1 arguments)
  separate_arguments(arguments UNIX_COMMAND "${arguments}")
  run(${prefix}/bin/reprise ${arguments})
endforeach()

# The example program gives the same take as the command.
set(name s02/s02_03)
run(${WORK_DIR}/build/consumer library.rpz ${name} by_library.bvh)
if(NOT output MATCHES "${name}: [0-9]")
  message(FATAL_ERROR "the example did not list ${name}:\n${output}")
endif()
run(${CMAKE_COMMAND} -E compare_files take.bvh by_library.bvh)
