#include "runtime/measure/sphere_study.h"
#include "runtime/measure/portrait.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/character_state.h"
#include "runtime/offscreen.h"

namespace blush {
namespace {

constexpr std::uint32_t side_pixels = 96, every = 3;
constexpr double half_extent = 1.05;

Face sphere() {
    Face face;
    face.path = "sphere";
    constexpr std::uint32_t columns = 96, rows = 48;
    constexpr double pi = std::numbers::pi;
    for (std::uint32_t y = 0; y <= rows; ++y) {
        for (std::uint32_t x = 0; x <= columns; ++x) {
            const double theta = pi * y / rows, phi = 2 * pi * x / columns;
            const glm::dvec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            face.positions.emplace_back(n);
            face.normals.emplace_back(n);
            face.tangents.emplace_back(static_cast<float>(std::cos(phi)), 0.0F, static_cast<float>(-std::sin(phi)),
                                       1.0F);
            face.uv0.emplace_back(0.0F);
            face.uv1.emplace_back(0.0F);
        }
    }
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            face.indices.insert(face.indices.end(), {a, c, d, a, d, b});
        }
    }
    Material material;
    material.name = "skin";
    material.metallic = 0;
    material.roughness = 0.5F;
    face.materials.push_back(material);
    Primitive primitive;
    primitive.vertex_count = static_cast<std::uint32_t>(face.positions.size());
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size());
    primitive.material = 0;
    face.primitives.push_back(primitive);
    face.meshes.push_back({"sphere", 0, 1});
    Node node;
    node.mesh = 0;
    face.nodes.push_back(node);
    return face;
}

struct Drawn {
    Portrait character;
    Offscreen offscreen;
    Lighting lighting;
    ViewFrame view;
    std::function<glm::dvec3(glm::dvec3)> exact;

    void draw() {
        view.lighting = &lighting;
        character.draw(view);
        glFinish();
    }
};

std::shared_ptr<Drawn> make_drawn(const Device& device, const Lighting& lighting, const SphereVariant& variant) {
    Result<Portrait> character = Portrait::create(device, sphere());
    Result<Offscreen> offscreen = Offscreen::create(device, side_pixels, side_pixels, Output::linear_hdr);
    if (!character || !offscreen) return nullptr;
    for (const auto& [setting, value] : {std::pair<std::string, std::string>("scattering.method", "off"),
                                         {"shadows.method", "off"},
                                         {"reflection.roughness", std::to_string(sphere_roughness)},
                                         {variant.setting, variant.value}}) {
        if (Status set = character->set(setting, value); !set) return nullptr;
    }
    auto drawn =
        std::make_shared<Drawn>(Drawn{*std::move(character), *std::move(offscreen), lighting, {}, variant.exact});
    drawn->view = drawn->offscreen.view();
    drawn->view.samples = 1;
    // From so far that every pixel is seen along -Z.
    constexpr float far_away = 1e4F;
    constexpr auto half = static_cast<float>(half_extent);
    drawn->view.camera.view_from_world = glm::lookAtRH(glm::vec3(0, 0, far_away), glm::vec3(0), glm::vec3(0, 1, 0));
    drawn->view.camera.clip_from_view = glm::orthoRH_NO(-half, half, -half, half, far_away - 2, far_away + 2);
    return drawn;
}

Variant::Error error_of(Drawn& drawn) {
    drawn.draw();
    const Image image = drawn.offscreen.read();
    Variant::Error error;
    double sum = 0, count = 0;
    for (std::uint32_t y = 0; y < side_pixels; y += every) {
        for (std::uint32_t x = 0; x < side_pixels; x += every) {
            // Rows of a picture run down.
            const glm::dvec2 at =
                half_extent * glm::dvec2(2 * (x + 0.5) / side_pixels - 1, 1 - 2 * (y + 0.5) / side_pixels);
            const double r2 = glm::dot(at, at);
            if (r2 > 0.97 * 0.97) continue;
            const glm::dvec3 exact = drawn.exact({at, std::sqrt(1 - r2)});
            for (glm::length_t c = 0; c < 3; ++c) {
                const std::size_t i = 4 * (std::size_t{y} * side_pixels + x) + static_cast<std::size_t>(c);
                const double off = std::abs(static_cast<double>(image.floats[i]) - exact[c]);
                error.mean += off;
                error.worst = std::max(error.worst, off);
                sum += exact[c];
                ++count;
            }
        }
    }
    if (sum > 0) {
        error.mean *= 100 / sum;
        error.worst *= 100 * count / sum;
    }
    return error;
}

}  // namespace

std::vector<Study> sphere_study(const Device& device, const std::string& name, const std::string& reference,
                                const Lighting& lighting, const std::vector<SphereVariant>& variants) {
    Study study{name, reference, "% of the mean light", {}, nullptr};
    for (const SphereVariant& wanted : variants) {
        const std::shared_ptr<Drawn> drawn = make_drawn(device, lighting, wanted);
        if (!drawn) return {};
        Variant variant;
        variant.label = wanted.setting + "=" + wanted.value;
        variant.is_default = wanted.is_default;
        variant.work = std::to_string(side_pixels) + "x" + std::to_string(side_pixels) + " pixels";
        variant.run = [drawn] { drawn->draw(); };
        variant.error = [drawn] { return error_of(*drawn); };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

}  // namespace blush
