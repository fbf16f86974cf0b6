# cmake --install: the libraries with their public headers (component library), the program with its assets (component
# program). `find_package(blush)` then gives blush::runtime, which brings everything else.
include(CMakePackageConfigHelpers)
include(public_headers)

install(TARGETS blush_options blush_shaders blush_rig blush_load blush_script blush_runtime EXPORT blushTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
set_target_properties(blush_options PROPERTIES EXPORT_NAME options)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/blush)
install(EXPORT blushTargets NAMESPACE blush:: DESTINATION ${package_folder} COMPONENT library)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/blushConfig.cmake.in ${PROJECT_BINARY_DIR}/blushConfig.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/blushConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/blushConfig.cmake ${PROJECT_BINARY_DIR}/blushConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT library)

# The folders are kept, so that `#include "runtime/character.h"` reads the same inside and outside of the project.
foreach(header IN LISTS BLUSH_PUBLIC_HEADERS)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION include/blush/${folder} COMPONENT library)
endforeach()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT library)

install(TARGETS blush RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/assets/ DESTINATION share/blush COMPONENT program PATTERN "*.copied" EXCLUDE)
