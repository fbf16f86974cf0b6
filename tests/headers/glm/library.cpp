#include "tests/headers/glm/library.h"

#include <glm/gtc/matrix_transform.hpp>

namespace blush::test {

std::vector<std::size_t> layout_of_library() { return layout(); }

Vec2 handed_on(Vec2 v) { return v; }
Vec3 handed_on(Vec3 v) { return v; }
Vec4 handed_on(Vec4 v) { return v; }
DVec3 handed_on(DVec3 v) { return v; }
Quat handed_on(Quat q) { return q; }

bool reads(const Transform& transform) {
    const Quat& q = transform.rotation;
    return q.w == 1 && q.x == 2 && q.y == 3 && q.z == 4 && transform.scale == glm::vec3(5, 6, 7);
}

Mat4 camera_of_library() {
    return glm::perspective(0.5F, 1.0F, 1.0F, 3.0F) * glm::lookAt(glm::vec3(0, 0, 2), glm::vec3(0), glm::vec3(0, 1, 0));
}

}  // namespace blush::test
