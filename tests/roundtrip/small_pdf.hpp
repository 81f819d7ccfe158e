/// Writes small PDF documents from hand-written objects.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dotpose::roundtrip {

/// Writes a PDF document. `objects` contains the text of the objects 1, 2, ..., without "obj" and
/// "endobj". The first object is the catalogue.
void write_pdf(const std::filesystem::path& path, const std::vector<std::string>& objects);

std::string stream(const std::string& data);

}  // namespace dotpose::roundtrip
