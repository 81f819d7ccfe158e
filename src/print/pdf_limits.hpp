/// Limits for untrusted documents: depth of nesting, and number of bytes after unpacking.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <qpdf/InputSource.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// Maximum nesting depth of objects. Useful documents are nested less deeply, and recursive
/// functions do not overflow the stack at this depth.
inline constexpr int kMaxPdfLevels = 100;

/// Throws Error if `level` (from 1) exceeds kMaxPdfLevels. The message states that `what` is nested
/// too deeply.
void require_pdf_level(const char* what, int level);

/// Throws Error if the page tree is nested too deeply.
void require_shallow_page_tree(QPDF& pdf);

/// Opens a PDF such that reading it cannot overflow the stack. qpdf reads recursively: the length
/// of a stream may be stored in another stream, whose length is stored in a third stream, and so
/// on. A read throws an exception if too much of the stack is in use. qpdf converts the exception
/// to a warning, which `is_too_deep` recognizes. Throws Error for pipes and devices.
std::shared_ptr<InputSource> open_pdf(const std::filesystem::path& path);

/// Returns true if a warning of qpdf was caused by a read that stopped because too much of the
/// stack was in use.
bool is_too_deep(const std::string& warning);

/// Counts the bytes of unpacked streams before they are stored in memory. The limit is `max_mb`
/// megabytes for one page, and eight times as much for all pages together.
class UnpackedBytes {
  public:
    explicit UnpackedBytes(int max_mb) : max_mb_(max_mb) {}

    void start_page() { page_ = 0; }

    /// Counts the bytes of a stream. Throws Error if a limit is exceeded, or if the stream has too
    /// many filters or needs too much memory for a row of a predictor.
    void count(QPDFObjectHandle stream);

    /// Counts the bytes of the object streams (streams that contain other objects). The limit for
    /// one page applies to each object stream.
    void count_object_streams(QPDF& pdf);

  private:
    int max_mb_;
    std::uint64_t page_ = 0;
    std::uint64_t document_ = 0;
};

}  // namespace dotpose::print
