#include "dotpose/tools/evaluate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "dotpose/tools/protocol.hpp"
#include "dotpose/tools/score.hpp"
#include "dotpose/tools/sweep.hpp"
#include "evaluate_measured.hpp"
#include "known_frames.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "source_arguments.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEvaluateExamples =
    "Examples:\n"
    "  dotpose evaluate frames                  frames against the poses in frames/truth.csv\n"
    "  dotpose evaluate drive.mp4 --poses poses.csv\n"
    "  dotpose evaluate frames --sheets sheets.json --poses measured.csv --draw figures\n"
    "                                           places measured on a sheet or in the world\n"
    "  dotpose evaluate --preset hard           simulated frames; nothing is written\n"
    "  dotpose evaluate --sweep noise -o out    success and error over the noise: CSV and "
    "pictures\n"
    "  dotpose evaluate --protocol paper -o out the paper's own experiment, simulated\n\n"
    "A fix that is off by more than half a grid spacing or 2 degrees, or in another section, is\n"
    "wrong; errors are computed from the other fixes. Exit status 1 if truth.csv or an image\n"
    "cannot be read, 2 for wrong usage.\n";

/// The only value of `--protocol`: the published experiment (paper, section IV).
struct PaperProtocol {};
constexpr std::array kProtocols = {PaperProtocol{}};
const char* name(PaperProtocol) {
    return "paper";
}

/// The point whose poses truth.csv contains: the image centre, or the reference point of the robot.
enum class TruthOf : std::uint8_t { image, robot };
constexpr std::array kTruths = {TruthOf::image, TruthOf::robot};
const char* name(TruthOf truth) {
    return truth == TruthOf::image ? "image" : "robot";
}

struct EvaluateArguments {
    SourceArguments sources;
    std::string poses;
    std::optional<Preset> preset;
    std::optional<SweepKind> sweep;
    bool protocol = false;
    ReportArguments report;  ///< `out` is a file, or a folder with --sweep or --protocol
    std::optional<int> frames;
    Setup setup;
    DeviceOptions options;
    CameraArgument camera;
    MeasuredArguments measured;
    TruthOf truth_of = TruthOf::image;
    double spacing_mm = kDefaultSpacing_mm;
    bool spacing_given = false;
    std::optional<CodeVariant> code;   ///< code of all frames, or nullopt if not specified
    bool ignores_truth_codes = false;  ///< true to ignore the codes in truth.csv
    int threads = 0;
};

Progress progress_on(ProgressLine& line) {
    return [&line](int done, int total) {
        line.update(done, total);
        return !interrupted();
    };
}

/// Returns the score as JSON. A statistic over zero frames is NaN in `score` and null in JSON.
nlohmann::ordered_json json_of(const Score& score) {
    nlohmann::ordered_json statuses = nlohmann::ordered_json::object();
    for (std::size_t i = 1; i < score.by_status.size(); ++i) {
        if (score.by_status[i] > 0) {
            statuses[dotpose::name(static_cast<Status>(i))] = score.by_status[i];
        }
    }
    return {
        {"frames", score.frames},
        {"unreadable", score.unreadable},
        {"located", score.located},
        {"located_fraction", score.located_fraction()},
        {"wrong", score.wrong},
        {"not_located", statuses},
        {"position_um", quantiles_json(score.position_um)},
        {"angle_deg", quantiles_json(score.angle_deg)},
        {"normalised_squared_error",
         {{"x", score.normalised[0]}, {"y", score.normalised[1]}, {"theta", score.normalised[2]}}},
        {"largest_p_wrong", score.largest_p_wrong},
        {"elapsed_us", quantiles_json(score.elapsed_us)}};
}

std::string report_of(const Score& score, bool as_json) {
    if (as_json) return json_of(score).dump(2) + '\n';
    std::string text;
    for (const auto& [what, value] : described(score))
        text += fmt::format("{:<44}{}\n", what, value);
    return text;
}

int report(const std::vector<Outcome>& outcomes, const ReportArguments& arguments) {
    int exit_code = 0;
    for (const Outcome& outcome : outcomes) {
        if (outcome.problem.empty()) continue;
        notify(outcome.problem);
        exit_code = kExitFailed;
    }
    write_report(arguments, report_of(score_of(outcomes), arguments.as_json));
    return exit_code;
}

