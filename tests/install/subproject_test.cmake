# The library as a folder inside another project. Stops with an error at the first thing that is wrong.
# usage: cmake -D SOURCE_DIR= -D WORK_DIR= -D CXX_COMPILER= -D CXX_FLAGS= -D GENERATOR= -P subproject_test.cmake
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

write_consumer()
run(${CMAKE_COMMAND} -S ${WORK_DIR}/consumer -B ${WORK_DIR}/build -G ${GENERATOR}
    -D CMAKE_BUILD_TYPE=Debug -D REPRISE_SOURCE_DIR=${SOURCE_DIR} -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build --target CMakeFiles/consumer.dir/main.cc.o)
