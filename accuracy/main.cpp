// Reruns every number of docs/accuracy.md. Run by `make accuracy`.
//
//   dotpose_accuracy [--quick] [--update docs/accuracy.md] [FOLDER]
//
// Writes tables.md, sweep-*.{csv,svg,png}, table-3.md and figure-*.{svg,png} to FOLDER
// (accuracy-out).
// --update also replaces the generated parts of the document and the pictures beside it.
// --quick takes a tenth of the frames, to test the program; its numbers are not exact.
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <unistd.h>

#include <dotpose/tools/evaluate.hpp>
#include <dotpose/tools/protocol.hpp>
#include <dotpose/tools/score.hpp>
#include <dotpose/tools/sweep.hpp>

#include "../reports/document.hpp"

namespace {

namespace fs = std::filesystem;
using namespace dotpose;

/// A seed that no test and no tuning uses.
constexpr std::uint64_t kSeed = 404;

struct Arguments {
    fs::path out = "accuracy-out";
    fs::path document;
    bool is_quick = false;
    int share(int frames) const { return is_quick ? frames / 10 : frames; }
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--quick") {
            arguments.is_quick = true;
        } else if (argument == "--update" && i + 1 < argc) {
            arguments.document = argv[++i];
        } else if (argument.starts_with('-')) {
            throw BadArgument("usage: dotpose_accuracy [--quick] [--update DOCUMENT] [FOLDER]");
        } else {
            arguments.out = argument;
        }
    }
    return arguments;
}

/// Prints a step of the program and its time. On a terminal, it shows the progress as well.
class Step {
  public:
    explicit Step(std::string what)
        : what_(std::move(what)), start_(std::chrono::steady_clock::now()) {}
    ~Step() {
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
        fmt::print(stderr, "{}{}: {:.0f} s\n", is_shown_ ? "\r\033[K" : "", what_, time.count());
    }
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

    Progress progress() {
        return [this](int done, int total) {
            const int percent = static_cast<int>(100LL * done / total);
            if (isatty(STDERR_FILENO) != 1 || percent == percent_) return true;
            percent_ = percent;
            is_shown_ = true;
            fmt::print(stderr, "\r\033[K{}: {} %", what_, percent);
            return true;
        };
    }

  private:
    std::string what_;
    std::chrono::steady_clock::time_point start_;
    int percent_ = -1;
    bool is_shown_ = false;
};

/// Options to locate with, as a user may choose them.
struct Way {
    const char* name;
    Decoder decoder;
    Effort effort;
};
constexpr std::array kWays = {
    Way{"all dots (default)", Decoder::all, Effort::twice},
    Way{"all dots, `--effort once`", Decoder::all, Effort::once},
    Way{"all dots, `--effort device`", Decoder::all, Effort::device},
    Way{"8 x 8 window (paper)", Decoder::window, Effort::twice},
    Way{"8 x 8 window, `--effort once`", Decoder::window, Effort::once},
};

struct Condition {
    Preset preset;
    int frames;
};
constexpr std::array kConditions = {Condition{Preset::clean, 2000},
                                    Condition{Preset::nominal, 10000},
                                    Condition{Preset::hard, 4000}};

std::string three(const Quantiles& quantiles, int decimals) {
    return fmt::format("{:.{}f} / {:.{}f} / {:.{}f}", quantiles.median, decimals, quantiles.p95,
                       decimals, quantiles.max, decimals);
}

std::string frame_row(Preset preset, const Way& way, const Score& score) {
    // Devices report no covariance.
    const auto& [x, y, theta] = score.normalised;
    const std::string normalised =
        std::isfinite(x) ? fmt::format("{:.2f} / {:.2f} / {:.2f}", x, y, theta) : "-";
    return fmt::format("| {} | {} | {} | {:.2f} % | {} | {} | {} | {} |\n", name(preset), way.name,
                       score.frames, 100 * score.located_share(), score.wrong,
                       three(score.position_um, 2), three(score.angle_deg, 3), normalised);
}

std::string status_rows(Preset preset, const Score& score) {
    std::string rows;
    for (std::size_t i = 1; i < score.by_status.size(); ++i) {
        if (score.by_status[i] == 0) continue;
        const auto status = static_cast<Status>(i);
        rows += fmt::format("| {} | `{}` | {:.2f} % | {} |\n", name(preset), name(status),
                            100.0 * score.by_status[i] / score.frames, message(status));
    }
    return rows;
}

