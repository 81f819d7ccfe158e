#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "fleet_log.hpp"
#include "fleet_share.hpp"
#include "fleet_state.hpp"
#include "fleet_view.hpp"
#include "mqtt_arguments.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::steady_clock;

constexpr const char* kFleetExamples =
    "Examples:\n"
    "  dotpose fleet --mqtt mqtt://broker --sheets table.json --draw fleet.svg\n"
    "  dotpose fleet --mqtt mqtts://me@broker --mqtt-ca ca.pem --seconds 60\n"
    "  dotpose fleet --mqtt mqtt://broker --qos 1 --shard 1/3 --log part1.csv\n"
    "  dotpose fleet --mqtt mqtt://broker --qos 1 --share loggers --log states.csv\n\n"
    "Lists all robots that publish to the broker (dotpose watch --mqtt), on a terminal live, else "
    "at\n"
    "the end. Open the map in a browser and let it reload. Ctrl-C ends.\n";

struct FleetArguments {
    MqttArguments mqtt;
    ShareArguments share;
    std::string sheets;
    std::string map;
    std::string log;
    double seconds = 0;  ///< run time; 0 means until interrupted
    double every_s = 1;
};

/// Receives the messages of the broker in the thread of the subscriber, and logs them.
class FleetInput {
  public:
    FleetInput(const FleetArguments& arguments, const publish::MqttOptions& options)
        : shard_(arguments.share.shard()),
          fleet_([this](std::string_view robot, const RobotState& state) { log(robot, state); }) {
        if (!arguments.log.empty()) log_.emplace(arguments.log);
        subscriber_.emplace(
            options, arguments.share.topics(),
            [this](std::string_view topic, std::string_view payload) { take(topic, payload); });
    }

    const FleetState& fleet() const { return fleet_; }

    /// Writes the buffered lines of the log. Throws Error.
    void flush() {
        if (log_) log_->flush();
    }

    /// Disconnects and completes the log. Throws Error if the log cannot be written.
    void finish() {
        subscriber_->disconnect();
        flush();
    }

    /// Throws Error if no connection to the broker was established.
    void require_reached() const { subscriber_->require_reached(); }

  private:
    void take(std::string_view topic, std::string_view payload) {
        const auto sender = parse_topic(topic);
        if (sender && !shard_.has(sender->robot)) return;
        now_us_ = system_us();
        fleet_.take(topic, payload, now_us_);
    }
    void log(std::string_view robot, const RobotState& state) {
        if (log_) log_->add(robot, state, now_us_);
    }

    Shard shard_;
    std::int64_t now_us_ = 0;  ///< arrival time of the current message
    std::optional<FleetLog> log_;
    FleetState fleet_;
    std::optional<publish::MqttSubscriber> subscriber_;
};

void run(const FleetArguments& arguments) {
    const auto options = arguments.mqtt.options();
    if (!options) throw BadArgument("name the broker: --mqtt mqtt://HOST");
    RunFiles files;
    files.reads("--sheets", arguments.sheets);
    files.reads("--mqtt-ca", arguments.mqtt.ca_file());
    files.writes("--draw", arguments.map, Content::svg);
    files.writes("--log", arguments.log, Content::csv);
    catch_interrupts();
    FleetView view(arguments.sheets, arguments.map,
                   arguments.share.is_shared() ? Delivery::shared : Delivery::all);
    FleetInput input(arguments, *options);
    const auto begun = steady_clock::now();
    const auto seconds_since = [](steady_clock::time_point time) {
        return std::chrono::duration<double>(steady_clock::now() - time).count();
    };
    auto shown = begun;
    while (!interrupted() && (arguments.seconds <= 0 || seconds_since(begun) < arguments.seconds)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (seconds_since(shown) < arguments.every_s) continue;
        shown = steady_clock::now();
        view.refresh(input.fleet());
        input.flush();
    }
    input.finish();
    view.finish(input.fleet());
    input.require_reached();
}

}  // namespace

void add_fleet(Command& app, int&) {
    const auto arguments = std::make_shared<FleetArguments>();
    Command* command = app.add_subcommand("fleet", "Show all robots that publish to a broker");
    command->footer(kFleetExamples);
    arguments->mqtt.add_to(*command)->required();
    add_sheets_option(*command, arguments->sheets, "Sheet file: draw its sheets on the map");
    add_draw_option(*command, arguments->map, "Map to draw and update (SVG)");
    command->add_option("--log", arguments->log, "Write every state as a line of CSV")
        ->type_name("FILE");
    arguments->share.add_to(*command);
    command->add_option("--every", arguments->every_s, "Time between two updates")
        ->type_name("S")
        ->capture_default_str()
        ->check(Range(0.05, 3600.0));
    command->add_option("--seconds", arguments->seconds, "End after this time")
        ->type_name("S")
        ->check(Range(0.1, 1e9));
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
