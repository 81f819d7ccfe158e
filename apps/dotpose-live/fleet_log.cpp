#include "fleet_log.hpp"

#include <cerrno>
#include <cstdio>
#include <iterator>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "fields.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kHeader =
    "robot,state,map,number,t_s,latency_ms,x_mm,y_mm,theta_deg,deviation_mm,vx_mm_s,vy_mm_s,"
    "turn_deg_s\n";

}  // namespace

FleetLog::FleetLog(const std::string& path) : path_(path), file_(create_file(path)) {
    constexpr std::size_t kBuffer_bytes = 1 << 18;
    std::setvbuf(file_.get(), nullptr, _IOFBF, kBuffer_bytes);
    std::fputs(kHeader, file_.get());
}

void FleetLog::add(std::string_view robot, const RobotState& state, std::int64_t received_us) {
    std::string line = csv_line({{"robot", std::string(robot), true},
                                 {"state", state.state, true},
                                 {"map", state.map_id, true}});
    line.back() = ',';
    const auto out = std::back_inserter(line);
    fmt::format_to(out, "{},{}.{:06},{:.3f}", state.header_id, state.sent_us / 1'000'000,
                   state.sent_us % 1'000'000,
                   static_cast<double>(received_us - state.sent_us) * 1e-3);
    if (state.is_localized) {
        fmt::format_to(out, ",{:.6f},{:.6f},{:.6f},{:.6f},{:.3f},{:.3f},{:.3f}\n",
                       state.x_m * kMm_per_m, state.y_m * kMm_per_m, state.theta_rad * kDegrees,
                       state.deviation_m * kMm_per_m, state.vx_m_s * kMm_per_m,
                       state.vy_m_s * kMm_per_m, state.omega_rad_s * kDegrees);
    } else {
        line += ",,,,,,,\n";
    }
    std::fwrite(line.data(), 1, line.size(), file_.get());
}

void FleetLog::flush() {
    errno = 0;
    if (std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0) return;
    throw_unwritable(path_, errno != 0 ? errno : EIO);
}

}  // namespace dotpose::cli
