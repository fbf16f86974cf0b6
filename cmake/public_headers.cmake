# What an engine may include: installed by cmake/install.cmake, compiled one by one by tests/headers/.
file(GLOB BLUSH_PUBLIC_HEADERS CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/rig/*.h)
foreach(header appearance_file camera character device effect_settings face_appearance face_file frame_report import_head lighting lighting_file occlusion_file offscreen output_file performance_file picture_file rig_description_file view wrinkle_file)
  list(APPEND BLUSH_PUBLIC_HEADERS runtime/${header}.h)
endforeach()
foreach(header performer sandbox script)
  list(APPEND BLUSH_PUBLIC_HEADERS runtime/script/${header}.h)
endforeach()
