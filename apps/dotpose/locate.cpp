#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/frame_file.hpp"
#include "follower_arguments.hpp"
#include "image_names.hpp"
#include "lines.hpp"
#include "locate_record.hpp"
#include "picture_advice.hpp"
#include "picture_folder.hpp"
#include "run_files.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::steady_clock;

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
    FollowerArguments follower;
};

/// Reads and locates one image after the other.
class ImageLocator {
  public:
    ImageLocator(const LocateArguments& arguments, const RunFiles& files)
        : arguments_(arguments), follower_(options_of(arguments)) {
        if (!arguments.draw_folder.empty()) pictures_.emplace(arguments.draw_folder, files);
    }

    bool has_sheets() const { return !follower_.sheets().empty(); }

    /// Throws Error if the image cannot be read.
    Record operator()(const std::string& name) {
        image_ = {};
        try {
            // Images that are too large are reduced, unless a camera file gives their size.
            image_ = arguments_.follower.camera.camera ? read_frame(name) : read_image(name);
        } catch (const ImageTooLarge& large) {
            return too_large(name, large);
        }
        if (arguments_.follower.is_inverted) invert(image_);
        const auto start = steady_clock::now();
        const Located located = locate(name);
        const std::chrono::duration<double, std::micro> elapsed = steady_clock::now() - start;
        if (located.reduced_by > 1) {
            const ImageView small = follower_.image();
            tell(fmt::format("{}: reduced from {} x {} to {} x {} px", name, image_.width_px,
                             image_.height_px, small.width_px, small.height_px));
        }
        Record record = record_of(located, follower_);
        record.file = name;
        record.width_px = image_.width_px;
        record.height_px = image_.height_px;
        record.elapsed_us = elapsed.count();
        record.advice = advice(record.fix.status);
        spacing_mm_ = record.spacing_mm;
        return record;
    }

    /// Draws the image just located, if pictures are wanted. Throws Error.
    void draw(const std::string& name) {
        if (!pictures_ || image_.pixels.empty()) return;
        pictures_->add(name, follower_.image(), follower_.trace(), spacing_mm_);
    }

  private:
    static FollowerOptions options_of(const LocateArguments& arguments) {
        FollowerOptions options = arguments.follower.read();
        options.locate.show_stages = !arguments.draw_folder.empty();
        return options;
    }

    Located locate(const std::string& name) {
        try {
            return follower_.locate(image_);
        } catch (const BadArgument& error) {
            throw Error(fmt::format("{}: {}", name, error.what()));
        }
    }

    /// Returns the record of an image that is refused because of its header, without reading
    /// pixels.
    Record too_large(const std::string& name, const ImageTooLarge& image) const {
        Record record;
        record.file = name;
        record.has_sheets = has_sheets();
        record.width_px = image.width_px;
        record.height_px = image.height_px;
        record.fix.status = Status::image_too_large;
        return record;
    }

    std::string advice(Status status) {
        if (status == Status::ok) return {};
        if (!scratch_) scratch_ = std::make_unique<LargeMemory>();
        return advice_on(follower_.image(), status, follower_.used_options(), *scratch_);
    }

    const LocateArguments& arguments_;
    Follower follower_;
    std::unique_ptr<LargeMemory> scratch_;  ///< for a look at what could not be located
    std::optional<PictureFolder> pictures_;
    GreyImage image_;
    double spacing_mm_ = 0;
};

RunFiles files_of(const LocateArguments& arguments, const ImageNames& names) {
    RunFiles files;
    arguments.follower.add_files(files);
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
    add_follower_options(*command, arguments->follower,
                         "Sheet file: also tell the sheet, and the place on it and in the world");
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