/// Evaluates the frames in batches. After Ctrl-C, returns only the outcomes of the completed
/// batches, limited to the first `readable_frames()` outcomes.
std::vector<Outcome> evaluate_in_parts(const FrameRun& all, ProgressLine& line,
                                       const std::function<std::size_t()>& readable_frames) {
    const int part = 16 * static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::vector<Outcome> outcomes;
    for (int done = 0; done < all.frames && !interrupted(); done += part) {
        FrameRun run = all;
        run.frames = std::min(part, all.frames - done);
        run.frame_at = [&all, done](int index) { return all.frame_at(done + index); };
        run.progress = [&](int done_now, int) {
            line.update(done + done_now, all.frames);
            return true;
        };
        std::ranges::move(evaluate(run).front(), std::back_inserter(outcomes));
    }
    if (interrupted()) {
        if (outcomes.size() > readable_frames()) outcomes.resize(readable_frames());
        notify(fmt::format("interrupted; the report covers the first {} of {} frames",
                           outcomes.size(), all.frames));
    }
    return outcomes;
}

int evaluate_run(const EvaluateArguments& arguments, const std::string& what, FrameRun& run,
                 const std::function<std::size_t()>& readable_frames) {
    ProgressLine line("evaluating " + what);
    run.options = {arguments.options};
    run.any_code = !arguments.code;
    if (arguments.ignores_truth_codes) {
        run.frame_at = [read = run.frame_at](int index) {
            KnownFrame frame = read(index);
            frame.code.reset();
            return frame;
        };
    }
    run.threads = arguments.threads;
    const std::vector<Outcome> outcomes = evaluate_in_parts(run, line, readable_frames);
    const int exit_code = report(outcomes, arguments.report);
    return outcomes.size() < static_cast<std::size_t>(run.frames) ? kExitFailed : exit_code;
}

/// Configures `run` to locate the frames with the camera file, as `locate --camera` does. A frame
/// whose size differs from the size in the camera file is reported as a problem.
void locate_with(const Camera& camera, const std::vector<TruthRow>& rows, FrameRun& run) {
    run.frame_at = [camera, rows, read = run.frame_at](int index) {
        KnownFrame frame = read(index);
        if (!frame.problem.empty()) return frame;
        try {
            DeviceOptions unused;
            use_camera(camera, frame.image.width_px, frame.image.height_px, unused);
        } catch (const BadArgument& error) {
            const std::string& file = rows[static_cast<std::size_t>(index)].file;
            frame.problem = fmt::format("{}: {}", file, error.what());
        }
        return frame;
    };
    run.refine = [camera](const Fix& fix, const Trace& trace) {
        return with_camera(fix, camera, trace);
    };
}

std::string what_is_read(const SourceArguments& sources) {
    if (sources.names.size() == 1 && sources.list.empty()) return sources.names.front();
    return "the frames";
}

void make_folder(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) throw Error("cannot create " + folder.string() + ": " + failed.message());
}

int evaluate_on_sheets(const EvaluateArguments& arguments, const KnownFrames& known) {
    FollowerOptions options;
    options.locate = arguments.options;
    options.camera = arguments.camera.camera;
    options.sheets = read_sheets(system::path_of(arguments.measured.sheets));
    if (options.sheets.empty()) throw Error(arguments.measured.sheets + " has no sheets");
    if (!arguments.measured.draw.empty()) make_folder(system::path_of(arguments.measured.draw));
    return evaluate_measured(arguments.measured, options, known, arguments.report);
}

int evaluate_sources(const EvaluateArguments& arguments) {
    const auto spacing_mm =
        arguments.spacing_given ? std::optional(arguments.spacing_mm) : std::nullopt;
    const KnownFrames known = known_frames(arguments.sources, arguments.poses, spacing_mm);
    if (!arguments.measured.sheets.empty()) return evaluate_on_sheets(arguments, known);
    if (!known.rows.front().is_in_pattern) {
        throw Error(
            "the poses are places on sheets or in the world: name the sheet file, --sheets");
    }
    FrameRun run;
    run.frames = static_cast<int>(known.rows.size());
    run.frame_at = known.frame_at;
    if (arguments.code) {
        run.frame_at = [&arguments, read = run.frame_at](int index) {
            KnownFrame frame = read(index);
            frame.code = arguments.options.code;
            return frame;
        };
    }
    if (arguments.camera.camera) locate_with(*arguments.camera.camera, known.rows, run);
    const int exit_code =
        evaluate_run(arguments, what_is_read(arguments.sources), run, known.readable_frames);
    known.finish();
    return exit_code;
}

