/// blush evaluate: the deformed mesh as numbers.

#include <algorithm>
#include <cmath>
#include <iostream>

#include "rig/controls/head_and_eyes.h"
#include "rig/deform/deform.h"
#include "runtime/files/face_file.h"
#include "runtime/files/output_file.h"
#include "runtime/files/rig_description_file.h"
#include "runtime/settings.h"
#include "tools/blush/assets.h"
#include "tools/blush/commands.h"
#include "tools/blush/performing.h"
#include "tools/blush/stage.h"

namespace blush::tool {
namespace {

struct Options {
    std::string face, on = "cpu", output, space = "mesh";
    PoseOptions pose;
    PerformOptions perform;
    bool check_finite = false;
};

/// The first vertex with a NaN or an infinity, as --check-finite reports it.
std::optional<NotFinite> find_not_finite(const Scene::Surface& surface, const std::string& pass) {
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        for (glm::length_t c = 0; c < 3; ++c) {
            const std::string place = "vertex " + std::to_string(v) + " component " + std::to_string(c);
            if (!std::isfinite(surface.positions[v][c]))
                return NotFinite{pass, "positions", place, surface.positions[v][c]};
            if (!std::isfinite(surface.normals[v][c])) return NotFinite{pass, "normals", place, surface.normals[v][c]};
        }
    }
    return std::nullopt;
}

Result<Scene::Surface> evaluate_on_cpu(const Face& face, const Options& options) {
    const Result<RigDescription> description = find_rig_description(face, options.pose.rig_file);
    if (!description) return description.error();
    const Rig rig(face, *description);
    std::vector<float> controls(rig.control_names().size());
    if (Status set = options.pose.apply(face, rig, controls); !set) return set.error();
    EffectSettings settings;
    const auto apply_setting = [&](std::string_view name, std::string_view value) { return settings.set(name, value); };
    if (Status set = options.pose.apply_settings(apply_setting); !set) return set.error();
    Pose pose = rig.rest_pose();
    if (Status performed = perform_moment(face, rig, options.perform, controls, pose); !performed) {
        return performed.error();
    }
    rig.evaluate(controls, pose);
    Deformer deformer(face);
    DeformedSurface surface;
    deformer.deform(pose.weights, static_cast<NormalMethod>(settings.choice("normals", "source")), surface);
    return Scene::Surface{std::move(surface.positions), std::move(surface.normals), std::move(surface.tangents)};
}

/// Moves each mesh to where its first node stands in the world at rest.
void place_in_world(const Face& face, Scene::Surface& surface) {
    const std::vector<glm::dmat4> placed = rest_placement(face);
    const std::vector<glm::mat4> world(placed.begin(), placed.end());
    for (const Primitive& primitive : face.primitives) {
        const auto node = std::ranges::find(face.nodes, static_cast<std::int32_t>(primitive.mesh), &Node::mesh);
        if (node == face.nodes.end()) continue;
        const glm::mat4& matrix = world[static_cast<std::size_t>(node - face.nodes.begin())];
        for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
            surface.positions[v] = glm::vec3(matrix * glm::vec4(surface.positions[v], 1));
            surface.normals[v] =
                normalized_or(glm::transpose(glm::inverse(glm::mat3(matrix))) * surface.normals[v], surface.normals[v]);
        }
    }
}

int evaluate(const Options& options) {
    const Result<Face> face = load_face(face_path(options.face));
    if (!face) return fail(face.error());
    Scene::Surface surface;
    if (options.on == "cpu") {
        Result<Scene::Surface> evaluated = evaluate_on_cpu(*face, options);
        if (!evaluated) return fail(evaluated.error());
        surface = *std::move(evaluated);
    } else {
        Result<std::unique_ptr<Stage>> stage = make_stage(options.face, options.pose);
        if (!stage) return fail(stage.error());
        Portrait& character = (*stage)->character;
        if (Status performed = perform_moment(character.face(), character.rig(), options.perform, character.controls(),
                                              character.pose());
            !performed) {
            return fail(performed.error());
        }
        surface = character.read_deformed();
    }
    if (options.check_finite) {
        FrameReport report;
        report.not_finite = find_not_finite(surface, "evaluate on " + options.on);
        if (Status good = finite(report); !good) return fail(good.error());
    }
    if (options.space == "world") place_in_world(*face, surface);
    if (Status written = write_surface(options.output, surface.positions, surface.normals, face->indices); !written) {
        return fail(written.error());
    }
    std::cout << options.output << ": " << surface.positions.size() << " vertices, " << face->indices.size() / 3
              << " triangles\n";
    return 0;
}

}  // namespace

void add_evaluate(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand(
        "evaluate", "Write the deformed mesh: every vertex of the file, all primitives in file order, before joints");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").required();
    options->pose.add_to(command);
    options->perform.add_moment_to(command);
    command.option("--on", &options->on, "Where to compute").one_of({"cpu", "gpu"}).shows_default();
    command.option("--space", &options->space, "mesh: the mesh's own space; world: after its node's place in the scene")
        .one_of({"mesh", "world"})
        .shows_default();
    command.option("-o,--output", &options->output, "A .ply or .obj file").required();
    command.flag("--check-finite", options->check_finite, "Fail on any NaN or infinity");
    command.runs([options] { return evaluate(*options); });
}

}  // namespace blush::tool
