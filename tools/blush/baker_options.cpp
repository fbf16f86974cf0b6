#include "tools/blush/baker_options.h"

#include <algorithm>

namespace blush::tool {

void BakerOptions::add_to(Command& command, const Baker& baker) {
    for (const Setting& setting : baker.settings) {
        std::string flag = "--" + std::string(setting.name);
        std::ranges::replace(flag, '_', '-');
        std::string meaning(setting.meaning);
        meaning.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning.front())));
        if (!setting.choices.empty()) {
            std::string& choice = choices_[std::string(setting.name)] = setting.choices[setting.default_choice];
            const std::vector<std::string> names(setting.choices.begin(), setting.choices.end());
            command.option(flag, &choice, meaning).one_of(names).shows_default();
            continue;
        }
        double& value = values_[std::string(setting.name)] = setting.default_number;
        command.option(flag, &value, meaning).range(setting.lowest, setting.highest).shows_default();
    }
}

}  // namespace blush::tool
