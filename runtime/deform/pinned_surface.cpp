#include "runtime/deform/pinned_surface.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/character_state.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

constexpr std::size_t vec3_bytes = sizeof(glm::vec3), vec4_bytes = sizeof(glm::vec4);
static_assert(sizeof(Pin) == 8 * sizeof(std::uint32_t) && sizeof(PinnedVertex) == 10 * sizeof(std::uint32_t),
              "pin.comp reads them as they are");

bool finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// From the file's space to that of the buffers.
Pin pin_of(std::uint32_t vertex, glm::vec3 position_face, glm::vec3 normal_face, const glm::dmat4& face_from_buffer) {
    Pin pin;
    if (!finite(position_face) || !finite(normal_face)) return pin;
    const glm::dvec3 normal = glm::transpose(glm::dmat3(face_from_buffer)) * glm::dvec3(normal_face);
    const double length = glm::length(normal);
    if (!(length > 1e-30)) return pin;
    pin.position = glm::vec3(glm::inverse(face_from_buffer) * glm::dvec4(position_face, 1));
    pin.normal = glm::vec3(normal / length);
    if (finite(pin.position) && finite(pin.normal)) pin.vertex = vertex;
    return pin;
}

}  // namespace

std::size_t PinnedSurface::bytes() const {
    if (!list) return 0;
    GLint count = 0;
    std::size_t sum = 0;
    for (const gl::Buffer* buffer : {&surface.positions, &surface.normals, &surface.tangents, &list}) {
        glGetNamedBufferParameteriv(buffer->name(), GL_BUFFER_SIZE, &count);
        sum += static_cast<std::size_t>(count);
    }
    return sum;
}

void find_pins(CharacterState& character) {
    CharacterFacts& facts = character.facts;
    facts.pinned = facts.pins_applied = false;
    character.stance.pins = 0;
    if (!character.pinned || character.pinned->positions_face.empty()) return;
    PinnedSurface& pinned = *character.pinned;
    const glm::dmat4 from_skinned = glm::translate(glm::dmat4(1), character.facts_of_face.skinned_origin);
    bool changed = pinned.number == 0;
    for (std::size_t i = 0; i < pinned.vertices.size(); ++i) {
        const std::size_t entry = pinned.entry[i];
        const Pin pin =
            pin_of(pinned.vertices[i], pinned.positions_face[i], pinned.normals_face[i],
                   entry < character.face_from_node.size() ? character.face_from_node[entry] : from_skinned);
        changed |= !(pin == pinned.pins[i]);
        pinned.pins[i] = pin;
        facts.pinned |= pin.vertex != no_vertex;
    }
    if (changed) ++pinned.number;
    if (!facts.pinned) return;
    character.stance.pins = pinned.number;
    const auto& made = pinned.made;
    facts.pins_applied = made.valid && made.number == pinned.number && made.active == character.stance.active &&
                         made.joints == character.stance.skinned_from_mesh && made.settings == character.settings;
}

void prepare_pins(CharacterState& character) {
    PinnedSurface& pinned = *character.pinned;
    gl::require_program(pinned.program, {.compute = "deform/pin.comp"});
    if (pinned.list) return;
    const std::size_t count = character.face.positions.size();
    pinned.surface = {gl::make_buffer(count * vec3_bytes, nullptr), gl::make_buffer(count * vec3_bytes, nullptr),
                      gl::make_buffer(count * vec4_bytes, nullptr)};
    const std::size_t pin_bytes = pinned.pins.size() * sizeof(Pin),
                      ring_bytes = pinned.ring.size() * sizeof(PinnedVertex);
    pinned.list = gl::make_buffer(pin_bytes + ring_bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferSubData(pinned.list.name(), static_cast<GLintptr>(pin_bytes), static_cast<GLsizeiptr>(ring_bytes),
                         pinned.ring.data());
}

void run_pins(CharacterState& character) {
    PinnedSurface& pinned = *character.pinned;
    if (!pinned.program) return;
    const SurfaceBuffers &from = *pinned.source, &to = pinned.surface;
    const std::size_t count = character.face.positions.size();
    const auto copy = [&](const gl::Buffer& source, const gl::Buffer& target, std::size_t stride) {
        glCopyNamedBufferSubData(source.name(), target.name(), 0, 0, static_cast<GLsizeiptr>(count * stride));
    };
    copy(from.positions, to.positions, vec3_bytes);
    copy(from.normals, to.normals, vec3_bytes);
    copy(from.tangents, to.tangents, vec4_bytes);
    glNamedBufferSubData(pinned.list.name(), 0, static_cast<GLsizeiptr>(pinned.pins.size() * sizeof(Pin)),
                         pinned.pins.data());
    glUseProgram(pinned.program.name());
    const auto bind = [](GLuint binding, const gl::Buffer& buffer) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
    };
    bind(BLUSH_PIN_FROM_POSITIONS_BINDING, from.positions);
    bind(BLUSH_PIN_FROM_NORMALS_BINDING, from.normals);
    bind(BLUSH_PIN_TO_POSITIONS_BINDING, to.positions);
    bind(BLUSH_PIN_TO_NORMALS_BINDING, to.normals);
    bind(BLUSH_PIN_TO_TANGENTS_BINDING, to.tangents);
    bind(BLUSH_PINS_BINDING, pinned.list);
    const auto ring_count = static_cast<GLuint>(pinned.ring.size());
    glUniform1ui(0, static_cast<GLuint>(pinned.pins.size() * sizeof(Pin) / sizeof(std::uint32_t)));
    glUniform1ui(1, ring_count);
    glDispatchCompute((ring_count + BLUSH_PIN_INVOCATIONS - 1) / BLUSH_PIN_INVOCATIONS, 1, 1);
    // Drawn as vertices, read in shaders, copied for the next frame, read back.
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    auto& made = pinned.made;
    made.valid = true;
    made.number = pinned.number;
    made.active = character.stance.active;
    made.joints = character.stance.skinned_from_mesh;
    made.settings = character.settings;
}

}  // namespace blush
