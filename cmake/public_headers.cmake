# What an engine may include: installed by cmake/install.cmake, compiled one by one by tests/headers/.
file(GLOB_RECURSE BLUSH_PUBLIC_HEADERS CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/rig/*.h)
# Bodies of kernels, for the files that are compiled for one instruction set.
list(FILTER BLUSH_PUBLIC_HEADERS EXCLUDE REGEX "^rig/deform/simd/")
foreach(header camera character depth_convention device face_asset frame_report lighting offscreen scene settings surface surface_point version view files/appearance_file files/face_appearance files/face_file files/import/import_head files/lighting_file files/occlusion_file files/output_file files/performance/performance_file files/picture_file files/rig_description_file files/wrinkle_file)
  list(APPEND BLUSH_PUBLIC_HEADERS runtime/${header}.h)
endforeach()
foreach(header performer sandbox script)
  list(APPEND BLUSH_PUBLIC_HEADERS runtime/script/${header}.h)
endforeach()
