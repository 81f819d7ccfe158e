/// Limits for documents that anybody may have made: depth of nesting, and bytes after unpacking.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <qpdf/InputSource.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// Deepest nesting of objects that is accepted. Useful documents need less, and recursive functions
/// have stack enough for it.
inline constexpr int kMostPdfLevels = 100;

/// Throws Error that says that `what` is nested too deeply if `level`, which counts from 1, is
/// above kMostPdfLevels.
void require_pdf_level(const char* what, int level);

/// Throws Error if the page tree is nested too deeply.
void require_shallow_page_tree(QPDF& pdf);

/// Opens a PDF so that reading it cannot overflow the stack. qpdf reads recursively: the length of
/// a stream may be stored in another stream, whose length is stored in a third, and so on. A read
/// that finds too much of the stack in use throws; qpdf turns that into a warning, which
/// `is_too_deep` recognizes. Throws Error for pipes and devices.
std::shared_ptr<InputSource> open_pdf(const std::filesystem::path& path);

/// Whether a warning of qpdf comes from a read that found too much of the stack in use.
bool is_too_deep(const std::string& warning);

/// Counts the bytes of unpacked streams, before they are kept in memory. A page may have `most_mb`
/// megabytes, all pages together eight times as many.
class UnpackedBytes {
  public:
    explicit UnpackedBytes(int most_mb) : most_mb_(most_mb) {}

    void start_page() { page_ = 0; }

    /// Throws Error if there are too many bytes, or too many filters on top of each other.
    void count(QPDFObjectHandle stream);

    /// Counts the object streams, which contain other objects; the limit of a page applies to each.
    void count_object_streams(QPDF& pdf);

  private:
    int most_mb_;
    std::uint64_t page_ = 0;
    std::uint64_t document_ = 0;
};

}  // namespace dotpose::print
