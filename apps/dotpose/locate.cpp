#include "dotpose/locate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/frame_file.hpp"
#include "dotpose/tools/heap_locator.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "image_names.hpp"
#include "lines.hpp"
#include "locate_record.hpp"
#include "page_cut.hpp"
#include "picture_advice.hpp"
#include "picture_folder.hpp"
#include "reduced_image.hpp"
#include "run_files.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::steady_clock;

/// Largest distance of a reference point from the image centre: far outside of any image, but well
/// within the range of the fixed-point pose.
constexpr double kFarthestReference_px = 10'000;

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose locate frame.png\n"
    "  dotpose locate --format csv frames/*.pgm > poses.csv\n"
    "  dotpose locate --draw pictures frame.png\n"
    "  dotpose locate --sheets sheets.json frame.png\n"
    "  dotpose locate --camera camera.yaml frame.png\n"
    "  find frames -name '*.png' | sort | dotpose locate --list -\n\n"
    "One line per image, also for those without a fix. Exit status 1 if some image could not be\n"
    "read, 2 for wrong usage.\n";

struct LocateArguments {
    std::vector<std::string> images;
    std::string list;
    std::string out;
    std::string draw_folder;
    RecordFormat format = RecordFormat::jsonl;
    std::string sheets;  ///< path of the sheet file; empty for none
    double spacing_mm = kDefaultSpacing_mm;
    bool is_inverted = false;
    std::optional<Profile> code;  ///< none if it is found out from the image
    Options options;
    CameraArgument camera;
    std::optional<PixelPoint> reference_px;
};

void invert(GreyImage& image) {
    for (std::uint8_t& grey : image.pixels)
        grey = static_cast<std::uint8_t>(255 - grey);
}

/// Reads and locates one image after the other.
class ImageLocator {
  public:
    ImageLocator(const LocateArguments& arguments, const RunFiles& files)
        : arguments_(arguments), unplaced_spacing_mm_(arguments.spacing_mm) {
        if (arguments.code) profiles_ = {*arguments.code};
        if (!arguments.sheets.empty()) use_sheets();
        if (!arguments.draw_folder.empty()) pictures_.emplace(arguments.draw_folder, files);
    }

    bool has_sheets() const { return !arguments_.sheets.empty(); }

    /// Throws Error if the image cannot be read.
    Record operator()(const std::string& name) {
        try {
            // Images that are too large are reduced, unless a camera file gives their size.
            image_ = arguments_.camera.camera ? read_frame(name) : read_image(name);
        } catch (const ImageTooLarge& large) {
            return too_large(name, large);
        }
        if (arguments_.is_inverted) invert(image_);
        try {
            options_ = options_for(image_);
        } catch (const BadArgument& error) {
            throw Error(fmt::format("{}: {}", name, error.what()));
        }
        Record record;
        record.file = name;
        record.has_sheets = has_sheets();
        record.code_is_given = !profiles_.empty();
        record.width_px = image_.width_px;
        record.height_px = image_.height_px;
        const int reduction = reduce_if_large(name);
        record.min_dots = options_.lattice.min_dots;
        record.max_p_wrong_log2 = options_.integrity.max_p_wrong_log2;
        const auto start = steady_clock::now();
        const Found found = read();
        record.reading = found.reading;
        record.fix = found.fix;
        const std::chrono::duration<double, std::micro> elapsed = steady_clock::now() - start;
        record.elapsed_us = elapsed.count();
        record.fix = in_whole_pixels(record.fix, reduction);
        record.advice = advice(record.fix.status);
        record.place = find_sheet(sheets_, options_.profile, record.fix);
        spacing_mm_ =
            record.place ? record.place->entry->sheet.pattern.spacing_mm : unplaced_spacing_mm_;
        record.spacing_mm = spacing_mm_;
        return record;
    }

    /// Draws the image just located, if pictures are wanted. Throws Error.
    void draw(const std::string& name) {
        if (!pictures_ || image_.pixels.empty()) return;
        pictures_->add(name, image_.view(), locator_.trace(), spacing_mm_);
    }

  private:
    /// Returns the record of an image that is refused because of its header, without reading
    /// pixels.
    Record too_large(const std::string& name, const ImageTooLarge& image) {
        image_ = {};
        Record record;
        record.file = name;
        record.has_sheets = has_sheets();
        record.width_px = image.width_px;
        record.height_px = image.height_px;
        record.fix.status = Status::image_too_large;
        return record;
    }

