// Fuzzes a fleet with arbitrary broker messages, one per line, with a tab between topic and
// payload. The fleet must accept each message or count it as bad, and its table, metrics and map
// must remain printable.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fleet_metrics.hpp"
#include "fleet_report.hpp"
#include "fleet_state.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    constexpr std::int64_t kNow_us = 1'795'000'000'000'000;
    std::istringstream stream({reinterpret_cast<const char*>(data), size});
    cli::FleetState fleet;
    std::int64_t taken = 0;
    for (std::string line; std::getline(stream, line); ++taken) {
        const std::size_t tab = std::min(line.find('\t'), line.size());
        const std::string topic =
            tab == 0 ? cli::topic_of("anna", cli::Subject::visualization) : line.substr(0, tab);
        fleet.take(topic, line.substr(std::min(tab + 1, line.size())), {kNow_us + taken, taken});
    }
    if (fleet.counts().messages + fleet.bad() > taken) std::abort();
    fleet.latency();
    const cli::Now now{kNow_us + taken, taken};
    const cli::FleetMap map;
    const cli::FleetRobots robots = fleet.robots(now);
    const std::string texts = cli::table_of(fleet, map, cli::Delivery::all, now) +
                              cli::metrics_text(fleet, robots, map, {true, {}, {}});
    for (const char c : texts) {
        if (static_cast<unsigned char>(c) < ' ' && c != '\n') std::abort();
    }
    for (const auto& [name, robot] : robots)
        cli::drawing_of(fleet, robot.newest.map_id, map, now);
    return 0;
}
