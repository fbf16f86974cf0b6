# cmake -DBUILD=... -DSOURCE=... -DFOLDER=... -DCXX=... -DLAUNCHER=... -DBUILD_TYPE=... -DSANITIZE=... -DFACE=... -P install_and_use.cmake
# Installs the library into a folder of its own, then configures, builds and runs a project that finds it there.
file(REMOVE_RECURSE ${FOLDER})
function(step)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${BUILD} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix --component library)
file(GLOB_RECURSE license ${FOLDER}/prefix/share/*/LICENSE)
if(NOT license)
  message(FATAL_ERROR "the licence is not installed")
endif()
step(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/build -G Ninja -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
  -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
step(${CMAKE_COMMAND} --build ${FOLDER}/build)
step(${FOLDER}/build/engine ${FOLDER}/frame.png)
step(${FOLDER}/build/engine_other_glm ${FOLDER}/frame_other_glm.png)
step(${CMAKE_COMMAND} -E compare_files ${FOLDER}/frame.png ${FOLDER}/frame_other_glm.png)
step(${FOLDER}/build/in_a_room ${FACE} ${FOLDER}/in_a_room.png)
# A sanitizer's runtime has to come first in a program and stays in it.
if(NOT SANITIZE)
  step(${FOLDER}/build/engine_with_plugin ${FOLDER}/build/libplugin.so)
endif()
