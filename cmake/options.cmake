# Compiler settings of every target of this project; not installed.
add_library(blush_options INTERFACE)
target_compile_options(blush_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wnull-dereference -Wdouble-promotion -Wimplicit-fallthrough -Werror
  # The CPU path must give the bits of the GPU path, whose shaders are `precise`: no fused multiply-add on either side.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports impossible paths through std::variant and std::vector after inlining (GCC bugs 105562, 105329, 107852).
  target_compile_options(blush_options INTERFACE -Wno-null-dereference -Wno-maybe-uninitialized -Wno-restrict
    -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()
# GLM's functions leave no symbol of ours for a host to share: its copies obey its own GLM_FORCE_* macros.
target_compile_definitions(blush_options INTERFACE GLM_FORCE_INLINE)
# A plug-in that links the libraries exports nothing of them, and no unique symbol keeps it mapped after dlclose.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(blush_options INTERFACE -fno-gnu-unique)
endif()
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
if(BLUSH_SANITIZE)
  set(sanitizers_address address,undefined)
  set(sanitizers_thread thread)
  set(sanitizers ${sanitizers_${BLUSH_SANITIZE}})
  if(NOT sanitizers)
    message(FATAL_ERROR "BLUSH_SANITIZE is ${BLUSH_SANITIZE}; it may be address or thread")
  endif()
  target_compile_options(blush_options INTERFACE -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(blush_options INTERFACE -fsanitize=${sanitizers})
endif()
