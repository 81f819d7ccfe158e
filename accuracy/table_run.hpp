/// Runs one table of dotpose_tables: parses the command line, distributes the work over all cores,
/// and prints the results.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "../apps/dotpose/command_line.hpp"
#include "../apps/dotpose/progress.hpp"
#include "document.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/evaluate.hpp"
#include "dotpose/tools/score.hpp"

namespace dotpose::tables {

/// Number of completed items and elapsed time.
struct Done {
    std::uint64_t wanted = 0;  ///< number of items
    std::uint64_t done = 0;    ///< number of completed items, less than `wanted` if interrupted
    double seconds = 0;

    bool is_complete() const { return done == wanted; }
    /// Returns text such as "12000 frames in 60 s, 200 frames/s", with a note if the run was
    /// interrupted.
    std::string speed_text(const std::string& items) const;
};

/// The result of a measurement: the sum of the tallies that the threads produced.
template <typename Tally>
struct Count : Done {
    Tally tally;
};

/// A run that produces one table. The function that implements the table adds its options to
/// `command`, calls `parse`, performs the measurements, and prints the results.
class TableRun {
  public:
    /// `what` is the first line of the help. `argv[0]` is ignored.
    TableRun(const std::string& name, const std::string& what, int argc, const char* const* argv)
        : command(what, name), argc_(argc), argv_(argv) {}

    cli::Command command;
    std::uint64_t seed = 1;
    unsigned threads = std::max(std::thread::hardware_concurrency(), 1u);

    /// Adds an option whose value is a number of items in the range [0, 2e9].
    void add_count(const std::string& flag, std::uint64_t& count, const std::string& what);
    void add_seed();
    void add_threads();
    /// Adds the --update option: the path of the document in which `update_document` replaces the
    /// generated blocks.
    void add_update();
    /// Parses the command line. Returns false if the help was requested and has been printed.
    /// Throws cli::UsageError, or Error if the document cannot be read.
    bool parse();

    /// Runs `work(i, tally)` for i from 0 to count - 1, with one Tally per thread, and adds up the
    /// tallies with +=. The result does not depend on the number of threads. `what` is the label of
    /// the progress line. Ctrl-C ends the run early.
    template <typename Tally, typename Work>
    Count<Tally> count(const std::string& what, std::uint64_t count, Work work) const {
        std::vector<Tally> tallies(threads);
        Count<Tally> result{
            on_threads(what, count, [&](std::uint64_t i, unsigned k) { work(i, tallies[k]); }), {}};
        for (const Tally& tally : tallies)
            result.tally += tally;
        return result;
    }

    /// Returns outcomes[k][i], the outcome of frame i with options[k]. `what` is the label of the
    /// progress line. Throws Error if interrupted.
    std::vector<std::vector<Outcome>> evaluate(const std::string& what, FrameRun frames) const;

    /// Prints a generated block for the document, and stores it for `update_document`.
    void print_block(const std::string& name, const std::string& text);
    const Blocks& blocks() const { return blocks_; }
    /// If a document was named, replaces its generated blocks with the printed blocks. After an
    /// interruption, leaves the document unchanged, because the printed blocks may be incomplete.
    void update_document() const;
    const std::string& document() const { return document_; }

  private:
    /// Runs `work(i, thread)` for i from 0 to count - 1, distributed over all threads.
    Done on_threads(const std::string& what, std::uint64_t count,
                    const std::function<void(std::uint64_t, unsigned)>& work) const;

    int argc_;
    const char* const* argv_;
    std::string document_;  ///< path of the document, or empty if none was named
    Blocks blocks_;
};

/// Returns a callback that shows the progress on `line` and stops the run after Ctrl-C.
Progress shown_on(cli::ProgressLine& line);

/// Returns the memory for the locators of the calling thread.
LargeMemory& thread_memory();

/// Returns the frame and the true pose of a shot. The code variant of the frame is not set.
KnownFrame known_frame(const Shot& shot);

/// Returns a setup with the `nominal` preset and the given image size.
Setup setup_of(std::uint64_t seed, int width_px, int height_px);

}  // namespace dotpose::tables
