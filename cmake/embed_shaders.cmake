# cmake -DOUTPUT=file.cpp -DROOT=shaders -DFILES=a;b -P embed_shaders.cmake
# A string literal may not be longer than 64 KiB in all compilers, so a file that grows past it must be split.
set(entries "")
foreach(file IN LISTS FILES)
  file(RELATIVE_PATH name ${ROOT} ${file})
  file(READ ${file} text)
  string(LENGTH "${text}" length)
  if(length GREATER 60000)
    message(FATAL_ERROR "${name} is ${length} bytes long; a shader file may have 60000")
  endif()
  string(APPEND entries "    {\"${name}\", R\"_glsl_(${text})_glsl_\"},\n")
endforeach()
file(WRITE ${OUTPUT}
"#include \"shaders/embedded.h\"\n#include <array>\n\nnamespace blush {\nnamespace {\nconstexpr auto shaders = std::to_array<EmbeddedShader>({\n${entries}});\n}\nstd::span<const EmbeddedShader> embedded_shaders() { return shaders; }\n}\n")
