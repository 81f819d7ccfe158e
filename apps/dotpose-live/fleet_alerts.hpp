/// Detects the changes of robots that operators are alerted to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fleet_report.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

class AlertWatch {
  public:
    /// Returns an alert for each robot that, since the previous call, was lost for a second, became
    /// silent or gone, is fine again, or was removed. A new robot causes an alert only if it is
    /// lost or silent. Times and numbers of the alerts are not set.
    std::vector<RobotAlert> changes(const FleetRobots& robots, const Now& now);

  private:
    std::map<std::string, Condition, std::less<>> known_;
};

}  // namespace dotpose::cli
