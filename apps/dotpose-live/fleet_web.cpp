#include "fleet_web.hpp"

#include <algorithm>
#include <utility>

#include "fleet_map_values.hpp"
#include "metrics_text.hpp"
#include "serve/background_thread.hpp"
#include "terminal_text.hpp"
#include "web_pages.hpp"

namespace dotpose::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{33};
constexpr milliseconds kEachTick{0};
constexpr milliseconds kListPeriod{500};
constexpr milliseconds kRobotPeriod{200};
constexpr milliseconds kTrailPeriod{1000};
constexpr milliseconds kCheckPeriod{250};

serve::ServerOptions with_pages(serve::ServerOptions options) {
    options.pages = fleet_pages();
    return options;
}

}  // namespace

FleetWeb::FleetWeb(FleetWebOptions options, const FleetState& fleet, const FleetMap& map)
    : options_(std::move(options)),
      fleet_(fleet),
      map_(map),
      counted_at_(Clock::now()),
      server_(with_pages(options_.server)),
      setup_(server_.add_topic("setup", serve::Format::text)),
      summary_{server_.add_topic("summary", serve::Format::text), kListPeriod},
      table_{server_.add_topic("table", serve::Format::text), kListPeriod},
      robot_{server_.add_topic("robot", serve::Format::text), kRobotPeriod},
      positions_{server_.add_topic("positions", serve::Format::binary), kEachTick},
      trails_{server_.add_topic("trails", serve::Format::binary), kTrailPeriod},
      history_topic_(server_.add_topic("history", serve::Format::text)) {
    server_.start();
    server_.set_route("/metrics", [this] {
        return serve::Answer{
            .type = kMetricsType,
            .body = metrics_text(fleet_, fleet_.robots(options_.now()), map_, options_.services())};
    });
    const bool has_history = !options_.store.empty();
    server_.publish(setup_, [text = setup_value(map_, options_.limits, options_.device,
                                                has_history)] { return text; });
    if (has_history) history_.emplace(options_.store, server_, history_topic_);
    options_.server.notify("the page is at " + server_.url());
    thread_ = std::thread([this] { run(); });
}

FleetWeb::~FleetWeb() {
    ends_ = true;
    thread_.join();
}

void FleetWeb::run() {
    serve::run_in_background();
    Clock::time_point next = Clock::now();
    while (!ends_) {
        // Skips missed ticks instead of catching up.
        next = std::max(next + kTick, Clock::now());
        std::this_thread::sleep_until(next);
        const Clock::time_point now = Clock::now();
        snapshot_.reset();
        obey();
        note_alerts(now);
        publish_lists(now);
        publish_map(now);
    }
}

bool FleetWeb::is_due(TimedTopic& timed, Clock::time_point now) {
    if (now < timed.next || !timed.topic.is_wanted()) return false;
    timed.next = now + timed.period;
    return true;
}

const FleetWeb::Snapshot& FleetWeb::snapshot() {
    if (!snapshot_) {
        const Now now = options_.now();
        snapshot_ = std::make_shared<const FleetSnapshot>(FleetSnapshot{fleet_.robots(now), now});
    }
    return snapshot_;
}

/// Stores new alerts, even if no browser is connected.
void FleetWeb::note_alerts(Clock::time_point now) {
    constexpr std::size_t kMaxRemembered = 2000;
    if (now < next_check_) return;
    next_check_ = now + kCheckPeriod;
    for (RobotAlert& alert : watch_.changes(snapshot()->robots, snapshot()->now)) {
        alert.sent_us = snapshot()->now.system_us;
        alerts_.push_back(std::move(alert));
        if (alerts_.size() > kMaxRemembered) alerts_.pop_front();
    }
}

void FleetWeb::publish_lists(Clock::time_point now) {
    const Delivery delivery = options_.services().delivery;
    if (is_due(summary_, now)) {
        const std::int64_t states = fleet_.counts().messages;
        const std::chrono::duration<double> elapsed = now - std::exchange(counted_at_, now);
        const auto added = static_cast<double>(states - std::exchange(counted_states_, states));
        server_.publish(summary_.topic,
                        [text = summary_value(*snapshot(), fleet_, map_, options_.services(),
                                              added / elapsed.count(), alerts_)] { return text; });
    }
    if (is_due(table_, now)) {
        server_.publish_for_each(
            table_.topic, [this, delivery, shot = snapshot()](const serve::Command& request) {
                return table_value(*shot, map_, delivery, request);
            });
    }
    if (is_due(robot_, now)) {
        server_.publish_for_each(robot_.topic, [this, delivery, shot = snapshot(),
                                                alerts = alerts_](const serve::Command& request) {
            return robot_value(*shot, fleet_, map_, delivery, alerts, request);
        });
    }
}

void FleetWeb::publish_map(Clock::time_point now) {
    if (is_due(positions_, now)) {
        server_.publish_for_each(positions_.topic,
                                 [this, shot = snapshot()](const serve::Command& request) {
                                     return positions_value(*shot, map_, request);
                                 });
    }
    if (is_due(trails_, now)) {
        server_.publish_for_each(trails_.topic,
                                 [this, shot = snapshot()](const serve::Command& request) {
                                     return trails_value(*shot, fleet_, map_, request);
                                 });
    }
}

void FleetWeb::obey() {
    while (const std::optional<serve::Command> command = server_.take_command()) {
        if (command->name == "remove") remove(*command);
    }
}

/// Removes a robot, as `dotpose fleet remove` does. The command contains the number and the name of
/// the robot. The name must also match, because the number may belong to another robot after a
/// restart of the program.
void FleetWeb::remove(const serve::Command& command) {
    const auto* id = command.argument<double>("robot");
    const auto* name = command.argument<std::string>("name");
    if (id == nullptr || name == nullptr || !options_.remove) return;
    const auto* robot = robot_with(snapshot()->robots, *id);
    if (robot == nullptr || printable(robot->first) != *name) return;
    options_.remove(robot->first);
    options_.server.notify("web: removed " + printable(robot->first));
}

}  // namespace dotpose::cli
