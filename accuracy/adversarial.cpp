// How often is `locate` deceived?
//
//   dotpose_adversarial [--frames N] [--seed S] [--threads N]
//
// N frames, evenly over the classes of tests/adversarial_frames.hpp. Exits 1 if any fix is wrong.
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string_view>

#include <fmt/core.h>

#include "../tests/adversarial_frames.hpp"
#include "dotpose/locate.hpp"
#include "workers.hpp"

namespace {

using namespace dotpose;
using test::Adversary;
using test::Verdict;

struct Arguments {
    std::uint64_t frames = 18'000;
    std::uint64_t seed = 1;
    unsigned threads = std::max(std::thread::hardware_concurrency(), 1u);
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; i += 2) {
        const std::string_view name = argv[i];
        const auto value = i + 1 < argc ? std::strtoull(argv[i + 1], nullptr, 10) : 0;
        if (name == "--frames" && value > 0) {
            arguments.frames = value;
        } else if (name == "--seed" && value > 0) {
            arguments.seed = value;
        } else if (name == "--threads" && value > 0) {
            arguments.threads = static_cast<unsigned>(value);
        } else {
            throw BadArgument("usage: dotpose_adversarial [--frames N] [--seed S] [--threads N]");
        }
    }
    return arguments;
}

constexpr std::array<std::string_view, 5> kVerdicts{"refused", "right", "second", "twin", "wrong"};
using Counts = std::array<std::uint64_t, kVerdicts.size()>;
constexpr std::size_t kClasses = test::kAdversaries.size();

struct Tally {
    std::array<Counts, kClasses> counts{};

    Tally& operator+=(const Tally& other) {
        for (std::size_t c = 0; c < kClasses; ++c)
            add(counts[c], other.counts[c]);
        return *this;
    }
    static void add(Counts& sum, const Counts& counts) {
        for (std::size_t v = 0; v < sum.size(); ++v)
            sum[v] += counts[v];
    }
};

void try_frame(std::uint64_t seed, std::uint64_t frame_index, Workspace& workspace, Tally& tally) {
    const std::size_t n = frame_index % kClasses;
    const std::uint64_t index = frame_index / kClasses;
    const test::AdversarialFrame frame = test::make_adversarial(test::kAdversaries[n], seed, index);
    const Fix fix = locate(frame.image.view(), frame.options, workspace);
    const Verdict verdict = test::judge(fix, frame);
    ++tally.counts[n][static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::wrong) {
        fmt::print(
            "wrong: {}, seed {}, index {}: cell {}, {}, theta {:.3f}, section {}, {}, 2^{}, "
            "{} bit errors\n",
            name(test::kAdversaries[n]), seed, index, fix.cell.x, fix.cell.y, fix.theta_rad(),
            fix.section.u, fix.section.v, fix.p_wrong_log2, fix.bit_errors);
    }
}

/// Returns how many are wrong.
std::uint64_t print(const Tally& tally) {
    const auto line = [](std::string_view title, const Counts& counts) {
        fmt::print("{:<16} {:>9}", title, std::accumulate(counts.begin(), counts.end(), 0ULL));
        for (const std::uint64_t n : counts)
            fmt::print(" {:>9}", n);
        fmt::print("\n");
    };
    fmt::print("{:<16} {:>9}", "", "frames");
    for (const std::string_view verdict : kVerdicts)
        fmt::print(" {:>9}", verdict);
    fmt::print("\n");
    Counts all{};
    for (std::size_t c = 0; c < kClasses; ++c) {
        line(name(test::kAdversaries[c]), tally.counts[c]);
        Tally::add(all, tally.counts[c]);
    }
    line("all", all);
    return all[static_cast<std::size_t>(Verdict::wrong)];
}

int run(const Arguments& arguments) {
    const auto start = std::chrono::steady_clock::now();
    const Tally tally = run_on_threads<Tally>(
        arguments.frames, arguments.threads, [&](std::uint64_t i, Tally& mine) {
            thread_local const auto kWorkspace = std::make_unique<LargeWorkspace>();
            try_frame(arguments.seed, i, *kWorkspace, mine);
        });
    const std::uint64_t wrong = print(tally);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("seed {}, {:.0f} s with {} threads, {:.0f} frames/s\n", arguments.seed,
               seconds.count(), arguments.threads,
               static_cast<double>(arguments.frames) / seconds.count());
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(parse(argc, argv));
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_adversarial: {}\n", error.what());
        return 2;
    }
}
