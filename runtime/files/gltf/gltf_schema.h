#pragma once
/// The shape of a glTF document: every member that this loader depends on has the right type, and every reference names
/// something that exists. One table, so that what comes after may index without asking.

#include <nlohmann/json_fwd.hpp>

namespace blush::load {

/// Throws BadFile with the place of the first member that breaks a rule.
void check_schema(const nlohmann::json& document);

}  // namespace blush::load