    void use_sheets() {
        sheets_ = read_sheets(arguments_.sheets);
        if (sheets_.empty()) throw Error(arguments_.sheets + " has no sheets");
        profiles_.clear();
        unplaced_spacing_mm_ = sheets_.front().sheet.pattern.spacing_mm;
        for (const SheetEntry& entry : sheets_) {
            const Pattern& pattern = entry.sheet.pattern;
            if (std::ranges::find(profiles_, pattern.profile) == profiles_.end()) {
                profiles_.push_back(pattern.profile);
            }
            if (pattern.spacing_mm != unplaced_spacing_mm_) {
                unplaced_spacing_mm_ = std::numeric_limits<double>::quiet_NaN();
            }
        }
    }

    std::string advice(Status status) {
        if (status == Status::ok) return {};
        if (!scratch_) scratch_ = std::make_unique<LargeMemory>();
        return advice_on(image_.view(), status, options_, *scratch_);
    }

    /// Reduces the image if it is too large, and returns the factor. With a camera file it is not
    /// reduced, because the file is valid for one size only.
    int reduce_if_large(const std::string& name) {
        const int by =
            arguments_.camera.camera ? 1 : reduction_of(image_.width_px, image_.height_px);
        if (by == 1) return 1;
        options_ = reduced(options_, image_, by);
        GreyImage small = reduced(image_, by);
        tell(fmt::format("{}: reduced from {} x {} to {} x {} px", name, image_.width_px,
                         image_.height_px, small.width_px, small.height_px));
        image_ = std::move(small);
        return by;
    }

    struct Found {
        CodeReading reading;
        Fix fix;  ///< the pose of the reference point, by the camera file
    };

    /// Locates the image, and sets the profile in `options_` to the one that was read.
    Found read() {
        if (!profiles_.empty()) return locate_with_any_profile();
        const CodeReading reading = locator().locate_in_any_code(image_.view(), evidence_);
        evidence_ = reading.evidence;
        options_.profile = reading.code;
        return {reading, corrected(reading.fix)};
    }

    /// Returns the first fix that is on a sheet of its profile. If there is none, it returns the
    /// first fix, or without any fix the result for the first profile.
    Found locate_with_any_profile() {
        Profile best = profiles_.front();
        bool is_found = false;
        Found found;
        for (const Profile profile : profiles_) {
            found = locate_with(profile);
            if (profiles_.size() == 1 || find_sheet(sheets_, profile, found.fix)) return found;
            if (found.fix.status == Status::ok && !is_found) {
                best = profile;
                is_found = true;
            }
        }
        // Unless it was the last profile, the image is located again in the best one, so that the
        // trace matches the fix.
        return options_.profile == best ? found : locate_with(best);
    }

    Found locate_with(Profile profile) {
        options_.profile = profile;
        const CodeReading reading = locator().locate_in_code(image_.view());
        return {reading, corrected(reading.fix)};
    }

    Fix corrected(Fix fix) {
        const auto place = find_sheet(sheets_, options_.profile, fix);
        if (place) fix = without_surroundings(fix, *place);
        if (!arguments_.camera.camera) return fix;
        return with_camera(fix, *arguments_.camera.camera, locator_.trace(),
                           place ? place->entry->print_scale() : AxisScale{});
    }

    /// Locates an image on a known sheet again without the area beside its dots: labels and the
    /// table there are no evidence against the fix.
    Fix without_surroundings(const Fix& fix, const SheetPlace& place) {
        if (fix.bit_errors == 0) return fix;
        const auto cut = cut_to_dots(image_.view(), options_, fix, place.entry->sheet);
        if (!cut) return fix;
        Fix again = locator().locate(cut->view(), Prediction::like(fix));
        const auto place_again = find_sheet(sheets_, options_.profile, again);
        const bool is_better = place_again && place_again->entry == place.entry &&
                               again.bit_errors < fix.bit_errors &&
                               again.dots_used + fix.bit_errors >= fix.dots_used;
        if (!is_better) {
            // The trace must hold the results of the fix that is returned.
            (void)locator().locate(image_.view());
            return fix;
        }
        if (again.attempt == Attempt::tracked) again.attempt = fix.attempt;
        // The bound of the first fix takes all codes into account, so it is kept.
        again.p_wrong_log2 = fix.p_wrong_log2;
        return again;
    }

    /// With the options of the image.
    Locator& locator() {
        locator_.set_options(options_);
        return locator_;
    }

    Options options_for(const GreyImage& image) const {
        Options options = arguments_.options;
        options.show_stages = pictures_.has_value();
        if (const auto& camera = arguments_.camera.camera) {
            use_camera(*camera, image.width_px, image.height_px, options);
        }
        if (const auto& reference_px = arguments_.reference_px) {
            const auto from_centre_q8 = [](double px, int side_px) {
                return static_cast<std::int32_t>(std::lround((px - (side_px - 1) / 2.0) * 256));
            };
            options.reference_dx_q8 = from_centre_q8(reference_px->u, image.width_px);
            options.reference_dy_q8 = from_centre_q8(reference_px->v, image.height_px);
        }
        return options;
    }

