#include "runtime/measure/studies.h"

#include <array>

namespace blush {

std::span<const Studied> studied() {
    static constexpr std::array<Studied, 26> all = {{
        {"deformation", studies::deformation},
        {"normals", studies::normals},
        {"skinning", studies::skinning},
        {"pinning", studies::pinning},
        {"wrinkle_baking", studies::wrinkle_baking},
        {"wrinkles", studies::wrinkles},
        {"appearance_baking", studies::appearance_baking},
        {"blood", studies::blood},
        {"shadows", studies::shadows},
        {"translucency", studies::translucency},
        {"host_shadows", nullptr,
         "what a host's map is off by is the host's; tests hold what it hides to a light that is not there"},
        {"reflection", studies::reflection},
        {"environment", studies::environment},
        {"probes", nullptr,
         "nine coefficients are what a host gives; what they leave of a room, the study of environment shows"},
        {"occlusion", nullptr,
         "frames by rays, to compare its own with, are not made; tests hold coefficients and shading to their twins"},
        {"parts", studies::parts},
        {"scattering", studies::scattering},
        {"depth_of_field", studies::depth_of_field},
        {"bloom", studies::bloom},
        {"exposure", studies::exposure},
        {"velocities", nullptr, "velocities show in no picture: what is made of them is measured as antialiasing"},
        {"multisampling", studies::multisampling},
        {"antialiasing", studies::antialiasing},
        {"supersampling", studies::supersampling},
        {"reprojection", studies::reprojection},
        {"grain", studies::grain},
    }};
    return all;
}

}  // namespace blush
