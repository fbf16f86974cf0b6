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
if(BLUSH_SANITIZE)
  target_compile_options(blush_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(blush_options INTERFACE -fsanitize=address,undefined)
endif()
