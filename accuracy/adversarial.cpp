// How often is `locate` deceived?
//
//   dotpose_adversarial [--frames N] [--class NAME] [--seed S] [--threads N]
//
// N frames, evenly over the classes of tests/adversarial_frames.hpp, or all of one class. Exits 1
// if any fix is wrong.
// Ctrl-C prints the table of the frames seen so far. The times are wall time on one thread.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "../tests/adversarial_frames.hpp"
#include "counting.hpp"
#include "dotpose/locate.hpp"

namespace {

using namespace dotpose;
using test::Adversary;
using test::Verdict;

constexpr std::array<std::string_view, 5> kVerdicts{"refused", "right", "second", "twin", "wrong"};
using Counts = std::array<std::uint64_t, kVerdicts.size()>;
constexpr std::size_t kClasses = test::kAdversaries.size();

using Clock = std::chrono::steady_clock;

/// What became of the frames of one class, and the time that went into them.
struct ClassTally {
    Counts verdicts{};
    std::chrono::duration<double> rendering{};
    std::chrono::duration<double> locating{};

    ClassTally& operator+=(const ClassTally& other) {
        for (std::size_t v = 0; v < verdicts.size(); ++v)
            verdicts[v] += other.verdicts[v];
        rendering += other.rendering;
        locating += other.locating;
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

void try_frame(Adversary adversary, std::uint64_t seed, std::uint64_t index, Workspace& workspace,
               Tally& tally) {
    const auto start = Clock::now();
    const test::AdversarialFrame frame = test::make_adversarial(adversary, seed, index);
    const auto rendered = Clock::now();
    const Fix fix = locate(frame.image.view(), frame.options, workspace);
    const auto located = Clock::now();
    const Verdict verdict = test::judge(fix, frame);
    ClassTally& mine = tally.classes[static_cast<std::size_t>(adversary)];
    ++mine.verdicts[static_cast<std::size_t>(verdict)];
    mine.rendering += rendered - start;
    mine.locating += located - rendered;
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
        for (const auto time : {counted.rendering, counted.locating}) {
            fmt::print(" {:>9.2f}",
                       frames == 0 ? 0 : 1e3 * time.count() / static_cast<double>(frames));
        }
        fmt::print("\n");
    };
    fmt::print("{:<16} {:>9}", "", "frames");
    for (const std::string_view verdict : kVerdicts)
        fmt::print(" {:>9}", verdict);
    fmt::print(" {:>9} {:>9}\n", "render ms", "locate ms");
    ClassTally all;
    for (std::size_t c = 0; c < kClasses; ++c) {
        if (tally.classes[c].frames() == 0) continue;
        line(name(test::kAdversaries[c]), tally.classes[c]);
        all += tally.classes[c];
    }
    line("all", all);
}

int run(const Counting& counting, std::uint64_t frames, std::span<const Adversary> adversaries) {
    Count<Tally> count = count_on_threads<Tally>(
        "adversarial frames", frames, counting.threads, [&](std::uint64_t i, Tally& mine) {
            thread_local const auto kWorkspace = std::make_unique<LargeWorkspace>();
            try_frame(adversaries[i % adversaries.size()], counting.seed, i / adversaries.size(),
                      *kWorkspace, mine);
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
    CLI::App app("How often is `locate` deceived? Status 1 if any fix is wrong.",
                 "dotpose_adversarial");
    add_count(app, "--frames", frames, "How many, evenly over the classes");
    std::map<std::string, Adversary> by_name;
    for (const Adversary adversary : test::kAdversaries)
        by_name.emplace(name(adversary), adversary);
    std::vector<Adversary> adversaries(test::kAdversaries.begin(), test::kAdversaries.end());
    app.add_option("--class", adversaries, "Only frames of this class, given once or more")
        ->transform(CLI::CheckedTransformer(by_name));
    counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(counting, frames, adversaries); });
}
