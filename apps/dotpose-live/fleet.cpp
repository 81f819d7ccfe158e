#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "alert_publisher.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "fleet_input.hpp"
#include "fleet_metrics.hpp"
#include "fleet_share.hpp"
#include "fleet_store.hpp"
#include "fleet_view.hpp"
#include "fleet_web.hpp"
#include "metrics_file.hpp"
#include "mqtt_options.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "robot_remover.hpp"
#include "run_files.hpp"
#include "web_arguments.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::steady_clock;

constexpr const char* kFleetExamples =
    "Examples:\n"
    "  dotpose fleet --mqtt mqtt://broker --sheets table.json --draw fleet.svg\n"
    "  dotpose fleet --mqtt mqtt://broker --sheets table.json --web 8080\n"
    "  dotpose fleet --mqtt mqtts://me@broker --mqtt-ca ca.pem --seconds 60\n"
    "  dotpose fleet --mqtt mqtt://broker --qos 1 --shard 1/3 --log part1.csv\n"
    "  dotpose fleet --mqtt mqtt://broker --qos 1 --share loggers --log states.csv\n"
    "  dotpose fleet --mqtt mqtt://broker --qos 1 --store fleet.db --store-days 30\n"
    "  dotpose fleet history --store fleet.db --robot anna --draw anna.svg\n\n"
    "Lists all robots that publish to the broker (dotpose watch --mqtt), on a terminal live, else "
    "at\n"
    "the end. Open the map in a browser and let it reload. Ctrl-C ends. docs/fleet.md\n";

struct FleetArguments {
    MqttArguments mqtt;
    ShareArguments share;
    std::string sheets;
    std::string map;
    std::string log;
    std::string metrics;
    StoreArguments store;
    WebArguments web;
    double seconds = 0;  ///< run time, or 0 to run until interrupted
    double every_s = 1;
    double silent_after_s = 5;
    double gone_after_s = 60;
    bool publishes_alerts = false;
};

ConditionLimits limits_of(const FleetArguments& arguments) {
    if (arguments.gone_after_s < arguments.silent_after_s) {
        throw BadArgument("--gone-after must not be less than --silent-after");
    }
    return {std::llround(arguments.silent_after_s * 1e6),
            std::llround(arguments.gone_after_s * 1e6)};
}

void register_files(const FleetArguments& arguments) {
    RunFiles files;
    files.reads("--sheets", arguments.sheets);
    files.reads("--mqtt-ca", arguments.mqtt.ca_file);
    files.reads("--web-token-file", arguments.web.token_file());
    files.writes("--draw", arguments.map, Content::svg);
    files.writes("--log", arguments.log, Content::csv);
    files.writes("--metrics", arguments.metrics, Content::text);
    if (!store::is_on_server(arguments.store.where)) {
        files.updates("--store", arguments.store.where, Content::own);
    }
}

/// Limits an action to one call per period.
class Periodically {
  public:
    explicit Periodically(double period_s) : period_s_(period_s), last_(steady_clock::now()) {}

    template <typename Function>
    void call(const Function& function) {
        const auto now = steady_clock::now();
        if (std::chrono::duration<double>(now - last_).count() < period_s_) return;
        last_ = now;
        function();
    }

  private:
    double period_s_;
    steady_clock::time_point last_;
};

std::optional<store::QueueStatus> store_status(const std::optional<FleetStore>& store) {
    return store ? std::optional(store->status()) : std::nullopt;
}

/// Returns the options for the web page, or nullopt if --web is not given. The caller must set
/// `now` and `services`.
std::optional<FleetWebOptions> web_options(const FleetArguments& arguments,
                                           const publish::MqttOptions& mqtt) {
    auto server = arguments.web.options();
    if (!server) return std::nullopt;
    server->notify = mqtt.notify;
    FleetWebOptions options;
    options.server = *server;
    options.limits = limits_of(arguments);
    options.store = arguments.store.where;
    options.remove = [remover = std::make_shared<RobotRemover>(mqtt)](const std::string& robot) {
        remover->remove(robot);
    };
    return options;
}

