// `dotpose fleet history`: reads the states stored by `dotpose fleet --store`.
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"
#include "fleet_store.hpp"
#include "fleet_view.hpp"
#include "history_path.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "state_message.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kHistoryExamples =
    "Examples:\n"
    "  dotpose fleet history --store fleet.db\n"
    "  dotpose fleet history --store fleet.db --robot anna --from 2026-11-28T08:00 --to "
    "2026-11-28T09:00 --draw anna.svg\n"
    "  dotpose fleet history --store postgresql://me@db/robots --robot anna --format csv -o "
    "anna.csv\n\n"
    "Without --robot, lists the robots with the times of their first and last states. Times are "
    "UTC.\n"
    "With --draw and without -o, no lines are written.\n";

struct HistoryArguments {
    std::string where;
    store::Query query;
    std::string sheets;
    std::string drawing;
    LineArguments lines;
};

/// Converts a UTC time, such as "2026-11-28", "2026-11-28T08:00" or "2026-11-28T08:00:00.5Z", to
/// microseconds since 1970. Throws ValidationError for any other text.
std::int64_t parse_time(const std::string& flag, std::string text) {
    const std::string given = text;
    if (text.size() == std::string_view("2026-11-28").size()) text += "T00:00";
    if (text.size() == std::string_view("2026-11-28T08:00").size()) text += ":00";
    if (!text.ends_with('Z')) text += 'Z';
    const auto time_us = parse_timestamp(text);
    if (!time_us) {
        throw ValidationError(flag, "'" + given + "' is not a time such as 2026-11-28 or " +
                                        "2026-11-28T08:00:00 (UTC)");
    }
    return *time_us;
}

/// Returns the fields for a state, with the names and units used by `dotpose fleet --log`.
std::vector<Field> fields(const store::State& state) {
    const bool is_localized = state.motion != store::Motion::lost;
    const auto shown = [is_localized](double value, double factor, int decimals) {
        return is_localized ? decimal(value * factor, decimals) : std::string();
    };
    return {
        {"robot", *state.robot, true},
        {"time", timestamp(state.time_us), true},
        {"state", std::string(name(state.motion)), true},
        {"reason", state.reason == Status::ok ? "" : name(state.reason), true},
        {"map", state.place->map, true},
        {"sheet", state.place->sheet, true},
        {"number", fmt::format("{}", state.number)},
        {"latency_ms", decimal(state.delay_us * 1e-3, 3)},
        {"x_mm", shown(static_cast<double>(state.x_nm), 1e-6, 6)},
        {"y_mm", shown(static_cast<double>(state.y_nm), 1e-6, 6)},
        {"theta_deg", shown(state.theta_urad, 1e-6 * kDegrees, 6)},
        {"deviation_mm", shown(state.deviation_nm, 1e-6, 6)},
        {"vx_mm_s", shown(state.vx_um_s, 1e-3, 3)},
        {"vy_mm_s", shown(state.vy_um_s, 1e-3, 3)},
        {"turn_deg_s", shown(state.omega_urad_s, 1e-6 * kDegrees, 3)},
    };
}

std::vector<Field> fields(const store::RobotSpan& span) {
    return {{"robot", span.robot, true},
            {"first", timestamp(span.first_us), true},
            {"last", timestamp(span.last_us), true}};
}

void list_robots(store::Database& database, const LineArguments& arguments) {
    Lines lines(arguments.out);
    if (arguments.format == RecordFormat::csv) lines.write(csv_header(fields(store::RobotSpan())));
    for (const store::RobotSpan& span : database.robots())
        lines.write(line_of(fields(span), arguments.format));
}

[[noreturn]] void throw_no_states(store::Database& database, const store::Query& query) {
    for (const store::RobotSpan& span : database.robots()) {
        if (span.robot != query.robot) continue;
        throw Error(
            fmt::format("there are no states of {} in this time: its states are from {} to {}",
                        printable(query.robot), timestamp(span.first_us), timestamp(span.last_us)));
    }
    throw Error(fmt::format(
        "there are no states of a robot {}: without --robot, this command lists all robots",
        printable(query.robot)));
}

void write_states(store::Database& database, const HistoryArguments& arguments) {
    std::optional<Lines> lines;
    if (arguments.drawing.empty() || !arguments.lines.out.empty()) {
        lines.emplace(arguments.lines.out);
    }
    HistoryPath path(read_fleet_map(arguments.sheets));
    std::int64_t states = 0;
    database.read(arguments.query, [&](const store::State& state) {
        const RecordFormat format = arguments.lines.format;
        if (states++ == 0 && lines && format == RecordFormat::csv) {
            lines->write(csv_header(fields(state)));
        }
        if (lines) lines->write(line_of(fields(state), format));
        if (!arguments.drawing.empty()) path.add(state);
        if (interrupted()) throw Error("interrupted");
    });
    if (states == 0) throw_no_states(database, arguments.query);
    if (!arguments.drawing.empty()) write_file(arguments.drawing, draw::draw_map(path.drawing()));
}

void run(const HistoryArguments& arguments) {
    if (arguments.query.robot.empty() && !arguments.drawing.empty()) {
        throw BadArgument("--draw needs a robot: --robot NAME");
    }
    if (arguments.query.from_us >= arguments.query.to_us) {
        throw BadArgument("--from must be before --to");
    }
    RunFiles files;
    if (!store::is_on_server(arguments.where)) files.reads("--store", arguments.where);
    files.reads("--sheets", arguments.sheets);
    files.writes_lines(arguments.lines.out, content_of(arguments.lines.format));
    files.writes("--draw", arguments.drawing, Content::svg);
    catch_interrupts();
    const auto database = store::make_database(arguments.where, store::Access::read);
    if (arguments.query.robot.empty()) return list_robots(*database, arguments.lines);
    write_states(*database, arguments);
}

void add_time(Command& command, const std::string& flag, std::int64_t& time_us,
              const std::string& help) {
    command
        .add_option_function<std::string>(
            flag, [flag, &time_us](const std::string& text) { time_us = parse_time(flag, text); },
            help)
        ->type_name("TIME");
}

}  // namespace

void add_fleet_history(Command& fleet) {
    const auto arguments = std::make_shared<HistoryArguments>();
    Command* command =
        fleet.add_subcommand("history", "Read the stored states of a robot")->group("Commands");
    command->footer(kHistoryExamples);
    command
        ->add_option("--store", arguments->where,
                     "Database that dotpose fleet --store wrote: URL of PostgreSQL, or file")
        ->type_name("WHERE")
        ->required();
    command
        ->add_option_function<std::string>(
            "--robot",
            [arguments](const std::string& name) { arguments->query.robot = stored_name(name); },
            "Name of the robot")
        ->type_name("NAME");
    add_time(*command, "--from", arguments->query.from_us, "First time, UTC: 2026-11-28T08:00:00");
    add_time(*command, "--to", arguments->query.to_us, "Time before which the history ends, UTC");
    add_sheets_option(*command, arguments->sheets, "Sheet file: draw its sheets on the map");
    add_draw_option(*command, arguments->drawing, "Map of the path (SVG)");
    add_format_options(*command, arguments->lines);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
