#include "rig/names.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace blush {
namespace {

std::vector<std::string> arkit() { return {arkit_names.begin(), arkit_names.end()}; }

/// "mouthSmileLeft" to {"mouth", "Smile", "Left"}.
std::vector<std::string> words(std::string_view name) {
    std::vector<std::string> result(1);
    for (const char c : name) {
        if (std::isupper(static_cast<unsigned char>(c))) result.emplace_back();
        result.back() += c;
    }
    return result;
}

std::string joined(const std::vector<std::string>& parts, const std::string& separator) {
    std::string result;
    for (const std::string& part : parts) result += (result.empty() ? "" : separator) + part;
    return result;
}

std::string cased(std::string text, int (*change)(int)) {
    for (char& c : text) c = static_cast<char>(change(static_cast<unsigned char>(c)));
    return text;
}

/// All the ways in which the name is written in the wild.
std::vector<std::string> spellings(std::string_view name) {
    const std::vector<std::string> parts = words(name);
    std::string pascal(name);
    pascal[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(pascal[0])));
    std::vector<std::string> result = {std::string(name), pascal};
    for (const char* separator : {"_", "-", " ", "."}) {
        const std::string plain = joined(parts, separator);
        result.insert(result.end(), {plain, cased(plain, std::tolower), cased(plain, std::toupper)});
    }
    if (parts.back() == "Left" || parts.back() == "Right") {
        const std::string side = parts.back().substr(0, 1);
        for (const std::string& whole : {std::string(name), pascal}) {
            const std::string base = whole.substr(0, whole.size() - parts.back().size());
            for (const char* separator : {"", "_", "-", " ", "."}) result.push_back(base + separator + side);
            result.push_back(base + "_" + cased(side, std::tolower));
            result.push_back(base + "_" + parts.back());
        }
        const std::vector<std::string> stem(parts.begin(), parts.end() - 1);
        result.push_back(cased(joined(stem, "_"), std::toupper) + "_" + side);
    }
    return result;
}

TEST(Names, ThereAre52OfWhich40HaveASide) {
    const auto sided = std::count_if(arkit_names.begin(), arkit_names.end(), [](std::string_view name) {
        return name.ends_with("Left") || name.ends_with("Right");
    });
    // Pairs: 7 of an eye, jawLeft/Right and mouthLeft/Right, 7 more of the mouth, 4 of brows, cheeks and nose.
    EXPECT_EQ(sided, 2 * (7 + 2 + 7 + 4));
    EXPECT_EQ(std::set<std::string_view>(arkit_names.begin(), arkit_names.end()).size(), 52U);
}

TEST(Names, No2OfThe52ShareACanonicalForm) {
    std::set<std::string> forms;
    for (const std::string_view name : arkit_names) forms.insert(canonical_name(name));
    EXPECT_EQ(forms.size(), 52U);
}

TEST(Names, EverySpellingOfAll52IsFound) {
    const std::vector<std::string> names = arkit();
    std::size_t tried = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (const std::string& spelling : spellings(names[i])) {
            EXPECT_EQ(find_name(spelling, names), i) << spelling;
            EXPECT_EQ(find_name(names[i], std::vector<std::string>{"other", spelling}), 1U) << spelling;
            ++tried;
        }
    }
    EXPECT_GT(tried, 1000U);
}

TEST(Names, CanonicalFormIsItsOwnCanonicalForm) {
    for (const std::string_view name : arkit_names) {
        const std::string once = canonical_name(name);
        EXPECT_EQ(canonical_name(once), once);
    }
}

TEST(Names, TheSpellingsOfTheContract) {
    EXPECT_EQ(canonical_name("jawOpen"), "jawopen");
    for (const char* name : {"JawOpen", "jaw_open", "JAW_OPEN", "jaw-open", "Jaw Open", "_jawOpen_"}) {
        EXPECT_EQ(canonical_name(name), "jawopen") << name;
    }
    for (const char* name : {"mouthSmile_L", "mouthSmileL", "MouthSmile_L", "mouthSmile.L", "mouthSmile_left",
                             "MOUTH_SMILE_LEFT", "mouth_smile_l"}) {
        EXPECT_EQ(canonical_name(name), "mouthsmileleft") << name;
    }
}

