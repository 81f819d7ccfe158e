// Describes the machine on which the benchmarks run.
#include <array>
#include <cstdlib>
#include <fstream>

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include "benchmarks.hpp"

namespace dotpose::bench {
namespace {

/// Returns the value of `name` in a file whose lines are `name: value` or `name="value"`.
std::string value_in(const char* path, std::string_view name) {
    std::ifstream lines(path);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(name)) continue;
        const std::size_t from = line.find_first_not_of("\t :=\"", name.size());
        if (from == std::string::npos) break;
        return line.substr(from, line.find_last_not_of('"') + 1 - from);
    }
    return "unknown";
}

/// Returns the sizes of the data caches. Virtual machines may hide them.
std::string caches() {
    std::string text;
    for (const auto& cache : benchmark::CPUInfo::Get().caches) {
        if (cache.type == "Instruction") continue;
        text +=
            fmt::format("{}L{} {} KB", text.empty() ? "" : ", ", cache.level, cache.size / 1024);
    }
    return text.empty() ? "caches unknown" : text;
}

}  // namespace

std::string load_average() {
    std::array<double, 3> load{};
    if (getloadavg(load.data(), 3) != 3) return "unknown";
    return fmt::format("{:.1f}, {:.1f}, {:.1f}", load[0], load[1], load[2]);
}

std::string machine_list() {
    const benchmark::CPUInfo& cpu = benchmark::CPUInfo::Get();
    return fmt::format(
        "- processor: {}, {} cores seen, {:.1f} GHz nominal; {}\n"
        "- system: {}\n"
        "- compiler: {} {}, `{}`\n"
        "- libapriltag {}\n",
        value_in("/proc/cpuinfo", "model name"), cpu.num_cpus, 1e-9 * cpu.cycles_per_second,
        caches(), value_in("/etc/os-release", "PRETTY_NAME"),
#ifdef __clang__
        "clang", __clang_version__,
#else
        "gcc", __VERSION__,
#endif
        DOTPOSE_FLAGS, DOTPOSE_APRILTAG_VERSION);
}

}  // namespace dotpose::bench
