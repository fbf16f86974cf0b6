/// blush accuracy: error against time into a folder.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "runtime/files/face_file.h"
#include "runtime/files/output_file.h"
#include "runtime/measure/accuracy.h"
#include "tools/blush/assets.h"
#include "tools/blush/commands.h"
#include "tools/blush/new_folder.h"

namespace blush::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string face = "default", effect, output;
    bool quick = false, check_finite = false;
    double millimetres_a_unit = 0;
};

Json json_of(const AccuracyReport& report) {
    Json json = {{"face", report.face},
                 {"renderer", report.renderer},
                 {"rounds", report.rounds},
                 {"millimetres_a_unit", report.millimetres_a_unit},
                 {"studies", Json::array()}};
    for (const MeasuredStudy& study : report.studies) {
        Json variants = Json::array();
        for (const MeasuredVariant& variant : study.variants) {
            variants.push_back(
                {{"label", variant.label},
                 {"default", variant.is_default},
                 {"work", variant.work},
                 {"error_mean", variant.error_mean},
                 {"error_worst", variant.error_worst},
                 {"error_mean_rgb", variant.channel_mean},
                 {"error_worst_rgb", variant.channel_worst},
                 {"time_ms", {{"median", variant.median_ms}, {"quartiles", {variant.low_ms, variant.high_ms}}}},
                 {"time_ratio_to_default",
                  {{"median", variant.ratio_to_default}, {"quartiles", {variant.ratio_low, variant.ratio_high}}}},
                 {"on_frontier", variant.on_frontier}});
        }
        json["studies"].push_back({{"effect", study.effect},
                                   {"name", study.name},
                                   {"reference", study.reference},
                                   {"unit", study.unit},
                                   {"variants", std::move(variants)}});
    }
    return json;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string number(double value, const char* format = "%.3g") {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Error over time, both logarithmic, as SVG: the frontier in full colour, what it beats in grey.
std::string plot_of(const MeasuredStudy& study) {
    constexpr double width = 560, height = 220, left = 70, right = 20, top = 16, bottom = 40;
    double low_ms = 1e300, high_ms = 0, low_error = 1e300, high_error = 0;
    for (const MeasuredVariant& variant : study.variants) {
        low_ms = std::min(low_ms, variant.low_ms);
        high_ms = std::max(high_ms, variant.high_ms);
        if (variant.error_worst > 0) low_error = std::min(low_error, variant.error_worst);
        high_error = std::max(high_error, variant.error_worst);
    }
    if (!(high_error > 0)) low_error = high_error = 1e-9;  // everything is exact: one line
    low_ms /= 1.5, high_ms *= 1.5, low_error /= 3, high_error *= 3;
    const auto x = [&](double ms) {
        return left + (width - left - right) * std::log(ms / low_ms) / std::log(high_ms / low_ms);
    };
    const auto y = [&](double error) {
        const double shown = std::max(error, low_error);
        return height - bottom -
               (height - top - bottom) * std::log(shown / low_error) / std::log(high_error / low_error);
    };
    std::string svg = "<svg viewBox=\"0 0 " + number(width, "%.0f") + " " + number(height + 0, "%.0f") +
                      "\" role=\"img\" aria-label=\"worst error over median time\">\n";
    svg += "<rect x=\"" + number(left) + "\" y=\"" + number(top) + "\" width=\"" + number(width - left - right) +
           "\" height=\"" + number(height - top - bottom) + "\" class=\"frame\"/>\n";
    svg +=
        "<text x=\"" + number(left) + "\" y=\"" + number(height - 22, "%.0f") + "\">" + number(low_ms) + " ms</text>";
    svg += "<text x=\"" + number(width - right, "%.0f") + "\" y=\"" + number(height - 22, "%.0f") +
           "\" text-anchor=\"end\">" + number(high_ms) + " ms</text>";
    svg += "<text x=\"" + number((left + width - right) / 2) + "\" y=\"" + number(height - 6, "%.0f") +
           "\" text-anchor=\"middle\">median time, quartiles as a bar</text>";
    svg += "<text x=\"" + number(left - 6) + "\" y=\"" + number(top + 10) + "\" text-anchor=\"end\">" +
           number(high_error) + "</text><text x=\"" + number(left - 6) + "\" y=\"" + number(height - bottom) +
           "\" text-anchor=\"end\">" + number(low_error) + "</text>";
    svg += "<text transform=\"translate(14 " + number((top + height - bottom) / 2) +
           ") rotate(-90)\" text-anchor=\"middle\">worst, " + escaped(study.unit) + "</text>\n";
    for (std::size_t v = 0; v < study.variants.size(); ++v) {
        const MeasuredVariant& variant = study.variants[v];
        const std::string at_y = number(y(variant.error_worst), "%.1f"), kind = variant.on_frontier ? "best" : "beaten";
        svg += "<line class=\"" + kind + "\" x1=\"" + number(x(variant.low_ms), "%.1f") + "\" x2=\"" +
               number(x(variant.high_ms), "%.1f") + "\" y1=\"" + at_y + "\" y2=\"" + at_y + "\"/>";
        svg += "<circle class=\"" + kind + "\" r=\"5\" cx=\"" + number(x(variant.median_ms), "%.1f") + "\" cy=\"" +
               at_y + "\"/><text x=\"" + number(x(variant.median_ms), "%.1f") + "\" y=\"" +
               number(y(variant.error_worst) - 9 - 12.0 * static_cast<double>(v % 2), "%.1f") +
               "\" text-anchor=\"middle\">" + std::to_string(v + 1) + "</text>\n";
    }
    return svg + "</svg>\n";
}

std::string page_of(const AccuracyReport& report) {
    std::string html =
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>blush: accuracy and time</title>\n<style>\n"
        "body{font:16px/1.45 sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}\n"
        "table{border-collapse:collapse;margin:.5rem 0 2rem}td,th{padding:.25rem .7rem;text-align:right;"
        "border-bottom:1px solid "
        "#ddd;white-space:nowrap}td:last-child{white-space:normal}td:nth-child(2),th:nth-child(2),td:last-child,th:"
        "last-child{text-align:left}\n"
        "svg{width:100%;max-width:40rem;font-size:12px;fill:#444}.frame{fill:none;stroke:#bbb}"
        "circle.best{fill:#a3283c}circle.beaten{fill:#aaa}line.best{stroke:#a3283c}line.beaten{stroke:#aaa}"
        "line{stroke-width:2}\n</style>\n<h1>What accuracy costs in time</h1>\n<p>Face: " +
        escaped(report.face) + " (" + number(report.millimetres_a_unit) +
        " mm a unit). Renderer: " + escaped(report.renderer) + ". " + std::to_string(report.rounds) +
        " rounds, the variants of a study in turn; median and quartiles. A ratio compares times of one round. Red: no "
        "other variant is both as fast and more exact.</p>\n";
    std::string effect;
    for (const MeasuredStudy& study : report.studies) {
        if (study.effect != effect) html += "<h2>" + escaped(effect = study.effect) + "</h2>\n";
        html +=
            "<h3>" + escaped(study.name) + "</h3>\n<p>Error in " + escaped(study.unit) + " against " +
            escaped(study.reference) + ".</p>\n" + plot_of(study) +
            "<table><tr><th></th><th>variant</th><th>mean error</th><th>worst</th><th>median ms</th><th>quartiles</th>"
            "<th>time / default</th><th>quartiles</th><th>work</th></tr>\n";
        for (std::size_t v = 0; v < study.variants.size(); ++v) {
            const MeasuredVariant& variant = study.variants[v];
            html += "<tr><td>" + std::to_string(v + 1) + "</td><td>" + escaped(variant.label) +
                    (variant.is_default ? " (default)" : "") + "</td><td>" + number(variant.error_mean) + "</td><td>" +
                    number(variant.error_worst) + "</td><td>" + number(variant.median_ms) + "</td><td>" +
                    number(variant.low_ms) + " to " + number(variant.high_ms) + "</td><td>" +
                    number(variant.ratio_to_default) + "</td><td>" + number(variant.ratio_low) + " to " +
                    number(variant.ratio_high) + "</td><td>" + escaped(variant.work) + "</td></tr>\n";
        }
        html += "</table>\n";
    }
    return html + "</html>\n";
}

int accuracy(const Options& options) {
    const Result<Face> face = load_face(face_path(options.face));
    if (!face) return fail(face.error());
    // Before the minutes of measuring.
    const std::filesystem::path folder = options.output;
    NewFolder new_folder;
    if (Status made = new_folder.make(folder); !made) return fail(made.error());
    Result<Device> device = Device::headless(false);
    if (!device) return fail(device.error());
    AccuracyOptions measure{options.effect, options.quick, options.millimetres_a_unit, {}};
    measure.progress = [](std::string_view study) { std::cerr << "measuring " << study << "\n"; };
    const Result<AccuracyReport> report = measure_accuracy(*device, *face, measure);
    if (!report) return fail({"--effect: " + report.error().message});
    for (const MeasuredStudy& study : report->studies) {
        for (const MeasuredVariant& variant : study.variants) {
            // Errors are sums over every value of a variant's output, so one value that is not finite shows here.
            if (!options.check_finite || std::isfinite(variant.error_mean + variant.error_worst)) continue;
            return fail({"--check-finite: " + study.effect + ", " + study.name + ": \"" + variant.label +
                         "\" has an error that is not finite"});
        }
    }

    const std::string json = json_of(*report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (Status written = write_file(folder / "accuracy.json", json); !written) return fail(written.error());
    if (Status written = write_file(folder / "index.html", page_of(*report)); !written) return fail(written.error());
    for (const MeasuredStudy& study : report->studies) {
        std::cout << study.effect << ", " << study.name << "\n";
        for (const MeasuredVariant& variant : study.variants) {
            std::printf(
                "  %-36s worst %9.3g %s, %8.3g ms (x%.3g of the default, "
                "quartiles %.3g to %.3g), %s\n",
                variant.label.c_str(), variant.error_worst, study.unit.c_str(), variant.median_ms,
                variant.ratio_to_default, variant.ratio_low, variant.ratio_high, variant.work.c_str());
            const bool by_channel = std::ranges::any_of(variant.channel_worst, [](double e) { return e > 0; });
            if (!by_channel) continue;
            const auto& mean = variant.channel_mean;
            const auto& worst = variant.channel_worst;
            std::printf(
                "  %-36s mean %.3g, worst %.3g; red %.3g, %.3g; green %.3g, "
                "%.3g; blue %.3g, %.3g\n",
                "", variant.error_mean, variant.error_worst, mean[0], worst[0], mean[1], worst[1], mean[2], worst[2]);
        }
        std::fflush(stdout);
    }
    std::cout << (folder / "index.html").string() << ", " << (folder / "accuracy.json").string() << "\n";
    return 0;
}

}  // namespace

void add_accuracy(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand(
        "accuracy", "Measure error against time for every effect and setting, and write a page of it");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").shows_default();
    command.option("--effect", &options->effect, "One effect by name");
    command.flag("--quick", options->quick, "Fewer rounds and the largest study of each effect only");
    command.flag("--check-finite", options->check_finite, "Fail on any error that is not finite");
    command
        .option("--millimetres-per-unit", &options->millimetres_a_unit,
                "Scale of the face; found from its size without it")
        .range(1e-6, 1e6);
    command.option("-o,--output", &options->output, "A folder for accuracy.json and index.html").required();
    command.runs([options] { return accuracy(*options); });
}

}  // namespace blush::tool
