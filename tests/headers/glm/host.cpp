// A host that asks GLM for something else than the library does. Exit status 0: both mean the same by every public
// type.

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "all_public_headers.h"
#include "tests/headers/glm/library.h"

namespace {

using namespace blush;

/// Of the host's own making, so that its copies of these functions are in the program.
Mat4 camera_of_host() {
    return Mat4(glm::perspective(0.5F, 1.0F, 1.0F, 3.0F)) *
           Mat4(glm::lookAt(glm::vec3(0, 0, 2), glm::vec3(0), glm::vec3(0, 1, 0)));
}

bool wrong(const char* what) {
    std::printf("host: %s\n", what);
    return true;
}

}  // namespace

int main() {
    bool failed = false;
    if (test::layout() != test::layout_of_library()) failed = wrong("a struct has another layout");
    if (test::handed_on(Vec2(1, 2)) != Vec2(1, 2) || test::handed_on(Vec3(1, 2, 3)) != Vec3(1, 2, 3) ||
        test::handed_on(Vec4(1, 2, 3, 4)) != Vec4(1, 2, 3, 4) || test::handed_on(DVec3(1, 2, 3)) != DVec3(1, 2, 3) ||
        test::handed_on(Quat{1, 2, 3, 4}) != Quat{1, 2, 3, 4}) {
        failed = wrong("a vector arrives changed");
    }
    if (!test::reads({.translation = {}, .rotation = {1, 2, 3, 4}, .scale = {5, 6, 7}})) failed = wrong("a rotation");
    const Mat4 right_handed = Mat4(glm::perspectiveRH_NO(0.5F, 1.0F, 1.0F, 3.0F)) *
                              glm::lookAtRH(Vec3(0, 0, 2), Vec3(0, 0, 0), Vec3(0, 1, 0));
    volatile float of_host = camera_of_host()[2][2];
    static_cast<void>(of_host);
    if (test::camera_of_library() != right_handed) failed = wrong("the library's camera is the host's");
    return failed ? 1 : 0;
}
