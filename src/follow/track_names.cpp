#include "dotpose/tools/track_names.hpp"

namespace dotpose {

std::string state_name(const Track& track) {
    if (track.is_lost) return "lost";
    return track.is_stationary ? "stationary" : "moving";
}

std::string event_names(const TrackEvents& events) {
    std::string names;
    const auto add = [&names](bool happened, const char* name) {
        if (!happened) return;
        if (!names.empty()) names += ' ';
        names += name;
    };
    add(events.fix, "fix");
    add(events.lost, "lost");
    add(events.kidnapped, "kidnapped");
    add(events.stationary, "stationary");
    add(events.moving, "moving");
    return names;
}

}  // namespace dotpose
