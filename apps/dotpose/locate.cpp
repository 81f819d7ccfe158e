#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "choices.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/image_file.hpp"
#include "follower_arguments.hpp"
#include "lines.hpp"
#include "locate_record.hpp"
#include "ordered_threads.hpp"
#include "output_arguments.hpp"
#include "picture_advice.hpp"
#include "picture_folder.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "source_arguments.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::steady_clock;

constexpr const char* kLocateExamples =
    "Examples:\n"
    "  dotpose locate frame.png\n"
    "  dotpose locate --format text frame.png\n"
    "  dotpose locate --format csv frames/*.pgm > poses.csv\n"
    "  dotpose locate --draw picture.svg frame.png\n"
    "  dotpose locate --draw pictures frames/*.pgm\n"
    "  dotpose locate --units ros --sheets sheets.json frame.png\n"
    "  dotpose locate --sheets sheets.json frame.png\n"
    "  dotpose locate --camera camera.yaml frame.png\n"
    "  dotpose locate --camera camera.yaml --pose space frame.png\n"
    "  find frames -name '*.png' | sort | dotpose locate --list -\n"
    "  dotpose locate drive.mp4\n"
    "  dotpose locate --threads 4 --code anoto frames > poses.json\n\n"
    "One line per image or frame, also for those without a fix; frame N of a video is called\n"
    "drive.mp4#N. Exit status 1 if something could not be read, 2 for wrong usage.\n";

struct LocateArguments {
    SourceArguments sources;
    LineArguments lines;
    std::optional<Columns> columns;  ///< CSV columns, or none if not specified
    std::string draw;                ///< NAME.svg or a folder, or empty for no pictures
    FollowerArguments follower;
    int threads = 1;
};

class ImageLocator {
  public:
    ImageLocator(const LocateArguments& arguments, const RunFiles& files)
        : arguments_(arguments), follower_(options_of(arguments)) {
        if (!arguments.draw.empty()) pictures_.emplace(system::path_of(arguments.draw), files);
    }

    const Follower& follower() const { return follower_; }

    /// Locates an image, which must remain valid until `draw` is called. `bits_per_px` is the
    /// number of bits per pixel of a compressed video, or 0 if unknown. Throws Error if the size of
    /// the image differs from the size in the camera file.
    Record operator()(const std::string& name, GreyImage& image, double bits_per_px) {
        if (arguments_.follower.is_inverted) invert(image);
        const auto start = steady_clock::now();
        const Located located = locate(name, image);
        const std::chrono::duration<double, std::micro> elapsed = steady_clock::now() - start;
        if (located.reduced_by > 1) {
            const ImageView small = follower_.image();
            notify(fmt::format("{}: reduced from {} x {} to {} x {} px", name, image.width_px,
                               image.height_px, small.width_px, small.height_px));
        }
        Record record = record_of(located, follower_);
        record.file = name;
        record.width_px = image.width_px;
        record.height_px = image.height_px;
        record.elapsed_us = elapsed.count();
        record.advice = advice(record, bits_per_px);
        return record;
    }

    /// Returns the record for an image whose size, according to its header, exceeds the limit. The
    /// pixels of such an image are not read.
    Record too_large(const std::string& name, const ImageTooLarge& image) const {
        Record record = empty_record(follower_);
        record.file = name;
        record.width_px = image.width_px;
        record.height_px = image.height_px;
        record.fix.status = Status::image_too_large;
        return record;
    }

    /// Draws the last located image if --draw is given. Throws Error on failure.
    void draw(const Record& record) {
        if (!pictures_) return;
        pictures_->add(record.file, follower_.image(), follower_.trace(),
                       {.spacing_mm = record.spacing_mm,
                        .fix = record.fix,
                        .place = record.place,
                        .reason = reason(record)});
    }

  private:
    static FollowerOptions options_of(const LocateArguments& arguments) {
        FollowerOptions options = arguments.follower.read();
        options.locate.show_stages = !arguments.draw.empty();
        return options;
    }

    Located locate(const std::string& name, const GreyImage& image) {
        try {
            return follower_.locate(image);
        } catch (const BadArgument& error) {
            throw Error(fmt::format("{}: {}", name, error.what()));
        }
    }

    std::string advice(const Record& record, double bits_per_px) {
        if (record.fix.status == Status::ok) return {};
        if (!scratch_) scratch_ = std::make_unique<LargeMemory>();
        return advice_on(
            follower_.image(),
            {record.fix.status, follower_.used_options(), record.code_is_given, bits_per_px},
            *scratch_);
    }

