#include "tools/blush/baker_options.h"

#include <algorithm>

#include "tools/blush/options.h"

namespace blush::tool {

void BakerOptions::add_to(CLI::App& command, const Effect& effect) {
    for (const Setting& setting : effect.settings) {
        if (!setting.choices.empty()) continue;
        double& value = values_[std::string(setting.name)] = setting.default_number;
        std::string flag = "--" + std::string(setting.name);
        std::ranges::replace(flag, '_', '-');
        std::string meaning(setting.meaning);
        meaning.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning.front())));
        command.add_option(flag, value, meaning)
            ->check(number_from(setting.lowest, setting.highest))
            ->capture_default_str();
    }
}

}  // namespace blush::tool
