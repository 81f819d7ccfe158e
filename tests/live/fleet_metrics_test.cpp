// Tests the metrics of `dotpose fleet`, and the files for Prometheus and Grafana. promtool checks
// the metrics and the alert rules.
#include "fleet_metrics.hpp"

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive.hpp"
#include "../paths.hpp"
#include "dotpose/tools/image_file.hpp"
#include "fleet_receiver.hpp"
#include "mqtt_fixture.hpp"
#include "watched_fleet.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

fs::path monitoring() {
    return source_dir() + "/packaging/monitoring";
}

std::string metrics_of(const Receiver& r, const cli::FleetMap& map = {},
                       const cli::FleetServices& services = {}) {
    return cli::metrics_text(r.fleet, r.fleet.robots(r.now()), map, services);
}

/// Checks metrics with promtool. Returns the reported problems.
std::string findings_in(const std::string& metrics) {
    const TemporaryDirectory directory;
    std::ofstream(directory.path() / "metrics") << metrics;
    const ShellOutcome outcome =
        run_shell("promtool check metrics < " + (directory.path() / "metrics").string() + " 2>&1");
    return outcome.exit_code == 0 ? outcome.output : "failed: " + outcome.output;
}

/// Returns all words that begin with "dotpose_".
std::set<std::string> metric_names(const std::string& text) {
    constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyz_";
    std::set<std::string> names;
    for (std::size_t at = 0; (at = text.find("dotpose_", at)) != std::string::npos;) {
        const std::size_t end = std::min(text.find_first_not_of(kLetters, at), text.size());
        names.insert(text.substr(at, end - at));
        at = end;
    }
    return names;
}

/// Returns the metrics of a fleet, with at least one sample of every metric.
std::string complete_metrics() {
    Receiver r;
    nlohmann::json camera = {{"rate", 30}, {"frames", 30}, {"refused", {{"no_grid", 1}}}};
    r.receive({.robot = "anna", .camera = camera});
    return metrics_of(r, {}, {true, cli::Delivery::all, store::QueueStatus{}});
}

TEST(FleetMetrics, CountRobotsMessagesAndLatencies) {
    Receiver r;
    r.receive({.robot = "anna"}, 900);
    r.pass(0.1);
    r.receive({.robot = "anna", .map = "other"}, 7000);
    r.receive({.robot = "bert", .state = "lost", .is_localized = false}, -5000);  // clock ahead
    r.fleet.take("uagv/v2/dotpose/carl/visualization", "{}", r.now());
    r.pass(2.5);
    cli::FleetMap map;
    map.id = "table";
    const std::string text =
        metrics_of(r, map, {true, cli::Delivery::all, store::QueueStatus{7, 5, 3, true}});
    for (const char* line : {
             "dotpose_fleet_robots{state=\"moving\"} 1\n",
             "dotpose_fleet_robots{state=\"lost\"} 1\n",
             "dotpose_fleet_robots{state=\"silent\"} 0\n",
             "dotpose_fleet_robots_on_unknown_sheets 1\n",
             "dotpose_fleet_states_total 3\n",
             "dotpose_fleet_bad_messages_total 1\n",
             "dotpose_fleet_latency_seconds_bucket{le=\"0.001\"} 2\n",
             "dotpose_fleet_latency_seconds_bucket{le=\"0.005\"} 2\n",
             "dotpose_fleet_latency_seconds_bucket{le=\"0.01\"} 3\n",
             "dotpose_fleet_latency_seconds_bucket{le=\"+Inf\"} 3\n",
             "dotpose_fleet_latency_seconds_count 3\n",
             "dotpose_fleet_broker_connected 1\n",
             "dotpose_fleet_store_connected 0\n",
             "dotpose_fleet_store_waiting_states 5\n",
             "dotpose_fleet_store_dropped_states_total 3\n",
             "dotpose_fleet_stored_states_total 7\n",
             "dotpose_robot_state{robot=\"anna\",state=\"moving\"} 1\n",
             "dotpose_robot_state{robot=\"bert\",state=\"lost\"} 1\n",
         }) {
        EXPECT_THAT(text, HasSubstr(std::string("\n") + line));
    }
    EXPECT_THAT(text, testing::ContainsRegex("_latency_seconds_sum 0.007[0-9]*\n"));
    EXPECT_EQ(findings_in(text), "");
    EXPECT_THAT(metrics_of(r), testing::Not(HasSubstr("_store_")));
    EXPECT_THAT(metrics_of(r, {}, {true, cli::Delivery::shared, {}}),
                testing::Not(HasSubstr("missed")));
}

