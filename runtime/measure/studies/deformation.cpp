/// Every path of the deformation, on the GPU and the CPU, against the sum in double precision.

#include <cstdio>

#include "rig/deform/deform.h"
#include "runtime/measure/errors.h"
#include "runtime/measure/studies.h"
#include "runtime/measure/study_scene.h"

namespace blush {
namespace {

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

    const auto on_gpu = [&](std::string_view method) {
        Variant variant;
        variant.label = "deformation.method=" + std::string(method);
        variant.is_default = method == "sparse";
        variant.run = [scene, method] {
            if (method == "passes") {
                scene->stream_out().add_targets_in_passes(NormalMethod::authored);
            } else {
                scene->stream_out().add_targets_sparse(NormalMethod::authored);
            }
            glFinish();
        };
        variant.run();
        variant.work = work_of(scene->stream_out(), active);
        variant.error = [scene, method, millimetres_a_unit] {
            const Status chosen = scene->character.set("deformation.method", method);
            return chosen
                       ? distance_error<glm::dvec3>(scene->read().positions, scene->exact.positions, millimetres_a_unit)
                       : Variant::Error{};
        };
        study.variants.push_back(std::move(variant));
    };
    on_gpu("sparse");
    on_gpu("passes");

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

}  // namespace

std::vector<Study> studies::deformation(const Device& device, const Face& face, double millimetres_a_unit, bool quick) {
    std::vector<Study> result;
    for (const std::size_t count : study_counts(face, quick)) {
        result.push_back(study_of(device, face, millimetres_a_unit, count));
    }
    return result;
}

}  // namespace blush
