// Locates many frames with known poses on all processor cores.
#include "dotpose/tools/evaluate.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "dotpose/code_evidence.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/frame_file.hpp"
#include "system/path.hpp"

namespace dotpose {
namespace {

using Outcomes = std::vector<std::vector<Outcome>>;

/// Locates frames in several threads. Whenever a thread is free, it takes the next frame.
class Crew {
  public:
    Crew(const FrameRun& run, Outcomes& outcomes)
        : run_(run), outcomes_(outcomes), errors_(static_cast<std::size_t>(run.frames)) {}

    void work(bool reports) {
        Locator locator{DeviceOptions{}};
        for (int index = next_++; index < run_.frames && !stopped_; index = next_++) {
            try {
                locate_frame(index, locator);
            } catch (...) {
                errors_[static_cast<std::size_t>(index)] = std::current_exception();
                stopped_ = true;
            }
            ++done_;
            if (reports && run_.progress && !run_.progress(done_, run_.frames)) {
                given_up_ = true;
                stopped_ = true;
            }
        }
    }

    void rethrow() const {
        for (const std::exception_ptr& error : errors_) {
            if (error) std::rethrow_exception(error);
        }
        if (given_up_) throw Error("interrupted");
    }

  private:
    void locate_frame(int index, Locator& locator) {
        const KnownFrame frame = run_.frame_at(index);
        for (std::size_t k = 0; k < run_.options.size(); ++k) {
            Outcome& outcome = outcomes_[k][static_cast<std::size_t>(index)];
            outcome.truth = frame.truth;
            outcome.problem = frame.problem;
            if (!frame.problem.empty()) continue;
            DeviceOptions options = run_.options[k];
            options.code = frame.code.value_or(options.code);
            locator.set_options(options);
            const auto start = std::chrono::steady_clock::now();
            if (run_.any_code && !frame.code) {
                CodeReader reader;
                outcome.fix = reader.locate(frame.image.view(), locator);
            } else {
                outcome.fix = locator.locate(frame.image.view());
            }
            const std::chrono::duration<double, std::micro> elapsed =
                std::chrono::steady_clock::now() - start;
            outcome.elapsed_us = elapsed.count();
            if (run_.refine) outcome.fix = run_.refine(outcome.fix, locator.trace());
        }
    }

    const FrameRun& run_;
    Outcomes& outcomes_;
    std::vector<std::exception_ptr> errors_;
    std::atomic<int> next_ = 0;
    std::atomic<int> done_ = 0;
    std::atomic<bool> stopped_ = false;
    bool given_up_ = false;
};

}  // namespace

std::vector<std::vector<Outcome>> evaluate(const FrameRun& run) {
    if (run.frames < 0 || !run.frame_at) throw BadArgument("there are no frames to evaluate");
    Outcomes outcomes(run.options.size(),
                      std::vector<Outcome>(static_cast<std::size_t>(run.frames)));
    Crew crew(run, outcomes);
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    // Uses at most one thread per frame. With more threads, the main thread might get no frame and
    // would then report no progress.
    const int threads = std::min(run.threads > 0 ? run.threads : cores, run.frames);
    {
        std::vector<std::jthread> others;
        for (int i = 1; i < threads; ++i)
            others.emplace_back([&crew] { crew.work(false); });
        crew.work(true);
    }
    crew.rethrow();
    return outcomes;
}

FrameSource frames_of_folder(const std::filesystem::path& folder, std::vector<TruthRow> rows) {
    return [folder, rows = std::move(rows)](int index) {
        const TruthRow& row = rows.at(static_cast<std::size_t>(index));
        KnownFrame frame;
        frame.truth = row.truth;
        frame.code = row.code;
        try {
            frame.image = read_frame(folder / system::path_of(row.file));
        } catch (const Error& error) {
            frame.problem = error.what();
        }
        return frame;
    };
}

FrameSource frames_of_setup(const Setup& setup) {
    return [setup](int index) {
        const Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
        return KnownFrame{render(shot), truth_of(shot), setup.pattern.code, {}};
    };
}

}  // namespace dotpose
