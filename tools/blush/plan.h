#pragma once
/// What a frame ran and left out, and why, as JSON and as words.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/measure/portrait.h"

namespace blush::tool {

/// report: of the frame that the character drew last.
nlohmann::ordered_json plan_of(Portrait& character, const FrameReport& report);

/// The JSON's text; names that are no valid UTF-8 have such bytes replaced.
std::string text_of(const nlohmann::ordered_json& plan);

void print_plan(const nlohmann::ordered_json& plan);

}  // namespace blush::tool
