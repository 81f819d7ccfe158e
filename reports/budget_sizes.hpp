/// The table of RAM, flash and instructions by size of frame and core.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "budget_run.hpp"

/// Memory and instructions that one core needs for frames of one size.
struct SizeRow {
    std::string size;
    std::string core;
    Count ram_bytes = 0;
    Count code_bytes = 0;
    Cost fresh;
    Cost tracked;

    /// The cells of the table before the numbers.
    std::string begin() const;
    /// The numbers, in the order of the table's columns.
    std::array<Count, 6> numbers() const;
};

/// Reads what `firmware/budget --all` has written to a folder.
std::vector<SizeRow> read_sizes(const std::filesystem::path& folder);

std::string size_table(const std::vector<SizeRow>& rows);

/// Prints every number that is more than 3 % above that in the text of the document. Returns
/// whether there is none.
bool keeps_sizes(std::string_view document, const std::vector<SizeRow>& rows);
