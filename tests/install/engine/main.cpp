// Renders one frame headless through the installed library, into the file named. Exit status 0 when a face is to be
// seen.

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>

#include "drawing.h"
#include "runtime/files/face_file.h"
#include "runtime/files/output_file.h"
#include "runtime/version.h"

namespace {

int failed(const blush::Error& error) {
    std::fprintf(stderr, "engine: %s\n", error.message.c_str());
    return 1;
}

std::string text(const blush::Version& version) {
    return std::to_string(version.major) + "." + std::to_string(version.minor) + "." + std::to_string(version.patch);
}

/// The engine's own: whatever its macros make of it, the library must not come to call it.
glm::mat4 own_camera() {
    return glm::perspective(0.5F, 1.0F, 0.1F, 10.0F) *
           glm::lookAt(glm::vec3(0, 0, 3), glm::vec3(0), glm::vec3(0, 1, 0));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return failed({"usage: engine picture.png"});
    if (text({}) != PACKAGE_VERSION) return failed({"the headers say that they are " + text({})});
    if (blush::version() != blush::Version{}) return failed({"the library is " + text(blush::version())});
    const volatile float used = own_camera()[0][0];
    static_cast<void>(used);

    const blush::Result<blush::Device> device = blush::Device::headless();
    if (!device) return failed(device.error());
    // A file that does not exist reaches the loaders, so that they are linked too.
    if (blush::load_face("there is no such file.glb")) return failed({"a missing file was loaded"});
    const blush::Result<blush::Image> image = draw_pyramid(*device);
    if (!image) return failed(image.error());
    std::set<unsigned> colours;
    for (std::size_t i = 0; i + 3 < image->bytes.size(); i += 4) {
        colours.insert((unsigned{image->bytes[i]} << 16) | (unsigned{image->bytes[i + 1]} << 8) | image->bytes[i + 2]);
    }
    constexpr std::size_t fewest_colours = 10;
    if (colours.size() < fewest_colours) return failed({"the picture is blank"});
    if (const blush::Status written = blush::write_image(argv[1], *image); !written) return failed(written.error());
    std::printf("engine: blush %s, %zu colours\n", text(blush::version()).c_str(), colours.size());
    return 0;
}
