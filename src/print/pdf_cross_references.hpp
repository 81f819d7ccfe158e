/// What a document lists its objects in.
#pragma once

#include <filesystem>

#include "pdf_limits.hpp"

namespace dotpose::print {

/// Counts what the cross-reference streams of a document become when they are unpacked, which the
/// library does before anybody can ask it: to be called before it opens the document. Follows the
/// references as far as they make sense; where they do not, the library refuses them. Throws Error
/// as `UnpackedBytes::count`, and what `FileInputSource` throws.
void count_cross_references(const std::filesystem::path& path, UnpackedBytes& unpacked);

}  // namespace dotpose::print
