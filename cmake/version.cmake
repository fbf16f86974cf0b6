# BLUSH_VERSION, as runtime/version.h has it: an engine sees that header, and CMake asks for the same numbers.
set(version_header ${CMAKE_CURRENT_LIST_DIR}/../runtime/version.h)
set(BLUSH_VERSION "")
foreach(part MAJOR MINOR PATCH)
  file(STRINGS ${version_header} line REGEX "^#define BLUSH_VERSION_${part} [0-9]+$")
  string(REGEX REPLACE ".* " "" number "${line}")
  list(APPEND BLUSH_VERSION ${number})
endforeach()
list(JOIN BLUSH_VERSION . BLUSH_VERSION)
# A new number configures anew.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${version_header})
