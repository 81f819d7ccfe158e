/// One run of the firmware: a target that has located a set of frames.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/core.h>

using Count = std::uint64_t;

struct Target {
    const char* name;
    /// Assumption for the table of frame rates, which docs/firmware.md explains.
    double instructions_per_cycle;
};

/// Statistics of the instructions per frame.
struct Cost {
    Count median = 0;
    Count worst = 0;
};

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

/// Reads what firmware/budget has written to a folder. `suffix` tells the size of frames: none for
/// 188 x 120 px, otherwise for example "-320x240".
Run read_run(const std::filesystem::path& folder, const Target& target, const std::string& preset,
             const std::string& suffix = "");

/// Formats a number with groups of three digits, such as "1,234,567".
std::string grouped(Count number);
