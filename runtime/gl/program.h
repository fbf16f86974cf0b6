#pragma once
/// Programs from the embedded shaders.

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "rig/result.h"
#include "runtime/gl/object.h"

namespace blush::gl {

inline void delete_program(GLuint name) { glDeleteProgram(name); }
using Program = Object<delete_program>;

struct ProgramSource {
    std::string_view vertex = {};                    ///< file name in shaders/
    std::string_view fragment = {};                  ///< empty for stream-out
    std::span<const std::string_view> defines = {};  ///< permutation, such as "HAS_NORMAL_DELTAS"
    std::span<const char* const> streamed_out = {};  ///< vertex outputs captured, each into a buffer of its own
    std::string_view compute = {};                   ///< file name of a compute program, which has no other stage
};

/// Compiles and links, and checks every uniform block of shared.glsl against its C++ struct. An error names the file,
/// the permutation and the driver's log: it is a defect of the library or of the driver, never of the user's data.
Result<Program> make_program(const ProgramSource& source);

/// For programs that are made when a frame first needs them, where nobody can take an error: a failure is a defect, and
/// ends the process with the sentence that make_program() would give.
void require_program(Program& program, const ProgramSource& source);

/// Compares each uniform block of shared.glsl that `program` has, as the driver laid it out, with its C++ struct.
/// Error: the block or field that differs; `file` names the shader in it. make_program() asks this.
Status check_blocks(GLuint program, std::string_view file);

/// The text of a shader with `#include "file"` resolved (each file once) and #version and the defines in front.
/// Error: a file that does not exist.
Result<std::string> expand_shader(std::string_view file, std::span<const std::string_view> defines);

}  // namespace blush::gl
