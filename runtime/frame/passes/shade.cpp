/// Draws the surfaces that the deformation left, lit, in linear HDR.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/draw/shading.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

/// A primitive as it will be drawn.
struct DrawItem {
    Permutation permutation;
    CharacterState* character = nullptr;
    const Primitive* primitive = nullptr;
    std::size_t draw_index = 0;
    bool mirrored = false;
    std::uint32_t order = 0;  ///< in its list
};

/// What shading draws, in order; kept for its memory.
struct DrawLists {
    std::vector<DrawItem> solid, cores, blended;
    std::vector<CharacterState*> far_to_near;
};

void write_frame_block(const FrameState& frame, CharacterState& character) {
    shared::FrameBlock block{};
    block.clip_from_world = frame.camera.clip_from_view * character.view_from_shading;
    block.camera_world = glm::vec4(glm::vec3(frame.eye_world - character.origin_world), 1);
    const glm::mat4 rows = glm::transpose(character.view_from_shading);
    block.depth_from_world = -rows[2];
    block.sky_radiance_linear = glm::vec4(frame.lighting->sky_radiance_linear, 0);
    block.ground_radiance_linear = glm::vec4(frame.lighting->ground_radiance_linear, 0);
    std::ranges::copy(character.ambient_sh, block.ambient_sh);
    block.millimetres_a_unit = static_cast<float>(character.millimetres_a_unit);
    const std::size_t lights = character.shader_lights.size();
    block.counts = {static_cast<int>(lights), static_cast<int>(character.index) + 1, 0, 0};
    std::ranges::copy(character.shader_lights, block.lights);
    glNamedBufferSubData(character.frame_block.name(), 0,
                         static_cast<GLsizeiptr>(offsetof(shared::FrameBlock, lights) + lights * sizeof(shared::Light)),
                         &block);
}

void cull(const Face& face, const Primitive& primitive, bool mirrored) {
    const std::int32_t material = primitive.material;
    if (material >= 0 && face.materials[static_cast<std::size_t>(material)].double_sided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(mirrored ? GL_CW : GL_CCW);
}

void draw_items(FrameState& frame, const std::vector<DrawItem>& items) {
    const CharacterState* bound = nullptr;
    const DrawItem* last = nullptr;
    for (const DrawItem& item : items) {
        CharacterState& character = *item.character;
        const gl::Program program = shade_program(frame.shared, item.permutation);
        if (!program) continue;
        use_program(frame, program);
        if (bound != &character) {
            glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, character.frame_block.name());
            character.model->bind_surface(*character.surface);
        }
        // Units follow from the permutation.
        if (bound != &character || last->permutation != item.permutation)
            bind_effects(frame, character, item.permutation);
        bound = &character;
        last = &item;
        character.draw_blocks.bind(item.draw_index);
        character.model->bind_maps(item.primitive->material, item.permutation.textures);
        cull(character.face, *item.primitive, item.mirrored);
        draw_elements(frame, character, *item.primitive);
    }
}

/// Writes the depth of blended hair where it is dense, after all that is solid.
void draw_hair_cores(FrameState& frame, const std::vector<DrawItem>& items) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    const CharacterState* bound = nullptr;
    for (const DrawItem& item : items) {
        CharacterState& character = *item.character;
        if (bound != &character) {
            glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, character.frame_block.name());
            character.model->bind_surface(*character.surface);
        }
        bound = &character;
        bind_hair_core(frame, character, *item.primitive, SeenFrom::camera);
        character.draw_blocks.bind(item.draw_index);
        cull(character.face, *item.primitive, item.mirrored);
        draw_elements(frame, character, *item.primitive);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

bool is_skin(const CharacterState& character, const Primitive& primitive) {
    const std::size_t material =
        primitive.material >= 0 ? static_cast<std::size_t>(primitive.material) : character.face.materials.size();
    return character.facts_of_face.material_kind[material] == MaterialKind::skin;
}

void list_draws(FrameState& frame, DrawLists& lists) {
    lists.solid.clear();
    lists.cores.clear();
    lists.blended.clear();
    lists.far_to_near.assign(frame.characters.begin(), frame.characters.end());
    std::ranges::sort(lists.far_to_near, [&frame](const CharacterState* a, const CharacterState* b) {
        const double far_a = glm::distance(a->centre_world, frame.eye_world);
        const double far_b = glm::distance(b->centre_world, frame.eye_world);
        return far_a > far_b || (far_a == far_b && a->index < b->index);
    });
    for (CharacterState* character : lists.far_to_near) {
        if (!character->report->on_screen) continue;
        const Face& face = character->face;
        each_drawn_primitive(*character, [&](const Primitive& primitive, std::size_t draw_index, bool mirrored) {
            if (!character->skin.on_screen && is_skin(*character, primitive) && !frame.facts.forced) return;
            const bool blended = is_blended(face, primitive);
            std::vector<DrawItem>& list = blended ? lists.blended : lists.solid;
            const DrawItem item{
                permutation_of(*character, primitive.material), character, &primitive, draw_index, mirrored,
                static_cast<std::uint32_t>(list.size())};
            list.push_back(item);
            if (blended && is_hair_card(*character, primitive)) lists.cores.push_back(item);
        });
    }
    // Only depth is written of cores: in any order, each program once.
    std::ranges::sort(lists.cores, {}, [](const DrawItem& item) {
        return std::pair(is_textured_hair(*item.character, *item.primitive), item.order);
    });
    // Solid surfaces come in any order: each program is used once, and for it the nearest character first.
    std::ranges::sort(lists.solid, [](const DrawItem& a, const DrawItem& b) {
        return a.permutation < b.permutation || (a.permutation == b.permutation && a.order > b.order);
    });
}

