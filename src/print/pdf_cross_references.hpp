/// Limits the size of the cross-reference streams of a PDF, which list its objects.
#pragma once

#include <filesystem>

#include "pdf_limits.hpp"

namespace dotpose::print {

/// Counts the unpacked bytes of the cross-reference streams of a document. qpdf unpacks them as
/// soon as it opens the document, without a limit, so call this first. References that make no
/// sense are not followed; qpdf refuses them later. Throws Error like `UnpackedBytes::count`, and
/// what `FileInputSource` throws.
void count_cross_references(const std::filesystem::path& path, UnpackedBytes& unpacked);

}  // namespace dotpose::print
