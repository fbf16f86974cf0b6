#include "runtime/antialias/antialias_passes.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "rig/antialias/mlaa_table.h"
#include "rig/antialias/smaa_tables.h"
#include "rig/antialias/weights.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

static_assert(BLUSH_ORTHOGONAL_DISTANCES == orthogonal_distances && BLUSH_DIAGONAL_DISTANCES == diagonal_distances &&
              BLUSH_MLAA_DISTANCES == mlaa_distances && BLUSH_SEARCH_TABLE_RIGHT == search_table_right &&
              BLUSH_FEWEST_DIAGONAL_EDGES == fewest_diagonal_edges);

/// Of size_pixels in antialias_tiles.vert.
constexpr GLint size_location = 8;

gl::Texture upload(GLenum internal_format, GLenum format, int width, int height, const std::uint8_t* texels) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, internal_format, width, height);
    GLint alignment = 0, unpack_buffer = 0;
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack_buffer);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, format, GL_UNSIGNED_BYTE, texels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack_buffer));
    return texture;
}
gl::Texture upload(const AreaImage& areas) {
    return upload(GL_RG8, GL_RG, areas.width, areas.height, areas.near_far.data());
}

gl::Sampler sampler(GLint filter, GLint wrap) {
    gl::Sampler made = gl::make_sampler();
    glSamplerParameteri(made.name(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(made.name(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(made.name(), GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(made.name(), GL_TEXTURE_WRAP_T, wrap);
    return made;
}

Status compile(gl::Program& program, std::string_view vertex, std::string_view fragment,
               std::initializer_list<std::string_view> defines = {}) {
    std::vector<std::string_view> wanted;
    std::ranges::copy_if(defines, std::back_inserter(wanted), [](std::string_view define) { return !define.empty(); });
    Result<gl::Program> made = gl::make_program({.vertex = vertex, .fragment = fragment, .defines = wanted});
    if (!made) return made.error();
    program = *std::move(made);
    return Done{};
}

void bind(GLuint unit, GLuint texture, const gl::Sampler& sampler) {
    glBindTextureUnit(unit, texture);
    glBindSampler(unit, sampler.name());
}

}  // namespace

Result<AntialiasPasses> AntialiasPasses::create() {
    AntialiasPasses made;
    constexpr std::array<std::string_view, 3> sources = {"EDGES_FROM_LUMA", "EDGES_FROM_COLOR", "EDGES_FROM_DEPTH"};
    Status status = Done{};
    for (std::size_t on = 0; on < 2; ++on) {
        for (std::size_t source = 0; status && source < sources.size(); ++source) {
            status = compile(made.edges_[source][on], "screen.vert", "antialias/antialias_edges.frag",
                             {sources[source], on != 0 ? "PREDICATED" : ""});
        }
        for (std::size_t straight = 0; status && straight < 2; ++straight) {
            status =
                compile(made.blend_[on][straight], "antialias/antialias_tiles.vert", "antialias/antialias_blend.frag",
                        {on != 0 ? "DECODE_SRGB" : "", straight != 0 ? "STRAIGHT_ALPHA" : ""});
        }
        if (status)
            status = compile(made.smaa_weights_[on], "antialias/antialias_tiles.vert", "antialias/smaa_weights.frag",
                             {on != 0 ? "DIAGONALS" : ""});
    }
    if (status) status = compile(made.mlaa_weights_, "antialias/antialias_tiles.vert", "antialias/mlaa_weights.frag");
    if (!status) return status.error();
    Result<gl::Program> list_tiles = gl::make_program({.compute = "antialias/antialias_tiles.comp"});
    if (!list_tiles) return list_tiles.error();
    made.list_tiles_ = *std::move(list_tiles);
    made.orthogonal_areas_ = upload(smaa_areas().orthogonal);
    made.diagonal_areas_ = upload(smaa_areas().diagonal);
    made.mlaa_areas_ = upload(mlaa_areas());
    made.search_ = upload(GL_R8, GL_RED, search_table_width, search_table_height, search_table().data());
    made.nearest_ = sampler(GL_NEAREST, GL_CLAMP_TO_EDGE);
    made.bilinear_with_border_ = sampler(GL_LINEAR, GL_CLAMP_TO_BORDER);  // its colour is 0 from the start
    made.no_attributes_ = gl::make_vertex_array();
    made.source_ = gl::make_framebuffer();
    return made;
}

void AntialiasPasses::draw(const gl::Program& program, const PassTarget& target) const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(target.width), static_cast<GLsizei>(target.height));
    glUseProgram(program.name());
    glBindVertexArray(no_attributes_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void AntialiasPasses::draw_tiles(const gl::Program& program, const EdgeTiles& tiles, const PassTarget& target) const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(target.width), static_cast<GLsizei>(target.height));
    glUseProgram(program.name());
    glProgramUniform2f(program.name(), size_location, static_cast<float>(target.width),
                       static_cast<float>(target.height));
    glBindVertexArray(no_attributes_.name());
    tiles.draw();
}

namespace {

void clear(const PassTarget& target) {
    constexpr std::array<GLfloat, 4> nothing{};
    glClearNamedFramebufferfv(target.framebuffer, GL_COLOR, 0, nothing.data());
}

}  // namespace

void AntialiasPasses::edges(GLuint color, GLuint depth, const EdgeSettings& settings, const PictureMeaning& meaning,
                            EdgeTiles& tiles, const PassTarget& target) const {
    const bool from_depth = settings.source == EdgeSource::depth;
    const bool predicated = settings.predication.on && !from_depth;
    const gl::Program& program = edges_[static_cast<std::size_t>(settings.source)][predicated ? 1 : 0];
    bind(BLUSH_AA_COLOR_UNIT, color, nearest_);
    bind(BLUSH_AA_DEPTH_UNIT, depth, nearest_);
    glProgramUniform2f(program.name(), 0, from_depth ? settings.depth_threshold : settings.threshold,
                       settings.contrast_factor);
    glProgramUniform3f(program.name(), 1, settings.predication.depth_threshold, settings.predication.scale,
                       settings.predication.strength);
    glProgramUniform2i(program.name(), 2, meaning.transfer == Transfer::linear ? 1 : 0,
                       static_cast<GLint>(meaning.alpha));
    draw(program, target);
    GLint edges = 0;
    glGetNamedFramebufferAttachmentParameteriv(target.framebuffer, GL_COLOR_ATTACHMENT0,
                                               GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &edges);
    bind(BLUSH_AA_EDGES_UNIT, static_cast<GLuint>(edges), bilinear_with_border_);
    glUseProgram(list_tiles_.name());
    tiles.list(target.width, target.height);
}

void AntialiasPasses::smaa_weights(GLuint edges, const SmaaSettings& settings, SubsampleSlices slices,
                                   const EdgeTiles& tiles, const PassTarget& target) const {
    const gl::Program& program = smaa_weights_[settings.diagonal_search_steps > 0 ? 1 : 0];
    clear(target);
    bind(BLUSH_AA_EDGES_UNIT, edges, bilinear_with_border_);
    bind(BLUSH_AA_AREAS_UNIT, orthogonal_areas_.name(), nearest_);
    bind(BLUSH_AA_DIAGONAL_AREAS_UNIT, diagonal_areas_.name(), nearest_);
    bind(BLUSH_AA_SEARCH_UNIT, search_.name(), nearest_);
    glProgramUniform2i(program.name(), 0, settings.search_steps, settings.diagonal_search_steps);
    glProgramUniform1f(program.name(), 1, settings.corner_rounding);
    glProgramUniform4i(program.name(), 2, slices.x, slices.y, slices.z, slices.w);
    draw_tiles(program, tiles, target);
}

void AntialiasPasses::mlaa_weights(GLuint edges, const MlaaSettings& settings, const EdgeTiles& tiles,
                                   const PassTarget& target) const {
    clear(target);
    bind(BLUSH_AA_EDGES_UNIT, edges, bilinear_with_border_);
    bind(BLUSH_AA_AREAS_UNIT, mlaa_areas_.name(), nearest_);
    glProgramUniform1i(mlaa_weights_.name(), 0, std::min(settings.search_steps, largest_mlaa_search_steps));
    draw_tiles(mlaa_weights_, tiles, target);
}

void AntialiasPasses::blend(GLuint color, GLuint weights, const PictureMeaning& meaning, const EdgeTiles& tiles,
                            const PassTarget& target) const {
    const auto width = static_cast<GLint>(target.width), height = static_cast<GLint>(target.height);
    glNamedFramebufferTexture(source_.name(), GL_COLOR_ATTACHMENT0, color, 0);
    glBlitNamedFramebuffer(source_.name(), target.framebuffer, 0, 0, width, height, 0, 0, width, height,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    const bool decode = meaning.transfer == Transfer::srgb && meaning.blend_in_linear_light;
    bind(BLUSH_AA_COLOR_UNIT, color, nearest_);
    bind(BLUSH_AA_WEIGHTS_UNIT, weights, nearest_);
    draw_tiles(blend_[decode ? 1 : 0][meaning.alpha == AlphaMeaning::straight ? 1 : 0], tiles, target);
}

}  // namespace blush
