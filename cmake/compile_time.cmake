# What keeps a cold build short.

# Code that reads files and words, and tests: -O3 takes a tenth to two fifths longer to compile, and what they do is over in
# no time. What computes (rig, the runtime, bakers, make_face, benches) keeps -O3; so does what filters a map or a mesh on
# loading.
set(quick_targets blush_load blush_command_line blush)
if(BLUSH_BUILD_TESTS)
  list(APPEND quick_targets test_rig test_load test_script test_bake test_gl test_make_face test_viewer test_cli test_stability
    test_golden test_headers)
endif()
foreach(target IN LISTS quick_targets)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endforeach()
foreach(file environment wrinkle_bake gltf/missing_attributes)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/runtime/files/${file}.cpp TARGET_DIRECTORY blush_load
    PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
endforeach()

if(BLUSH_PRECOMPILED_HEADERS)
  foreach(target blush_rig blush_load blush_runtime blush_measure blush_script blush_make_face blush)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory>
      <optional> <span> <string> <string_view> <variant> <vector> <glm/glm.hpp>)
  endforeach()
  # Compiled for another processor than its precompiled headers.
  set_source_files_properties(${PROJECT_SOURCE_DIR}/rig/deform/simd/avx2.cpp TARGET_DIRECTORY blush_rig
    PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endif()
