#include "runtime/frame/warm_up.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/antialias/last_frame.h"
#include "runtime/draw/shading.h"
#include "runtime/frame/frame.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 16;  // pixels

/// What predicates tell apart.
struct Situation {
    bool posed = false;    ///< every control half way, else none
    bool far_off = false;  ///< smaller than anything that depends on size, else larger
    bool unlit = false;    ///< without lights, else with those that there are
};
constexpr std::uint32_t situations_a_character = 8;

Situation situation(std::uint32_t which) { return {(which & 1) != 0, (which & 2) != 0, (which & 4) != 0}; }

/// Of a view, as far as it has come.
struct WarmUp {
    std::shared_ptr<FrameState> frame;
    gl::Texture color, velocity;
    gl::Framebuffer framebuffer, velocities;
    std::uint32_t next = 0;  ///< situation, counted over all subjects
    /// What situations showed: of the view, and of each subject beside it.
    std::vector<Shading> of_view;
    std::vector<std::vector<Shading>> of_subjects;
    std::uint32_t compiled = 0;
};

/// Characters that no other one before them is like.
std::vector<CharacterState*> subjects(const SceneState& scene) {
    std::vector<CharacterState*> result;
    for (CharacterState* character : scene.characters) {
        const bool known = std::ranges::any_of(result, [character](const CharacterState* other) {
            return other->model == character->model && other->settings == character->settings;
        });
        if (!known) result.push_back(character);
    }
    return result;
}

/// Keeps what a character's owner has set, for a scope.
class Kept {
public:
    explicit Kept(CharacterState& character)
        : character_(character), controls_(character.controls), pose_(character.pose) {}
    ~Kept() {
        character_.controls = std::move(controls_);
        character_.pose = std::move(pose_);
    }
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;

private:
    CharacterState& character_;
    std::vector<float> controls_;
    Pose pose_;
};

/// A camera before the character's middle; `step`: a little to the side, so that a second frame moves.
Camera camera_for(const CharacterState& character, bool far_off, double step) {
    const double away = std::max(4 * character.radius_world, 1e-6);
    const glm::dvec3 eye = character.centre_world + glm::dvec3(step * away, 0, away);
    Camera camera;
    camera.view_from_world = glm::lookAt(eye, character.centre_world, glm::dvec3(0, 1, 0));
    // A head fills 16 pixels at a zoom of 8: from a tenth of a pixel a millimetre to some hundreds.
    const float zoom = far_off ? 0.02F : 400.0F;
    camera.clip_from_view = glm::perspective(0.5F, 1.0F, static_cast<float>(0.1 * away), static_cast<float>(10 * away));
    camera.clip_from_view[0][0] *= zoom;
    camera.clip_from_view[1][1] *= zoom;
    return camera;
}

void make_target(WarmUp& own, Output output) {
    if (own.framebuffer) return;
    own.color = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(own.color.name(), 1, output == Output::linear_hdr ? GL_RGBA16F : GL_RGBA8, side, side);
    own.framebuffer = gl::make_framebuffer();
    glNamedFramebufferTexture(own.framebuffer.name(), GL_COLOR_ATTACHMENT0, own.color.name(), 0);
    own.velocity = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(own.velocity.name(), 1, GL_RG16F, side, side);
    own.velocities = gl::make_framebuffer();
    glNamedFramebufferTexture(own.velocities.name(), GL_COLOR_ATTACHMENT0, own.velocity.name(), 0);
}

