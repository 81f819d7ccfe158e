#include <filesystem>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"
#include "log_updates.hpp"
#include "output_arguments.hpp"
#include "print/lower_case.hpp"
#include "robot_name.hpp"
#include "robot_recording.hpp"
#include "run_files.hpp"
#include "run_log.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kReplayExamples =
    "Examples:\n"
    "  dotpose watch run.mp4 --log run.csv\n"
    "  dotpose replay run.csv --draw run.svg\n"
    "  dotpose replay run.csv --format json -o run.json\n"
    "  dotpose watch run.mp4 > run.json         and then: dotpose replay run.json\n"
    "  dotpose replay run.csv -o run.mcap       and then: ros2 bag play run.mcap, or Foxglove\n\n"
    "The picture shows the path, and speed, dots and certainty over time, with all gaps.\n";

struct ReplayArguments {
    std::string log;
    std::string picture;
    std::string robot = "robot";
    std::string frame_prefix;
    ReportArguments report;
};

/// Returns true if the output file (-o) is a recording rather than a report.
bool is_recording(const std::string& out) {
    return print::lower_case(system::path_of(out).extension().string()) == ".mcap";
}

std::string list_of(const std::map<std::string, std::int64_t>& counts) {
    std::string text;
    for (const auto& [name, count] : counts)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", printable(name), count);
    return text.empty() ? "none" : text;
}

double fraction(std::int64_t part, std::int64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// Returns a list of the frames of reference used for poses, or "none". Adds advice if any pose is
/// in the pattern frame.
std::string frames_of_poses(const RunStatistics& run) {
    std::string text;
    for (const std::string& plane : run.planes)
        text += (text.empty() ? "" : ", ") + printable(plane);
    if (text.empty()) return "none";
    if (!run.planes.contains("pattern")) return text;
    return text + " (y down, angles clockwise); for the world, 'dotpose sheets place' before watch";
}

std::string text_report(const RunStatistics& run) {
    std::string text;
    const auto line = [&text](const char* what, const std::string& value) {
        text += fmt::format("{:<28}{}\n", what, value);
    };
    line("frames", fmt::format("{}", run.frames));
    line("duration", fmt::format("{:.3f} s", run.duration_s));
    line("frames with a fix",
         fmt::format("{} ({:.2f} %)", run.fixes, 100 * fraction(run.fixes, run.frames)));
    line("frames without, by status", list_of(run.without_fix));
    line("gaps", fmt::format("{}, the longest {:.3f} s", run.gaps, run.longest_gap_s));
    line("events", list_of(run.events));
    line("verdicts of the tracker", list_of(run.verdicts));
    line("frame of the poses", frames_of_poses(run));
    line("distance driven", fmt::format("{:.3f} mm", run.distance_mm));
    line("stationary", fmt::format("{:.3f} s", run.stationary_s));
    line("speed while moving", fmt::format("mean {:.1f} mm/s, largest {:.1f} mm/s",
                                           run.mean_speed_mm_s, run.largest_speed_mm_s));
    line("largest p_wrong", fmt::format("{:.3g}", run.largest_p_wrong));
    return text;
}

std::string json_report(const RunStatistics& run) {
    const nlohmann::ordered_json json = {{"frames", run.frames},
                                         {"duration_s", run.duration_s},
                                         {"fixes", run.fixes},
                                         {"fixes_fraction", fraction(run.fixes, run.frames)},
                                         {"without_fix", run.without_fix},
                                         {"gaps", run.gaps},
                                         {"longest_gap_s", run.longest_gap_s},
                                         {"events", run.events},
                                         {"verdicts", run.verdicts},
                                         {"planes", run.planes},
                                         {"distance_mm", run.distance_mm},
                                         {"stationary_s", run.stationary_s},
                                         {"mean_speed_mm_s", run.mean_speed_mm_s},
                                         {"largest_speed_mm_s", run.largest_speed_mm_s},
                                         {"largest_p_wrong", run.largest_p_wrong}};
    return with_escaped_controls(
               json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)) +
           '\n';
}

/// Writes an MCAP file with the messages that the robot would have published during the run.
void record(const ReplayArguments& arguments) {
    LogReader log(system::path_of(arguments.log));
    ros::RobotMessenger messenger(arguments.robot, ros::with_prefix(arguments.frame_prefix));
    RobotRecording recording(arguments.report.out, arguments.robot);
    while (const auto update = log.next(update_of))
        recording.take(messenger.messages(*update), update->time_ns);
    recording.finish();
}

void run(const ReplayArguments& arguments) {
    RunFiles files;
    files.reads("", arguments.log);
    files.writes("-o", arguments.report.out,
                 is_recording(arguments.report.out) ? Content::mcap : content_of(arguments.report));
    files.writes("--draw", arguments.picture, Content::svg);
    if (!arguments.picture.empty()) require_writable(system::path_of(arguments.picture));
    const auto rows = read_log(system::path_of(arguments.log));
    const RunStatistics statistics = statistics_of(rows);
    ReportArguments report = arguments.report;
    if (is_recording(report.out)) {
        record(arguments);
        report.out = kStandardOutput;
    }
    write_report(report, report.as_json ? json_report(statistics) : text_report(statistics));
    if (arguments.picture.empty()) return;
    write_file(system::path_of(arguments.picture),
               draw_run(rows, system::path_of(arguments.log).filename().string()));
}

}  // namespace

void add_replay(Command& app, int&) {
    const auto arguments = std::make_shared<ReplayArguments>();
    Command* command =
        app.add_subcommand("replay", "Statistics and a picture of a run that watch recorded");
    command->footer(kReplayExamples);
    command
        ->add_option("log", arguments->log, "Log of dotpose watch --log (CSV), or its lines (JSON)")
        ->type_name("FILE")
        ->required();
    add_report_options(*command, arguments->report,
                       "File to write instead of standard output; NAME.mcap: ROS 2 messages");
    add_draw_option(*command, arguments->picture, "Also draw the run (SVG)");
    add_robot_option(*command, arguments->robot, "Name of the robot in ROS topics");
    add_frame_prefix_option(*command, arguments->frame_prefix);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