TEST(Names, WordsThatEndInLOrRHaveNoSide) {
    EXPECT_EQ(canonical_name("mouthFunnel"), "mouthfunnel");
    EXPECT_EQ(canonical_name("mouthPucker"), "mouthpucker");
    EXPECT_EQ(canonical_name("jawClear"), "jawclear");
    EXPECT_EQ(canonical_name("MOUTH_FUNNEL"), "mouthfunnel");
    EXPECT_EQ(canonical_name("mouthRollLower"), "mouthrolllower");
    EXPECT_EQ(canonical_name("L"), "l");
    EXPECT_EQ(canonical_name(""), "");
    EXPECT_EQ(canonical_name("___"), "");
}

TEST(Names, IdenticalBeatsCanonicalAndAmbiguityIsNoMatch) {
    const std::vector<std::string> names = {"JawOpen", "jaw_open", "jawOpen"};
    EXPECT_EQ(find_name("jawOpen", names), 2U);
    EXPECT_EQ(find_name("jaw_open", names), 1U);
    EXPECT_EQ(find_name("JAW_OPEN", names), std::nullopt);
    EXPECT_EQ(find_name("jawOpe", names), std::nullopt);
    EXPECT_EQ(find_name("jawOpen", {}), std::nullopt);
}

TEST(Names, APrefixBeforeTheLastDotMayBeDroppedOnEitherSide) {
    const std::vector<std::string> plain = {"jawOpen", "mouthSmileLeft"};
    EXPECT_EQ(find_name("blendShape1.jawOpen", plain), 0U);
    EXPECT_EQ(find_name("blendShape1.mouthSmile_L", plain), 1U);
    EXPECT_EQ(find_name("blendShape1.mouthSmile.L", plain), 1U);
    const std::vector<std::string> prefixed = {"Head_blendShape.jawOpen", "Head_blendShape.mouthSmile_L"};
    EXPECT_EQ(find_name("jawOpen", prefixed), 0U);
    EXPECT_EQ(find_name("mouthSmileLeft", prefixed), 1U);
    EXPECT_EQ(find_name("other.jawOpen", prefixed), 0U);
}

TEST(Names, ADroppedPrefixMustLeaveOneMatch) {
    const std::vector<std::string> names = {"Head.jawOpen", "Teeth.jawOpen"};
    EXPECT_EQ(find_name("jawOpen", names), std::nullopt);
    EXPECT_EQ(find_name("Teeth.jawOpen", names), 1U);
}

TEST(Names, ASideOrNumberAfterADotIsNoName) {
    EXPECT_EQ(find_name("mouthSmile.L", std::vector<std::string>{"browDown.L"}), std::nullopt);
    EXPECT_EQ(find_name("jawOpen.001", std::vector<std::string>{"browDown.001"}), std::nullopt);
    EXPECT_EQ(find_name("mouthSmile.left", std::vector<std::string>{"browDown.left"}), std::nullopt);
}

TEST(Names, NearestOffersWhatWasMeantAndNothingFar) {
    const std::vector<std::string> names = arkit();
    EXPECT_EQ(nearest_name("jawOpne", names), "jawOpen");
    EXPECT_EQ(nearest_name("moutSmileLeft", names), "mouthSmileLeft");
    EXPECT_EQ(nearest_name("mouthSmle_R", names), "mouthSmileRight");
    EXPECT_EQ(nearest_name("tail", names), std::nullopt);
    EXPECT_EQ(nearest_name("", names), std::nullopt);
    EXPECT_EQ(nearest_name("jawOpen", {}), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(1'000'000, 'j'), names), std::nullopt);
}

}  // namespace
}  // namespace blush
