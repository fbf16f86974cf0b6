#pragma once
/// GL objects that delete themselves. A name of 0 is an empty handle.

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

namespace blush::gl {

template <void (*Delete)(GLuint)>
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
        if (name_ != 0) Delete(name_);
    }
    GLuint name() const { return name_; }
    /// Leaves the object to the caller.
    GLuint release() { return std::exchange(name_, 0); }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_query(GLuint name) { glDeleteQueries(1, &name); }
inline void delete_transform_feedback(GLuint name) { glDeleteTransformFeedbacks(1, &name); }

inline void delete_sampler(GLuint name) { glDeleteSamplers(1, &name); }

using Sampler = Object<delete_sampler>;
using Buffer = Object<delete_buffer>;
using Texture = Object<delete_texture>;
using VertexArray = Object<delete_vertex_array>;
using Framebuffer = Object<delete_framebuffer>;
using Query = Object<delete_query>;
using TransformFeedback = Object<delete_transform_feedback>;

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
