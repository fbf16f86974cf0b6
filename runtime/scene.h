#pragma once
/// Scene: characters in one light, drawn into any number of views.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/result.h"
#include "rig/vectors.h"
#include "runtime/character.h"
#include "runtime/device.h"
#include "runtime/frame_report.h"
#include "runtime/lighting.h"
#include "runtime/view.h"

namespace blush {

struct SceneState;

/// One view of a frame and what it is drawn for.
struct ViewInFrame {
    View& view;
    const ViewFrame& frame;
};

/// A depth-only pass of the host's, such as its own shadow map.
struct DepthFrame {
    DMat4 clip_from_world{1};
    DepthConvention depth_convention;     ///< of clip_from_world and of the framebuffer's depth
    std::uint32_t x = 0, y = 0;           ///< pixels
    std::uint32_t width = 0, height = 0;  ///< pixels
    std::uint32_t framebuffer = 0;        ///< GL name; its depth is tested and written, nothing else
};

/// How far warm_up() has come.
struct WarmUpProgress {
    bool done = false;
    float share = 0;                      ///< of the situations that it goes through
    std::uint32_t programs_compiled = 0;  ///< since it began
    std::optional<std::string> failure;   ///< as FrameReport::failure; it ends with one
};

/// Shaders for a host's own program (docs/integrating.md).
struct ShadingText {
    std::string vertex;  ///< whole
    std::string
        fragment;  ///< all but outputs and main(), which calls model_surface(interpolants()) and model_lighting()
};

class Scene {
public:
    static Result<Scene> create(const Device& device);

    /// Adds a character of the same device; a second time has no effect. It leaves when it is destroyed. Status: it is
    /// of another device.
    Status add(const Character& character);
    void remove(const Character& character);

    /// What lights it; nothing: three lights of a portrait that follow the camera of each view.
    void set_lighting(std::optional<Lighting> lighting);
    /// Status: no such effect, setting or choice, or one that another owner has (runtime/settings.h).
    Status set(std::string_view setting, std::string_view choice);

    /// Draws one frame of all characters into a view, and restores every GL state that it touched. The report stands
    /// until the view is next drawn. A view without pixels draws nothing. Each call is a frame: what moved since the
    /// last call is what velocities tell.
    const FrameReport& draw(View& view, const ViewFrame& frame);
    /// Several views of one frame: surfaces are deformed and shadow maps drawn once for all of them.
    void draw(std::span<const ViewInFrame> views);
    /// Compiles ahead what frames of this scene can come to need, so that none of them does: for its characters, its
    /// lighting and the settings as they are, any pose, distance and camera (a first probe or another number of host
    /// shadow maps that come to reach a character may compile). `like`: output, backdrop and the other ways of the
    /// frames to come; its camera and framebuffer do not matter. One call compiles `most_programs` at most; call it
    /// until it is done, between frames or before the first. Controls and poses stay; the next frame of a temporal mode
    /// stands alone. Restores every GL state that it touches.
    WarmUpProgress warm_up(View& view, const ViewFrame& like, std::uint32_t most_programs = 1);

    /// For a host that shades the characters with programs of its own: makes all that shading reads (surfaces, shadow
    /// maps, blood, blocks of numbers) for a view, and draws no picture. It stands until the scene is next drawn,
    /// deformed or prepared. Restores every GL state that it touched.
    const FrameReport& prepare(View& view, const ViewFrame& frame);
    /// The shaders of one primitive, as prepare() has found its effects: Character::surface().primitives by index. They
    /// change where the effects that are on do. Status: the character is not of the scene, or has no such primitive.
    Result<ShadingText> shading_text(View& view, const Character& character, std::size_t primitive);
    /// Binds what a program of shading_text() reads, and leaves it bound: the vertex array, uniform blocks and storage
    /// blocks, textures with their samplers from unit 0 on. Draw with glDrawElements and the primitive's range of
    /// 32-bit indices. Error as of shading_text().
    Status bind_shading(View& view, const Character& character, std::size_t primitive);

    /// The report of a view's last frame.
    static const FrameReport& report(const View& view);

    /// Draws the depth of all that casts shadows, as the controls stand now, for a pass of the host's own. Restores
    /// every GL state that it touched.
    void draw_depth(const DepthFrame& frame);

    /// Makes the surfaces of all characters, as the controls stand now, and draws nothing: for a host that draws
    /// Character::surface() itself. No frame of its own: velocities do not see it. Restores every GL state that it
    /// touched. Report: of this alone, until the next deform() or draw_depth().
    const FrameReport& deform();

    /// Deforms (on the GPU, without drawing) and reads back: positions, normals and tangents of every vertex, in the
    /// mesh's space, as the file has it: before joints, and, of a face without joints, with pins.
    struct Surface {
        std::vector<Vec3> positions, normals;
        std::vector<Vec4> tangents;
    };
    Surface read_deformed(const Character& character);

    SceneState& state() { return *state_; }

private:
    explicit Scene(std::shared_ptr<SceneState> state);
    std::shared_ptr<SceneState> state_;
};

}  // namespace blush
