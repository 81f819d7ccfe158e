// Counts wrong fixes of `locate` in adversarial frames, which show patterns that resemble the code.
//
//   dotpose_adversarial [--frames N] [--class NAME] [--code given|auto] [--seed S] [--threads N]
//
// The N frames are distributed evenly over the classes of tests/adversarial_frames.hpp, or all are
// of one class. The exit status is 1 if any fix is wrong. Ctrl-C ends the run and prints the table
// of the frames until then. Times are processor times.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "../apps/dotpose/choices.hpp"
#include "../tests/adversarial_frames.hpp"
#include "counting.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/locate.hpp"

namespace {

using namespace dotpose;
using test::Adversary;
using test::Verdict;

constexpr std::array<std::string_view, 5> kVerdicts{"refused", "right", "second", "twin", "wrong"};
using Counts = std::array<std::uint64_t, kVerdicts.size()>;
constexpr std::size_t kClasses = test::kAdversaries.size();

/// Returns the processor time of this thread in seconds.
double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Results and times of the frames of one class.
struct ClassTally {
    Counts verdicts{};
    double rendering_s = 0;
    double locating_s = 0;
    double longest_s = 0;  ///< longest time of one call of `locate`

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

struct Tally {
    std::array<ClassTally, kClasses> classes{};
    std::vector<std::string> wrong;

    Tally& operator+=(const Tally& other) {
        for (std::size_t c = 0; c < kClasses; ++c)
            classes[c] += other.classes[c];
        wrong.insert(wrong.end(), other.wrong.begin(), other.wrong.end());
        return *this;
    }
};

/// Whether the profile is given by the options of the frame or found out by `locate`.
enum class Code : std::uint8_t { given, automatic };

/// Locates a frame. If the profile is found out, it is stored in the options of the frame.
Fix locate(test::AdversarialFrame& frame, Code code, LargeMemory& memory) {
    if (code == Code::given) return Locator(memory, frame.options).locate(frame.image.view());
    const CodeReading reading =
        Locator(memory, frame.options).locate_in_any_code(frame.image.view(), CodeEvidence{});
    frame.options.profile = reading.code;
    return reading.fix;
}

void try_frame(Adversary adversary, Code code, std::uint64_t seed, std::uint64_t index,
               LargeMemory& memory, Tally& tally) {
    const double start_s = thread_seconds();
    test::AdversarialFrame frame = test::make_adversarial(adversary, seed, index);
    const double rendered_s = thread_seconds();
    const Fix fix = locate(frame, code, memory);
    const double locating_s = thread_seconds() - rendered_s;
    const Verdict verdict = test::judge(fix, frame);
    ClassTally& mine = tally.classes[static_cast<std::size_t>(adversary)];
    ++mine.verdicts[static_cast<std::size_t>(verdict)];
    mine.rendering_s += rendered_s - start_s;
    mine.locating_s += locating_s;
    mine.longest_s = std::max(mine.longest_s, locating_s);
    if (verdict == Verdict::wrong) {
        tally.wrong.push_back(fmt::format(
            "wrong: {}, seed {}, index {}: cell {}, {}, theta {:.3f}, section {}, {}, 2^{}, "
            "{} bit errors",
            name(adversary), seed, index, fix.cell.x, fix.cell.y, fix.theta_rad(), fix.section.u,
            fix.section.v, fix.p_wrong_log2, fix.bit_errors));
    }
}

void print(Tally& tally) {
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

int run(const Counting& counting, std::uint64_t frames, Code code,
        std::span<const Adversary> adversaries) {
    Count<Tally> count = count_on_threads<Tally>(
        "adversarial frames", frames, counting.threads, [&](std::uint64_t i, Tally& mine) {
            thread_local const auto kMemory = std::make_unique<LargeMemory>();
            try_frame(adversaries[i % adversaries.size()], code, counting.seed,
                      i / adversaries.size(), *kMemory, mine);
        });
    print(count.tally);
    fmt::print("seed {}, {} threads: {}\n", counting.seed, counting.threads,
               speed_line("frames", count.asked, count.done, count.seconds));
    return count.tally.wrong.empty() && count.done == count.asked ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Counting counting;
    std::uint64_t frames = 18'000;
    cli::Command app("How often is `locate` deceived? Status 1 if any fix is wrong.",
                     "dotpose_adversarial");
    add_count(app, "--frames", frames, "How many, evenly over the classes");
    std::vector<std::string> all;
    for (const Adversary adversary : test::kAdversaries)
        all.emplace_back(name(adversary));
    std::vector<std::string> wanted = all;
    app.add_option("--class", wanted,
                   "Only frames of this class, given once or more: " + cli::alternatives(all))
        ->check(cli::one_of(all));
    std::string code = "given";
    app.add_option("--code", code, "The printed code: given, or found out (auto)")
        ->check(cli::one_of({"given", "auto"}));
    counting.add_to(app);
    return run_program(app, argc, argv, [&] {
        std::vector<Adversary> adversaries;
        for (const std::string& each : wanted) {
            const auto at = std::find(all.begin(), all.end(), each) - all.begin();
            adversaries.push_back(test::kAdversaries[static_cast<std::size_t>(at)]);
        }
        return run(counting, frames, code == "auto" ? Code::automatic : Code::given, adversaries);
    });
}
