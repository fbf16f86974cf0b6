#include "runtime/gl/program.h"

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/gl/shared_blocks.h"
#include "shaders/embedded.h"

namespace blush::gl {
namespace {

std::optional<std::string_view> shader_text(std::string_view file) {
    for (const EmbeddedShader& shader : embedded_shaders()) {
        if (shader.name == file) return shader.text;
    }
    return std::nullopt;
}

Status expand_into(std::string_view file, std::set<std::string_view>& seen, std::string& out) {
    const auto text = shader_text(file);
    if (!text) return Error{"shader " + std::string(file) + " is not in the library"};
    constexpr std::string_view directive = "#include \"";
    std::size_t line_number = 0;
    std::size_t at = 0;
    while (at < text->size()) {
        ++line_number;
        const std::size_t end = std::min(text->find('\n', at), text->size());
        const std::string_view line = text->substr(at, end - at);
        at = end + 1;
        if (!line.starts_with(directive)) {
            out.append(line).append("\n");
            continue;
        }
        const std::string_view name = line.substr(directive.size(), line.rfind('"') - directive.size());
        if (!seen.insert(name).second) continue;
        out += "#line 1\n";
        if (Status included = expand_into(name, seen, out); !included) return included;
        out += "#line " + std::to_string(line_number + 1) + "\n";
    }
    return Done{};
}

Result<GLuint> compile(GLenum stage, std::string_view file, std::span<const std::string_view> defines) {
    const Result<std::string> text = expand_shader(file, defines);
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

struct Field {
    const char* name;
    std::size_t offset;
};
struct Block {
    const char* name;
    std::size_t bytes;
    std::vector<Field> fields;
};

const std::vector<Block>& shared_blocks() {
    using namespace shared;
    static const std::vector<Block> blocks = {
        {"FrameBlock",
         sizeof(FrameBlock),
         {{"clip_from_world", offsetof(FrameBlock, clip_from_world)},
          {"camera_world", offsetof(FrameBlock, camera_world)},
          {"depth_from_world", offsetof(FrameBlock, depth_from_world)},
          {"sky_radiance_linear", offsetof(FrameBlock, sky_radiance_linear)},
          {"ground_radiance_linear", offsetof(FrameBlock, ground_radiance_linear)},
          {"ambient_sh[0]", offsetof(FrameBlock, ambient_sh)},
          {"environment", offsetof(FrameBlock, environment)},
          {"skin", offsetof(FrameBlock, skin)},
          {"translucency", offsetof(FrameBlock, translucency)},
          {"parts", offsetof(FrameBlock, parts)},
          {"mouth_front", offsetof(FrameBlock, mouth_front)},
          {"mouth_forward", offsetof(FrameBlock, mouth_forward)},
          {"eyes[0]", offsetof(FrameBlock, eyes)},
          {"world_from_lids", offsetof(FrameBlock, world_from_lids)},
          {"eye_data", offsetof(FrameBlock, eye_data)},
          {"lid_points[0]", offsetof(FrameBlock, lid_points)},
          {"profile[0]", offsetof(FrameBlock, profile)},
          {"counts", offsetof(FrameBlock, counts)},
          {"occlusion_poses", offsetof(FrameBlock, occlusion_poses)},
          {"occlusion_weights[0]", offsetof(FrameBlock, occlusion_weights)},
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
        {"AppearanceBlock",
         sizeof(AppearanceBlock),
         {{"wrinkle_weights[0]", offsetof(AppearanceBlock, wrinkle_weights)},
          {"wrinkle_range", offsetof(AppearanceBlock, wrinkle_range)},
          {"wrinkle_part", offsetof(AppearanceBlock, wrinkle_part)},
          {"blood", offsetof(AppearanceBlock, blood)}}},
    };
    return blocks;
}

}  // namespace

Status check_blocks(GLuint program, std::string_view file) {
    for (const Block& block : shared_blocks()) {
        const GLuint index = glGetProgramResourceIndex(program, GL_UNIFORM_BLOCK, block.name);
        if (index == GL_INVALID_INDEX) continue;
        GLint bytes = 0;
        glGetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        if (static_cast<std::size_t>(bytes) != block.bytes) {
            return Error{"shader " + std::string(file) + ": block " + block.name + " has " + std::to_string(bytes) +
                         " bytes in the driver and " + std::to_string(block.bytes) + " in C++"};
        }
        for (const Field& field : block.fields) {
            const GLuint uniform = glGetProgramResourceIndex(program, GL_UNIFORM, field.name);
            if (uniform == GL_INVALID_INDEX) continue;  // the driver may drop a field that the shader does not read
            const GLenum property = GL_OFFSET;
            GLint offset = -1;
            glGetProgramResourceiv(program, GL_UNIFORM, uniform, 1, &property, 1, nullptr, &offset);
            if (static_cast<std::size_t>(offset) != field.offset) {
                return Error{"shader " + std::string(file) + ": " + block.name + "." + field.name + " stands at byte " +
                             std::to_string(offset) + " in the driver and " + std::to_string(field.offset) + " in C++"};
            }
        }
    }
    return Done{};
}

Result<std::string> expand_shader(std::string_view file, std::span<const std::string_view> defines) {
    std::string out = "#version 450 core\n";
    for (const std::string_view define : defines) out.append("#define ").append(define).append("\n");
    out += "#define BLUSH_UNIFORM_BLOCK(Name, Binding) layout(std140, binding = Binding) uniform Name\n#line 1\n";
    std::set<std::string_view> seen;
    if (Status expanded = expand_into(file, seen, out); !expanded) return expanded.error();
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
        const Result<GLuint> shader = compile(stage, file, source.defines);
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
    if (Status blocks = check_blocks(program.name(), first); !blocks) return blocks.error();
    return Program(program.release());
}

/// What tells one program from another: names of files and outputs have no line breaks.
std::string key_of(const ProgramSource& source) {
    std::string key;
    for (const std::string_view file : {source.vertex, source.fragment, source.compute}) key.append(file).append("\n");
    for (const std::string_view define : source.defines) key.append(define).append("\n");
    for (const char* output : source.streamed_out) key.append("\n").append(output);
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
    ++compiled_;
    Result<Program> made = compile_program(source);
    if (made) programs_.emplace(key, *made);
    return made;
}

void ProgramCache::fail(Error error) {
    if (!failure_) failure_ = std::move(error);
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
