#include "runtime/measure/study_scene.h"
#include "runtime/measure/portrait.h"

#include <algorithm>

namespace blush {

std::shared_ptr<StudyScene> make_study_scene(const Device& device, const Face& face, std::size_t active_count) {
    Result<Portrait> character = Portrait::create(device, face);
    if (!character) return nullptr;
    auto scene = std::make_shared<StudyScene>(StudyScene{*std::move(character), {}, {}});
    std::vector<float> weights(face.targets.size(), 0);
    for (std::size_t t = 0; t < std::min(active_count, weights.size()); ++t) {
        weights[t] = 0.3F + 0.1F * static_cast<float>(t % 7);
        scene->active.push_back({static_cast<std::uint32_t>(t), weights[t]});
    }
    std::ranges::copy(weights, scene->character.controls().begin());
    scene->exact = deform_exact(face, weights);
    scene->stream_out().set_active(scene->active);
    return scene;
}

std::vector<std::size_t> study_counts(const Face& face, bool quick) {
    constexpr std::size_t usual = 12;
    std::vector<std::size_t> counts;
    for (const std::size_t count : {std::size_t{1}, usual, face.targets.size()}) {
        if (count > face.targets.size() || count == 0) continue;
        if (!counts.empty() && counts.back() >= count) continue;
        counts.push_back(count);
    }
    if (quick && counts.size() > 1) counts.erase(counts.begin(), counts.end() - 1);
    return counts;
}

}  // namespace blush
