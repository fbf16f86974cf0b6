#include "runtime/files/rig_description_file.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <unordered_map>

#include "rig/names.h"
#include "runtime/files/bad_file.h"
#include "runtime/files/bytes.h"
#include "runtime/files/json_text.h"

namespace blush {
namespace {

namespace fs = std::filesystem;
using load::refuse;

/// Any name of a rig is far shorter; it also bounds the messages.
constexpr std::size_t longest_name = 200;

std::string member(const std::string& place, std::string_view key) {
    return place + (place.empty() ? "" : ".") + std::string(key);
}

/// One file laid over a description. Refuses with BadFile.
class Reader {
public:
    explicit Reader(RigDescription& into) : into_(into) {
        for (std::size_t i = 0; i < into.expressions.size(); ++i) {
            expression_at_.emplace(canonical_name(into.expressions[i].name), i);
        }
    }

    void read(const Json& root) {
        if (!root.is_object()) refuse("", std::string("a rig must be an object, not ") + root.type_name());
        const Json* version = find(root, "blush_rig");
        if (version == nullptr) refuse("", "not a rig description: the key 'blush_rig' is missing");
        if (*version != 1) refuse("blush_rig", "version " + version->dump() + " is not known, only 1 is");
        only(root, "",
             {"blush_rig", "name", "action_units", "emotions", "compounds", "states", "in_betweens", "correctives",
              "limits", "wrinkles", "hemoglobin"});
        if (const Json* name = find(root, "name")) text(*name, "name");
        for (const ControlKind kind :
             {ControlKind::action_unit, ControlKind::emotion, ControlKind::compound, ControlKind::state}) {
            if (const Json* list = find(root, plural_of(kind))) expressions(*list, kind);
        }
        if (const Json* list = find(root, "in_betweens")) in_betweens(*list);
        if (const Json* list = find(root, "correctives")) correctives(*list);
        if (const Json* list = find(root, "limits")) limits(*list);
        if (const Json* part = find(root, "wrinkles")) wrinkles(*part);
        if (const Json* part = find(root, "hemoglobin")) hemoglobin(*part);
    }

private:
    static const Json* find(const Json& object, std::string_view key) {
        const auto found = object.find(key);
        return found == object.end() ? nullptr : &*found;
    }
    static const Json& need(const Json& object, const std::string& place, std::string_view key) {
        const Json* found = find(object, key);
        if (found == nullptr) refuse(place, "the key '" + std::string(key) + "' is missing");
        return *found;
    }
    static void must_be(bool holds, const Json& value, const std::string& place, const std::string& wanted) {
        if (!holds) refuse(place, "it must be " + wanted + ", not " + value.type_name());
    }
    static const Json& object(const Json& value, const std::string& place) {
        must_be(value.is_object(), value, place, "an object");
        for (const auto& [key, ignored] : value.items()) name(key, place);
        return value;
    }
    static const Json& array(const Json& value, const std::string& place) {
        must_be(value.is_array(), value, place, "an array");
        return value;
    }
    static std::string name(const std::string& text, const std::string& place) {
        if (text.empty()) refuse(place, "a name is empty");
        if (text.size() > longest_name) refuse(place, "a name may have " + std::to_string(longest_name) + " bytes");
        return text;
    }
    static std::string text(const Json& value, const std::string& place) {
        must_be(value.is_string(), value, place, "a string");
        return value.get<std::string>();
    }
    static std::string name(const Json& value, const std::string& place) { return name(text(value, place), place); }
    static float number(const Json& value, const std::string& place) {
        must_be(value.is_number(), value, place, "a number");
        return static_cast<float>(std::clamp(value.get<double>(), -1e30, 1e30));  // check() has the real bounds
    }
    static bool truth(const Json& value, const std::string& place) {
        must_be(value.is_boolean(), value, place, "true or false");
        return value.get<bool>();
    }

    /// Refuses keys that are not among the known ones.
    static void only(const Json& object, const std::string& place, std::initializer_list<std::string_view> known) {
        for (const auto& [key, ignored] : object.items()) {
            if (std::ranges::find(known, key) != known.end()) continue;
            const std::vector<std::string> names(known.begin(), known.end());
            const auto near = nearest_name(key, names);
            refuse(member(place, name(key, place)),
                   "there is no such key" + (near ? " (did you mean '" + *near + "'?)" : std::string()));
        }
    }

