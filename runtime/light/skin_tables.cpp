#include "runtime/light/skin_tables.h"

#include "rig/light/skin_reflectance.h"

namespace blush {
namespace {

gl::Texture make_table(GLsizei width, GLsizei height, GLenum internal, GLenum format,
                       const std::vector<float>& values) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, internal, width, height);
    glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, format, GL_FLOAT, values.data());
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

const SkinTables& skin_tables(FrameState& frame) {
    auto& tables = frame.shared_own<SkinTables>();
    if (!tables.beckmann) {
        // The numbers are computed once in a process.
        static const std::vector<float> beckmann = beckmann_table(BLUSH_BECKMANN_TABLE_SIDE);
        static const std::vector<float> albedo =
            specular_albedo_table(BLUSH_SPECULAR_ALBEDO_COLUMNS, BLUSH_SPECULAR_ALBEDO_ROWS);
        tables.beckmann = make_table(BLUSH_BECKMANN_TABLE_SIDE, BLUSH_BECKMANN_TABLE_SIDE, GL_R32F, GL_RED, beckmann);
        tables.specular_albedo =
            make_table(BLUSH_SPECULAR_ALBEDO_COLUMNS, BLUSH_SPECULAR_ALBEDO_ROWS, GL_RG32F, GL_RG, albedo);
    }
    return tables;
}

}  // namespace blush
