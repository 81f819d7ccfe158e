#include "dotpose/files/profile_names.hpp"

namespace dotpose {

const char* name(Profile profile) {
    switch (profile) {
        case Profile::anoto:
            return "anoto";
        case Profile::libdots:
            return "libdots";
        case Profile::microdots:
            return "microdots";
    }
    return "";
}

std::optional<Profile> profile_by_name(std::string_view asked) {
    for (const Profile profile : {Profile::anoto, Profile::libdots, Profile::microdots}) {
        if (asked == name(profile)) return profile;
    }
    return std::nullopt;
}

}  // namespace dotpose
