#include "budget_sizes.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include <dotpose/files/error.hpp>

namespace {

namespace fs = std::filesystem;
using dotpose::Error;

constexpr std::array kSizes = {"160x120", "188x120", "320x240"};
constexpr std::array kCores = {"cortex-m0plus", "cortex-m4f", "cortex-m33", "mips32r2", "rv32imc"};

SizeRow read_row(const fs::path& folder, const std::string& size, const char* core) {
    const std::string suffix = size == "188x120" ? "" : "-" + size;
    const Run fresh = read_run(folder, {core, 1}, "nominal", suffix);
    const Run tracked = read_run(folder, {core, 1}, "tracked", suffix);
    return {size,       core,        std::max(fresh.ram_bytes, tracked.ram_bytes), fresh.code_bytes,
            fresh.cost, tracked.cost};
}

/// Returns the numbers of a row of the document's table. Throws Error if it has no such row.
std::vector<Count> committed(std::string_view document, const SizeRow& row) {
    const std::size_t at = document.find(row.begin());
    if (at == std::string_view::npos)
        throw Error("no row " + row.begin() + ": run make budget ARGS=\"--all --update\"");
    std::vector<Count> numbers;
    bool is_in_number = false;
    for (const char c : document.substr(at + row.begin().size())) {
        if (c == '\n') break;
        if (c == '|') is_in_number = false;
        if (std::isdigit(static_cast<unsigned char>(c)) == 0) continue;
        if (!is_in_number) numbers.push_back(0);
        is_in_number = true;
        numbers.back() = 10 * numbers.back() + static_cast<Count>(c - '0');
    }
    return numbers;
}

}  // namespace

std::string SizeRow::begin() const {
    return fmt::format("| {} | {} |", size, core);
}

std::array<Count, 6> SizeRow::numbers() const {
    return {ram_bytes, code_bytes, fresh.median, fresh.worst, tracked.median, tracked.worst};
}

std::vector<SizeRow> read_sizes(const fs::path& folder) {
    std::vector<SizeRow> rows;
    for (const char* size : kSizes) {
        for (const char* core : kCores)
            rows.push_back(read_row(folder, size, core));
    }
    return rows;
}

std::string size_table(const std::vector<SizeRow>& rows) {
    std::string text =
        "| frames | core | RAM | flash | fresh: median | fresh: worst | tracked: median | tracked: "
        "worst |\n|---|---|--:|--:|--:|--:|--:|--:|\n";
    for (const SizeRow& row : rows) {
        text += row.begin();
        for (const Count number : row.numbers())
            text += fmt::format(" {} |", grouped(number));
        text += '\n';
    }
    return text;
}

bool keeps_sizes(std::string_view document, const std::vector<SizeRow>& rows) {
    bool is_kept = true;
    for (const SizeRow& row : rows) {
        const std::vector<Count> before = committed(document, row);
        const std::array<Count, 6> now = row.numbers();
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (i < before.size() && 100 * now[i] <= 103 * before[i]) continue;
            is_kept = false;
            fmt::print(stderr, "{} column {} has grown by more than 3 %, to {}\n", row.begin(),
                       i + 3, now[i]);
        }
    }
    return is_kept;
}
