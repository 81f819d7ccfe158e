// Benchmarks the encoding and decoding of positions, without images.
#include <fmt/core.h>

#include <dotpose/code.hpp>

#include "benchmarks.hpp"

namespace dotpose::bench {
namespace {

constexpr const char* kEncode = "code/symbol_at";
constexpr const char* kDecode = "code/decode";

void encode_symbol(benchmark::State& state) {
    std::uint32_t p = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(symbol_at(CodeVariant::anoto, {p, p / 2}, {}));
        p = (p + 1'000'003) % kPositionsPerAxis;
    }
}

void decode_window(benchmark::State& state) {
    constexpr Cell kCorner{123'456, 654'321};
    std::vector<Symbol> symbols;
    for (std::uint32_t y = 0; y < 8; ++y) {
        for (std::uint32_t x = 0; x < 8; ++x)
            symbols.push_back(symbol_at(CodeVariant::anoto, {kCorner.x + x, kCorner.y + y}, {}));
    }
    Place place;
    for (auto _ : state) {
        if (decode(CodeVariant::anoto, {symbols, 8, 8}, place) != Status::ok ||
            place.cell != kCorner)
            return state.SkipWithError("the window was not decoded");
    }
}

}  // namespace

void add_code_benchmarks() {
    benchmark::RegisterBenchmark(kEncode, encode_symbol);
    benchmark::RegisterBenchmark(kDecode, decode_window);
}

std::string code_table(const Results& results) {
    return fmt::format(
        "| | ns |\n|---|--:|\n"
        "| the symbol of a cell (`symbol_at`) | {:.0f} |\n"
        "| the position of 8 x 8 symbols (`decode`) | {:.0f} |\n",
        1e3 * results.of(kEncode).us, 1e3 * results.of(kDecode).us);
}

}  // namespace dotpose::bench
