# Installs the build to a fresh folder, then configures, builds and runs the consumer project against it, with the
# compiler and flags of the build (a library built with sanitizers needs a consumer linked with them).

set(work "${BUILD}/tests/package")
file(REMOVE_RECURSE "${work}/prefix" "${work}/consumer")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${work}/prefix")
run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}" -B "${work}/consumer" -G Ninja
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
  "-DCMAKE_PREFIX_PATH=${work}/prefix")
run(${CMAKE_COMMAND} --build "${work}/consumer")
run("${work}/consumer/consumer")