    const LocateArguments& arguments_;
    Follower follower_;
    std::unique_ptr<LargeMemory> scratch_;  ///< used by `advice_on` if an image has no fix
    std::optional<PictureFolder> pictures_;
};

RunFiles files_of(const LocateArguments& arguments, const Sources& sources) {
    RunFiles files;
    arguments.follower.add_files(files);
    sources.add_files(files);
    files.writes_lines(arguments.lines.out, content_of(arguments.lines.format));
    const std::filesystem::path picture = system::path_of(arguments.draw);
    if (is_picture_name(picture) || !std::filesystem::exists(picture)) {
        files.writes("--draw", arguments.draw, Content::svg);
    }
    return files;
}

/// Locates all frames of a run. After an error, continues with the next frame or source.
class LocateRun {
  public:
    LocateRun(const LocateArguments& arguments, Sources& sources)
        : files_(files_of(arguments, sources)),
          locator_(arguments, files_),
          lines_(arguments.lines.out),
          format_(arguments.lines.format),
          columns_(arguments.columns.value_or(Columns::brief)),
          units_(arguments.lines.units),
          arguments_(arguments),
          sources_(sources),
          frames_(sources.open(options_of(arguments))),
          images_(sources.number_of_images()),
          progress_("locating", arguments.lines.out) {
        // If a pipe delivers the image names, signals are not caught, because a signal must
        // terminate the tool immediately, even while the tool is waiting for a name. No line is
        // lost, because each line is flushed.
        if (!sources.has_pipe()) catch_interrupts();
    }

    /// Locates all frames and returns the exit status. Throws Error if a line cannot be written.
    int operator()() {
        if (format_ == RecordFormat::csv) {
            lines_.write(csv_header(locator_.follower(), units_, columns_));
        }
        if (arguments_.threads != 1) return in_threads();
        capture::Frame frame;
        for (std::int64_t done = 0; next(frame); ++done) {
            progress_.update(done, images_ > 0 ? images_ : frames_->length());
            const std::string name = frames_->name_of_frame();
            Record record;
            if (!attempt([&] { record = locator_(name, frame.image, frames_->bits_per_px()); })) {
                continue;
            }
            write(record);
            if (!frame.image.pixels.empty()) attempt([&] { locator_.draw(record); });
        }
        if (interrupted()) fail(Error("interrupted; the lines so far are complete"));
        return exit_code_;
    }

  private:
    /// The record for an image, or the error that occurred instead.
    using Outcome = std::variant<Record, Error>;

    capture::SourceOptions options_of(const LocateArguments& arguments) {
        return options_of(arguments, [this](Outcome outcome) { return take(outcome); });
    }

    /// Returns the options for opening sources. `pass_on` receives an outcome for each image that
    /// cannot be read.
    capture::SourceOptions options_of(const LocateArguments& arguments,
                                      std::function<bool(Outcome)> pass_on) {
        capture::SourceOptions options = arguments.sources.options;
        // Without a camera file, images of up to kDefaultImagePixels pixels are accepted, because
        // Follower downscales large images. With a camera file, only images of the size in the file
        // are accepted.
        if (!arguments.follower.camera.camera) options.max_pixels = kDefaultImagePixels;
        options.notify = notify;
        options.stop = interrupted;
        options.before_reading = [this](const std::string& file) {
            files_.require_not_written(file);
        };
        options.on_unreadable = [this, pass_on = std::move(pass_on)](const std::string& file,
                                                                     const Error& error) {
            const auto* large = dynamic_cast<const ImageTooLarge*>(&error);
            pass_on(large != nullptr ? Outcome(locator_.too_large(file, *large)) : Outcome(error));
        };
        return options;
    }

    bool take(const Outcome& outcome) {
        if (const auto* error = std::get_if<Error>(&outcome)) {
            fail(*error);
        } else {
            write(std::get<Record>(outcome));
        }
        return true;
    }