void run(const FleetArguments& arguments) {
    constexpr auto kTick = std::chrono::milliseconds(50);
    constexpr double kBetweenAlerts_s = 0.25;
    auto mqtt = mqtt_options(arguments.mqtt);
    if (!mqtt) throw BadArgument("name the broker: --mqtt mqtt://HOST");
    const ConditionLimits limits = limits_of(arguments);
    register_files(arguments);
    catch_interrupts();
    const Delivery delivery = arguments.share.is_shared() ? Delivery::shared : Delivery::all;
    FleetView view(read_fleet_map(arguments.sheets), arguments.map, delivery);
    mqtt->notify = [&view](const std::string& message) { view.notify(message); };
    std::optional<FleetStore> store;
    if (!arguments.store.where.empty()) store.emplace(arguments.store, mqtt->notify);
    FleetInput input({*mqtt, arguments.share, limits, arguments.log}, store ? &*store : nullptr);
    std::optional<AlertPublisher> alerts;
    if (arguments.publishes_alerts) alerts.emplace(*mqtt);

    const auto begun = steady_clock::now();
    const auto is_over = [&] {
        const std::chrono::duration<double> elapsed = steady_clock::now() - begun;
        return arguments.seconds > 0 && elapsed.count() >= arguments.seconds;
    };
    std::optional<MetricsFile> metrics;
    if (!arguments.metrics.empty()) metrics.emplace(arguments.metrics, mqtt->notify);
    const auto services = [&] {
        return FleetServices{input.is_connected(), delivery, store_status(store)};
    };
    const auto write_metrics = [&] {
        if (!metrics) return;
        metrics->write(
            metrics_text(input.fleet(), input.fleet().robots(input.now()), view.map(), services()));
    };
    std::optional<FleetWeb> web;
    if (auto options = web_options(arguments, *mqtt)) {
        options->now = [&input] { return input.now(); };
        options->services = services;
        web.emplace(*options, input.fleet(), view.map());
    }
    Periodically refresh(arguments.every_s);
    Periodically alert(kBetweenAlerts_s);
    while (!interrupted() && !is_over() && view.take_keys(input.fleet(), input.now())) {
        std::this_thread::sleep_for(kTick);
        input.observe();
        alert.call([&] {
            if (alerts) alerts->check(input.fleet().robots(input.now()), input.now());
        });
        refresh.call([&] {
            view.refresh(input.fleet(), input.now());
            write_metrics();
            input.flush();
        });
    }
    web.reset();
    input.finish();
    view.finish(input.fleet(), input.now());
    if (alerts) alerts->finish();
    write_metrics();
    if (store) store->finish();
    input.require_reached();
}

void add_limits(Command& command, FleetArguments& arguments) {
    const auto add = [&command](const char* flag, double& value, const char* help) {
        command.add_option(flag, value, help)
            ->type_name("S")
            ->capture_default_str()
            ->check(Range(0.1, 1e7));
    };
    add("--silent-after", arguments.silent_after_s,
        "Time without a message after which a robot is silent");
    add("--gone-after", arguments.gone_after_s,
        "Time without a message after which a robot is gone");
    command.add_flag("--alerts", arguments.publishes_alerts,
                     "Publish robots that are lost, silent or gone to dotpose/alerts/ROBOT");
}

}  // namespace

void add_fleet(Command& app, int&) {
    const auto arguments = std::make_shared<FleetArguments>();
    Command* command = app.add_subcommand("fleet", "Show all robots that publish to a broker");
    command->footer(kFleetExamples);
    command->require_subcommand(0, 1);
    arguments->mqtt.add_to(*command);
    add_sheets_option(*command, arguments->sheets, "Sheet file: draw its sheets on the map");
    add_draw_option(*command, arguments->map, "Map to draw and update (SVG)");
    command->add_option("--log", arguments->log, "Write every state as a line of CSV")
        ->type_name("FILE");
    command
        ->add_option("--metrics", arguments->metrics,
                     "File of metrics for Prometheus (.prom), replaced at each update")
        ->type_name("FILE");
    arguments->store.add_to(*command);
    arguments->web.add_to(*command);
    arguments->share.add_to(*command);
    add_limits(*command, *arguments);
    command->add_option("--every", arguments->every_s, "Time between two updates")
        ->type_name("S")
        ->capture_default_str()
        ->check(Range(0.05, 3600.0));
    command->add_option("--seconds", arguments->seconds, "End after this time")
        ->type_name("S")
        ->check(Range(0.1, 1e9));
    add_fleet_remove(*command);
    add_fleet_history(*command);
    command->callback([arguments, command] {
        if (command->get_parsed_subcommands().empty()) run(*arguments);
    });
}

}  // namespace dotpose::cli
