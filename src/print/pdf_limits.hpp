/// Limits for untrusted documents: nesting depth, and number of bytes after unpacking.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <qpdf/InputSource.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// Maximum nesting depth of objects. Real documents are nested less deeply, and recursive functions
/// do not overflow the stack at this depth.
inline constexpr int kMaxPdfLevels = 100;

/// Throws Error if `level`, counted from 1, exceeds kMaxPdfLevels. `what` names the nested objects
/// in the message.
void require_pdf_level(const char* what, int level);

/// Throws Error if the page tree is nested too deeply.
void require_shallow_page_tree(QPDF& pdf);

/// Opens a PDF so that reading it cannot overflow the stack. qpdf reads recursively, because the
/// length of a stream may be stored in another stream, whose length is in a third stream, and so
/// on. If too much of the stack is in use, a read throws an exception, which qpdf turns into a
/// warning (see `is_too_deep`). Throws Error for directories, pipes and devices.
std::shared_ptr<InputSource> open_pdf(const std::filesystem::path& path);

/// Returns true if qpdf issued this warning because a read would have used too much of the stack,
/// or because objects are nested too deeply.
bool is_too_deep(const std::string& warning);

/// Counts the unpacked bytes of streams without storing them. The limit is `max_mb` megabytes for
/// each page, and eight times as much for all pages together.
class UnpackedBytes {
  public:
    explicit UnpackedBytes(int max_mb) : max_mb_(max_mb) {}

    void start_page() { page_ = 0; }

    /// Counts the bytes of a stream, and ignores objects that are not streams. Throws Error if a
    /// limit is exceeded, if the stream has too many filters, or if the predictor of a filter needs
    /// too much memory for a row.
    void count(QPDFObjectHandle stream);

    /// Counts the bytes of all object streams (streams that contain other objects). Each object
    /// stream is treated as a page, so the limit for one page applies to it.
    void count_object_streams(QPDF& pdf);

  private:
    int max_mb_;
    std::uint64_t page_ = 0;
    std::uint64_t document_ = 0;
};

}  // namespace dotpose::print
