/// Options shared by several subcommands, and helpers for them.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "choices.hpp"
#include "command_line.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/tools/print.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::cli {

/// Adds --code anoto|libdots|microdots, for commands that write a pattern. The default is the
/// initial value of `code`.
void add_code_option(Command& command, CodeVariant& code);

/// Adds --code auto|anoto|libdots|microdots, for commands that read a pattern. The default is auto,
/// which sets `code` to none.
void add_code_option(Command& command, std::optional<CodeVariant>& code);

/// Adds --section U,V, where U and V are integers from 0 to 62.
void add_section_option(Command& command, Section& section);

/// Adds --spacing MM, from 0.01 to 100 mm.
void add_spacing_option(Command& command, double& spacing_mm);

/// Adds an option for a cell X,Y, such as --origin. `help` describes the meaning of the cell.
void add_cell_option(Command& command, const std::string& flag, Cell& cell,
                     const std::string& help);

/// Adds --sheets FILE. `help` describes what the command uses the file for.
Option* add_sheets_option(Command& command, std::string& path, const std::string& help);

/// Adds --k, the lens distortion that `locate` corrects, in 1/px^2.
Option* add_lens_option(Command& command, FixedLens& lens);

/// Adds --flip, for mirrored frames.
void add_flip_option(Command& command, bool& flip);

/// The path and the contents of a camera file.
struct CameraArgument {
    std::string path;  ///< empty if no file was given
    std::optional<Camera> camera;
};

/// Adds --camera FILE. The file is read when the command line is parsed.
Option* add_camera_option(Command& command, CameraArgument& camera, const std::string& help);

/// Adds --decoder and --effort. `options` must outlive the command.
void add_attempt_options(Command& command, DeviceOptions& options);

/// Adds --size WxH, the size of a simulated frame.
void add_size_option(Command& command, CameraModel& camera);

/// Adds an option that selects one of `values` by name. `values` must outlive the command.
template <typename Values, typename Store>
Option* add_named(Command& command, const std::string& flag, const Values& values,
                  const std::string& default_name, const std::string& help, Store store) {
    std::vector<std::string> names;
    for (const auto value : values)
        names.emplace_back(name(value));
    return command
        .add_option_function<std::string>(
            flag,
            [&values, store](const std::string& asked) {
                for (const auto value : values) {
                    if (asked == name(value)) return store(value);
                }
            },
            help + ": " + alternatives(names))
        ->type_name("NAME")
        ->default_str(default_name)
        ->check(one_of(names));
}

/// The options --code, --section, --spacing, --displacement and --dot.
class PatternArguments {
  public:
    /// Role of the pattern: made by the command, or expected in an image. The option --section is
    /// omitted for an expected pattern, because the section is read from the image.
    enum class Use { made, expected };
    void add_to(Command& command, Use use = Use::made);

    /// Returns the pattern given by the options. Displacement and dot diameter default to a sixth
    /// of the spacing.
    Pattern pattern() const;

    /// Returns the expected code, or none to detect the code from the image.
    std::optional<CodeVariant> expected_code() const { return expected_code_; }

  private:
    Pattern given_;
    std::optional<CodeVariant> expected_code_;
    std::optional<double> displacement_mm_;
    std::optional<double> dot_mm_;
};

/// Convert between DotDrawing and the names used by --dots. `drawing_by_name` returns none for an
/// unknown name.
std::string drawing_name(DotDrawing drawing);
std::optional<DotDrawing> drawing_by_name(const std::string& name);

/// Adds --dots, which selects how a PDF draws dots.
void add_drawing_option(Command& command, DotDrawing& drawing);

/// Parses integers from 0 to `max`. Each character of `separators` separates two consecutive
/// integers: "640x480" has the separators "x", and "10,20,640x480" has ",,x". Returns none if the
/// text does not match.
std::optional<std::vector<std::uint32_t>> whole_numbers(std::string_view text,
                                                        std::string_view separators,
                                                        std::uint32_t max);

struct FrameSize {
    int width_px = 0;
    int height_px = 0;
};
/// Parses "WIDTHxHEIGHT". If the text is invalid, throws ValidationError for the option `flag`.
FrameSize parse_frame_size(const std::string& flag, const std::string& text);

/// Makes all numeric options of all subcommands reject values that are not finite, such as nan, inf
/// and 1e999. Call it after all options have been added.
void refuse_non_finite_numbers(Command& app);

/// Stores the arguments of `main` for `command_line`.
void remember_command_line(int argc, const char* const* argv);

/// Returns the arguments of `main` without the name of the program.
std::vector<std::string> given_arguments();

/// Returns the word quoted for a shell if necessary.
std::string quoted_for_shell(const std::string& word);

/// Returns the command line, quoted for a shell, without the options in `without` and their values.
std::string command_line(const std::set<std::string>& without = {});

/// Returns a description of the page and of the region of the code plane that it covers.
std::string region_text(const Sheet& sheet);

/// Returns the name of a code variant, as in --code.
const char* code_name(CodeVariant code);

}  // namespace dotpose::cli