    void expressions(const Json& list, ControlKind kind) {
        for (const auto& [key, value] : object(list, plural_of(kind)).items()) {
            const std::string place = member(plural_of(kind), key);
            if (!expressions_here_.insert(canonical_name(key)).second) refuse(place, "it is there twice");
            only(object(value, place), place, {"meaning", "drives"});
            Expression expression{.name = key, .kind = kind, .meaning = {}, .drives = {}};
            if (const Json* meaning = find(value, "meaning")) expression.meaning = text(*meaning, place + ".meaning");
            const std::string drives = place + ".drives";
            for (const auto& [control, weight] : object(need(value, place, "drives"), drives).items()) {
                expression.drives.push_back({control, number(weight, member(drives, control))});
            }
            const auto [same, added] = expression_at_.emplace(canonical_name(key), into_.expressions.size());
            if (added) {
                into_.expressions.push_back(std::move(expression));
            } else {
                Expression& known = into_.expressions[same->second];
                expression.name = known.name;  // rows of wrinkles and hemoglobin go by it
                known = std::move(expression);
            }
        }
    }

    void in_betweens(const Json& list) {
        into_.in_betweens.clear();
        for (const Json& value : array(list, "in_betweens")) {
            const std::string place = load::at("in_betweens", into_.in_betweens.size());
            only(object(value, place), place, {"shape", "target", "at"});
            into_.in_betweens.push_back({name(need(value, place, "shape"), place + ".shape"),
                                         name(need(value, place, "target"), place + ".target"),
                                         number(need(value, place, "at"), place + ".at")});
        }
    }

    void correctives(const Json& list) {
        into_.correctives.clear();
        for (const Json& value : array(list, "correctives")) {
            const std::string place = load::at("correctives", into_.correctives.size());
            only(object(value, place), place, {"target", "drivers", "rule", "weight"});
            Corrective corrective;
            corrective.target = name(need(value, place, "target"), place + ".target");
            const Json& drivers = array(need(value, place, "drivers"), place + ".drivers");
            for (std::size_t d = 0; d < drivers.size(); ++d) {
                corrective.drivers.push_back(name(drivers[d], load::at(place + ".drivers", d)));
            }
            if (const Json* rule = find(value, "rule")) {
                const std::string word = text(*rule, place + ".rule");
                if (word != "product" && word != "minimum")
                    refuse(place + ".rule", "it is neither product nor minimum");
                corrective.rule = word == "product" ? CorrectiveRule::product : CorrectiveRule::minimum;
            }
            if (const Json* weight = find(value, "weight")) corrective.weight = number(*weight, place + ".weight");
            into_.correctives.push_back(std::move(corrective));
        }
    }

    void limits(const Json& list) {
        std::set<std::string> here;
        std::vector<Limit> read;
        for (const auto& [key, value] : object(list, "limits").items()) {
            const std::string place = member("limits", key);
            if (!here.insert(canonical_name(key)).second) refuse(place, "it is there twice");
            only(object(value, place), place, {"low", "high", "with", "holds_own"});
            Limit limit;
            limit.control = key;
            if (const Json* low = find(value, "low")) limit.low = number(*low, place + ".low");
            if (const Json* high = find(value, "high")) limit.high = number(*high, place + ".high");
            if (const Json* with = find(value, "with")) limit.with = name(*with, place + ".with");
            if (const Json* own = find(value, "holds_own")) limit.holds_own = truth(*own, place + ".holds_own");
            read.push_back(std::move(limit));
        }
        std::erase_if(into_.limits, [&](const Limit& known) { return here.contains(canonical_name(known.control)); });
        std::ranges::move(read, std::back_inserter(into_.limits));
    }

