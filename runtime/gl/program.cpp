#include "runtime/gl/program.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/gl/shared_blocks.h"
#include "shaders/embedded.h"

namespace blush::gl {
namespace {

/// Resolves directives of one shader.
class Expansion {
public:
    explicit Expansion(const Insertions& insertions) : insertions_(insertions) {}

    Status file(std::string_view name, std::string& out) {
        const auto text = text_of(name);
        if (!text) return Error{"shader " + std::string(name) + " is not in the library"};
        return lines(*text, out);
    }

private:
    std::optional<std::string_view> text_of(std::string_view file) const {
        for (const std::span<const EmbeddedShader> shaders :
             {embedded_shaders(), std::span<const EmbeddedShader>(insertions_.files)}) {
            for (const EmbeddedShader& shader : shaders) {
                if (shader.name == file) return shader.text;
            }
        }
        return std::nullopt;
    }

    Status lines(std::string_view text, std::string& out) {
        std::size_t line_number = 0;
        std::size_t at = 0;
        while (at < text.size()) {
            ++line_number;
            const std::size_t end = std::min(text.find('\n', at), text.size());
            const std::string_view line = text.substr(at, end - at);
            at = end + 1;
            bool other_lines = false;
            if (Status resolved = resolve(line, out, other_lines); !resolved) return resolved;
            if (other_lines) out += "#line " + std::to_string(line_number + 1) + "\n";
        }
        return Done{};
    }

    /// Appends what a line stands for; other_lines: it was more than itself.
    Status resolve(std::string_view line, std::string& out, bool& other_lines) {
        constexpr std::string_view include = "#include \"", insert = "#insert ", call = "#call ";
        if (line.starts_with(include)) {
            const std::string_view name = line.substr(include.size(), line.rfind('"') - include.size());
            if (!seen_.emplace(name).second) return Done{};
            other_lines = true;
            out += "#line 1\n";
            return file(name, out);
        }
        if (line.starts_with(insert)) {
            const auto found = insertions_.texts.find(line.substr(insert.size()));
            if (found == insertions_.texts.end()) return Done{};
            other_lines = true;
            out += "#line 1\n";
            return lines(found->second, out);
        }
        if (line.starts_with(call)) {
            const std::string_view hook = line.substr(call.size(), line.find('(') - call.size());
            const auto found = insertions_.calls.find(hook);
            if (found == insertions_.calls.end()) return Done{};
            other_lines = true;
            for (const std::string& function : found->second)
                out.append("    ").append(function).append(line.substr(line.find('('))).append(";\n");
            return Done{};
        }
        out.append(line).append("\n");
        return Done{};
    }

