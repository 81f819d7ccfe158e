// Counts the wrong fixes that `locate` returns for adversarial frames, whose patterns resemble the
// code.
//
//   dotpose_tables adversarial [--frames N] [--class NAME] [--code given|auto] [--seed S]
//   [--threads N]
//
// Attempts to locate N frames, which are divided equally among the classes in
// tests/adversarial_frames.hpp. With --class, all frames belong to the class NAME. The exit status
// is 1 if any fix is wrong. Ctrl-C ends the run early and prints the results so far. Times are CPU
// times.
#include <algorithm>
#include <array>
#include <ctime>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "../apps/dotpose/choices.hpp"
#include "../tests/adversarial_frames.hpp"
#include "dotpose/code_evidence.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

using test::Adversary;

constexpr std::array<std::string_view, 5> kVerdicts{"refused", "right", "second", "twin", "wrong"};
using Counts = std::array<std::uint64_t, kVerdicts.size()>;
constexpr std::size_t kClasses = test::kAdversaries.size();

/// Returns the CPU time of the calling thread, in seconds.
double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Results and CPU times for the frames of one class.
struct ClassTally {
    Counts verdicts{};
    double rendering_s = 0;
    double locating_s = 0;
    double longest_s = 0;  ///< longest CPU time of a single call to `locate`

    ClassTally& operator+=(const ClassTally& other) {
        for (std::size_t v = 0; v < verdicts.size(); ++v)
            verdicts[v] += other.verdicts[v];
        rendering_s += other.rendering_s;
        locating_s += other.locating_s;
        longest_s = std::max(longest_s, other.longest_s);
        return *this;
    }
    std::uint64_t frames() const {
        return std::accumulate(verdicts.begin(), verdicts.end(), std::uint64_t{0});
    }
};

struct AdversaryTally {
    std::array<ClassTally, kClasses> classes{};
    std::vector<std::string> wrong;

    AdversaryTally& operator+=(const AdversaryTally& other) {
        for (std::size_t c = 0; c < kClasses; ++c)
            classes[c] += other.classes[c];
        wrong.insert(wrong.end(), other.wrong.begin(), other.wrong.end());
        return *this;
    }
};

/// Source of the code variant: the frame's options, or detection by the locator.
enum class Code : std::uint8_t { given, automatic };

/// Locates a frame. If the locator detects the code variant, stores the variant in the frame's
/// options.
Fix locate(test::AdversarialFrame& frame, Code code) {
    if (code == Code::given)
        return Locator(thread_memory(), frame.options).locate(frame.image.view());
    const CodeReading reading = Locator(thread_memory(), frame.options)
                                    .locate_in_any_code(frame.image.view(), CodeEvidence{});
    frame.options.code = reading.code;
    return reading.fix;
}

void try_adversary(Adversary adversary, Code code, std::uint64_t seed, std::uint64_t index,
                   AdversaryTally& tally) {
    const double start_s = thread_seconds();
    test::AdversarialFrame frame = test::make_adversarial(adversary, seed, index);
    const double rendered_s = thread_seconds();
    const Fix fix = locate(frame, code);
    const double locating_s = thread_seconds() - rendered_s;
    const test::Verdict verdict = test::judge(fix, frame);
    ClassTally& mine = tally.classes[static_cast<std::size_t>(adversary)];
    ++mine.verdicts[static_cast<std::size_t>(verdict)];
    mine.rendering_s += rendered_s - start_s;
    mine.locating_s += locating_s;
    mine.longest_s = std::max(mine.longest_s, locating_s);
    if (verdict == test::Verdict::wrong) {
        tally.wrong.push_back(fmt::format(
            "wrong: {}, seed {}, index {}: cell {}, {}, theta {:.3f}, section {}, {}, 2^{}, "
            "{} bit errors",
            name(adversary), seed, index, fix.cell.x, fix.cell.y, fix.theta_rad(), fix.section.u,
            fix.section.v, fix.p_wrong_log2, fix.bit_errors));
    }
}

void print(AdversaryTally& tally) {
    std::sort(tally.wrong.begin(), tally.wrong.end());
    for (const std::string& wrong : tally.wrong)
        fmt::print("{}\n", wrong);
    const auto line = [](std::string_view title, const ClassTally& counted) {
        const std::uint64_t frames = counted.frames();
        fmt::print("{:<16} {:>9}", title, frames);
        for (const std::uint64_t n : counted.verdicts)
            fmt::print(" {:>9}", n);
        for (const double time_s : {counted.rendering_s, counted.locating_s})
            fmt::print(" {:>9.2f}", frames == 0 ? 0 : 1e3 * time_s / static_cast<double>(frames));
        fmt::print(" {:>10.1f}\n", 1e3 * counted.longest_s);
    };
    fmt::print("{:<16} {:>9}", "", "frames");
    for (const std::string_view verdict : kVerdicts)
        fmt::print(" {:>9}", verdict);
    fmt::print(" {:>9} {:>9} {:>10}\n", "render ms", "locate ms", "longest ms");
    ClassTally all;
    for (std::size_t c = 0; c < kClasses; ++c) {
        if (tally.classes[c].frames() == 0) continue;
        line(name(test::kAdversaries[c]), tally.classes[c]);
        all += tally.classes[c];
    }
    line("all", all);
}

}  // namespace

bool adversarial_table(TableRun& run) {
    std::uint64_t frames = 18'000;
    run.add_count("--frames", frames, "Number of frames, divided evenly among the classes");
    std::vector<std::string> all;
    for (const Adversary adversary : test::kAdversaries)
        all.emplace_back(name(adversary));
    std::vector<std::string> wanted = all;
    run.command
        .add_option("--class", wanted,
                    "Only frames of this class, given once or more: " + cli::alternatives(all))
        ->check(cli::one_of(all));
    std::string code = "given";
    run.command.add_option("--code", code, "The printed code: given, or detected (auto)")
        ->check(cli::one_of({"given", "auto"}));
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    std::vector<Adversary> adversaries;
    for (const std::string& each : wanted) {
        const auto at = std::ranges::find(all, each) - all.begin();
        adversaries.push_back(test::kAdversaries[static_cast<std::size_t>(at)]);
    }
    auto count = run.count<AdversaryTally>(
        "adversarial frames", frames, [&](std::uint64_t i, AdversaryTally& tally) {
            try_adversary(adversaries[i % adversaries.size()],
                          code == "auto" ? Code::automatic : Code::given, run.seed,
                          i / adversaries.size(), tally);
        });
    print(count.tally);
    fmt::print("seed {}, {} threads: {}\n", run.seed, run.threads, count.speed_text("frames"));
    return count.tally.wrong.empty() && count.is_complete();
}

}  // namespace dotpose::tables
