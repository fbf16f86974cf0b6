# What an engine may include: installed by cmake/install.cmake, compiled one by one by tests/headers/.
file(GLOB BLUSH_PUBLIC_HEADERS CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/rig/*.h)
foreach(header appearance_file camera character device effect_settings face_file frame_report import_head lighting lighting_file
               offscreen output_file performance_file view)
  list(APPEND BLUSH_PUBLIC_HEADERS runtime/${header}.h)
endforeach()
