// Speed of `locate` on frames of several sizes, and of the position code. Answers are checked
// before time counts. Compare figures of one run only: `make bench`.
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "dotpose/locate.hpp"
#include "dotpose/simulate.hpp"

namespace {

using namespace dotpose;

/// Nominal frames of one size, in turn.
void locate_frames(benchmark::State& state) {
    Setup setup;
    setup.camera.width_px = static_cast<int>(state.range(0));
    setup.camera.height_px = static_cast<int>(state.range(1));
    const auto workspace = std::make_unique<LargeWorkspace>();
    std::vector<GreyImage> frames;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const Shot shot = draw_shot(setup, i);
        frames.push_back(render(shot));
        const Fix fix = locate(frames.back().view(), {}, *workspace);
        if (fix.status != Status::ok || fix.cell != shot.pose.cell) {
            return state.SkipWithError("a frame was not located rightly");
        }
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(locate(frames[next].view(), {}, *workspace));
        next = (next + 1) % frames.size();
    }
}
BENCHMARK(locate_frames)->Args({188, 120})->Args({640, 480})->Unit(benchmark::kMicrosecond);

void encode_symbol(benchmark::State& state) {
    std::uint32_t p = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(symbol_at(Profile::anoto, {p, p / 2}, {}));
        p = (p + 1'000'003) % kPositionsPerAxis;
    }
}
BENCHMARK(encode_symbol);

void decode_window(benchmark::State& state) {
    std::vector<Symbol> symbols;
    for (std::uint32_t y = 0; y < 8; ++y) {
        for (std::uint32_t x = 0; x < 8; ++x) {
            symbols.push_back(symbol_at(Profile::anoto, {123'456 + x, 654'321 + y}, {}));
        }
    }
    Place place;
    for (auto _ : state) {
        if (decode(Profile::anoto, {symbols, 8, 8}, place) != Status::ok) {
            return state.SkipWithError("the window was not decoded");
        }
    }
}
BENCHMARK(decode_window);

}  // namespace
