/// Limits the size of the cross-reference streams of a PDF. These streams list the objects of the
/// PDF.
#pragma once

#include <filesystem>

#include "pdf_limits.hpp"

namespace dotpose::print {

/// Counts the unpacked bytes of the cross-reference streams of a document. Must be called before
/// qpdf opens the document, because qpdf unpacks these streams without a limit. Ignores invalid
/// references, because qpdf rejects them later. Throws the same errors as `UnpackedBytes::count`,
/// and does not catch exceptions thrown by `FileInputSource`.
void count_cross_references(const std::filesystem::path& path, UnpackedBytes& unpacked);

}  // namespace dotpose::print
