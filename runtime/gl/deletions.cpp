#include "runtime/gl/deletions.h"

#include <epoxy/gl.h>

namespace blush::gl {
namespace {

thread_local Deletions* deferred_to = nullptr;

void delete_now(ObjectKind kind, GLuint name) {
    switch (kind) {
        case ObjectKind::buffer:
            glDeleteBuffers(1, &name);
            break;
        case ObjectKind::texture:
            glDeleteTextures(1, &name);
            break;
        case ObjectKind::vertex_array:
            glDeleteVertexArrays(1, &name);
            break;
        case ObjectKind::framebuffer:
            glDeleteFramebuffers(1, &name);
            break;
        case ObjectKind::query:
            glDeleteQueries(1, &name);
            break;
        case ObjectKind::feedback:
            glDeleteTransformFeedbacks(1, &name);
            break;
        case ObjectKind::sampler:
            glDeleteSamplers(1, &name);
            break;
    }
}

}  // namespace

void Deletions::add(ObjectKind kind, std::uint32_t name) {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back({kind, name});
}

void Deletions::carry_out() {
    const std::scoped_lock lock(mutex_);
    for (const Waiting& object : waiting_) delete_now(object.kind, object.name);
    waiting_.clear();
}

DeletionScope::DeletionScope(Deletions* to) : before_(deferred_to) { deferred_to = to; }
DeletionScope::~DeletionScope() { deferred_to = before_; }

void delete_object(ObjectKind kind, std::uint32_t name) {
    if (deferred_to != nullptr) {
        deferred_to->add(kind, name);
    } else {
        delete_now(kind, name);
    }
}

}  // namespace blush::gl