void draw(WarmUp& own, SceneState& scene, CharacterState& subject, const ViewFrame& like, const Situation& shown) {
    std::vector<std::unique_ptr<Kept>> kept;
    for (CharacterState* character : scene.characters) kept.push_back(std::make_unique<Kept>(*character));
    for (const int second : {0, 1}) {
        std::ranges::fill(subject.controls, shown.posed ? 0.5F + 0.1F * static_cast<float>(second) : 0.0F);
        begin_scene_frame(scene);
        ViewFrame frame = like;
        frame.camera = camera_for(subject, shown.far_off, 0.01 * second);
        frame.depth_convention = {};
        frame.x = frame.y = 0;
        frame.width = frame.height = side;
        frame.framebuffer = own.framebuffer.name();
        if (like.velocity_framebuffer != 0) frame.velocity_framebuffer = own.velocities.name();
        frame.cut = false;
        frame.check_finite = frame.timed = frame.force_effects = false;
        Lighting unlit;
        if (shown.unlit) {
            if (const Lighting* lighting = like.lighting != nullptr ? like.lighting
                                           : scene.lighting         ? &*scene.lighting
                                                                    : nullptr)
                unlit = *lighting;
            unlit.lights.clear();
            frame.lighting = &unlit;
        }
        draw_view(*own.frame, scene, frame);
        end_scene_frame(scene, !own.frame->shared.programs.postponed() && compares_frames(*own.frame, frame));
    }
}

void add(std::vector<Shading>& seen, const Shading& shading) {
    if (std::ranges::find(seen, shading) == seen.end()) seen.push_back(shading);
}

/// Several characters share what the view decides: one may be near and another far off.
void remember(WarmUp& own, const CharacterState& subject, std::size_t index) {
    const ShadingLayout& layout = shading_layout(own.frame->shared);
    Shading of_view, of_subject = subject.shading;
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        const Effect& effect = *layout.parts[k].effect;
        if (effect.need == nullptr || effect.shading->takes_part != nullptr) continue;
        of_view.parts |= subject.shading.parts & (1U << k);
        of_subject.parts &= ~(1U << k);
    }
    own.of_subjects.resize(std::max(own.of_subjects.size(), index + 1));
    add(own.of_view, of_view);
    add(own.of_subjects[index], of_subject);
}

/// Programs of all that was seen, together.
void compile_combinations(const WarmUp& own, const std::vector<CharacterState*>& all) {
    for (std::size_t s = 0; s < all.size() && s < own.of_subjects.size(); ++s) {
        for (const Shading& of_subject : own.of_subjects[s]) {
            for (const Shading& of_view : own.of_view) {
                all[s]->shading = {of_subject.parts | of_view.parts, of_subject.variants};
                const Face& face = all[s]->face;
                for (const Primitive& primitive : face.primitives) {
                    shade_program(own.frame->shared, permutation_of(*all[s], primitive.material));
                    if (own.frame->shared.programs.postponed()) return;
                }
            }
        }
    }
}

}  // namespace

WarmUpProgress warm_up(FrameState& view, SceneState& scene, const ViewFrame& like, std::uint32_t most_programs) {
    WarmUp& own = view.own<WarmUp>();
    gl::ProgramCache& programs = view.shared.programs;
    if (!own.frame) own.frame = std::make_shared<FrameState>(view.device);
    own.frame->settings = view.settings;
    make_target(own, like.output);
    begin_scene_frame(scene, false);
    const std::vector<CharacterState*> all = subjects(scene);
    const auto total = static_cast<std::uint32_t>(all.size()) * situations_a_character;
    const std::uint64_t before = programs.compiled();
    std::optional<std::string> failure;
    programs.limit(most_programs);
    while (own.next < total && !failure) {
        draw(own, scene, *all[own.next / situations_a_character], like, situation(own.next % situations_a_character));
        failure = own.frame->report.failure;
        if (programs.postponed()) break;
        remember(own, *all[own.next / situations_a_character], own.next / situations_a_character);
        ++own.next;
    }
    if (own.next >= total && scene.characters.size() > 1) compile_combinations(own, all);
    const bool more = programs.postponed();
    if (std::optional<Error> failed = programs.take_failure()) failure = failed->message;
    programs.unlimited();
    own.compiled += static_cast<std::uint32_t>(programs.compiled() - before);
    WarmUpProgress progress{.done = (own.next >= total && !more) || failure.has_value(),
                            .share = total == 0 ? 1.0F : static_cast<float>(own.next) / static_cast<float>(total),
                            .programs_compiled = own.compiled,
                            .failure = failure};
    if (progress.done) view.store.forget<WarmUp>();
    scene.kept.clear();
    return progress;
}

}  // namespace blush
