#pragma once
/// Words over a picture, by Dear ImGui's font atlas (which holds stb_truetype's glyphs).

#include <memory>
#include <string_view>
#include <vector>

#include "rig/face.h"

struct ImFont;
struct ImFontAtlas;

namespace blush::tool {

/// Adds the font of captions: DejaVu Sans where the system has it, else the one that is part of Dear ImGui.
ImFont* add_caption_font(ImFontAtlas& atlas, float size_pixels);

struct CaptionLine {
    std::string_view text;
    float x = 0, y = 0;  ///< of its upper left corner, from the picture's
};
/// Breaks words into lines that stand in the middle at the lower edge of a picture. Words in UTF-8.
std::vector<CaptionLine> caption_lines(const ImFont& font, std::string_view words, float width, float height);

/// Draws captions into pictures of one height.
class Captions {
public:
    explicit Captions(std::uint32_t picture_height_pixels);
    Captions(Captions&&) noexcept;
    Captions& operator=(Captions&&) noexcept;
    ~Captions();

    /// White with a dark edge, over an 8-bit RGBA image of rows from the top. No words: nothing.
    void draw(std::string_view words, Image& image) const;

private:
    std::unique_ptr<ImFontAtlas> atlas_;
    ImFont* font_ = nullptr;
};

}  // namespace blush::tool
