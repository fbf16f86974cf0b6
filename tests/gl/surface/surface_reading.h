#pragma once
/// Reads what a character publishes of its surface.

#include <epoxy/gl.h>

#include <vector>

#include "runtime/scene.h"

namespace blush::test {

template <class Vector>
std::vector<Vector> read_buffer(const VertexBuffer& buffer) {
    std::vector<Vector> values(buffer.count);
    if (!values.empty()) {
        glGetNamedBufferSubData(buffer.name, 0, static_cast<GLsizeiptr>(values.size() * sizeof(Vector)), values.data());
    }
    return values;
}

/// The final surface, in the buffers' own space.
inline Scene::Surface read_published(const PublishedSurface& surface) {
    return {read_buffer<Vec3>(surface.positions), read_buffer<Vec3>(surface.normals),
            read_buffer<Vec4>(surface.tangents)};
}

}  // namespace blush::test
