/// Options that several subcommands share, spelt and explained in one place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "dotpose/options.hpp"
#include "dotpose/tools/camera_file.hpp"
#include "dotpose/tools/print.hpp"
#include "dotpose/tools/sheet.hpp"
#include "dotpose/tools/simulate.hpp"
#include "fields.hpp"

namespace dotpose::cli {

/// --code anoto|libdots|microdots, of what is made. The default stays what `profile` holds.
void add_code_option(CLI::App& command, Profile& profile);

/// --code auto|anoto|libdots|microdots, of what is read; none: auto, the default.
void add_code_option(CLI::App& command, std::optional<Profile>& code);

/// --section U,V; each 0 to 62.
void add_section_option(CLI::App& command, Section& section);

/// --spacing MM; more than 0.
void add_spacing_option(CLI::App& command, double& spacing_mm);

/// --origin X,Y, a cell; the meaning of the cell for this command is in `help`.
void add_cell_option(CLI::App& command, const std::string& flag, Cell& cell,
                     const std::string& help);

/// --sheets FILE; what the file is for in this command is in `help`.
CLI::Option* add_sheets_option(CLI::App& command, std::string& path, const std::string& help);

/// --k 1/PX^2: what `locate` corrects.
CLI::Option* add_lens_option(CLI::App& command, Lens& lens);

/// A camera file and what it says.
struct CameraArgument {
    std::string path;  ///< empty: none
    std::optional<Camera> camera;
};

/// --camera FILE, which is read at once.
CLI::Option* add_camera_option(CLI::App& command, CameraArgument& camera, const std::string& help);

/// --decoder and --effort. `options` must outlive the command.
void add_attempt_options(CLI::App& command, Options& options);

/// --format jsonl|csv of output lines.
void add_format_option(CLI::App& command, RecordFormat& format);

/// --size WxH of a simulated frame.
void add_size_option(CLI::App& command, CameraModel& camera);

/// An option whose value is the name of one of `values`, which must outlive the command.
template <typename Values, typename Store>
CLI::Option* add_named(CLI::App& command, const std::string& flag, const Values& values,
                       const std::string& default_name, const std::string& help, Store store) {
    std::string names;
    for (const auto value : values)
        names += (names.empty() ? "" : ", ") + std::string(name(value));
    return command
        .add_option_function<std::string>(
            flag,
            [&values, names, flag, store](const std::string& asked) {
                for (const auto value : values) {
                    if (asked == name(value)) return store(value);
                }
                throw CLI::ValidationError(flag,
                                           fmt::format("'{}' is not one of {}", asked, names));
            },
            help + ": " + names)
        ->type_name("NAME")
        ->default_str(default_name);
}

/// --code, --section, --spacing, --displacement and --dot.
class PatternArguments {
  public:
    /// What the pattern is for. The section of one that is expected is found in the image, so it is
    /// no option.
    enum class Use { made, expected };
    void add_to(CLI::App& command, Use use = Use::made);

    /// The pattern asked for. Displacement and dot diameter follow the spacing (one sixth of it)
    /// unless they were given.
    Pattern pattern() const;

    /// The profile that is expected; none: it is found out.
    std::optional<Profile> expected_code() const { return expected_code_; }

  private:
    Pattern given_;
    std::optional<Profile> expected_code_;
    std::optional<double> displacement_mm_;
    std::optional<double> dot_mm_;
};

/// --dots: how a PDF draws them.
void add_drawing_option(CLI::App& command, DotDrawing& drawing);

/// The whole numbers from 0 to `most` in a text, with these separators between them and nothing
/// else: "640x480" with the separator x, "10,20,640x480" with ",,x". None if it is no such text.
std::optional<std::vector<std::uint32_t>> whole_numbers(std::string_view text,
                                                        std::string_view separators,
                                                        std::uint32_t most);

struct FrameSize {
    int width_px = 0;
    int height_px = 0;
};
/// "WIDTHxHEIGHT". Throws CLI::ValidationError that names the flag.
FrameSize parse_frame_size(const std::string& flag, const std::string& text);

/// Every option of every subcommand refuses what is read as a number and is none that can be
/// reckoned with: nan, inf, 1e999. To be called when all options are there.
void refuse_non_finite_numbers(CLI::App& app);

/// Keeps the arguments of `main` for `command_line`.
void remember_command_line(int argc, char** argv);

/// The command as the user could type it again, quoted where a shell needs it.
std::string command_line();

/// The page and the part of the code plane on it, in words.
std::string region_text(const Sheet& sheet);

/// Name of a profile as --code takes it.
const char* profile_name(Profile profile);

}  // namespace dotpose::cli
