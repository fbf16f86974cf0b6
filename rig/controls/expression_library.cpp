#include "rig/controls/expression_library.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "rig/wrinkles/wrinkle_zones.h"

namespace blush {
namespace {

// How the tables are written: "NAME WEIGHT, NAME WEIGHT, ...". A star stands for Left and for Right; a row with a star
// in `drives` also makes the one-sided units NAME_L and NAME_R.

struct ExpressionRow {
    std::string_view name, meaning, drives;
};

/// FACS (Ekman, Friesen, Hager 2002), in the shapes of ARKit, which are FACS units in all but name. Gaze and head turns
/// go to the angles as well: 0.6 radians of yaw and 0.55 of pitch go with an eye shape of 1 in recordings of Live Link
/// Face; 0.6, 0.4 and 0.35 radians are an easy turn, nod and tilt of a head.
constexpr ExpressionRow action_units[] = {
    {"AU1", "inner brow raiser", "browInnerUp* 1"},
    {"AU2", "outer brow raiser", "browOuterUp* 1"},
    {"AU4", "brow lowerer", "browDown* 1"},
    {"AU5", "upper lid raiser", "eyeWide* 1"},
    {"AU6", "cheek raiser and lid compressor", "cheekSquint* 1, eyeSquint* 0.35"},
    {"AU7", "lid tightener", "eyeSquint* 1"},
    {"AU9", "nose wrinkler", "noseSneer* 1, browDown* 0.15"},
    {"AU10", "upper lip raiser", "mouthUpperUp* 1, noseSneer* 0.15"},
    {"AU11", "nasolabial deepener", "mouthUpperUp* 0.3, noseSneer* 0.25"},
    {"AU12", "lip corner puller", "mouthSmile* 1"},
    {"AU13", "sharp lip puller", "mouthSmile* 0.45, cheekPuff* 0.2"},
    {"AU14", "dimpler", "mouthDimple* 1"},
    {"AU15", "lip corner depressor", "mouthFrown* 1"},
    {"AU16", "lower lip depressor", "mouthLowerDown* 1"},
    {"AU17", "chin raiser", "mouthShrugLower 1, mouthShrugUpper 0.35"},
    {"AU18", "lip pucker", "mouthPucker 1"},
    {"AU20", "lip stretcher", "mouthStretch* 1"},
    {"AU22", "lip funneler", "mouthFunnel 1"},
    {"AU23", "lip tightener", "mouthPress* 0.25, mouthRollLower 0.45, mouthRollUpper 0.4"},
    {"AU24", "lip pressor", "mouthPress* 1"},
    {"AU25", "lips part", "mouthLowerDown* 0.35, mouthUpperUp* 0.2"},
    {"AU26", "jaw drop", "jawOpen 0.4"},
    {"AU27", "mouth stretch", "jawOpen 1"},
    {"AU28", "lip suck", "mouthRollLower 1, mouthRollUpper 1"},
    {"AU43", "eyes closed", "eyeBlink* 1"},
    {"AU45", "blink", "eyeBlink* 1"},
    {"AU46", "wink (without a side: the left eye)", "eyeBlinkLeft 1, cheekSquintLeft 0.5"},
    {"AU46_L", "wink of the left eye", "eyeBlinkLeft 1, cheekSquintLeft 0.5"},
    {"AU46_R", "wink of the right eye", "eyeBlinkRight 1, cheekSquintRight 0.5"},
    {"AU51", "head turns left", "headYaw 0.6"},
    {"AU52", "head turns right", "headYaw -0.6"},
    {"AU53", "head up", "headPitch -0.4"},
    {"AU54", "head down", "headPitch 0.4"},
    {"AU55", "head tilts left", "headRoll -0.35"},
    {"AU56", "head tilts right", "headRoll 0.35"},
    {"AU57", "head forward (a pose has no control for it)", ""},
    {"AU58", "head back (a pose has no control for it)", ""},
    {"AU61", "eyes turn left", "eyeLookOutLeft 1, eyeLookInRight 1, leftEyeYaw 0.6, rightEyeYaw 0.6"},
    {"AU62", "eyes turn right", "eyeLookInLeft 1, eyeLookOutRight 1, leftEyeYaw -0.6, rightEyeYaw -0.6"},
    {"AU63", "eyes up", "eyeLookUpLeft 1, eyeLookUpRight 1, leftEyePitch -0.55, rightEyePitch -0.55"},
    {"AU64", "eyes down", "eyeLookDownLeft 1, eyeLookDownRight 1, leftEyePitch 0.55, rightEyePitch 0.55"},
};

/// The six of Ekman. Which units: the prototypes of FACS (Ekman, Friesen 1978, table 11-1; EMFACS), which agree with
/// those counted by Lucey et al. 2010 (CK+, table 1) and Du, Tao, Martinez 2014 (table 1). Units that come with them
/// often but not always have the lower weights. The intensities within a prototype are ours, set by eye.
constexpr ExpressionRow emotions[] = {
    {"joy", "6+12+25, with 26: a Duchenne smile", "AU6 0.8, AU12 0.9, AU25 0.65, AU26 0.1"},
    {"sadness", "1+4+15, with 11 and 17", "AU1 0.9, AU4 0.35, AU15 0.75, AU11 0.3, AU17 0.45, AU43 0.15, AU64 0.2"},
    {"anger", "4+5+7+23, with 10, 17 and 24", "AU4 1, AU5 0.4, AU7 0.6, AU23 0.8, AU24 0.25, AU17 0.45, AU10 0.15"},
    {"fear", "1+2+4+5+20+25, with 7 and 26",
     "AU1 0.9, AU2 0.55, AU4 0.45, AU5 0.9, AU20 0.8, AU25 0.7, AU26 0.5, AU7 0.2"},
    {"disgust", "9+10+17, with 4 and 15", "AU9 0.9, AU10 0.4, AU17 0.5, AU15 0.4, AU4 0.3, AU7 0.4, AU6 0.2"},
    {"surprise", "1+2+5+25+26, on the way to 27", "AU1 0.8, AU2 1, AU5 0.65, AU25 0.1, AU26 0.8, AU27 0.25"},
};

/// `blood` says whose hemoglobin map the state takes, where its parts do not bring one.
struct CompoundRow {
    std::string_view name, meaning, drives, blood;
};

constexpr CompoundRow compounds[] = {
    {"duchenneSmile", "a felt smile, lips closed: the eyes take part (Ekman, Davidson, Friesen 1990)",
     "AU6 0.75, AU12 0.75", "joy 0.75"},
    {"socialSmile", "a posed smile: the lip corners alone, no AU6 (Ekman, Davidson, Friesen 1990)", "AU12 0.75",
     "joy 0.35"},
    {"sadSmile", "the sad smile of jimenez-2012, figure 7.1", "sadness 0.8, AU12 0.7, AU6 0.2", ""},
    {"fearIntoAnger", "fear as it turns into anger", "fear 0.5, anger 0.6", ""},
    {"shySmile", "a smile held back, the gaze and the head going down (Keltner 1995: 12+24+64+54), with a blush",
     "AU12 0.55, AU6 0.3, AU24 0.35, AU64 0.45, AU54 0.3, AU51 0.15, blush 0.6", ""},
    {"embarrassment", "12+24+64+54+51 and a blush (Keltner 1995)",
     "AU12 0.3, AU24 0.6, AU64 0.75, AU54 0.5, AU51 0.3, blush 1", ""},
    {"contempt", "a one-sided 12+14 (Ekman, Friesen 1986)", "AU14_L 0.8, AU12_L 0.3", ""},
    {"laughter", "6+12+25+26, the head going back", "AU6 1, AU12 1, AU25 0.7, AU26 0.75, AU53 0.25", "joy 1"},
    {"pain", "4+6+7+9+10+43 (Prkachin, Solomon 2008)", "AU4 0.9, AU6 0.7, AU7 0.7, AU9 0.5, AU10 0.4, AU43 0.5", ""},
    // Du, Tao, Martinez 2014, table 1: named in the text, the units of more than 70 % of the subjects; with lower
    // weights, some of those that vary between subjects.
    {"happilySurprised", "Du et al. 2014: 1+2+12+25", "AU1 0.9, AU2 0.9, AU12 0.85, AU25 0.6, AU5 0.4, AU26 0.6",
     "joy 0.5, surprise 0.5"},
    {"happilyDisgusted", "Du et al. 2014: 10+12+25", "AU10 0.6, AU12 0.75, AU25 0.4, AU6 0.5, AU9 0.5",
     "joy 0.5, disgust 0.5"},
    {"sadlyFearful", "Du et al. 2014: 1+4+20+25", "AU1 0.9, AU4 0.6, AU20 0.6, AU25 0.5", "sadness 0.5, fear 0.5"},
    {"sadlyAngry", "Du et al. 2014: 4+15", "AU4 0.9, AU15 0.7, AU7 0.4, AU17 0.5", "sadness 0.5, anger 0.5"},
    {"sadlySurprised", "Du et al. 2014: 1+4+25+26", "AU1 0.9, AU4 0.5, AU25 0.4, AU26 0.7",
     "sadness 0.5, surprise 0.5"},
    {"sadlyDisgusted", "Du et al. 2014: 4+10", "AU4 0.8, AU10 0.6, AU1 0.4, AU6 0.5, AU15 0.5, AU17 0.4",
     "sadness 0.5, disgust 0.5"},
    {"fearfullyAngry", "Du et al. 2014: 4+20+25", "AU4 0.9, AU20 0.7, AU25 0.6, AU5 0.4, AU7 0.35",
     "fear 0.5, anger 0.5"},
    {"fearfullySurprised", "Du et al. 2014: 1+2+5+20+25",
     "AU1 0.9, AU2 0.8, AU5 0.9, AU20 0.6, AU25 0.6, AU4 0.3, AU26 0.5", "fear 0.5, surprise 0.5"},
    {"fearfullyDisgusted", "Du et al. 2014: 1+4+10+20+25",
     "AU1 0.8, AU4 0.6, AU10 0.6, AU20 0.6, AU25 0.5, AU2 0.4, AU5 0.4", "fear 0.5, disgust 0.5"},
    {"angrilySurprised", "Du et al. 2014: 4+25+26", "AU4 0.9, AU25 0.5, AU26 0.8, AU7 0.4, AU5 0.3",
     "anger 0.5, surprise 0.5"},
    {"angrilyDisgusted", "Du et al. 2014: 4+10+17", "AU4 0.9, AU10 0.6, AU17 0.6, AU7 0.5, AU9 0.5",
     "anger 0.5, disgust 0.5"},
    {"disgustedlySurprised", "Du et al. 2014: 1+2+5+10", "AU1 0.8, AU2 0.8, AU5 0.6, AU10 0.6, AU17 0.5",
     "disgust 0.5, surprise 0.5"},
    {"appalled", "Du et al. 2014: 4+10", "AU4 0.8, AU10 0.6, AU9 0.5, AU17 0.5", "disgust 0.6, anger 0.4"},
    {"hatred", "Du et al. 2014: 4+10", "AU4 1, AU10 0.5, AU7 0.6, AU17 0.6", "anger 0.7, disgust 0.3"},
    {"awed", "Du et al. 2014: 1+2+5+25", "AU1 0.8, AU2 0.8, AU5 0.8, AU25 0.5, AU20 0.4, AU26 0.5",
     "fear 0.4, surprise 0.6"},
};

/// Exercise and alcohol are those measured in jimenez-2012, 7.3; blush, pallor and cold are ours. What little they
/// move: breath through the mouth, heavy lids, eyes narrowed against the wind.
constexpr ExpressionRow states[] = {
    {"exercise", "after running up nine flights of stairs", "AU25 0.25"},
    {"alcohol", "after half a litre of beer", "AU43 0.12"},
    {"blush", "blood in the cheeks, ears and neck", ""},
    {"pallor", "blood gone from the face", ""},
    {"cold", "a red nose and ears, pale cheeks", "AU7 0.15"},
};

constexpr std::size_t zone_count = wrinkle_zone_places.size();

struct ZoneRow {
    std::string_view drivers;
    std::array<float, zone_count> weights;  ///< in the order of wrinkle_zone_places
};

/// jimenez-2012, table 8.1, as printed: its eight zones.
constexpr ZoneRow printed_zone_rows[] = {
    {"joy", {1.0F, 1.0F, 0.2F, 0.2F, 0.0F, 0.0F, 0.0F, 0.0F}},
    {"surprise", {0.8F, 0.8F, 0.8F, 0.8F, 0.0F, 0.0F, 0.0F, 0.0F}},
    {"fear", {0.2F, 0.2F, 0.75F, 0.75F, 0.3F, 0.3F, 0.0F, 0.6F}},
    {"anger", {-0.6F, -0.6F, -0.8F, -0.8F, 0.8F, 0.8F, 1.0F, 0.0F}},
    {"disgust", {0.0F, 0.0F, -0.1F, -0.1F, 1.0F, 1.0F, 1.0F, 0.5F}},
    {"sadness", {0.2F, 0.2F, 0.75F, 0.75F, 0.0F, 0.0F, 0.1F, 1.0F}},
};

/// Added to the printed ones.
constexpr ZoneRow own_zone_rows[] = {
    // A smile folds no forehead: the outer zones of the paper reach down to the corners of the eyes, which are zones of
    // their own here and take all of their weight. AU12 deepens the nasolabial fold (Ekman, Friesen, Hager 2002).
    {"joy", {-1.0F, -1.0F, -0.2F, -0.2F, 0, 0, 0, 0, 1.0F, 1.0F, 0.9F, 0.9F}},
    // By the units that these emotions have (AU9, AU10, AU11, AU20; AU6 in disgust).
    {"disgust", {0, 0, 0, 0, 0, 0, 0, 0, 0.3F, 0.3F, 0.8F, 0.8F}},
    {"sadness", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.3F, 0.3F}},
    {"anger", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.25F, 0.25F}},
    {"fear", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.2F, 0.2F}},
    // Surprise and anger together leave no wrinkle on the forehead (figure 8.5 and its text), but the printed weights
    // leave 0.8 - 0.6 on its outer zones: the rest goes where both act.
    {"surprise+anger", {-0.2F, -0.2F}},
    // So that a recorded performance wrinkles too: what the shapes do to the skin where no emotion above says it.
    {"browInnerUpLeft", {0, 0, 0.8F}},
    {"browInnerUpRight", {0, 0, 0, 0.8F}},
    {"browOuterUpLeft", {0.8F}},
    {"browOuterUpRight", {0, 0.8F}},
    {"browDownLeft", {-0.6F, 0, -0.8F, 0, 0, 0, 0.5F}},
    {"browDownRight", {0, -0.6F, 0, -0.8F, 0, 0, 0.5F}},
    {"noseSneerLeft", {0, 0, 0, 0, 1.0F, 0, 0.25F, 0, 0, 0, 0.5F}},
    {"noseSneerRight", {0, 0, 0, 0, 0, 1.0F, 0.25F, 0, 0, 0, 0, 0.5F}},
    {"mouthUpperUpLeft", {0, 0, 0, 0, 0.3F, 0, 0, 0, 0, 0, 0.5F}},
    {"mouthUpperUpRight", {0, 0, 0, 0, 0, 0.3F, 0, 0, 0, 0, 0, 0.5F}},
    {"mouthShrugLower", {0, 0, 0, 0, 0, 0, 0, 1.0F}},
    {"mouthFrownLeft", {0, 0, 0, 0, 0, 0, 0, 0.15F}},
    {"mouthFrownRight", {0, 0, 0, 0, 0, 0, 0, 0.15F}},
    {"mouthPucker", {0, 0, 0, 0, 0, 0, 0, 0.3F}},
    {"cheekSquintLeft", {0, 0, 0, 0, 0, 0, 0, 0, 1.0F}},
    {"cheekSquintRight", {0, 0, 0, 0, 0, 0, 0, 0, 0, 1.0F}},
    {"eyeSquintLeft", {0, 0, 0, 0, 0, 0, 0, 0, 0.4F}},
    {"eyeSquintRight", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0.4F}},
    {"mouthSmileLeft", {0, 0, 0, 0, 0, 0, 0, 0, 0.15F, 0, 0.9F}},
    {"mouthSmileRight", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0.15F, 0, 0.9F}},
};