    /// Locates the images in several threads, each of which has its own source and locator.
    int in_threads() {
        const std::vector<std::string> images = sources_.all_images();
        const std::size_t threads = arguments_.threads > 0
                                        ? static_cast<std::size_t>(arguments_.threads)
                                        : std::max(1U, std::thread::hardware_concurrency());
        using Threads = OrderedThreads<Outcome>;
        Threads outcomes(threads, [&](std::size_t thread, const Threads::Emit& emit) {
            ImageLocator locator(arguments_, files_);
            std::size_t at = thread;
            const auto next_image = [&]() -> std::optional<std::string> {
                if (at >= images.size()) return std::nullopt;
                return images[std::exchange(at, at + threads)];
            };
            capture::SourceList frames(next_image, options_of(arguments_, emit));
            capture::Frame frame;
            for (bool goes_on = true; goes_on && frames.next(frame);) {
                try {
                    goes_on = emit(locator(frame.file, frame.image, frames.bits_per_px()));
                } catch (const Error& error) {
                    goes_on = emit(error);
                }
            }
        });
        std::int64_t done = 0;
        while (const auto outcome = outcomes.next()) {
            take(*outcome);
            progress_.update(++done, static_cast<std::int64_t>(images.size()));
        }
        if (interrupted()) fail(Error("interrupted; the lines so far are complete"));
        return exit_code_;
    }

    /// Reads the next frame, skipping sources that cannot be read. Returns false after the last
    /// frame.
    bool next(capture::Frame& frame) {
        while (true) {
            try {
                return frames_->next(frame);
            } catch (const BadArgument&) {
                throw;
            } catch (const Error& error) {
                fail(error);
            }
        }
    }

    void write(const Record& record) {
        if (format_ == RecordFormat::text) return lines_.write(text_line(record, units_));
        const Columns columns = format_ == RecordFormat::csv ? columns_ : Columns::all;
        lines_.write(line_of(columns_of(fields(record, units_), columns), format_));
    }

    void fail(const Error& error) {
        notify(error.what());
        exit_code_ = kExitFailed;
    }

    template <typename Action>
    bool attempt(const Action& action) {
        try {
            action();
            return true;
        } catch (const Error& error) {
            fail(error);
            return false;
        }
    }

    RunFiles files_;
    ImageLocator locator_;
    Lines lines_;
    RecordFormat format_;
    Columns columns_;
    Units units_;
    const LocateArguments& arguments_;
    Sources& sources_;
    std::unique_ptr<capture::SourceList> frames_;
    std::int64_t images_;  ///< number of images in all sources, or 0 if unknown
    ProgressLine progress_;
    int exit_code_ = 0;
};

int run(const LocateArguments& arguments) {
    const bool has_code = arguments.follower.options.code || !arguments.follower.sheets.empty();
    if (arguments.threads != 1 && !has_code) {
        throw BadArgument(
            "--threads needs --code NAME or --sheets FILE: without them, all frames together "
            "decide which code they show");
    }
    if (arguments.threads != 1 &&
        arguments.follower.options.locate.integrity.bits_per_error == kMeasuredErrorRate) {
        throw BadArgument(
            "--threads needs another --bits-per-error: the number is measured over all images in "
            "their order");
    }
    if (arguments.columns && arguments.lines.format != RecordFormat::csv) {
        throw BadArgument("--columns is for --format csv only");
    }
    Sources sources(arguments.sources);
    if (is_picture_name(system::path_of(arguments.draw)) && sources.number_of_images() != 1) {
        throw BadArgument(fmt::format(
            "--draw {} is the picture of a single image: name a folder for several images",
            arguments.draw));
    }
    return LocateRun(arguments, sources)();
}

}  // namespace

void add_locate(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<LocateArguments>();
    Command* command = app.add_subcommand("locate", "Find the position of images on the pattern");
    command->footer(kLocateExamples);
    arguments->sources.add_to(*command);
    add_follower_options(*command, arguments->follower,
                         "Sheet file: also report the sheet, and the place on it and in the world");
    add_line_options(*command, arguments->lines, true);
    command
        ->add_option_function<std::string>(
            "--columns",
            [arguments](const std::string& name) {
                arguments->columns = name == "all" ? Columns::all : Columns::brief;
            },
            "Columns of CSV: brief (pose, standard deviations, p_wrong) or all")
        ->type_name("NAME")
        ->default_str("brief")
        ->check(one_of({"brief", "all"}));
    Option* draw =
        command
            ->add_option("--draw", arguments->draw,
                         "Also draw dots, grid and pose (SVG): NAME.svg for one image, or a folder "
                         "for several images, which is created if missing (not its parents)")
            ->type_name("FILE|DIR");
    command
        ->add_option(
            "--threads", arguments->threads,
            "Number of threads that locate images, 0 for all cores; the lines keep their order")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(0, 256))
        ->excludes(draw);
    command->callback([arguments, &exit_code] {
        arguments->follower.fit_to(arguments->sources);
        exit_code = run(*arguments);
    });
}

}  // namespace dotpose::cli