    const Insertions& insertions_;
    std::set<std::string, std::less<>> seen_;
};

Result<GLuint> compile(GLenum stage, std::string_view file, const ProgramSource& of) {
    const Result<std::string> text = expand_shader(file, of.defines, of.insertions);
    if (!text) return text.error();
    const GLuint shader = glCreateShader(stage);
    const char* source = text->c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::array<char, 4096> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteShader(shader);
    return Error{"shader " + std::string(file) + " does not compile: " + log.data()};
}

const std::vector<BlockLayout>& shared_blocks() {
    using namespace shared;
    static const std::vector<BlockLayout> blocks = {
        {"FrameBlock",
         sizeof(FrameBlock),
         {{"clip_from_world", offsetof(FrameBlock, clip_from_world)},
          {"camera_world", offsetof(FrameBlock, camera_world)},
          {"depth_from_world", offsetof(FrameBlock, depth_from_world)},
          {"sky_radiance_linear", offsetof(FrameBlock, sky_radiance_linear)},
          {"ground_radiance_linear", offsetof(FrameBlock, ground_radiance_linear)},
          {"ambient_sh[0]", offsetof(FrameBlock, ambient_sh)},
          {"millimetres_a_unit", offsetof(FrameBlock, millimetres_a_unit)},
          {"counts", offsetof(FrameBlock, counts)},
          {"lights[0].position_world", offsetof(FrameBlock, lights)},
          {"lights[0].radiance_linear", offsetof(FrameBlock, lights) + offsetof(Light, radiance_linear)},
          {"lights[0].cone_world", offsetof(FrameBlock, lights) + offsetof(Light, cone_world)},
          {"lights[0].shadow", offsetof(FrameBlock, lights) + offsetof(Light, shadow)},
          {"lights[0].shadow_depth", offsetof(FrameBlock, lights) + offsetof(Light, shadow_depth)},
          {"lights[0].shadow_from_world", offsetof(FrameBlock, lights) + offsetof(Light, shadow_from_world)},
          {"lights[1].position_world", offsetof(FrameBlock, lights) + sizeof(Light)}}},
        {"DrawBlock",
         sizeof(DrawBlock),
         {{"world_from_mesh", offsetof(DrawBlock, world_from_mesh)},
          {"world_normal_from_mesh", offsetof(DrawBlock, world_normal_from_mesh)}}},
        {"MaterialBlock",
         sizeof(MaterialBlock),
         {{"base_color_linear", offsetof(MaterialBlock, base_color_linear)},
          {"emissive_linear", offsetof(MaterialBlock, emissive_linear)},
          {"metallic_roughness_normal_occlusion", offsetof(MaterialBlock, metallic_roughness_normal_occlusion)},
          {"alpha", offsetof(MaterialBlock, alpha)},
          {"uv_rows[0]", offsetof(MaterialBlock, uv_rows)},
          {"uv_sets", offsetof(MaterialBlock, uv_sets)},
          {"emissive_uv_set", offsetof(MaterialBlock, emissive_uv_set)}}},
    };
    return blocks;
}

Status check_block(GLuint program, std::string_view file, const BlockLayout& block) {
    const GLuint index = glGetProgramResourceIndex(program, GL_UNIFORM_BLOCK, block.name.c_str());
    if (index == GL_INVALID_INDEX) return Done{};
    GLint bytes = 0;
    glGetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
    if (static_cast<std::size_t>(bytes) != block.bytes) {
        return Error{"shader " + std::string(file) + ": block " + block.name + " has " + std::to_string(bytes) +
                     " bytes in the driver and " + std::to_string(block.bytes) + " in C++"};
    }
    for (const BlockField& field : block.fields) {
        const GLuint uniform = glGetProgramResourceIndex(program, GL_UNIFORM, field.name.c_str());
        if (uniform == GL_INVALID_INDEX) continue;  // the driver may drop a field that the shader does not read
        const GLenum property = GL_OFFSET;
        GLint offset = -1;
        glGetProgramResourceiv(program, GL_UNIFORM, uniform, 1, &property, 1, nullptr, &offset);
        if (static_cast<std::size_t>(offset) != field.offset) {
            return Error{"shader " + std::string(file) + ": " + block.name + "." + field.name + " stands at byte " +
                         std::to_string(offset) + " in the driver and " + std::to_string(field.offset) + " in C++"};
        }
    }
    return Done{};
}

}  // namespace

Status check_blocks(GLuint program, std::string_view file, std::span<const BlockLayout> further) {
    for (const std::span<const BlockLayout> blocks : {std::span<const BlockLayout>(shared_blocks()), further}) {
        for (const BlockLayout& block : blocks) {
            if (Status agrees = check_block(program, file, block); !agrees) return agrees;
        }
    }
    return Done{};
}

Result<std::string> expand_shader(std::string_view file, std::span<const std::string_view> defines,
                                  const Insertions* insertions) {
    const Insertions none;
    const Insertions& inserted = insertions != nullptr ? *insertions : none;
    std::string out = "#version 450 core\n";
    for (const std::string_view define : defines) out.append("#define ").append(define).append("\n");
    for (const auto& [hook, functions] : inserted.calls) {
        out += "#define CALLS_";
        for (const char letter : hook) out += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        out += "\n";
    }
    out += "#define BLUSH_UNIFORM_BLOCK(Name, Binding) layout(std140, binding = Binding) uniform Name\n#line 1\n";
    Expansion expansion(inserted);
    if (Status expanded = expansion.file(file, out); !expanded) return expanded.error();
    return out;
}

namespace {

/// A program that is being made: deleted where that fails.
class NewProgram {
public:
    NewProgram() : name_(glCreateProgram()) {}
    ~NewProgram() {
        if (name_ != 0) glDeleteProgram(name_);
    }
    NewProgram(const NewProgram&) = delete;
    NewProgram& operator=(const NewProgram&) = delete;
    GLuint name() const { return name_; }
    GLuint release() { return std::exchange(name_, 0); }

private:
    GLuint name_;
};

Result<Program> compile_program(const ProgramSource& source) {
    NewProgram program;
    const auto attach = [&](GLenum stage, std::string_view file) -> Status {
        const Result<GLuint> shader = compile(stage, file, source);
        if (!shader) return shader.error();
        glAttachShader(program.name(), *shader);
        glDeleteShader(*shader);  // deleted with the program
        return Done{};
    };
    const bool computes = !source.compute.empty();
    const std::string_view first = computes ? source.compute : source.vertex;
    if (Status attached = attach(computes ? GL_COMPUTE_SHADER : GL_VERTEX_SHADER, first); !attached) {
        return attached.error();
    }
    if (!source.fragment.empty()) {
        if (Status fragment = attach(GL_FRAGMENT_SHADER, source.fragment); !fragment) return fragment.error();
    }
    if (!source.streamed_out.empty()) {
        glTransformFeedbackVaryings(program.name(), static_cast<GLsizei>(source.streamed_out.size()),
                                    source.streamed_out.data(), GL_SEPARATE_ATTRIBS);
    }
    glLinkProgram(program.name());
    GLint ok = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) {
        std::array<char, 4096> log{};
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        return Error{"program of " + std::string(first) + " does not link: " + log.data()};
    }
    const std::span<const BlockLayout> further = source.insertions != nullptr
                                                     ? std::span<const BlockLayout>(source.insertions->blocks)
                                                     : std::span<const BlockLayout>();
    if (Status blocks = check_blocks(program.name(), first, further); !blocks) return blocks.error();
    return Program(program.release());
}

/// What tells one program from another: names of files and outputs have no line breaks.
std::string key_of(const ProgramSource& source) {
    std::string key;
    for (const std::string_view file : {source.vertex, source.fragment, source.compute}) key.append(file).append("\n");
    for (const std::string_view define : source.defines) key.append(define).append("\n");
    for (const char* output : source.streamed_out) key.append("\n").append(output);
    if (source.insertions == nullptr) return key;
    for (const auto& [name, text] : source.insertions->texts) key.append("\n").append(name).append("\n").append(text);
    for (const auto& [hook, functions] : source.insertions->calls) {
        for (const std::string& function : functions) key.append("\n").append(function);
    }
    return key;
}

thread_local ProgramCache* current_cache = nullptr;

}  // namespace

