#pragma once
/// Programs from the embedded shaders, each compiled once for a context.

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/result.h"
#include "runtime/gl/object.h"
#include "shaders/embedded.h"

namespace blush::gl {

/// A program that its context's ProgramCache keeps: a name, free to copy. 0 is no program. Uniforms are whatever the
/// last user left: whoever draws sets all that the program has.
class Program {
public:
    Program() = default;
    explicit Program(GLuint name) : name_(name) {}
    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

/// A field of a uniform block and where C++ has it.
struct BlockField {
    std::string name;  ///< as the driver names it: "lights[0].radiance_linear"
    std::size_t offset = 0;
};
struct BlockLayout {
    std::string name;
    std::size_t bytes = 0;
    std::vector<BlockField> fields;
};

/// What a program's files leave open, for whoever makes the program to say.
struct Insertions {
    /// `#insert NAME` is this text, whose own directives count. A name without text stands for none.
    std::map<std::string, std::string, std::less<>> texts;
    /// `#call HOOK(arguments)` is a call of each of these functions, in order, and CALLS_HOOK is defined.
    std::map<std::string, std::vector<std::string>, std::less<>> calls;
    std::vector<EmbeddedShader> files;  ///< beside those of the library
    std::vector<BlockLayout> blocks;    ///< checked beside those of shared.glsl
};

struct ProgramSource {
    std::string_view vertex = {};                    ///< file name in shaders/
    std::string_view fragment = {};                  ///< empty for stream-out
    std::span<const std::string_view> defines = {};  ///< permutation, such as "HAS_NORMAL_DELTAS"
    std::span<const char* const> streamed_out = {};  ///< vertex outputs captured, each into a buffer of its own
    std::string_view compute = {};                   ///< file name of a compute program, which has no other stage
    const Insertions* insertions = nullptr;          ///< null: none
};

/// The programs of one context, which all that draws in it share: a second character of the same kind compiles nothing.
/// A Device has one, and makes it the current one of its thread where it makes its context current.
class ProgramCache {
public:
    ProgramCache() = default;
    ProgramCache(const ProgramCache&) = delete;
    ProgramCache& operator=(const ProgramCache&) = delete;
    ~ProgramCache();

    static ProgramCache* current();
    void make_current();
    /// Deletes every program; their context is current. Without this they go when it goes.
    void clear();

    std::size_t size() const { return programs_.size(); }
    /// How often a program was compiled since the cache was made.
    std::uint64_t compiled() const { return compiled_; }
    /// Keeps the first error until it is taken; none of what is postponed.
    void fail(Error error);
    bool failed() const { return failure_.has_value(); }
    std::optional<Error> take_failure();
    /// Until unlimited(), no more than so many programs are compiled: further ones are postponed, which is no failure.
    void limit(std::uint64_t most);
    void unlimited();
    bool postponed() const { return postponed_; }
    /// As make_program().
    Result<Program> get(const ProgramSource& source);

private:
    std::map<std::string, Program, std::less<>> programs_;
    std::uint64_t compiled_ = 0;
    std::optional<std::uint64_t> compile_until_;  ///< compiled_ may come to this
    bool postponed_ = false;
    std::optional<Error> failure_;
};

/// The program of these sources in the current cache. Where it is not there yet: compiles and links, and checks every
/// uniform block of shared.glsl against its C++ struct. An error names the file, the permutation and the driver's log:
/// it is a defect of the library or of the driver, never of the user's data.
Result<Program> make_program(const ProgramSource& source);

/// For programs that are made when a frame first needs them, where nobody can take an error: a failure is kept for the
/// frame to report (ProgramCache::take_failure), and `program` stays none. Returns whether there is a program.
bool require_program(Program& program, const ProgramSource& source);

/// Compares each uniform block of shared.glsl, and each of `further`, that `program` has, as the driver laid it out,
/// with its C++ struct. Error: the block or field that differs; `file` names the shader in it. make_program() asks
/// this.
Status check_blocks(GLuint program, std::string_view file, std::span<const BlockLayout> further = {});

/// The text of a shader with `#include "file"` (each file once), `#insert NAME` and `#call HOOK(arguments)` resolved,
/// and #version and the defines in front. Error: a file that does not exist.
Result<std::string> expand_shader(std::string_view file, std::span<const std::string_view> defines,
                                  const Insertions* insertions = nullptr);

}  // namespace blush::gl
