# cmake -DBUILD=... -DSOURCE=... -DFOLDER=... -DCXX=... -DLAUNCHER=... -DBUILD_TYPE=... -P install_and_use.cmake
# Installs the library into a folder of its own, then configures, builds and runs a project that finds it there.
file(REMOVE_RECURSE ${FOLDER})
function(step)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix --component library)
step(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/build -G Ninja -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
  -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
step(${CMAKE_COMMAND} --build ${FOLDER}/build)
execute_process(COMMAND ${FOLDER}/build/engine WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
