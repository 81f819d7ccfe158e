#include "common.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "dotpose/files/camera_file.hpp"
#include "dotpose/files/code_names.hpp"
#include "dotpose/files/option_names.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/image_file.hpp"
#include "system/path.hpp"

namespace dotpose::cli {
namespace {

const std::map<std::string, DotDrawing> kDrawings = {
    {"auto", DotDrawing::automatic},
    {"glyphs", DotDrawing::glyphs},
    {"strokes", DotDrawing::strokes},
};

/// Values of --code other than auto.
const std::vector<std::string> kCodes = {"anoto", "libdots", "microdots"};

std::vector<std::string> g_arguments;

/// Parses "A,B", two integers in the range [0, limit).
std::pair<std::uint32_t, std::uint32_t> parse_pair(const std::string& flag, const std::string& text,
                                                   std::uint32_t limit) {
    const auto numbers = whole_numbers(text, ",", limit - 1);
    if (!numbers) {
        throw ValidationError(
            flag, fmt::format("'{}' must be two whole numbers from 0 to {}, separated by a comma",
                              text, limit - 1));
    }
    return {(*numbers)[0], (*numbers)[1]};
}

/// Requires a positive number. CLI11 has an equivalent check, but its error message prints the
/// upper limit with 309 digits.
std::string require_positive(const std::string& text) {
    double value = 0;
    if (parse_number(text, value) && value > 0 && std::isfinite(value)) return {};
    return "'" + text + "' is not a length in mm above 0";
}

/// Rejects a spacing that was probably given in micrometres or metres instead of millimetres. The
/// minimum spacing is about ten printer dots at 25,000 dpi. With the maximum spacing, the smallest
/// view that determines a position, 8 x 8 dots, is 0.8 m wide.
std::string require_spacing(const std::string& text) {
    constexpr double kMin_mm = 0.01;
    constexpr double kMax_mm = 100;
    double value_mm = 0;
    if (!parse_number(text, value_mm) || !(value_mm > 0)) return require_positive(text);
    if (value_mm >= kMin_mm && value_mm <= kMax_mm) return {};
    return fmt::format("'{}' is not a spacing in mm from {:g} to {:g}; the default is {:g}", text,
                       kMin_mm, kMax_mm, kDefaultSpacing_mm);
}

void add_error_rate_option(Command& command, ErrorRates rates, int& bits_per_error) {
    const bool may_measure = rates == ErrorRates::known_or_measured;
    command
        .add_option_function<std::string>(
            "--bits-per-error",
            [&bits_per_error, may_measure](const std::string& text) {
                constexpr std::uint32_t kMax = 65536;
                if (may_measure && text == "measured") {
                    bits_per_error = kMeasuredErrorRate;
                    return;
                }
                const auto number = whole_numbers(text, "", kMax);
                if (!number)
                    throw ValidationError("--bits-per-error",
                                          fmt::format("'{}' is not {}a number from 0 to {}", text,
                                                      may_measure ? "'measured' or " : "", kMax));
                bits_per_error = static_cast<int>(number->front());
            },
            fmt::format("Minimum number of bits per misread bit with this print and camera{}: "
                        "smaller views suffice",
                        may_measure ? ", or 'measured' to measure it over the images so far" : ""))
        ->type_name("N")
        ->default_str("unknown");
}

}  // namespace

void add_code_option(Command& command, CodeVariant& code) {
    command
        .add_option_function<std::string>(
            "--code", [&code](const std::string& asked) { code = *code_by_name(asked); },
            "Code variant: " + alternatives(kCodes))
        ->type_name("NAME")
        ->default_str(code_name(code))
        ->check(one_of(kCodes));
}

void add_code_option(Command& command, std::optional<CodeVariant>& code) {
    std::vector<std::string> names = {"auto"};
    names.insert(names.end(), kCodes.begin(), kCodes.end());
    command
        .add_option_function<std::string>(
            "--code", [&code](const std::string& asked) { code = code_by_name(asked); },
            "Code variant that was printed: " + alternatives(kCodes) + "; auto: detected")
        ->type_name("NAME")
        ->default_str("auto")
        ->check(one_of(names));
}

void add_section_option(Command& command, Section& section) {
    command
        .add_option_function<std::string>(
            "--section",
            [&section](const std::string& text) {
                const auto [u, v] = parse_pair("--section", text, kSections);
                section = {static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v)};
            },
            "Section of the code, each number 0 to 62")
        ->type_name("U,V")
        ->default_str(fmt::format("{},{}", section.u, section.v));
}

