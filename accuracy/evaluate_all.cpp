#include "evaluate_all.hpp"

namespace dotpose {

std::vector<std::vector<Outcome>> evaluate_all(const std::string& what, FrameRun run,
                                               const Counting& counting) {
    cli::ProgressLine progress(what);
    run.threads = static_cast<int>(counting.threads);
    run.progress = [&progress](int done, int total) {
        progress.update(done, total);
        return !cli::interrupted();
    };
    return evaluate(run);
}

}  // namespace dotpose
