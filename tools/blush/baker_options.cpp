#include "tools/blush/baker_options.h"

#include <algorithm>

#include "tools/blush/options.h"

namespace blush::tool {

void BakerOptions::add_to(CLI::App& command, const Effect& effect) {
    for (const Setting& setting : effect.settings) {
        std::string flag = "--" + std::string(setting.name);
        std::ranges::replace(flag, '_', '-');
        std::string meaning(setting.meaning);
        meaning.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning.front())));
        if (!setting.choices.empty()) {
            std::string& choice = choices_[std::string(setting.name)] = setting.choices[setting.default_choice];
            const std::vector<std::string> names(setting.choices.begin(), setting.choices.end());
            command.add_option(flag, choice, meaning)->check(CLI::IsMember(names))->capture_default_str();
            continue;
        }
        double& value = values_[std::string(setting.name)] = setting.default_number;
        command.add_option(flag, value, meaning)
            ->check(number_from(setting.lowest, setting.highest))
            ->capture_default_str();
    }
}

}  // namespace blush::tool
