#pragma once
/// Options of a bake command out of the settings of its baker: one source of names, meanings, ranges and defaults.

#include <map>
#include <string>
#include <string_view>

#include "runtime/bake/baker.h"
#include "tools/command_line/command_line.h"

namespace blush::tool {

class BakerOptions {
public:
    /// Adds --NAME for each of the baker's settings ("mask_size" becomes --mask-size).
    void add_to(Command& command, const Baker& baker);

    double number(std::string_view setting) const { return values_.find(setting)->second; }
    const std::string& choice(std::string_view setting) const { return choices_.find(setting)->second; }
    template <class Whole>
    Whole whole(std::string_view setting) const {
        return static_cast<Whole>(number(setting));
    }

private:
    std::map<std::string, double, std::less<>> values_;
    std::map<std::string, std::string, std::less<>> choices_;
};

}  // namespace blush::tool
