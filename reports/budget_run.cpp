#include "budget_run.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include <dotpose/files/error.hpp>

#include "document.hpp"

namespace {

namespace fs = std::filesystem;
using dotpose::Error;

Cost cost_of(std::vector<Count> counts) {
    std::ranges::sort(counts);
    const std::size_t half = counts.size() / 2;
    const Count below = counts[counts.size() % 2 == 0 ? half - 1 : half];
    return {(below + counts[half]) / 2, counts.back()};
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

}  // namespace

Run read_run(const fs::path& folder, const Target& target, const std::string& preset,
             const std::string& suffix) {
    Run run{target, preset, {}, {}};
    const fs::path file = folder / fmt::format("{}-{}{}", target.name, preset, suffix);
    read_counts(file.string() + ".counts", run);
    const fs::path sizes = folder / fmt::format("{}{}.size", target.name, suffix);
    const Count data_bytes = number_after(sizes, ".data");
    run.ram_bytes =
        data_bytes + number_after(sizes, ".bss") + number_after(file.string() + ".txt", "stack");
    run.code_bytes = number_after(sizes, ".text") + data_bytes;
    return run;
}

std::string grouped(Count number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3;)
        digits.insert(at -= 3, 1, ',');
    return digits;
}
