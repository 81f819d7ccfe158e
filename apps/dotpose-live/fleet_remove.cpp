// `dotpose fleet remove`: removes robots from the broker, and thus from all running fleets.
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "dotpose/files/error.hpp"
#include "mqtt_options.hpp"
#include "state_message.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kRemoveExamples =
    "Examples:\n"
    "  dotpose fleet remove anna --mqtt mqtt://broker\n"
    "  dotpose fleet remove anna bert carl --mqtt mqtts://me@broker\n\n"
    "The broker forgets that the robots were connected, and every running fleet removes them from\n"
    "its table and map. Their history is kept. A robot that still publishes appears again.\n";

struct RemoveArguments {
    MqttArguments mqtt;
    std::vector<std::string> robots;
};

std::string check_level(const std::string& name) {
    const bool is_bad = name.empty() || name.find_first_of("/+#") != std::string::npos ||
                        name.size() > kMaxNameBytes;
    return is_bad ? "the name of a robot must have 1 to 128 bytes and must not contain / + #"
                  : std::string();
}

/// Returns the subset of `robots` whose connection messages the broker retains. Waits up to
/// kPatience for these messages. Throws Error if no connection to the broker was established.
std::set<std::string, std::less<>> retained_robots(const publish::MqttOptions& options,
                                                   const std::vector<std::string>& robots) {
    constexpr auto kPatience = std::chrono::seconds(3);
    std::mutex mutex;
    std::set<std::string, std::less<>> found;
    std::vector<std::string> topics;
    for (const std::string& robot : robots)
        topics.push_back(topic_of(robot, Subject::connection));
    publish::MqttSubscriber subscriber(options, topics,
                                       [&](std::string_view topic, std::string_view payload) {
                                           const auto sender = parse_topic(topic);
                                           const std::lock_guard lock(mutex);
                                           if (sender && !payload.empty())
                                               found.emplace(sender->robot);
                                       });
    // The broker sends retained messages immediately after the subscription. If there are none, it
    // sends nothing. The wait is therefore limited to kPatience.
    const auto end = std::chrono::steady_clock::now() + kPatience;
    const std::set<std::string> wanted(robots.begin(), robots.end());
    const auto has_all = [&] {
        const std::lock_guard lock(mutex);
        return found.size() == wanted.size();
    };
    while (!has_all() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    subscriber.require_reached();
    subscriber.disconnect();
    return found;
}

void run(const RemoveArguments& arguments) {
    constexpr auto kPatience = std::chrono::seconds(5);
    auto options = mqtt_options(arguments.mqtt);
    if (!options) throw BadArgument("name the broker: --mqtt mqtt://HOST");
    options->qos = 1;
    options->queue = arguments.robots.size();
    const auto retained = retained_robots(*options, arguments.robots);
    publish::MqttPublisher publisher(*options);
    for (const std::string& robot : arguments.robots)
        publisher.publish(topic_of(robot, Subject::connection), {}, true);
    const bool is_sent = publisher.flush(kPatience);
    publisher.require_reached();
    if (!is_sent || publisher.dropped() > 0) throw Error("the broker did not accept the removal");
    std::string unknown;
    for (const std::string& robot : arguments.robots) {
        if (retained.contains(robot)) {
            fmt::print("removed {}\n", printable(robot));
        } else {
            unknown += (unknown.empty() ? "" : ", ") + printable(robot);
        }
    }
    if (!unknown.empty()) {
        throw Error("the broker knows no robot " + unknown +
                    ": 'dotpose fleet' lists the names; if it listed this one, it is removed now");
    }
}

}  // namespace

void add_fleet_remove(Command& fleet) {
    const auto arguments = std::make_shared<RemoveArguments>();
    Command* command =
        fleet.add_subcommand("remove", "Remove robots from the broker and from running fleets")
            ->group("Commands");
    command->footer(kRemoveExamples);
    command->add_option("robots", arguments->robots, "Names of the robots")
        ->type_name("NAME")
        ->required()
        ->check(check_level);
    arguments->mqtt.add_to(*command);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