/// The scene's colour and what effects have shading write beside it.
constexpr std::size_t most_targets = 1 + std::tuple_size_v<decltype(FrameResources::targets)>;

/// Attaches what shading writes and clears it.
void bind_targets(FrameState& frame, const FrameGraph& graph) {
    const ViewFrame& view = *frame.view;
    const GLuint framebuffer = frame.common->scene.name();
    const FrameResources& resources = frame.resources;
    const std::size_t count = 1 + resources.target_count;
    std::array<GLenum, most_targets> buffers{};
    const std::array<float, 4> nothing{};
    for (std::size_t i = 0; i < most_targets; ++i) {
        const auto attachment = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
        glNamedFramebufferTexture(framebuffer, attachment, i < count ? graph[resources.to_resolve[i].from].handle : 0,
                                  0);
        buffers[i] = attachment;
    }
    glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(count), buffers.data());
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, graph[resources.scene_depth].handle, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(view.width), static_cast<GLsizei>(view.height));
    glm::vec4 behind = view.backdrop == Backdrop::color ? view.background_linear : glm::vec4(0);
    const float opacity = std::clamp(behind.a, 0.0F, 1.0F);
    behind = glm::vec4(glm::vec3(behind) * opacity, opacity);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &behind.x);
    for (std::size_t i = 1; i < count; ++i) {
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, static_cast<GLint>(i), nothing.data());
    }
    if (view.host_depth != HostDepth::none) return;  // the host's depth was read into it
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
}

void write_blocks(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        if (!character->report->on_screen) continue;
        write_frame_block(frame, *character);
        write_effects_block(frame, *character);
        if (frame.picture == 0) write_draw_blocks(*character);
    }
}

void shade(FrameState& frame, const FrameGraph& graph) {
    DrawLists& lists = frame.own<DrawLists>();
    bind_targets(frame, graph);
    write_blocks(frame);
    forget_program(frame);

    glEnable(GL_DEPTH_TEST);
    draw_items(frame, lists.solid);
    draw_hair_cores(frame, lists.cores);
    glDepthFunc(GL_LEQUAL);  // a core is shaded where its own depth stands
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    // What blends over skin takes its share of the light that scatters, and adds none.
    for (GLuint i = 1; i < most_targets; ++i) glBlendFunci(i, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_ADD);
    glDepthMask(GL_FALSE);
    draw_items(frame, lists.blended);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

/// What shading reads of the frame, whoever does it.
void declare_reads(FrameState& frame) {
    for (const CharacterState* character : frame.characters) {
        frame.graph.reads(character->resources.positions)
            .reads(character->resources.normals)
            .reads(character->resources.tangents);
    }
    for (const Effect* effect : effects()) {
        if (effect->shading != nullptr && effect->shading->reads != nullptr) effect->shading->reads(frame);
    }
}

/// Every program that the lists need; a failure is reported and draws nothing.
void require_programs(FrameState& frame, const DrawLists& lists) {
    for (const std::vector<DrawItem>* items : {&lists.solid, &lists.blended}) {
        for (const DrawItem& item : *items) shade_program(frame.shared, item.permutation);
    }
    if (!lists.cores.empty()) require_hair_cores(frame, SeenFrom::camera);
}

}  // namespace

void declare_shade(FrameState& frame) {
    DrawLists& lists = frame.own<DrawLists>();
    list_draws(frame, lists);
    require_programs(frame, lists);
    FrameGraph& graph = frame.graph;
    graph.pass("shade", [&frame](const FrameGraph& made) { shade(frame, made); });
    declare_reads(frame);
    for (std::size_t i = 0; i < frame.resources.resolve_count; ++i) graph.writes(frame.resources.to_resolve[i].from);
    if (frame.view->host_depth == HostDepth::none) {
        graph.writes(frame.resources.scene_depth);
    } else {
        graph.modifies(frame.resources.scene_depth);
    }
}

void declare_host_shading(FrameState& frame) {
    const ResourceId host = frame.graph.import_framebuffer("the host's shading", 0, {});
    frame.graph.pass("hand over", [&frame](const FrameGraph&) { write_blocks(frame); });
    declare_reads(frame);
    frame.graph.writes(host);
    frame.graph.present(host);
}

}  // namespace blush
