#include "tools/blush/viewer_panel.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "tools/blush/captions.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

namespace blush::tool {
namespace {

// Sizes in window coordinates at a text scale of 1: a name of 20 letters, a slider and a button side by side.
constexpr float usual_width = 320, usual_text_height = 13;

const ImVec4 on_color(0.55F, 0.85F, 0.55F, 1), off_color(0.70F, 0.70F, 0.70F, 1), held_color(1.0F, 0.78F, 0.40F, 1);

bool contains_ignoring_case(std::string_view text, std::string_view part) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return part.empty() || std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

void text(std::string_view line) { ImGui::TextUnformatted(line.data(), line.data() + line.size()); }

}  // namespace

Result<std::unique_ptr<Panel>> Panel::create(GLFWwindow* window, float text_scale) {
    std::unique_ptr<Panel> panel(new Panel(text_scale));
    if (!ImGui_ImplGlfw_InitForOpenGL(window, true) || !ImGui_ImplOpenGL3_Init("#version 450")) {
        return Error{"the viewer's panel cannot be drawn: Dear ImGui finds no libGL"};
    }
    return panel;
}

Panel::Panel(float text_scale) : width_(usual_width * text_scale) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // the panel always stands at the same place, so there is nothing to remember in a file
    io.ConfigInputTextCursorBlink = false;  // while paused, frames are drawn only when something happens
    ImFontConfig font;
    font.SizePixels = std::round(usual_text_height * text_scale);
    io.Fonts->AddFontDefault(&font);
    constexpr float caption_height = 26;
    caption_font_ = add_caption_font(*io.Fonts, std::round(caption_height * text_scale));
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 0;
    ImGui::GetStyle().ScaleAllSizes(text_scale);
}

