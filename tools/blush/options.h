#pragma once
/// What several commands share: the face, its controls, the size, the settings.

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/character.h"
#include "runtime/lighting.h"

namespace blush::tool {

/// Exit status of bad input (house rule).
inline constexpr int bad_input = 2;

/// Prints the sentence on standard error and returns bad_input.
int fail(const Error& error);

struct Size {
    std::uint32_t width = 0, height = 0;
};
/// "960x540". Error: anything else, or a side that is not 1 to 16384.
Result<Size> parse_size(const std::string& text);

/// Holds an option to a finite number from `low` to `high`. CLI11's own range lets NaN pass.
CLI::Validator number_from(double low, double high);

/// The face file that a user means: "default" is the one that this program ships.
std::filesystem::path face_path(const std::string& name);
/// Folder of what the program ships, beside the build or the installation; empty when there is none.
std::filesystem::path asset_folder();

/// --set, --emotion, --state, --rig, --defaults, --setting: what a frame starts from.
struct PoseOptions {
    std::vector<std::string> sets;      ///< "jawOpen=0.6", several separated by commas
    std::vector<std::string> emotions;  ///< the same, of emotions and compounds alone
    std::vector<std::string> states;    ///< the same, of physiological states alone
    std::string rig_file;               ///< a rig description; empty: what stands beside the face
    std::vector<std::string> settings;  ///< "deformation.method=passes"
    bool defaults = false;              ///< start from the file's own weights instead of zero

    void add_to(CLI::App& command, bool with_settings = true);
    /// Writes one value for each control of the rig. Error: an unknown control (with the nearest one), a bad number.
    Status apply(const Face& face, const Rig& rig, std::span<float> controls) const;
    Status apply_settings(Character& character) const;
};

/// --lights, --environment: what lights a frame.
struct LightOptions {
    std::string lights, environment;
    float environment_turn_degrees = 0, environment_factor = 1;

    void add_to(CLI::App& command);
    /// Nothing when neither is given: the frame's own lights. Error: a file or a name that is not what it should be.
    Result<std::optional<Lighting>> lighting(Character& character) const;
};

/// A headless device and a character with its pose set.
struct Stage {
    Device device;
    Character character;
};
/// The rig that a loaded face has by these options.
Result<RigDescription> describe_rig(const Face& face, const PoseOptions& pose);
Result<std::unique_ptr<Stage>> make_stage(const std::string& face, const PoseOptions& pose);

/// Draws a picture that stands alone: what was drawn before does not show, and a mode that needs two frames gets them.
const FrameReport& draw_alone(Character& character, View view);

/// Prints the finding of --check-finite and returns bad_input; 0 when there is none.
int report_not_finite(const FrameReport& report);

// One function a command: adds it to `app` and sets `exit_status` when it has run.
void add_info(CLI::App& app, int& exit_status);
void add_import(CLI::App& app, int& exit_status);
void add_evaluate(CLI::App& app, int& exit_status);
void add_render(CLI::App& app, int& exit_status);
void add_play(CLI::App& app, int& exit_status);
void add_explain(CLI::App& app, int& exit_status);
void add_accuracy(CLI::App& app, int& exit_status);
void add_controls(CLI::App& app, int& exit_status);
void add_lint(CLI::App& app, int& exit_status);
void add_kernel(CLI::App& app, int& exit_status);
void add_bake(CLI::App& app, int& exit_status);
void add_antialias(CLI::App& app, int& exit_status);

// The subcommands of bake.
void add_bake_appearance(CLI::App& bake_command, int& exit_status);
void add_bake_face(CLI::App& bake_command, int& exit_status);
void add_bake_wrinkles(CLI::App& bake_command, int& exit_status);
void add_bake_occlusion(CLI::App& bake_command, int& exit_status);
void add_bake_smaa_tables(CLI::App& bake_command, int& exit_status);

}  // namespace blush::tool