    void wrinkles(const Json& part) {
        only(object(part, "wrinkles"), "wrinkles", {"zones", "weights"});
        if (const Json* zones = find(part, "zones")) {
            into_.wrinkle_zones.clear();
            into_.wrinkles.clear();  // they were for other zones
            for (const Json& value : array(*zones, "wrinkles.zones")) {
                const std::string place = load::at("wrinkles.zones", into_.wrinkle_zones.size());
                only(object(value, place), place, {"name", "low", "high"});
                WrinkleZone zone;
                zone.name = name(need(value, place, "name"), place + ".name");
                if (const Json* low = find(value, "low")) zone.low = number(*low, place + ".low");
                if (const Json* high = find(value, "high")) zone.high = number(*high, place + ".high");
                into_.wrinkle_zones.push_back(std::move(zone));
            }
        }
        const Json* rows = find(part, "weights");
        if (rows == nullptr) return;
        std::set<std::string> here;
        std::vector<WrinkleRow> read;
        for (const auto& [key, value] : object(*rows, "wrinkles.weights").items()) {
            const std::string place = member("wrinkles.weights", key);
            WrinkleRow row;
            for (std::size_t start = 0; start <= key.size();) {
                const std::size_t end = std::min(key.find('+', start), key.size());
                row.drivers.push_back(key.substr(start, end - start));
                start = end + 1;
            }
            if (!here.insert(folded(row.drivers)).second) refuse(place, "it is there twice");
            array(value, place);
            for (std::size_t i = 0; i < value.size(); ++i) row.weights.push_back(number(value[i], load::at(place, i)));
            read.push_back(std::move(row));
        }
        std::erase_if(into_.wrinkles, [&](const WrinkleRow& known) { return here.contains(folded(known.drivers)); });
        std::ranges::move(read, std::back_inserter(into_.wrinkles));
    }

    static std::string folded(const std::vector<std::string>& drivers) {
        std::string joined;
        for (const std::string& driver : drivers) joined += canonical_name(driver) + "+";
        return joined;
    }

    void hemoglobin(const Json& part) {
        only(object(part, "hemoglobin"), "hemoglobin", {"maps", "weights"});
        if (const Json* maps = find(part, "maps")) {
            for (const Json& map : array(*maps, "hemoglobin.maps")) {
                into_.hemoglobin_maps.push_back(name(map, "hemoglobin.maps"));
            }
        }
        const Json* rows = find(part, "weights");
        if (rows == nullptr) return;
        std::set<std::string> here;
        std::vector<HemoglobinRow> read;
        for (const auto& [key, value] : object(*rows, "hemoglobin.weights").items()) {
            const std::string place = member("hemoglobin.weights", key);
            if (!here.insert(canonical_name(key)).second) refuse(place, "it is there twice");
            only(object(value, place), place, {"maps", "factor"});
            const Json* factor = find(value, "factor");
            const float on_all = factor == nullptr ? 1.0F : number(*factor, place + ".factor");
            const Json& maps = object(need(value, place, "maps"), place + ".maps");
            for (const auto& [map, share] : maps.items()) {
                read.push_back({key, map, number(share, member(place + ".maps", map)), on_all});
            }
        }
        std::erase_if(into_.hemoglobin,
                      [&](const HemoglobinRow& known) { return here.contains(canonical_name(known.driver)); });
        std::ranges::move(read, std::back_inserter(into_.hemoglobin));
    }

    RigDescription& into_;
    std::set<std::string> expressions_here_;
    std::unordered_map<std::string, std::size_t> expression_at_;  ///< by canonical name
};

/// Names come from the file: what would break a line or a terminal does not reach the message.
std::string printable(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
    }
    return text;
}

}  // namespace

Result<RigDescription> load_rig_description(const fs::path& path, const Face& face) {
    const std::string file = path.string();
    try {
        constexpr std::uint64_t most_bytes = 64U << 20;  // what parse_json() takes
        const load::Bytes bytes = load::read_file(path, most_bytes, "");
        std::string_view contents(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
        if (contents.starts_with(byte_order_mark)) contents.remove_prefix(byte_order_mark.size());
        if (contents.find_first_not_of(" \t\r\n") == std::string_view::npos) refuse("", "the file is empty");
        const Result<Json> root = parse_json(contents, file, "a rig description");
        if (!root) return root.error();
        RigDescription description = default_description(face);
        description.path = file;
        Reader(description).read(*root);
        if (Status good = check(description, face); !good) {
            return Error{file + ": " + printable(good.error().message)};
        }
        return description;
    } catch (const load::BadFile& bad) {
        return Error{file + ": " + printable((bad.place.empty() ? "" : bad.place + ": ") + bad.reason)};
    } catch (const std::exception& error) {
        return Error{file + ": the file cannot be read (" + error.what() + ")"};
    }
}

std::optional<fs::path> rig_description_beside(const fs::path& face_file) {
    fs::path beside = face_file;
    beside.replace_extension(".rig.json");
    std::error_code ignored;
    return fs::exists(beside, ignored) ? std::optional(beside) : std::nullopt;
}

Result<RigDescription> find_rig_description(const Face& face, const fs::path& named) {
    if (!named.empty()) return load_rig_description(named, face);
    if (const auto beside = rig_description_beside(face.path)) return load_rig_description(*beside, face);
    return default_description(face);
}

}  // namespace blush