struct BloodRow {
    std::string_view driver, map;
    float share, factor;
};

constexpr BloodRow blood_rows[] = {
    // jimenez-2012, 7.7: the hemoglobin of the whole face is scaled by 127 % in anger and 81 % in fear.
    {"joy", "joy", 1, 1},
    {"sadness", "sadness", 1, 1},
    {"anger", "anger", 1, 1.27F},
    {"fear", "fear", 1, 0.81F},
    {"disgust", "disgust", 1, 1},
    {"surprise", "surprise", 1, 1},
    // The maps of exercise and alcohol hold all of the change: no factor alone gives it (7.3.1, finding 5). A blush is
    // given half of anger's dilation, pallor fear's constriction, cold half of it: ours.
    {"exercise", "exercise", 1, 1},
    {"alcohol", "alcohol", 1, 1},
    {"blush", "blush", 1, 1.135F},
    {"pallor", "pallor", 1, 0.81F},
    {"cold", "cold", 1, 0.905F},
    // What deformation alone does to the blood (7.3.1, finding 2: a smile fills the cheekbones), where no emotion above
    // says it: half of the map of the emotion that makes the shape.
    {"mouthSmileLeft", "joy", 0.25F, 1},
    {"mouthSmileRight", "joy", 0.25F, 1},
    {"mouthFrownLeft", "sadness", 0.25F, 1},
    {"mouthFrownRight", "sadness", 0.25F, 1},
    {"browDownLeft", "anger", 0.25F, 1},
    {"browDownRight", "anger", 0.25F, 1},
    {"noseSneerLeft", "disgust", 0.25F, 1},
    {"noseSneerRight", "disgust", 0.25F, 1},
    {"eyeWideLeft", "surprise", 0.25F, 1},
    {"eyeWideRight", "surprise", 0.25F, 1},
};

