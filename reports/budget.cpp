// Reports the budget of the firmware from the files that firmware/budget has written to FOLDER.
//
//   dotpose_budget [--update] DOCUMENT FOLDER
//
// Prints a line `TARGET PRESET median=N worst=N ram=N code=N` for each run, and tables; `median`
// and `worst` are instructions per frame, `ram` and `code` bytes. With --update, the tables replace
// the generated parts of the document. Without it, the exit status is 1 if any figure is more than
// 3 % above that of the document.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include <dotpose/files/error.hpp>

#include "document.hpp"

namespace {

namespace fs = std::filesystem;
using dotpose::Error;
using Count = std::uint64_t;

struct Target {
    const char* name;
    /// Assumption for the table of frame rates, which docs/firmware.md explains.
    double instructions_per_cycle;
};
constexpr std::array kTargets = {Target{"cortex-m0plus", 0.7}, Target{"mips32r2", 0.8}};
/// The sets of frames: two presets, and frames of the first preset with predictions.
constexpr std::array kPresets = {"nominal", "hard", "tracked"};

/// Statistics of the instructions per frame.
struct Cost {
    Count median = 0;
    Count worst = 0;
};

Cost cost_of(std::vector<Count> counts) {
    std::ranges::sort(counts);
    const std::size_t half = counts.size() / 2;
    const Count below = counts[counts.size() % 2 == 0 ? half - 1 : half];
    return {(below + counts[half]) / 2, counts.back()};
}

struct StageCost {
    std::string name;
    Cost cost;
};

struct Figure {
    const char* name;
    Count value;
};

/// The results of one target with one set of frames.
struct Run {
    Target target;
    std::string preset;
    std::vector<StageCost> stages;
    Cost cost;
    Count ram_bytes = 0;
    Count code_bytes = 0;

    std::string name() const { return fmt::format("{} {}", target.name, preset); }
    /// The figures that must not grow.
    std::array<Figure, 4> figures() const {
        return {{{"median", cost.median},
                 {"worst", cost.worst},
                 {"ram", ram_bytes},
                 {"code", code_bytes}}};
    }
};

std::string line_of(const Run& run) {
    std::string line = run.name();
    for (const Figure& figure : run.figures())
        line += fmt::format(" {}={}", figure.name, figure.value);
    return line;
}

/// Reads the counts that the plugin reports/count.cpp has written.
void read_counts(const fs::path& path, Run& run) {
    std::istringstream lines(read_document(path));
    std::string line;
    std::getline(lines, line);
    std::istringstream names(line);
    std::vector<std::vector<Count>> counts_of;  // the counts of each stage, by frame
    for (std::string stage; names >> stage; counts_of.emplace_back())
        run.stages.push_back({stage, {}});
    std::vector<Count> totals;
    while (std::getline(lines, line)) {
        std::istringstream numbers(line);
        Count total = 0;
        for (std::vector<Count>& counts : counts_of) {
            Count count = 0;
            if (!(numbers >> count)) throw Error("bad line in " + path.string() + ": " + line);
            counts.push_back(count);
            total += count;
        }
        totals.push_back(total);
    }
    if (totals.empty()) throw Error("no frame was counted in " + path.string());
    run.cost = cost_of(totals);
    for (std::size_t i = 0; i < counts_of.size(); ++i)
        run.stages[i].cost = cost_of(counts_of[i]);
}

/// Returns the number after `name` at the start of a line, or 0 if there is no such line.
Count number_after(const fs::path& path, std::string_view name) {
    std::istringstream lines(read_document(path));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        Count number = 0;
        if (words >> word && word == name && words >> number) return number;
    }
    return 0;
}

Run read_run(const fs::path& folder, const Target& target, const char* preset) {
    Run run{target, preset, {}, {}};
    const fs::path file = folder / fmt::format("{}-{}", target.name, preset);
    read_counts(file.string() + ".counts", run);
    const fs::path sizes = folder / fmt::format("{}.size", target.name);
    const Count data_bytes = number_after(sizes, ".data");
    run.ram_bytes =
        data_bytes + number_after(sizes, ".bss") + number_after(file.string() + ".txt", "stack");
    run.code_bytes = number_after(sizes, ".text") + data_bytes;
    return run;
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

/// Formats a number with groups of three digits, such as "1,234,567".
std::string grouped(Count number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3;)
        digits.insert(at -= 3, 1, ',');
    return digits;
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

/// Prints the report or updates the document. Returns whether the budget is kept.
bool report(bool is_update, const fs::path& document, const fs::path& folder) {
    std::vector<Run> runs;
    for (const Target& target : kTargets) {
        for (const char* preset : kPresets)
            runs.push_back(read_run(folder, target, preset));
    }
    for (const Run& run : runs)
        fmt::print("{}\n", line_of(run));
    const Blocks blocks = {{"budget", summary(runs)},
                           {"located", located(folder)},
                           {"stages", stage_tables(runs)},
                           {"rates", rate_table(runs)}};
    fmt::print("\nLocated, on each target:\n\n{}\n{}\n{}", blocks[1].text, blocks[2].text,
               blocks[3].text);
    if (!is_update) return keeps_budget(document, runs);
    update_document(document, blocks);
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool is_update = !arguments.empty() && arguments.front() == "--update";
    const std::size_t first = is_update ? 1 : 0;
    if (arguments.size() != first + 2 || arguments[first].starts_with('-')) {
        fmt::print(stderr, "usage: dotpose_budget [--update] DOCUMENT FOLDER\n");
        return 2;
    }
    try {
        return report(is_update, arguments[first], arguments[first + 1]) ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_budget: {}\n", error.what());
        return 1;
    }
}