void add_spacing_option(Command& command, double& spacing_mm) {
    command.add_option("--spacing", spacing_mm, "Distance between adjacent grid intersections")
        ->type_name("MM")
        ->capture_default_str()
        ->check(require_spacing);
}

void add_cell_option(Command& command, const std::string& flag, Cell& cell,
                     const std::string& help) {
    command
        .add_option_function<std::string>(
            flag,
            [&cell, flag](const std::string& text) {
                const auto [x, y] = parse_pair(flag, text, kPositionsPerAxis);
                cell = {x, y};
            },
            help)
        ->type_name("X,Y")
        ->default_str(fmt::format("{},{}", cell.x, cell.y));
}

Option* add_sheets_option(Command& command, std::string& path, const std::string& help) {
    const auto not_empty = [](const std::string& text) {
        return text.empty() ? std::string("the name of the sheet file is empty") : std::string();
    };
    return command.add_option("--sheets", path, help)->type_name("FILE")->check(not_empty);
}

Option* add_lens_option(Command& command, FixedLens& lens) {
    return command
        .add_option_function<double>(
            "--k",
            [&lens](double k_per_px2) {
                constexpr double kMax_k = 1.0 / 512;
                if (!(std::abs(k_per_px2) < kMax_k)) {
                    throw ValidationError("--k", fmt::format("{} is not between {:.4f} and {:.4f}",
                                                             k_per_px2, -kMax_k, kMax_k));
                }
                lens = FixedLens::from_k(k_per_px2);
            },
            "Radial distortion, below 0 for barrel: p = m + r / (1 + k r^2)")
        ->type_name("1/PX^2")
        ->default_str("0");
}

void add_flip_option(Command& command, bool& flip) {
    command.add_flag("--flip", flip,
                     "First flip the image left to right, for a mirror or a camera that mirrors");
}

Option* add_camera_option(Command& command, CameraArgument& camera, const std::string& help) {
    return command
        .add_option_function<std::string>(
            "--camera",
            [&camera](const std::string& path) {
                camera = {path, read_camera(system::path_of(path))};
            },
            help)
        ->type_name("FILE");
}

void add_attempt_options(Command& command, ErrorRates rates, DeviceOptions& options) {
    add_named(command, "--decoder", kDecoders, name(options.decoder),
              "Dots from which the position is read",
              [&options](Decoder decoder) { options.decoder = decoder; });
    add_named(command, "--effort", kEfforts, name(options.effort), "How hard to try",
              [&options](Effort effort) { options.effort = effort; });
    add_error_rate_option(command, rates, options.integrity.bits_per_error);
}

void add_size_option(Command& command, CameraModel& camera) {
    command
        .add_option_function<std::string>(
            "--size",
            [&camera](const std::string& text) {
                const FrameSize size = parse_frame_size("--size", text);
                camera.width_px = size.width_px;
                camera.height_px = size.height_px;
            },
            "Size of a frame")
        ->type_name("WxH")
        ->default_str(fmt::format("{}x{}", camera.width_px, camera.height_px));
}

std::string drawing_name(DotDrawing drawing) {
    for (const auto& [name, value] : kDrawings) {
        if (value == drawing) return name;
    }
    return {};
}

std::optional<DotDrawing> drawing_by_name(const std::string& name) {
    const auto found = kDrawings.find(name);
    return found == kDrawings.end() ? std::nullopt : std::optional(found->second);
}

void add_drawing_option(Command& command, DotDrawing& drawing) {
    std::vector<std::string> names;
    for (const auto& [name, value] : kDrawings)
        names.push_back(name);
    command
        .add_option_function<std::string>(
            "--dots", [&drawing](const std::string& name) { drawing = kDrawings.at(name); },
            "Dots of a PDF: glyphs are small and fast, strokes are exact at any spacing; auto uses "
            "glyphs if they are exact at --dpi")
        ->type_name("NAME")
        ->default_str("auto")
        ->check(one_of(names));
}