ProgramCache::~ProgramCache() {
    if (current_cache == this) current_cache = nullptr;
}

ProgramCache* ProgramCache::current() { return current_cache; }
void ProgramCache::make_current() { current_cache = this; }

void ProgramCache::clear() {
    for (const auto& [key, program] : programs_) glDeleteProgram(program.name());
    programs_.clear();
}

Result<Program> ProgramCache::get(const ProgramSource& source) {
    const std::string key = key_of(source);
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    if (compile_until_ && compiled_ >= *compile_until_) {
        postponed_ = true;
        return Error{"no more programs may be compiled now"};
    }
    ++compiled_;
    Result<Program> made = compile_program(source);
    if (made) programs_.emplace(key, *made);
    return made;
}

void ProgramCache::limit(std::uint64_t most) {
    compile_until_ = compiled_ + most;
    postponed_ = false;
}

void ProgramCache::unlimited() {
    compile_until_.reset();
    postponed_ = false;
}

void ProgramCache::fail(Error error) {
    if (!failure_ && !postponed_) failure_ = std::move(error);
}

std::optional<Error> ProgramCache::take_failure() { return std::exchange(failure_, std::nullopt); }

Result<Program> make_program(const ProgramSource& source) {
    if (current_cache == nullptr) return Error{"no device is current on this thread"};
    return current_cache->get(source);
}

bool require_program(Program& program, const ProgramSource& source) {
    if (program) return true;
    Result<Program> made = make_program(source);
    if (!made) {
        if (current_cache != nullptr) current_cache->fail(made.error());
        return false;
    }
    program = *std::move(made);
    return true;
}

}  // namespace blush::gl
