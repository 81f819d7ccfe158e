#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <fmt/core.h>
#include <unistd.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "files/output_file.hpp"
#include "fleet_state.hpp"
#include "mqtt_arguments.hpp"
#include "output_arguments.hpp"
#include "path_memory.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::steady_clock;

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose fleet --mqtt mqtt://broker --sheets table.json --draw fleet.svg\n"
    "  dotpose fleet --mqtt mqtts://me@broker --mqtt-ca ca.pem --seconds 60\n\n"
    "Lists all robots that publish to the broker (dotpose watch --mqtt), on a terminal live, else "
    "at\n"
    "the end. Open the map in a browser and let it reload. Ctrl-C ends.\n";

struct FleetArguments {
    MqttArguments mqtt;
    std::string sheets;
    std::string map;
    double seconds = 0;  ///< how long to run; 0 until interrupted
    double every_s = 1;
};

class FleetView {
  public:
    explicit FleetView(const FleetArguments& arguments)
        : map_path_(arguments.map), on_terminal_(isatty(STDOUT_FILENO) == 1) {
        if (!map_path_.empty()) files::require_writable(map_path_);
        if (arguments.sheets.empty()) return;
        map_id_ = std::filesystem::path(arguments.sheets).stem().string();
        sheets_ = map_sheets(read_sheets(arguments.sheets), Plane::sheet_world);
    }

    void refresh(const FleetState& fleet, bool is_last) {
        constexpr const char* kClear = "\033[H\033[J";
        if (on_terminal_ || is_last) {
            fmt::print("{}{}", on_terminal_ ? kClear : "", table_of(fleet, system_us()));
            std::fflush(stdout);
        }
        if (!map_path_.empty()) write_map(fleet, is_last);
    }

  private:
    /// Writes the map. A failure is only reported, because the next attempt may succeed and the
    /// table goes on without the map; for the last map, it is an error.
    void write_map(const FleetState& fleet, bool is_last) {
        try {
            files::OutputFile file(map_path_);
            file.write(draw::draw_map(map_of(fleet, map_shown(fleet), sheets_)));
            file.commit();
            is_failing_ = false;
        } catch (const Error& error) {
            if (is_last) throw;
            if (!is_failing_) tell(error.what());
            is_failing_ = true;
        }
    }

    /// Returns the name of the map to draw: the world of the sheets, or else the plane of the first
    /// robot that has one.
    std::string map_shown(const FleetState& fleet) const {
        if (!map_id_.empty()) return map_id_;
        for (const auto& [name, robot] : fleet.robots()) {
            if (!robot.newest.map_id.empty()) return robot.newest.map_id;
        }
        return {};
    }

    std::string map_path_;
    std::string map_id_;
    std::vector<draw::MapSheet> sheets_;
    bool on_terminal_;
    bool is_failing_ = false;  ///< whether the last map could not be written
};

void run(const FleetArguments& arguments) {
    const auto options = arguments.mqtt.options();
    if (!options) throw BadArgument("name the broker: --mqtt mqtt://HOST");
    RunFiles files;
    files.reads("--sheets", arguments.sheets);
    files.reads("--mqtt-ca", arguments.mqtt.ca_file());
    files.writes("--draw", arguments.map, Content::svg);
    catch_interrupts();
    FleetView view(arguments);
    FleetState fleet;
    const publish::MqttSubscriber subscriber(
        *options, state_topic("+"), [&fleet](const std::string& topic, const std::string& payload) {
            fleet.take(topic, payload, system_us());
        });
    const auto begun = steady_clock::now();
    const auto seconds_since = [](steady_clock::time_point time) {
        return std::chrono::duration<double>(steady_clock::now() - time).count();
    };
    auto shown = begun;
    while (!interrupted() && (arguments.seconds <= 0 || seconds_since(begun) < arguments.seconds)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (seconds_since(shown) < arguments.every_s) continue;
        shown = steady_clock::now();
        view.refresh(fleet, false);
    }
    view.refresh(fleet, true);
}

}  // namespace

void add_fleet(CLI::App& app, int&) {
    const auto arguments = std::make_shared<FleetArguments>();
    CLI::App* command = app.add_subcommand("fleet", "Show all robots that publish to a broker");
    command->footer(kExamples);
    arguments->mqtt.add_to(*command)->required();
    add_sheets_option(*command, arguments->sheets, "Sheet file: draw its sheets on the map");
    add_draw_option(*command, arguments->map, "Map to draw (SVG), again and again");
    command->add_option("--every", arguments->every_s, "Time between two looks")
        ->type_name("S")
        ->capture_default_str()
        ->check(CLI::Range(0.05, 3600.0).description(""));
    command->add_option("--seconds", arguments->seconds, "End after this time")
        ->type_name("S")
        ->check(CLI::Range(0.1, 1e9).description(""));
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
