#include "serve/websockets/reports.hpp"

#include <utility>

#include <fmt/core.h>

namespace dotpose::serve {

void Reports::refuse(const std::string& peer, const std::string& reason, Clock::time_point now) {
    constexpr std::chrono::seconds kInterval(10);
    Count& count = counts_[reason];
    ++count.unreported;
    if (now < count.next) return;
    count.next = now + kInterval;
    const std::int64_t times = std::exchange(count.unreported, 0);
    notify_(times == 1 ? fmt::format("web: refused {}: {}", peer, reason)
                       : fmt::format("web: refused {} requests, the last from {}: {}", times, peer,
                                     reason));
}

}  // namespace dotpose::serve
