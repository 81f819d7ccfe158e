/// What a stranger's document may ask for: depth, and bytes once they are unpacked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <qpdf/InputSource.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// Nested deeper than any document is, and shallow enough for the recursion of whoever follows.
inline constexpr int kMostPdfLevels = 100;

/// Throws Error, which says that `what` is nested too deeply, for a level (from 1) beyond these.
void require_pdf_level(const char* what, int level);

/// Throws Error if the page tree is nested too deeply.
void require_shallow_page_tree(QPDF& pdf);

/// A file that ends the recursion of the library which reads it: a stream's length may stand in
/// another stream, whose length stands in yet another. Each `read` that finds more of the stack
/// taken than any document needs throws; the library makes a warning of that, for `is_too_deep`.
/// Throws Error for pipes and devices.
std::shared_ptr<InputSource> open_pdf(const std::filesystem::path& path);

/// Whether a warning of the library says that it gave up because of depth.
bool is_too_deep(const std::string& warning);

/// Counts what streams become when they are unpacked, before anybody keeps that in memory. A page
/// may have `most_mb`, all pages together eight times as much.
class UnpackedBytes {
  public:
    explicit UnpackedBytes(int most_mb) : most_mb_(most_mb) {}

    void start_page() { page_ = 0; }

    /// Throws Error if there are too many bytes, or too many filters on top of each other.
    void count(QPDFObjectHandle stream);

    /// The streams that other objects are packed in, each like a page.
    void count_object_streams(QPDF& pdf);

  private:
    int most_mb_;
    std::uint64_t page_ = 0;
    std::uint64_t document_ = 0;
};

}  // namespace dotpose::print
