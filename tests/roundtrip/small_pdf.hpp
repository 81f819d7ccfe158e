/// A PDF written out by hand, with everything that laying dots over it must not lose.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dotpose::roundtrip {

/// Objects 1, 2, ... as text without "obj" and "endobj"; the first is the catalogue.
void write_pdf(const std::filesystem::path& path, const std::vector<std::string>& objects);

std::string stream(const std::string& data);

}  // namespace dotpose::roundtrip
