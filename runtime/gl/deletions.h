#pragma once
/// Deleting GL objects in the context that they are of, and in no other.

#include <cstdint>
#include <mutex>
#include <vector>

namespace blush::gl {

enum class ObjectKind : std::uint8_t { buffer, texture, vertex_array, framebuffer, query, feedback, sampler };

/// Objects whose owners went while another context, or none, was current: they wait for their own.
class Deletions {
public:
    void add(ObjectKind kind, std::uint32_t name);
    /// Deletes them; their context is current.
    void carry_out();

private:
    struct Waiting {
        ObjectKind kind;
        std::uint32_t name;
    };
    std::mutex mutex_;  // owners may go on any thread
    std::vector<Waiting> waiting_;
};

/// While it lasts, objects of gl/object.h that this thread destroys are added to `to`; null: deleted at once.
class DeletionScope {
public:
    explicit DeletionScope(Deletions* to);
    ~DeletionScope();
    DeletionScope(const DeletionScope&) = delete;
    DeletionScope& operator=(const DeletionScope&) = delete;

private:
    Deletions* before_;
};

/// Deletes an object, or has it wait where a DeletionScope says so.
void delete_object(ObjectKind kind, std::uint32_t name);

}  // namespace blush::gl
