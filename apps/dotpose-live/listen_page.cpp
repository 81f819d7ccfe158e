// The web page of `dotpose listen --web`: the fleet page with the device as its only robot.
#include <memory>
#include <string>

#include "fleet_input.hpp"
#include "fleet_view.hpp"
#include "fleet_web.hpp"
#include "reading_sink.hpp"
#include "state_output.hpp"
#include "web_arguments.hpp"

namespace dotpose::cli {
namespace {

class ListenPage : public ReadingSink {
  public:
    ListenPage(const serve::ServerOptions& server, const std::string& robot,
               const std::string& sheets)
        : map_(read_fleet_map(sheets)),
          states_(robot, sheets, 0),
          web_({.server = server,
                .device = robot,
                .now = [this] { return clock_.now(); },
                .services = [] { return FleetServices{}; }},
               fleet_, map_) {}

    /// Passes the state to the fleet as a message, as if it had been received from a broker.
    void take(const Reading& reading) override {
        const auto state = states_.next(reading);
        fleet_.take(topic_of(state->robot, Subject::visualization), json_of(*state), clock_.now());
    }
    void finish() override {}

  private:
    FleetMap map_;
    WatchedClock clock_;
    FleetState fleet_;
    StateSource states_;
    FleetWeb web_;  ///< destroyed first, because its threads use the other members
};

}  // namespace

std::unique_ptr<ReadingSink> open_page(const PageArguments& arguments, const std::string& robot,
                                       const std::string& sheets) {
    const auto server = WebArguments(arguments).options();
    if (!server) return nullptr;
    return std::make_unique<ListenPage>(*server, robot, sheets);
}

}  // namespace dotpose::cli