    const LocateArguments& arguments_;
    std::vector<SheetEntry> sheets_;
    std::vector<Profile> profiles_;  ///< given, to try in this order; none: all are in question
    CodeEvidence evidence_;          ///< of the images before
    double unplaced_spacing_mm_;     ///< for a fix on no sheet; not a number if sheets differ
    HeapLocator locator_;
    std::unique_ptr<LargeMemory> scratch_;  ///< for a look at what could not be located
    std::optional<PictureFolder> pictures_;
    GreyImage image_;
    Options options_;
    double spacing_mm_ = 0;
};

RunFiles files_of(const LocateArguments& arguments, const ImageNames& names) {
    RunFiles files;
    files.reads("--sheets", arguments.sheets);
    files.reads("--camera", arguments.camera.path);
    files.reads("--list", arguments.list);
    files.reads("", names.known());
    files.writes_lines(arguments.out, content_of(arguments.format));
    return files;
}

/// Returns the exit status.
int run(const LocateArguments& arguments) {
    if (arguments.images.empty() && arguments.list.empty()) {
        throw BadArgument("no images given: name some, or use --list");
    }
    const bool is_csv = arguments.format == RecordFormat::csv;
    ImageNames names(arguments.images, arguments.list);
    const RunFiles files = files_of(arguments, names);
    ImageLocator locator(arguments, files);
    Lines lines(arguments.out);
    int exit_code = 0;
    // After a file that fails, the run goes on with the next one.
    const auto attempt = [&exit_code](const auto& action) {
        try {
            action();
            return true;
        } catch (const Error& error) {
            tell(error.what());
            exit_code = kExitFailed;
            return false;
        }
    };
    if (is_csv) lines.write(csv_header(locator.has_sheets()));
    while (const auto name = names.next()) {
        Record record;
        const bool is_read = attempt([&] {
            files.require_not_written(*name);
            record = locator(*name);
        });
        if (!is_read) continue;
        lines.write(is_csv ? csv_line(record) : json_line(record));
        attempt([&] { locator.draw(*name); });
    }
    return exit_code;
}

PixelPoint parse_reference(const std::string& text) {
    PixelPoint point;
    const std::size_t comma = text.find(',');
    const auto parse = [](const std::string& number, double& value) {
        return CLI::detail::lexical_cast(number, value) && std::abs(value) <= kFarthestReference_px;
    };
    if (comma == std::string::npos || !parse(text.substr(0, comma), point.u) ||
        !parse(text.substr(comma + 1), point.v)) {
        throw CLI::ValidationError(
            "--reference",
            fmt::format("'{}' must be two numbers from {} to {} with a comma between", text,
                        -kFarthestReference_px, kFarthestReference_px));
    }
    return point;
}

void add_camera_options(CLI::App& command, LocateArguments& arguments) {
    add_camera_option(command, arguments.camera,
                      "Camera file, of 'dotpose calibrate' or ROS: lens, reference, heading")
        ->excludes(add_lens_option(command, arguments.options.lens));
    command
        .add_option_function<std::string>(
            "--reference",
            [&arguments](const std::string& text) {
                arguments.reference_px = parse_reference(text);
            },
            "Pixel whose place is wanted; (0, 0) is the centre of the first pixel, undistorted")
        ->type_name("U,V")
        ->default_str("image centre");
}

}  // namespace

void add_locate(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<LocateArguments>();
    CLI::App* command = app.add_subcommand("locate", "Find where images look on the pattern");
    command->footer(kExamples);
    command->add_option("images", arguments->images, "PGM, PNG, JPEG, BMP or TIFF files")
        ->type_name("IMAGE");
    command
        ->add_option("--list", arguments->list,
                     "Read names from a file, or from - (standard input)")
        ->type_name("FILE|-");
    add_spacing_option(*command, arguments->spacing_mm);
    add_code_option(*command, arguments->code);
    add_sheets_option(*command, arguments->sheets,
                      "Sheet file: also tell the sheet, and the place on it and in the world")
        ->excludes(command->get_option("--spacing"), command->get_option("--code"));
    command->add_flag("--inverted", arguments->is_inverted, "The dots are white on black");
    add_camera_options(*command, *arguments);
    add_attempt_options(*command, arguments->options);
    add_format_option(*command, arguments->format);
    command->add_option("-o,--out", arguments->out, "File to write instead of standard output")
        ->type_name("FILE");
    command
        ->add_option("--draw", arguments->draw_folder,
                     "Also write a picture (SVG) of what was seen in each image; the last "
                     "folder of the name is made if missing")
        ->type_name("DIR");
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace dotpose::cli