Panel::~Panel() {
    if (ImGui::GetIO().BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
    if (ImGui::GetIO().BackendPlatformUserData) ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Panel::draw(const Shown& shown, ViewerState& state) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    if (state.panel_shown) {
        const ImVec2 window = ImGui::GetIO().DisplaySize;
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({std::min(width_, 0.5F * window.x), window.y});
        constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
        ImGui::Begin("panel", nullptr, fixed);
        ImGui::Text("%.1f ms a frame, %u triangles", static_cast<double>(shown.frame_milliseconds),
                    shown.report.triangles_drawn);
        draw_clock(state.clock);
        draw_effects(shown.report);
        draw_passes(shown.report);
        draw_controls(shown.character, state);
        ImGui::End();
    }
    draw_caption(shown.caption, state.panel_shown);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Panel::draw_caption(std::string_view caption, bool panel_shown) const {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float left = panel_shown ? std::min(width_, 0.5F * window.x) : 0;
    ImDrawList* const list = ImGui::GetForegroundDrawList();
    const float size = caption_font_->FontSize;
    for (const CaptionLine& line : caption_lines(*caption_font_, caption, window.x - left, window.y)) {
        const char* const end = line.text.data() + line.text.size();
        const ImVec2 place(left + line.x, line.y);
        constexpr float edge = 1.5F;
        for (const ImVec2 off : {ImVec2(edge, edge), ImVec2(-edge, edge), ImVec2(edge, -edge), ImVec2(-edge, -edge)}) {
            list->AddText(caption_font_, size, {place.x + off.x, place.y + off.y}, IM_COL32(0, 0, 0, 160),
                          line.text.data(), end);
        }
        list->AddText(caption_font_, size, place, IM_COL32(255, 255, 255, 255), line.text.data(), end);
    }
}

void Panel::draw_clock(PlaybackClock& clock) {
    ImGui::Separator();
    ImGui::SetNextItemWidth(-1);
    float time_seconds = static_cast<float>(clock.time_seconds);
    std::array<char, 64> format;  // in which the slider fills in the time
    std::snprintf(format.data(), format.size(), "%%.2f of %.2f s", clock.to_seconds);
    if (ImGui::SliderFloat("##time", &time_seconds, static_cast<float>(clock.from_seconds),
                           static_cast<float>(clock.to_seconds), format.data(), ImGuiSliderFlags_NoInput)) {
        clock.scrub(static_cast<double>(time_seconds));
    }
    // The label after ### keeps the button the same one, whatever it says.
    if (ImGui::Button(clock.playing ? "Pause###play" : "Play###play", {ImGui::GetFontSize() * 4, 0})) {
        clock.playing = !clock.playing;
    }
    ImGui::SameLine();
    if (ImGui::ArrowButton("back", ImGuiDir_Left)) clock.step(-1);
    ImGui::SameLine();
    if (ImGui::ArrowButton("forward", ImGuiDir_Right)) clock.step(1);
    ImGui::SameLine();
    ImGui::Text("speed");
    ImGui::SameLine();
    if (ImGui::Button("-")) clock.slower();
    ImGui::SameLine();
    ImGui::Text("x%g", clock.speed);
    ImGui::SameLine();
    if (ImGui::Button("+")) clock.faster();
}

void Panel::draw_effects(const FrameReport& report) {
    if (!ImGui::CollapsingHeader("Effects", ImGuiTreeNodeFlags_DefaultOpen)) return;
    for (const EffectReport& effect : report.effects) {
        text(effect.effect);
        ImGui::SameLine();
        ImGui::TextColored(effect.on ? on_color : off_color, "%s", effect.on ? "on" : "left out");
        if (!effect.on && effect.omission == Omission::bounded) {
            ImGui::SameLine();
            ImGui::Text("(at most %g %.*s)", effect.bound, static_cast<int>(effect.bound_unit.size()),
                        effect.bound_unit.data());
        }
        ImGui::Indent();
        ImGui::PushTextWrapPos();
        text(effect.reason);
        ImGui::PopTextWrapPos();
        ImGui::Unindent();
    }
}

void Panel::draw_passes(const FrameReport& report) {
    passes_timed_ = ImGui::CollapsingHeader("Passes");
    if (!passes_timed_) return;
    for (const PassReport& pass : report.passes) {
        text(pass.name);
        ImGui::SameLine();
        if (pass.ran) {
            ImGui::TextColored(on_color, "%.2f ms", pass.milliseconds);
        } else {
            ImGui::TextColored(off_color, "culled");
        }
    }
}

void Panel::draw_controls(Portrait& character, ViewerState& state) {
    if (!ImGui::CollapsingHeader("Controls", ImGuiTreeNodeFlags_DefaultOpen)) return;
    const std::span<const std::string> names = character.rig().control_names();
    ImGui::SetNextItemWidth(-1);
    const bool edited = ImGui::InputTextWithHint("##filter", "part of a name", &filter_);
    if (edited || !listed_current_) {
        listed_controls_.clear();
        for (std::uint32_t c = 0; c < names.size(); ++c) {
            if (contains_ignoring_case(names[c], filter_)) listed_controls_.push_back(c);
        }
        listed_current_ = true;
    }
    // In a low window the whole panel scrolls, rather than the list shrink to nothing.
    constexpr float fewest_rows = 8;
    const float least_height = fewest_rows * ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("list", {0, std::max(ImGui::GetContentRegionAvail().y, least_height)});
    ImGuiListClipper clipper;  // of thousands of controls, only the rows in sight are made
    clipper.Begin(static_cast<int>(listed_controls_.size()));
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            draw_control(listed_controls_[static_cast<std::size_t>(row)], character, state);
        }
    }
    ImGui::EndChild();
}

void Panel::draw_control(std::uint32_t control, Portrait& character, ViewerState& state) {
    // Control and a click take a number beyond the usual range.
    const ControlInfo& info = character.rig().info(static_cast<ControlId>(control));
    std::optional<float>& held = state.held_controls[control];
    float value = character.controls()[control];
    const std::string& name = character.rig().control_names()[control];

    ImGui::PushID(static_cast<int>(control));
    const float reset_width = ImGui::GetFrameHeight();
    const bool was_held = held.has_value();
    if (was_held) ImGui::PushStyleColor(ImGuiCol_Text, held_color);
    ImGui::SetNextItemWidth(0.4F * ImGui::GetContentRegionAvail().x);
    if (ImGui::SliderFloat("##value", &value, info.low, info.high, "%.2f")) held = value;
    ImGui::SameLine();
    if (was_held) {
        if (ImGui::Button("x", {reset_width, 0})) held.reset();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Give it back to the performance");
    } else {
        ImGui::Dummy({reset_width, 0});
    }
    ImGui::SameLine();
    text(name);
    if (was_held) ImGui::PopStyleColor();
    ImGui::PopID();
}

}  // namespace blush::tool
