// Reports the budget of the firmware from the files that firmware/budget has written to FOLDER.
//
//   dotpose_budget [--update] [--all | --quick] DOCUMENT FOLDER
//
// Prints a line `TARGET PRESET median=N worst=N ram=N code=N` for each run, and tables; `median`
// and `worst` are instructions per frame, `ram` and `code` bytes. With --all, also the table of all
// sizes and cores; with --quick, only the first core. With --update, the tables replace the
// generated parts of the document. Without it, the exit status is 1 if any figure is more than 3 %
// above that of the document.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include <dotpose/files/error.hpp>

#include "budget_run.hpp"
#include "budget_sizes.hpp"
#include "document.hpp"

namespace {

namespace fs = std::filesystem;
using dotpose::Error;

constexpr std::array kTargets = {Target{"cortex-m0plus", 0.7}, Target{"mips32r2", 0.8}};
/// The sets of frames: two presets, and frames of the first preset with predictions.
constexpr std::array kPresets = {"nominal", "hard", "tracked"};

std::string line_of(const Run& run) {
    std::string line = run.name();
    for (const Figure& figure : run.figures())
        line += fmt::format(" {}={}", figure.name, figure.value);
    return line;
}

/// Returns how many of the frames were located, as text. It is the same on all targets.
std::string located(const fs::path& folder) {
    std::string text;
    for (const char* preset : kPresets) {
        std::istringstream lines(read_document(folder / fmt::format("desktop-{}.txt", preset)));
        int frames = 0;
        int found = 0;
        for (std::string line; std::getline(lines, line); ++frames)
            found += line.starts_with("ok ") ? 1 : 0;
        text += fmt::format("- {} of {} `{}` frames\n", found, frames, preset);
    }
    return text;
}

std::string summary(const std::vector<Run>& runs) {
    std::string text = "```\n";
    for (const Run& run : runs)
        text += line_of(run) + '\n';
    return text + "```\n";
}

/// Returns the table of the stages. All `runs` must be those of one target.
std::string stage_table(std::span<const Run> runs) {
    std::string text = "| stage |";
    std::string rule = "|---|";
    for (const Run& run : runs) {
        text += fmt::format(" {0}: median | {0}: worst |", run.preset);
        rule += "--:|--:|";
    }
    text += '\n' + rule + '\n';
    for (std::size_t i = 0; i < runs.front().stages.size(); ++i) {
        text += fmt::format("| `{}` |", runs.front().stages[i].name);
        for (const Run& run : runs) {
            const Cost& cost = run.stages[i].cost;
            text += fmt::format(" {} | {} |", grouped(cost.median), grouped(cost.worst));
        }
        text += '\n';
    }
    text += "| **all** |";
    for (const Run& run : runs)
        text += fmt::format(" {} | {} |", grouped(run.cost.median), grouped(run.cost.worst));
    return text + '\n';
}

std::string stage_tables(const std::vector<Run>& runs) {
    std::string text;
    for (std::size_t i = 0; i < kTargets.size(); ++i) {
        const std::span of_target = std::span(runs).subspan(i * kPresets.size(), kPresets.size());
        text +=
            fmt::format("{}{}:\n\n{}", i > 0 ? "\n" : "", kTargets[i].name, stage_table(of_target));
    }
    return text;
}

std::string rate_table(const std::vector<Run>& runs) {
    constexpr std::array kClocks_MHz = {48, 133, 200};
    std::string text = "| target | frames | instructions per cycle |";
    std::string rule = "|---|---|--:|";
    for (const int clock_MHz : kClocks_MHz) {
        text += fmt::format(" {} MHz |", clock_MHz);
        rule += "--:|";
    }
    text += '\n' + rule + '\n';
    for (const Run& run : runs) {
        const double per_cycle = run.target.instructions_per_cycle;
        text += fmt::format("| {} | {} | {} |", run.target.name, run.preset, per_cycle);
        for (const int clock_MHz : kClocks_MHz) {
            const double per_second = clock_MHz * 1e6 * per_cycle;
            text +=
                fmt::format(" {:.1f} ({:.1f}) |", per_second / static_cast<double>(run.cost.median),
                            per_second / static_cast<double>(run.cost.worst));
        }
        text += '\n';
    }
    return text;
}

/// Returns the value of a figure in the document's line for a run.
Count committed_value(const fs::path& path, const Run& run, const char* figure) {
    std::istringstream lines(read_document(path));
    const std::string key = fmt::format(" {}=", figure);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t at = line.find(key);
        if (!line.starts_with(run.name() + ' ') || at == std::string::npos) continue;
        std::istringstream number(line.substr(at + key.size()));
        Count value = 0;
        if (number >> value) return value;
    }
    throw Error(fmt::format("{} has no '{}' of {}: run make budget ARGS=--update", path.string(),
                            figure, run.name()));
}

/// Prints every figure that has grown by more than 3 %. Returns whether there is none.
bool keeps_budget(const fs::path& path, const std::vector<Run>& runs) {
    bool is_kept = true;
    for (const Run& run : runs) {
        for (const Figure& figure : run.figures()) {
            const Count committed = committed_value(path, run, figure.name);
            if (100 * figure.value <= 103 * committed) continue;
            is_kept = false;
            fmt::print(stderr, "{}: {} has grown by more than 3 %, from {} to {}\n", run.name(),
                       figure.name, committed, figure.value);
        }
    }
    return is_kept;
}

struct Wanted {
    bool is_update = false;
    bool has_all_sizes = false;
    bool is_quick = false;
};

/// Prints the report or updates the document. Returns whether the budget is kept.
bool report(const Wanted& wanted, const fs::path& document, const fs::path& folder) {
    std::vector<Run> runs;
    for (const Target& target : std::span(kTargets).first(wanted.is_quick ? 1 : kTargets.size())) {
        for (const char* preset : kPresets)
            runs.push_back(read_run(folder, target, preset));
    }
    for (const Run& run : runs)
        fmt::print("{}\n", line_of(run));
    if (wanted.is_quick) return keeps_budget(document, runs);
    Blocks blocks = {{"budget", summary(runs)},
                     {"located", located(folder)},
                     {"stages", stage_tables(runs)},
                     {"rates", rate_table(runs)}};
    fmt::print("\nLocated, on each target:\n\n{}\n{}\n{}", blocks[1].text, blocks[2].text,
               blocks[3].text);
    std::vector<SizeRow> sizes;
    if (wanted.has_all_sizes) {
        sizes = read_sizes(folder);
        blocks.push_back({"sizes", size_table(sizes)});
        fmt::print("\n{}", blocks.back().text);
    }
    if (wanted.is_update) {
        update_document(document, blocks);
        return true;
    }
    const bool is_kept = keeps_budget(document, runs);
    return keeps_sizes(read_document(document), sizes) && is_kept;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto take = [&](const char* option) { return std::erase(arguments, option) > 0; };
    const Wanted wanted{take("--update"), take("--all"), take("--quick")};
    if ((wanted.is_quick && (wanted.is_update || wanted.has_all_sizes)) || arguments.size() != 2 ||
        arguments[0].starts_with('-')) {
        fmt::print(stderr, "usage: dotpose_budget [--update] [--all | --quick] DOCUMENT FOLDER\n");
        return 2;
    }
    try {
        return report(wanted, arguments[0], arguments[1]) ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_budget: {}\n", error.what());
        return 1;
    }
}
