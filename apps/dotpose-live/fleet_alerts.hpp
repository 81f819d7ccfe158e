/// Detects changes in robot conditions, and returns an alert for each important change.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fleet_report.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

class AlertWatch {
  public:
    /// Returns an alert for each important change since the previous call: a robot has been lost
    /// for a second, is now silent or gone, has recovered, or was removed. A new robot causes an
    /// alert only if it is silent or has been lost for a second. The caller must fill in the times
    /// and sequence numbers of the alerts.
    std::vector<RobotAlert> changes(const FleetRobots& robots, const Now& now);

  private:
    std::map<std::string, Condition, std::less<>> known_;
};

}  // namespace dotpose::cli