void require_apart(const EvaluateArguments& arguments) {
    RunFiles files;
    files.reads("", arguments.sources.names);
    files.reads("--list", arguments.sources.list);
    files.reads("--poses", arguments.poses);
    files.reads("--camera", arguments.camera.path);
    files.writes("-o", arguments.report.out, content_of(arguments.report));
    arguments.measured.add_files(files);
}

int evaluate_preset(const EvaluateArguments& arguments) {
    FrameRun run;
    run.frames = arguments.frames.value_or(1000);
    run.frame_at = frames_of_setup(arguments.setup);
    const auto all = [&run] { return static_cast<std::size_t>(run.frames); };
    return evaluate_run(arguments, fmt::format("preset {}", dotpose::name(*arguments.preset)), run,
                        all);
}

int evaluate_sweep(const EvaluateArguments& arguments) {
    make_folder(system::path_of(arguments.report.out));
    const std::string kind = dotpose::name(*arguments.sweep);
    ProgressLine line("evaluating " + kind);
    SweepOptions options;
    options.setup = arguments.setup;
    options.frames_per_value = arguments.frames.value_or(options.frames_per_value);
    options.locate = arguments.options;
    options.threads = arguments.threads;
    options.progress = progress_on(line);
    const Sweep sweep = run_sweep(*arguments.sweep, options);
    write_sweep(system::path_of(arguments.report.out), sweep);
    fmt::print("{0}/sweep-{1}.csv, {0}/sweep-{1}.svg and .png\n", arguments.report.out, kind);
    if (!interrupted()) return 0;
    notify(fmt::format("interrupted; the sweep contains the first {} values", sweep.points.size()));
    return kExitFailed;
}

int evaluate_protocol(const EvaluateArguments& arguments) {
    make_folder(system::path_of(arguments.report.out));
    ProgressLine line("evaluating the paper's protocol");
    ProtocolOptions options;
    options.setup = arguments.setup;
    options.samples = arguments.frames.value_or(options.samples);
    options.locate = arguments.options;
    options.threads = arguments.threads;
    options.progress = progress_on(line);
    const Protocol protocol = run_protocol(options);
    write_protocol(system::path_of(arguments.report.out), protocol);
    fmt::print(
        "{}\n{}: table-3.md, positions.csv, angles.csv, figure-13, figure-14 and figure-15, each "
        ".svg and .png\n",
        table_3(protocol), arguments.report.out);
    return 0;
}

int run(EvaluateArguments& arguments) {
    const bool writes = arguments.sweep || arguments.protocol;
    const bool has_sources = arguments.sources.is_given();
    // The command line must name exactly one thing to evaluate. With --sweep or --protocol,
    // --preset is not counted, because it only sets the conditions of the evaluation.
    const int jobs = static_cast<int>(has_sources) + static_cast<int>(arguments.sweep.has_value()) +
                     static_cast<int>(arguments.protocol) +
                     static_cast<int>(arguments.preset && !writes);
    if (jobs != 1 || (has_sources && arguments.preset)) {
        throw BadArgument(
            "name one thing to evaluate: frames with their poses, --preset, --sweep or --protocol");
    }
    const ReportArguments& report = arguments.report;
    if (writes && is_standard_output(report.out)) {
        throw BadArgument("name a folder for the results: -o DIR");
    }
    if (writes && report.as_json) {
        throw BadArgument("--format json is for frames and --preset only");
    }
    if (!writes) require_apart(arguments);
    if (!has_sources && !arguments.poses.empty()) throw BadArgument("--poses is for frames only");
    arguments.measured.require_sheets();
    if (!has_sources && !arguments.measured.sheets.empty()) {
        throw BadArgument("--sheets is for frames only");
    }
    if (has_sources && arguments.frames) throw BadArgument("--frames is for simulated frames only");
    if (auto& camera = arguments.camera.camera) {
        if (!has_sources) throw BadArgument("--camera is not for simulated frames");
        if (arguments.truth_of == TruthOf::image) {
            camera->reference_px.reset();
            camera->theta_offset_rad = 0;
        }
        arguments.sources.fit_to(camera);
        use_camera(*camera, camera->width_px, camera->height_px, arguments.options);
    }
    arguments.setup.preset = arguments.preset.value_or(Preset::nominal);
    Pattern& pattern = arguments.setup.pattern;
    pattern.code = arguments.options.code;
    pattern.spacing_mm = arguments.spacing_mm;
    pattern.displacement_mm = pattern.dot_mm = arguments.spacing_mm / 6;
    arguments.setup.camera.k = arguments.options.lens.k_q40 * 0x1p-40;
    catch_interrupts();
    if (has_sources) return evaluate_sources(arguments);
    if (arguments.sweep) return evaluate_sweep(arguments);
    if (arguments.protocol) return evaluate_protocol(arguments);
    return evaluate_preset(arguments);
}