/// Adds the tables of clean, nominal and hard frames, located in all ways.
void add_frame_tables(const Arguments& arguments, Blocks& blocks) {
    std::string frames =
        "| preset | decoder | frames | located | wrong | position error, µm: median / 95 % / max | "
        "angle error, degrees: median / 95 % / max | error² / variance: x / y / θ |\n"
        "|---|---|--:|--:|--:|--:|--:|--:|\n";
    std::string statuses = "| preset | status | frames | message |\n|---|---|--:|---|\n";
    for (const Condition& condition : kConditions) {
        Step step(fmt::format("preset {}", name(condition.preset)));
        Setup setup;
        setup.preset = condition.preset;
        setup.seed = kSeed;
        FrameRun run;
        run.frames = arguments.share(condition.frames);
        run.frame_at = frames_of_setup(setup);
        run.options.assign(kWays.size(), {});
        for (std::size_t i = 0; i < kWays.size(); ++i) {
            run.options[i].decoder = kWays[i].decoder;
            run.options[i].effort = kWays[i].effort;
        }
        run.progress = step.progress();
        const auto outcomes = evaluate(run);
        for (std::size_t i = 0; i < kWays.size(); ++i)
            frames += frame_row(condition.preset, kWays[i], score_of(outcomes[i]));
        statuses += status_rows(condition.preset, score_of(outcomes.front()));
    }
    blocks.push_back({"frames", frames});
    blocks.push_back({"statuses", statuses});
}

/// Returns the last value up to which at least this share of the frames is located. It starts at
/// the first value, which is the easiest one; for the spacing, it returns the range of values
/// instead.
std::string reach(const Sweep& sweep, Decoder decoder, double share) {
    const auto located = [&](std::size_t i) {
        const SweepPoint& point = sweep.points[i];
        return (decoder == Decoder::window ? point.window : point.all).located_share() >= share;
    };
    std::size_t first = 0;
    while (first < sweep.points.size() && !located(first))
        ++first;
    if (first == sweep.points.size()) return "never";
    std::size_t last = first;
    while (last + 1 < sweep.points.size() && located(last + 1))
        ++last;
    const double to = sweep.points[last].value;
    if (sweep.kind != SweepKind::spacing && first > 0) return "never";
    return sweep.kind == SweepKind::spacing
               ? fmt::format("{:g} to {:g}", sweep.points[first].value, to)
               : fmt::format("{:g}", to);
}

void add_sweeps(const Arguments& arguments, Blocks& blocks) {
    constexpr std::array kUnits = {"grey levels", "px", "% of the dots",
                                   "degrees",     "px", "% of the frame"};
    std::string table =
        "| condition | 99 % located up to: all dots | 8 x 8 window | half located up to: all dots "
        "| 8 x 8 window | unit |\n|---|--:|--:|--:|--:|---|\n";
    for (const SweepKind kind : kSweepKinds) {
        Step step(fmt::format("sweep {}", name(kind)));
        SweepOptions options;
        options.setup.seed = kSeed;
        options.frames_per_value = arguments.share(500);
        options.progress = step.progress();
        const Sweep sweep = run_sweep(kind, options);
        write_sweep(arguments.out, sweep);
        table += fmt::format("| {} | {} | {} | {} | {} | {} |\n", name(kind),
                             reach(sweep, Decoder::all, 0.99), reach(sweep, Decoder::window, 0.99),
                             reach(sweep, Decoder::all, 0.5), reach(sweep, Decoder::window, 0.5),
                             kUnits[static_cast<std::size_t>(kind)]);
    }
    blocks.push_back({"sweeps", table});
}

void add_protocol(const Arguments& arguments, Blocks& blocks) {
    Step step("the paper's protocol");
    ProtocolOptions options;
    options.setup.seed = kSeed;
    options.samples = arguments.is_quick ? 2 : options.samples;
    options.progress = step.progress();
    const Protocol protocol = run_protocol(options);
    write_protocol(arguments.out, protocol);
    blocks.push_back({"table-3", table_3(protocol)});
}

void run(const Arguments& arguments) {
    fs::create_directories(arguments.out);
    // A document that cannot be read is reported before the measurement, not an hour later.
    if (!arguments.document.empty()) read_document(arguments.document);
    Blocks blocks;
    add_frame_tables(arguments, blocks);
    add_protocol(arguments, blocks);
    add_sweeps(arguments, blocks);
    std::ofstream tables(arguments.out / "tables.md");
    for (const Block& block : blocks) {
        fmt::print("{}\n", block.text);
        tables << block.text << '\n';
    }
    tables.close();
    if (!tables) throw Error("cannot write " + (arguments.out / "tables.md").string());
    if (arguments.document.empty()) return;
    update_document(arguments.document, blocks);
    update_pictures(arguments.document, arguments.out);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(parse(argc, argv));
        return 0;
    } catch (const BadArgument& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_accuracy: {}\n", error.what());
        return 1;
    }
}