std::string with_side(std::string_view text, std::string_view side) {
    std::string result;
    for (const char c : text) {
        if (c == '*') {
            result += side;
        } else {
            result += c;
        }
    }
    return result;
}

std::vector<Drive> parse_drives(std::string_view list, std::string_view only_side = {}) {
    std::vector<Drive> drives;
    while (!list.empty()) {
        const std::size_t comma = list.find(',');
        std::string_view entry = list.substr(0, comma);
        list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
        entry.remove_prefix(entry.find_first_not_of(' '));
        const std::size_t space = entry.find(' ');
        const std::string_view name = entry.substr(0, space), number = entry.substr(space + 1);
        float weight = 0;
        std::from_chars(number.data(), number.data() + number.size(), weight);
        if (name.find('*') == std::string_view::npos) {
            drives.push_back({std::string(name), weight});
        } else if (!only_side.empty()) {
            drives.push_back({with_side(name, only_side), weight});
        } else {
            drives.push_back({with_side(name, "Left"), weight});
            drives.push_back({with_side(name, "Right"), weight});
        }
    }
    return drives;
}

void add_action_units(RigDescription& library) {
    for (const ExpressionRow& row : action_units) {
        library.expressions.push_back(
            {std::string(row.name), ControlKind::action_unit, std::string(row.meaning), parse_drives(row.drives)});
        if (row.drives.find('*') == std::string_view::npos) continue;
        for (const auto& [side, mark] : {std::pair{"Left", "_L"}, std::pair{"Right", "_R"}}) {
            std::vector<Drive> drives = parse_drives(row.drives, side);
            // A shape without sides, in a row that has them, does half of its work for either.
            for (Drive& drive : drives) {
                if (!drive.control.ends_with(side)) drive.weight *= 0.5F;
            }
            library.expressions.push_back({std::string(row.name) + mark, ControlKind::action_unit,
                                           std::string(row.meaning) + (mark[1] == 'L' ? ", left" : ", right"),
                                           std::move(drives)});
        }
    }
}

