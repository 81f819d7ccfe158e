#include "counting.hpp"

#include <cstdlib>
#include <exception>

#include <fmt/core.h>

namespace dotpose {

void Counting::add_to(cli::Command& app) {
    app.add_option("--seed", seed, "Another seed gives other frames")->capture_default_str();
    app.add_option("--threads", threads, "Default: one for each processor")
        ->check(cli::Range(1, 1024));
}

void add_count(cli::Command& app, const std::string& flag, std::uint64_t& count,
               const std::string& what) {
    constexpr std::uint64_t kMost = 2'000'000'000;
    app.add_option(flag, count, what)
        ->check(cli::Range(std::uint64_t{0}, kMost))
        ->capture_default_str();
}

int run_program(cli::Command& app, int argc, char** argv, const std::function<int()>& run) {
    try {
        if (!app.parse(argc, argv)) return EXIT_SUCCESS;
    } catch (const cli::UsageError& error) {
        fmt::print(stderr, "{}\nRun with --help for more information.\n", error.what());
        constexpr int kWrongUsage = 2;
        return kWrongUsage;
    }
    try {
        cli::catch_interrupts();
        return run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
        return EXIT_FAILURE;
    }
}

std::string speed_line(const std::string& what, std::uint64_t asked, std::uint64_t done,
                       double seconds) {
    const double speed = seconds > 0 ? static_cast<double>(done) / seconds : 0;
    return fmt::format("{} {} in {:.0f} s, {:.0f} {}/s{}", done, what, seconds, speed, what,
                       done < asked ? fmt::format(" (interrupted; {} were asked for)", asked) : "");
}

}  // namespace dotpose
