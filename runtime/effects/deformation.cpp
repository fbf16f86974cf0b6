/// Deformation: blend shapes by stream-out (jimenez-2012, 7.6 and 8.3).

#include <array>
#include <cstdio>

#include "rig/deform/deform.h"
#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/measure/errors.h"
#include "runtime/measure/study_scene.h"

namespace blush {
namespace {

enum Method : std::uint8_t { sparse, passes };
constexpr std::array<std::string_view, 2> method_choices = {"sparse", "passes"};
constexpr std::array<Setting, 1> settings = {{
    {"method",
     "sparse: one stream-out pass over the sparse deltas of the active targets; passes: repeated stream-out passes of "
     "four dense targets each, as published",
     method_choices, sparse},
}};

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (character.facts.active_targets == 0) {
        return {.on = false, .reason = "no target has a weight other than zero: the rest surface is drawn as it is"};
    }
    if (character.facts.deformation_current) {
        return {.on = false, .reason = "weights and settings are those of an earlier frame, whose result still stands"};
    }
    return {.on = true, .reason = "some target has a weight other than zero"};
}

void deform(CharacterState& character) {
    StreamOut& stream_out = character.stream_out;
    stream_out.set_active(character.active());
    if (character.settings.choice("deformation", "method") == passes) {
        stream_out.add_targets_in_passes(character.normal_method);
    } else {
        stream_out.add_targets_sparse(character.normal_method);
    }
    character.report->deltas_added = stream_out.last_work().deltas;
    ++character.report->stream_outs;
}

void declare(FrameState& frame) {
    const auto deform_all = [&frame](const FrameGraph&) {
        for (CharacterState* character : frame.characters) {
            if (!character->on(deformation_effect)) continue;
            deform(*character);
            frame.report.deltas_added += character->report->deltas_added;
        }
    };
    frame.graph.pass("deform", deform_all);
    for (const CharacterState* character : frame.characters) {
        if (!character->on(deformation_effect)) continue;
        frame.graph.writes(character->resources.positions)
            .writes(character->resources.normals)
            .writes(character->resources.tangents);
    }
}

std::string work_of(StreamOut& stream_out, std::size_t active) {
    const StreamOut::Work work = stream_out.last_work();
    return std::to_string(active) + " targets, " + std::to_string(work.passes) +
           (work.passes == 1 ? " pass, " : " passes, ") + std::to_string(work.deltas) + " deltas";
}

Study study_of(const Device& device, const Face& face, double millimetres_a_unit, std::size_t active) {
    std::shared_ptr<StudyScene> scene = make_study_scene(device, face, active);
    Study study{std::to_string(active) + " of " + std::to_string(face.targets.size()) + " targets active, " +
                    std::to_string(face.positions.size()) + " vertices",
                "the sum in double precision on the CPU (rig/deform/deform_exact.h)",
                "mm",
                {},
                scene};
    if (!scene) return study;

    const auto on_gpu = [&](std::uint8_t method) {
        Variant variant;
        variant.label = "deformation.method=" + std::string(method_choices[method]);
        variant.is_default = method == sparse;
        variant.run = [scene, method] {
            if (method == passes) {
                scene->stream_out().add_targets_in_passes(NormalMethod::authored);
            } else {
                scene->stream_out().add_targets_sparse(NormalMethod::authored);
            }
            glFinish();
        };
        variant.run();
        variant.work = work_of(scene->stream_out(), active);
        variant.error = [scene, method, millimetres_a_unit] {
            const Status chosen = scene->character.set("deformation.method", method_choices[method]);
            return chosen
                       ? distance_error<glm::dvec3>(scene->read().positions, scene->exact.positions, millimetres_a_unit)
                       : Variant::Error{};
        };
        study.variants.push_back(std::move(variant));
    };
    on_gpu(sparse);
    on_gpu(passes);

    const auto on_cpu = [&](const std::string& label, const PackOptions& options) {
        auto deformer = std::make_shared<Deformer>(scene->character.face(), options);
        auto surface = std::make_shared<DeformedSurface>();
        const PackedTargets& packed = deformer->path().targets();
        char megabytes[32];
        std::snprintf(megabytes, sizeof megabytes, "%.2f MB", static_cast<double>(packed.bytes()) * 1e-6);
        Variant variant;
        variant.label = "on the CPU, one thread" + label;
        variant.work = std::to_string(active) + " targets, all of them packed in " + megabytes +
                       (packed.dropped == 0 ? "" : ", " + std::to_string(packed.dropped) + " deltas dropped");
        variant.run = [scene, deformer, surface] {
            deformer->deform(scene->character.controls().first(scene->character.face().targets.size()),
                             NormalMethod::authored, *surface);
        };
        variant.error = [scene, surface, millimetres_a_unit] {
            return distance_error<glm::dvec3>(surface->positions, scene->exact.positions, millimetres_a_unit);
        };
        study.variants.push_back(std::move(variant));
    };
    on_cpu("", {});
    on_cpu(", 16-bit deltas", {.precision = DeltaPrecision::sixteen_bits});
    // A pixel shows 0.24 mm where a head of 240 mm fills 1,000 of them: a twentieth of that.
    constexpr double dropped_mm = 0.01;
    on_cpu(", deltas up to 0.01 mm dropped", {.drop_below = static_cast<float>(dropped_mm / millimetres_a_unit)});

    auto topology = std::make_shared<NormalTopology>(scene->character.face());
    auto plain = std::make_shared<DeformedSurface>();
    Variant loops;
    loops.label = "on the CPU, plain loops";
    loops.work = std::to_string(active) + " targets";
    loops.run = [scene, topology, plain] {
        *plain = deform_plain(scene->character.face(), *topology,
                              scene->character.controls().first(scene->character.face().targets.size()),
                              NormalMethod::authored);
    };
    loops.error = [scene, plain, millimetres_a_unit] {
        return distance_error<glm::dvec3>(plain->positions, scene->exact.positions, millimetres_a_unit);
    };
    study.variants.push_back(std::move(loops));
    return study;
}

std::vector<Study> studies(const Device& device, const Face& face, double millimetres_a_unit, bool quick) {
    std::vector<Study> result;
    for (const std::size_t count : study_counts(face, quick)) {
        result.push_back(study_of(device, face, millimetres_a_unit, count));
    }
    return result;
}

void leave(Face& /*face*/) {}

void scale(Face& face, float factor) {
    for (glm::vec3& position : face.positions) position *= factor;
    for (Target& target : face.targets) {
        for (glm::vec3& delta : target.position_deltas) delta *= factor;
    }
    for (Node& node : face.nodes) node.rest.translation *= factor;
}

constexpr std::array<HardCase, 8> hard_cases = {{
    {"weight that is not a number", "counts as zero: the rest surface", leave, std::numeric_limits<float>::quiet_NaN()},
    {"infinite weight", "counts as zero: the rest surface", leave, std::numeric_limits<float>::infinity()},
    {"weight of 1e30", "limited: every value stays finite", leave, 1e30F},
    {"weight of -1", "the opposite move", leave, -1.0F},
    {"smallest denormal weight", "a move too small to see", leave, std::numeric_limits<float>::denorm_min()},
    {"head of a micrometre", "normals keep their direction", [](Face& face) { scale(face, 1e-6F); }},
    {"head of a million units", "nothing overflows", [](Face& face) { scale(face, 1e6F); }},
    {"target that moves nothing", "costs nothing and changes nothing",
     [](Face& face) {
         face.targets.push_back({});
         face.targets.back().name = "hardNothing";
     }},
}};

}  // namespace

const Effect deformation_effect = {
    .name = "deformation",
    .what = "blend shapes move the surface",
    .settings = settings,
    .character_need = need,
    .declare = declare,
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
