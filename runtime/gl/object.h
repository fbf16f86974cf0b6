#pragma once
/// GL objects that delete themselves (runtime/gl/deletions.h). A name of 0 is an empty handle.

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

#include "runtime/gl/deletions.h"

namespace blush::gl {

template <ObjectKind Kind>
class Object {
public:
    Object() = default;
    explicit Object(GLuint name) : name_(name) {}
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() {
        if (name_ != 0) delete_object(Kind, name_);
    }
    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

using Sampler = Object<ObjectKind::sampler>;
using Buffer = Object<ObjectKind::buffer>;
using Texture = Object<ObjectKind::texture>;
using VertexArray = Object<ObjectKind::vertex_array>;
using Framebuffer = Object<ObjectKind::framebuffer>;
using Query = Object<ObjectKind::query>;
using TransformFeedback = Object<ObjectKind::feedback>;

inline Buffer make_buffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return Buffer(name);
}
/// Immutable when `flags` is 0. A size of 0 becomes 16 bytes, since GL has no empty storage and a bound block needs
/// one.
inline Buffer make_buffer(std::size_t bytes, const void* data, GLbitfield flags = 0) {
    Buffer buffer = make_buffer();
    if (bytes == 0) data = nullptr;
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(bytes == 0 ? 16 : bytes), data, flags);
    return buffer;
}
template <class T>
Buffer make_buffer(std::span<const T> data, GLbitfield flags = 0) {
    return make_buffer(data.size_bytes(), data.data(), flags);
}
inline Texture make_texture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return Texture(name);
}
inline Sampler make_sampler() {
    GLuint name = 0;
    glCreateSamplers(1, &name);
    return Sampler(name);
}
inline VertexArray make_vertex_array() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}
inline Framebuffer make_framebuffer() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return Framebuffer(name);
}
inline Query make_query(GLenum target) {
    GLuint name = 0;
    glCreateQueries(target, 1, &name);
    return Query(name);
}
inline TransformFeedback make_transform_feedback() {
    GLuint name = 0;
    glCreateTransformFeedbacks(1, &name);
    return TransformFeedback(name);
}

}  // namespace blush::gl
