#include "tools/blush/captions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <imgui/imgui.h>
#include <imgui/imgui_internal.h>

namespace blush::tool {
namespace {

constexpr float margin = 0.05F;        // of the picture's width on either side, and of its height below
constexpr float lines_a_picture = 22;  // a height of text that is read at a glance and hides no chin

/// Calls visit(glyph, x of its origin) for every glyph of a line that begins at x.
template <class Visit>
void each_glyph(const ImFont& font, std::string_view text, float x, Visit visit) {
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        unsigned int code = 0;
        at += std::max(ImTextCharFromUtf8(&code, at, end), 1);
        const ImFontGlyph* glyph = font.FindGlyph(static_cast<ImWchar>(code));
        if (glyph == nullptr) continue;
        visit(*glyph, x);
        x += glyph->AdvanceX;
    }
}

/// Lays the atlas's coverage of a glyph over the image.
void blend_glyph(const ImFontAtlas& atlas, const ImFontGlyph& glyph, float x, float y, std::uint8_t grey, float opacity,
                 Image& image) {
    const auto left = static_cast<int>(std::lround(x + glyph.X0)), top = static_cast<int>(std::lround(y + glyph.Y0));
    const auto atlas_x = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(atlas.TexWidth)));
    const auto atlas_y = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(atlas.TexHeight)));
    const auto width = static_cast<int>(std::lround(glyph.X1 - glyph.X0)),
               height = static_cast<int>(std::lround(glyph.Y1 - glyph.Y0));
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const int px = left + column, py = top + row;
            if (px < 0 || py < 0 || px >= static_cast<int>(image.width) || py >= static_cast<int>(image.height))
                continue;
            const unsigned char covered = atlas.TexPixelsAlpha8[(atlas_y + row) * atlas.TexWidth + atlas_x + column];
            const float share = opacity * static_cast<float>(covered) / 255.0F;
            std::uint8_t* const pixel =
                &image.bytes[(static_cast<std::size_t>(py) * image.width + static_cast<std::size_t>(px)) * 4];
            for (int c = 0; c < 3; ++c) {
                const float mixed =
                    static_cast<float>(pixel[c]) + share * (static_cast<float>(grey) - static_cast<float>(pixel[c]));
                pixel[c] = static_cast<std::uint8_t>(std::lround(mixed));
            }
        }
    }
}

}  // namespace

ImFont* add_caption_font(ImFontAtlas& atlas, float size_pixels) {
    constexpr const char* dejavu = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    ImFontConfig config;
    config.SizePixels = size_pixels;
    config.OversampleH = config.OversampleV = 1;  // glyphs stand on whole pixels
    std::error_code failed;
    ImFont* font =
        std::filesystem::exists(dejavu, failed) ? atlas.AddFontFromFileTTF(dejavu, size_pixels, &config) : nullptr;
    return font != nullptr ? font : atlas.AddFontDefault(&config);
}

std::vector<CaptionLine> caption_lines(const ImFont& font, std::string_view words, float width, float height) {
    std::vector<CaptionLine> lines;
    const float widest = width * (1 - 2 * margin);
    const char* at = words.data();
    const char* const end = at + words.size();
    while (at < end) {
        const char* stop = font.CalcWordWrapPositionA(1, at, end, widest);
        if (stop <= at) stop = at + 1;  // a word wider than the picture
        lines.push_back({std::string_view(at, static_cast<std::size_t>(stop - at))});
        at = stop;
        while (at < end && (*at == ' ' || *at == '\n')) ++at;
    }
    const float line_height = 1.2F * font.FontSize;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        float line_width = 0;
        each_glyph(font, lines[k].text, 0, [&](const ImFontGlyph& glyph, float x) { line_width = x + glyph.AdvanceX; });
        lines[k].x = std::round(0.5F * (width - line_width));
        lines[k].y = std::round(height * (1 - margin) - line_height * static_cast<float>(lines.size() - k));
    }
    return lines;
}

Captions::Captions(std::uint32_t picture_height_pixels) : atlas_(std::make_unique<ImFontAtlas>()) {
    constexpr float least = 10;
    font_ = add_caption_font(*atlas_,
                             std::max(std::round(static_cast<float>(picture_height_pixels) / lines_a_picture), least));
    unsigned char* alpha = nullptr;
    int width = 0, height = 0;
    atlas_->GetTexDataAsAlpha8(&alpha, &width, &height);
}
Captions::Captions(Captions&&) noexcept = default;
Captions& Captions::operator=(Captions&&) noexcept = default;
Captions::~Captions() = default;

void Captions::draw(std::string_view words, Image& image) const {
    if (words.empty() || image.channels != 4 || image.bytes.empty()) return;
    const std::vector<CaptionLine> lines =
        caption_lines(*font_, words, static_cast<float>(image.width), static_cast<float>(image.height));
    const float edge = std::max(1.0F, std::round(font_->FontSize / 16));
    for (const CaptionLine& line : lines) {
        const auto draw_line = [&](float dx, float dy, std::uint8_t grey, float opacity) {
            each_glyph(*font_, line.text, line.x, [&](const ImFontGlyph& glyph, float x) {
                if (glyph.Visible) blend_glyph(*atlas_, glyph, x + dx, line.y + dy, grey, opacity, image);
            });
        };
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (dx != 0 || dy != 0)
                    draw_line(edge * static_cast<float>(dx), edge * static_cast<float>(dy), 0, 0.35F);
            }
        }
        draw_line(0, 0, 255, 1);
    }
}

}  // namespace blush::tool
