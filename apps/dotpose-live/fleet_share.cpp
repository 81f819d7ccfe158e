#include "fleet_share.hpp"

#include "common.hpp"
#include "state_message.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

std::uint64_t hash_of(std::string_view text) {
    // The 64-bit FNV-1a hash. Its lowest bits alone would distribute similar names unevenly over
    // the instances, so the upper half is combined with the lower half.
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char byte : text)
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    return hash ^ (hash >> 32);
}

std::string check_group(const std::string& name) {
    const bool is_bad =
        name.empty() || name.find_first_of("/+#") != std::string::npos || printable(name) != name;
    return is_bad ? "the name of a group must not be empty, must not contain / + #, and must be "
                    "printable"
                  : std::string();
}

void parse_shard(const std::string& text, Shard& shard) {
    constexpr std::uint32_t kMax = 1'000'000;
    const auto numbers = whole_numbers(text, "/", kMax);
    if (!numbers || (*numbers)[0] < 1 || (*numbers)[0] > (*numbers)[1]) {
        throw ValidationError("--shard", "'" + text + "' is not I/N with I from 1 to N");
    }
    shard = {(*numbers)[0], (*numbers)[1]};
}

}  // namespace

bool Shard::has(std::string_view robot) const {
    return count == 1 || hash_of(robot) % count == index - 1;
}

void ShareArguments::add_to(Command& command) {
    auto* const share = command
                            .add_option("--share", group_,
                                        "Share the states with the other fleets of this group: "
                                        "each state is sent to one fleet")
                            ->type_name("GROUP")
                            ->check(check_group);
    command
        .add_option_function<std::string>(
            "--shard", [this](const std::string& text) { parse_shard(text, shard_); },
            "Take only part I of N of the robots, divided by their names")
        ->type_name("I/N")
        ->excludes(share);
}

std::vector<std::string> ShareArguments::topics() const {
    const std::string states = topic_of("+", Subject::visualization);
    return {is_shared() ? "$share/" + group_ + '/' + states : states,
            topic_of("+", Subject::connection)};
}

}  // namespace dotpose::cli