std::optional<std::vector<std::uint32_t>> whole_numbers(std::string_view text,
                                                        std::string_view separators,
                                                        std::uint32_t max) {
    std::vector<std::uint32_t> numbers;
    const char* next = text.data();
    const char* const end = next + text.size();
    while (true) {
        std::uint32_t& number = numbers.emplace_back();
        const auto [stop, error] = std::from_chars(next, end, number);
        if (error != std::errc() || number > max) return std::nullopt;
        const std::size_t done = numbers.size() - 1;
        if (done == separators.size()) return stop == end ? std::optional(numbers) : std::nullopt;
        if (stop == end || *stop != separators[done]) return std::nullopt;
        next = stop + 1;
    }
}

FrameSize parse_frame_size(const std::string& flag, const std::string& text) {
    const auto numbers = whole_numbers(text, "x", kMaxImageSide_px);
    if (!numbers || (*numbers)[0] == 0 || (*numbers)[1] == 0) {
        throw ValidationError(flag,
                              fmt::format("'{}' is not WIDTHxHEIGHT in px, such as 188x120", text));
    }
    const std::uint64_t pixels = std::uint64_t{(*numbers)[0]} * (*numbers)[1];
    if (pixels > kMaxImagePixels) {
        throw ValidationError(
            flag, fmt::format("{} has more than {} million pixels", text, kMaxImagePixels >> 20));
    }
    return {static_cast<int>((*numbers)[0]), static_cast<int>((*numbers)[1])};
}

void refuse_non_finite_numbers(Command& app) {
    // Option types whose values are text. Text may look like a number: for example, a file may be
    // named "nan".
    const std::set<std::string> texts = {"DIR",   "FILE", "FILE|-", "FILE|-|DIR", "NAME", "PART",
                                         "RANGE", "SCAN", "SOURCE", "TEXT",       "URL"};
    const auto is_finite = [](const std::string& text) -> std::string {
        double value = 0;
        if (!parse_number(text, value) || std::isfinite(value)) return {};
        return "'" + text + "' is not a finite number";
    };
    for (Command* command : app.get_all_subcommands()) {
        for (Option* option : command->get_options()) {
            if (!texts.contains(option->get_type_name())) option->check(is_finite);
        }
        refuse_non_finite_numbers(*command);
    }
}

void remember_command_line(int argc, const char* const* argv) {
    g_arguments.assign(argv, argv + argc);
}

std::vector<std::string> given_arguments() {
    return {g_arguments.begin() + 1, g_arguments.end()};
}

std::string quoted_for_shell(const std::string& word) {
    constexpr const char* kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_./,:=@%+";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string command_line(const std::set<std::string>& without) {
    std::string line = "dotpose";
    for (std::size_t i = 1; i < g_arguments.size(); ++i) {
        const std::string& word = g_arguments[i];
        if (without.contains(word)) {
            ++i;
        } else if (!without.contains(word.substr(0, word.find('=')))) {
            line += " " + quoted_for_shell(word);
        }
    }
    return line;
}

void PatternArguments::add_to(Command& command, Use use) {
    if (use == Use::made) {
        add_code_option(command, given_.code);
        add_section_option(command, given_.section);
    } else {
        add_code_option(command, expected_code_);
    }
    add_spacing_option(command, given_.spacing_mm);
    command.add_option("--displacement", displacement_mm_, "From intersection to dot centre")
        ->type_name("MM")
        ->default_str("spacing/6")
        ->check(require_positive);
    command.add_option("--dot", dot_mm_, "Diameter of a dot")
        ->type_name("MM")
        ->default_str("spacing/6")
        ->check(require_positive);
}

Pattern PatternArguments::pattern() const {
    Pattern pattern = given_;
    pattern.code = expected_code_.value_or(given_.code);
    pattern.displacement_mm = displacement_mm_.value_or(pattern.spacing_mm / 6);
    pattern.dot_mm = dot_mm_.value_or(pattern.spacing_mm / 6);
    return pattern;
}

std::string region_text(const Sheet& sheet) {
    const Pattern& pattern = sheet.pattern;
    return fmt::format(
        "page {:g} x {:g} mm, cells {},{} to {},{} ({} x {}), spacing {:g} mm, section {},{}, code "
        "{}",
        sheet.width_mm, sheet.height_mm, sheet.origin.x, sheet.origin.y,
        sheet.origin.x + static_cast<std::uint32_t>(sheet.columns - 1),
        sheet.origin.y + static_cast<std::uint32_t>(sheet.rows - 1), sheet.columns, sheet.rows,
        pattern.spacing_mm, pattern.section.u, pattern.section.v, code_name(pattern.code));
}

const char* code_name(CodeVariant code) {
    return name(code);
}

}  // namespace dotpose::cli
