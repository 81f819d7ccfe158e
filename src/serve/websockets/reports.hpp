// Reports refused clients to the user, and summarises repeated refusals.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace dotpose::serve {

class Reports {
  public:
    using Clock = std::chrono::steady_clock;

    explicit Reports(std::function<void(const std::string&)> notify) : notify_(std::move(notify)) {}

    /// Reports a refusal. The first refusal for each reason is reported immediately. For 10 s after
    /// each report, further refusals for the same reason are only counted. The next report for this
    /// reason includes their number. `reason` must be one of a small set of constants.
    void refuse(const std::string& peer, const std::string& reason, Clock::time_point now);

  private:
    struct Count {
        std::int64_t unreported = 0;
        Clock::time_point next;
    };

    std::function<void(const std::string&)> notify_;
    std::map<std::string, Count> counts_;
};

}  // namespace dotpose::serve