void add_jobs(Command& command, const std::shared_ptr<EvaluateArguments>& arguments) {
    arguments->sources.add_to(command);
    command.get_option("--size")->description(
        "Size of simulated frames (default 188x120) and of raw ones; of a camera, the size to "
        "request");
    command
        .add_option("--poses", arguments->poses,
                    "True poses of the frames: a CSV file as simulate writes it")
        ->type_name("FILE")
        ->default_str("truth.csv beside the frames");
    add_named(command, "--preset", kPresets, "", "Simulate frames in these conditions",
              [arguments](Preset preset) { arguments->preset = preset; });
    add_named(command, "--sweep", kSweepKinds, "", "Worsen one condition step by step",
              [arguments](SweepKind kind) { arguments->sweep = kind; });
    add_named(command, "--protocol", kProtocols, "", "Simulate a published experiment",
              [arguments](PaperProtocol) { arguments->protocol = true; });
    command
        .add_option("--frames", arguments->frames,
                    "Number of frames; of a sweep, for each value; of the protocol, at each place")
        ->type_name("N")
        ->check(Range(1, 10'000'000))
        ->default_str("1000, 200, 20");
    command.add_option("--seed", arguments->setup.seed, "Seed of the random numbers")
        ->type_name("N")
        ->capture_default_str();
}

}  // namespace

void add_evaluate(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<EvaluateArguments>();
    Command* command =
        app.add_subcommand("evaluate", "Measure how often and how well frames are located");
    command->footer(kEvaluateExamples);
    add_jobs(*command, arguments);
    add_attempt_options(*command, ErrorRates::known, arguments->options);
    add_code_option(*command, arguments->code);
    add_spacing_option(*command, arguments->spacing_mm);
    Option* camera =
        add_camera_option(*command, arguments->camera,
                          "Camera file with which frames are located, as with locate --camera");
    camera->excludes(add_lens_option(*command, arguments->options.lens));
    add_named(*command, "--truth", kTruths, "image",
              "Poses in truth.csv: of the image centre, as simulate writes them, or of the robot, "
              "by reference_px and theta_offset_rad of the camera file",
              [arguments](TruthOf truth) { arguments->truth_of = truth; })
        ->needs(camera);
    arguments->measured.add_to(*command);
    command->get_option("--sheets")
        ->excludes(command->get_option("--spacing"))
        ->excludes(command->get_option("--code"));
    command->get_option("--code")->default_str("as in truth.csv, or auto");
    command->get_option("--spacing")->default_str("as in truth.csv, or 0.508");
    command
        ->add_option("--threads", arguments->threads,
                     "Number of threads, 0 for all cores; results do not depend on it")
        ->type_name("N")
        ->check(Range(0, 1024))
        ->capture_default_str();
    add_report_options(*command, arguments->report,
                       "File to write instead of standard output; of a sweep and of the protocol, "
                       "the folder for the results, which is created if missing");
    command->get_option("--out")->type_name("FILE|-|DIR");
    command->callback([arguments, command, &exit_code] {
        arguments->spacing_given = command->count("--spacing") > 0;
        arguments->ignores_truth_codes = command->count("--code") > 0 && !arguments->code;
        if (const auto& size = arguments->sources.options; size.width_px > 0) {
            arguments->setup.camera.width_px = size.width_px;
            arguments->setup.camera.height_px = size.height_px;
        }
        arguments->options.code = arguments->code.value_or(CodeVariant::anoto);
        exit_code = run(*arguments);
    });
}

}  // namespace dotpose::cli