TEST(FleetMetrics, CountFramesSinceTheFirstReportOfARobot) {
    Receiver r;
    const auto report = [&](int frames, int refused) {
        nlohmann::json camera = {
            {"rate", 29.5}, {"frames", frames}, {"refused", {{"no_grid", refused}}}};
        r.receive({.robot = "anna", .camera = camera});
        r.pass(1);
    };
    report(1'000'000, 500);  // the robot started before the fleet
    report(1'000'030, 510);
    report(30, 1);  // the robot was restarted
    report(60, 3);
    const std::string text = metrics_of(r);
    EXPECT_THAT(text, HasSubstr("\ndotpose_fleet_frames_total 60\n"));
    EXPECT_THAT(text, HasSubstr("\ndotpose_fleet_refused_frames_total{reason=\"no_grid\"} 12\n"));
    EXPECT_THAT(text, HasSubstr("\ndotpose_robot_camera_frames_per_second{robot=\"anna\"} 29.5\n"));
    EXPECT_EQ(findings_in(text), "");
}

TEST(FleetMetrics, NamesAreEscaped) {
    Receiver r;
    for (const char* name : {"a\"} 1\nup 0", "back\\slash", "\x1b[2J", "{}", "#", "\xE2\x80\xAE"})
        r.receive({.robot = name});
    const std::string text = metrics_of(r);
    EXPECT_EQ(findings_in(text), "");
    EXPECT_THAT(text, HasSubstr("{robot=\"a\\\"} 1\xEF\xBF\xBDup 0\","));
    EXPECT_THAT(text, HasSubstr("{robot=\"back\\\\slash\","));
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(FleetMetrics, RulesAndDashboardUseOnlyMetricsThatExist) {
    const std::string metrics = complete_metrics();
    for (const char* file : {"alerts.yml", "grafana-dashboard.json"}) {
        const auto used = metric_names(read_file(monitoring() / file));
        EXPECT_GT(used.size(), 7U) << file;
        for (const std::string& name : used) {
            EXPECT_TRUE(metrics.find('\n' + name + '{') != std::string::npos ||
                        metrics.find('\n' + name + ' ') != std::string::npos)
                << file << " uses " << name;
        }
    }
    const auto dashboard =
        nlohmann::json::parse(read_file(monitoring() / "grafana-dashboard.json"));
    std::set<int> ids;
    for (const auto& panel : dashboard["panels"]) {
        EXPECT_TRUE(ids.insert(panel["id"].get<int>()).second);
        for (const auto& target : panel["targets"]) {
            EXPECT_THAT(target["expr"].get<std::string>(), HasSubstr("dotpose_"));
        }
    }
}

TEST(FleetMetrics, RulesAlert) {
    const ShellOutcome outcome = run_shell("cd '" + monitoring().string() +
                                           "' && promtool check rules alerts.yml && promtool test "
                                           "rules alerts_test.yml 2>&1");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("SUCCESS: 10 rules found"));
}

using FleetMetricsFile = Mqtt;

TEST_F(FleetMetricsFile, ContainsTheCameraOfAWatchedRobot) {
    const Broker broker(directory_);
    const DriveCamera camera(188, 120);
    const Drive drive;
    // The robot processes 10 frames per second and reports after 1, 2 and 3 s. The fleet counts
    // frames from the first report. From the first to the last report, the robot processes 20
    // frames, and 5 of them are blank.
    for (int i = 0; i < 35; ++i) {
        GreyImage image = camera.frame(drive, 240 + i);
        if (i >= 14 && i < 19) std::ranges::fill(image.pixels, std::uint8_t{200});
        write_pgm(directory_ / fmt::format("f{}.pgm", 100 + i), image.view());
    }
    save_drive_sheets(directory_ / "table.json");
    WatchedFleet fleet(directory_, "--metrics fleet.prom --mqtt " + broker.url());
    EXPECT_EQ(
        run("watch 'f*.pgm' --fps 10 --sheets table.json --robot anna --mqtt " + broker.url()), 0);
    wait_until([&] {
        return file("fleet.prom").find("dotpose_fleet_states_total 35\n") != std::string::npos;
    });
    const std::string text = file("fleet.prom");
    EXPECT_EQ(findings_in(text), "");
    EXPECT_THAT(text, HasSubstr("\ndotpose_fleet_frames_total 20\n"));
    EXPECT_THAT(text,
                HasSubstr("\ndotpose_fleet_refused_frames_total{reason=\"no_contrast\"} 5\n"));
    EXPECT_THAT(text, HasSubstr("\ndotpose_robot_camera_frames_per_second{robot=\"anna\"} 10\n"));
    EXPECT_THAT(text, HasSubstr("\ndotpose_fleet_broker_connected 1\n"));
    fleet.table();
    EXPECT_THAT(file("fleet.prom"), HasSubstr("\ndotpose_fleet_broker_connected 0\n"));
    EXPECT_EQ(run("fleet --metrics none/fleet.prom --mqtt " + broker.url()), 1);
}

}  // namespace
}  // namespace dotpose::test