void add_blood_of_compound(RigDescription& library, const CompoundRow& row) {
    for (const Drive& part : parse_drives(row.blood)) {
        for (const BloodRow& blood : blood_rows) {
            if (blood.driver != part.control) continue;
            library.hemoglobin.push_back(
                {std::string(row.name), std::string(blood.map), part.weight * blood.share, blood.factor});
        }
    }
}

std::vector<std::string> split_at_plus(std::string_view drivers) {
    const std::size_t plus = drivers.find('+');
    if (plus == std::string_view::npos) return {std::string(drivers)};
    return {std::string(drivers.substr(0, plus)), std::string(drivers.substr(plus + 1))};
}

/// To the row of the same drivers, where there is one.
void add_zone_row(RigDescription& library, const ZoneRow& row) {
    const std::vector<std::string> drivers = split_at_plus(row.drivers);
    const auto known = std::ranges::find(library.wrinkles, drivers, &WrinkleRow::drivers);
    if (known == library.wrinkles.end()) {
        library.wrinkles.push_back({drivers, {row.weights.begin(), row.weights.end()}});
        return;
    }
    for (std::size_t z = 0; z < zone_count; ++z) known->weights[z] += row.weights[z];
}

RigDescription make_library() {
    RigDescription library;
    add_action_units(library);
    const auto add = [&](const ExpressionRow& row, ControlKind kind) {
        library.expressions.push_back(
            {std::string(row.name), kind, std::string(row.meaning), parse_drives(row.drives)});
    };
    for (const ExpressionRow& row : emotions) add(row, ControlKind::emotion);
    for (const CompoundRow& row : compounds) add({row.name, row.meaning, row.drives}, ControlKind::compound);
    for (const ExpressionRow& row : states) add(row, ControlKind::state);
    // ARKit's mouthClose shuts the lips over an open jaw; more of it than of jawOpen pushes the lips into each other.
    library.limits.push_back({.control = "mouthClose", .low = 0, .high = 1, .with = "jawOpen", .holds_own = false});
    for (const WrinkleZonePlace& zone : wrinkle_zone_places) {
        library.wrinkle_zones.push_back({std::string(zone.name), 0, 1});
    }
    for (const ZoneRow& row : printed_zone_rows) add_zone_row(library, row);
    for (const ZoneRow& row : own_zone_rows) add_zone_row(library, row);
    for (const ExpressionRow& row : emotions) library.hemoglobin_maps.emplace_back(row.name);
    for (const ExpressionRow& row : states) library.hemoglobin_maps.emplace_back(row.name);
    for (const BloodRow& row : blood_rows) {
        library.hemoglobin.push_back({std::string(row.driver), std::string(row.map), row.share, row.factor});
    }
    for (const CompoundRow& row : compounds) add_blood_of_compound(library, row);
    return library;
}

}  // namespace

const RigDescription& expression_library() {
    static const RigDescription library = make_library();
    return library;
}

}  // namespace blush
