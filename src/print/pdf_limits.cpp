#include "pdf_limits.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <qpdf/FileInputSource.hh>
#include <qpdf/Pipeline.hh>
#include <qpdf/QPDFXRefEntry.hh>

#include "base/system_error.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::print {
namespace {

constexpr const char* kTooDeep = "streams whose lengths are in other streams";

/// Maximum stack usage of qpdf while it reads, in bytes. Valid documents need far less stack, and
/// the stack of a program's main thread is larger.
constexpr std::ptrdiff_t kMaxStack_bytes = 2 << 20;

class ShallowFile : public FileInputSource {
  public:
    explicit ShallowFile(const std::filesystem::path& path)
        : FileInputSource(path.string().c_str()), start_(stack_place()) {}

    std::size_t read(char* bytes, std::size_t length) override {
        if (std::abs(stack_place() - start_) > kMaxStack_bytes) throw std::runtime_error(kTooDeep);
        return FileInputSource::read(bytes, length);
    }

  private:
    static std::ptrdiff_t stack_place() {
        return reinterpret_cast<std::ptrdiff_t>(__builtin_frame_address(0));
    }

    std::ptrdiff_t start_;
};

/// Counts the bytes written to this pipeline, and discards them. Throws std::runtime_error if there
/// are more than `max` bytes.
class ByteCount : public Pipeline {
  public:
    explicit ByteCount(std::uint64_t max) : Pipeline("byte count", nullptr), max_(max) {}

    void write(unsigned char const* /*data*/, std::size_t size) override {
        bytes_ += size;
        // qpdf may turn this exception into a warning, so the caller must also check the count.
        if (bytes_ > max_) throw std::runtime_error("too many bytes");
    }
    void finish() override {}

    std::uint64_t bytes() const { return bytes_; }

  private:
    std::uint64_t max_;
    std::uint64_t bytes_ = 0;
};

/// Returns the number of bytes that the predictor of a compression filter allocates for a row, or 0
/// if there is no predictor.
double predictor_row_bytes(QPDFObjectHandle parameters) {
    if (!parameters.isDictionary()) return 0;
    double bytes = 1.0 / 8;
    for (const char* key : {"/Columns", "/Colors", "/BitsPerComponent"}) {
        QPDFObjectHandle value = parameters.getKey(key);
        if (value.isInteger()) bytes *= static_cast<double>(value.getIntValue());
    }
    return bytes;
}

/// Throws Error if a stream has more than kMaxFilters filters, because each filter can multiply the
/// size of the data. Also throws if a predictor needs more than kMaxRowBytes of memory for a row.
void require_few_filters(QPDFObjectHandle dict) {
    constexpr int kMaxFilters = 8;
    constexpr double kMaxRowBytes = 1 << 24;
    QPDFObjectHandle filters = dict.getKey("/Filter");
    if (filters.isArray() && filters.getArrayNItems() > kMaxFilters) {
        throw Error(
            fmt::format("it has content compressed {} times; at most {} times are supported",
                        filters.getArrayNItems(), kMaxFilters));
    }
    QPDFObjectHandle parameters = dict.getKey("/DecodeParms");
    double row_bytes = predictor_row_bytes(parameters);
    if (parameters.isArray()) {
        for (const QPDFObjectHandle& one : parameters.getArrayAsVector())
            row_bytes = std::max(row_bytes, predictor_row_bytes(one));
    }
    if (row_bytes > kMaxRowBytes) {
        throw Error(fmt::format(
            "it has content compressed in rows of {:.3g} bytes; at most {:.0f} are supported",
            row_bytes, kMaxRowBytes));
    }
}

/// Returns the root of the page tree, by following /Parent from the /Pages node of the document
/// catalogue.
QPDFObjectHandle page_tree(QPDF& pdf) {
    QPDFObjectHandle node = pdf.getRoot().getKey("/Pages");
    std::set<QPDFObjGen> seen;
    while (node.isDictionary() && node.getKey("/Parent").isDictionary() &&
           seen.insert(node.getObjGen()).second) {
        node = node.getKey("/Parent");
    }
    return node;
}

}  // namespace

void require_pdf_level(const char* what, int level) {
    if (level <= kMaxPdfLevels) return;
    throw Error(fmt::format("its {} are nested deeper than {} levels", what, kMaxPdfLevels));
}

void require_shallow_page_tree(QPDF& pdf) {
    std::vector<std::pair<QPDFObjectHandle, int>> nodes = {{page_tree(pdf), 1}};
    std::set<QPDFObjGen> seen;
    while (!nodes.empty()) {
        auto [node, level] = nodes.back();
        nodes.pop_back();
        // A node that was visited before is part of a cycle, or is a page that occurs twice. It is
        // skipped, because qpdf reports both faults.
        if (!node.isDictionary() || (node.isIndirect() && !seen.insert(node.getObjGen()).second)) {
            continue;
        }
        require_pdf_level("groups of pages", level);
        QPDFObjectHandle kids = node.getKey("/Kids");
        if (!kids.isArray()) continue;
        for (const QPDFObjectHandle& kid : kids.getArrayAsVector())
            nodes.emplace_back(kid, level + 1);
    }
}

std::shared_ptr<InputSource> open_pdf(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) base::throw_system("read", path, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error(
            fmt::format("cannot read {}: a PDF is read from its end, which pipes and "
                        "devices do not have",
                        path.string()));
    }
    return std::make_shared<ShallowFile>(path);
}

bool is_too_deep(const std::string& warning) {
    return warning.find(kTooDeep) != std::string::npos ||
           warning.find("deeply nested") != std::string::npos;
}

void UnpackedBytes::count(QPDFObjectHandle stream) {
    if (!stream.isStream()) return;
    require_few_filters(stream.getDict());
    const std::uint64_t max = static_cast<std::uint64_t>(max_mb_) << 20;
    const std::uint64_t max_of_document = 8 * max;
    ByteCount bytes(std::min(max - page_, max_of_document - document_));
    bool attempted = false;
    constexpr bool kSuppressWarnings = true;
    try {
        stream.pipeStreamData(&bytes, &attempted, 0, qpdf_dl_specialized, kSuppressWarnings);
    } catch (const std::runtime_error&) {
        // The exception can be ignored. If there were too many bytes, the code below throws an
        // Error. If the stream is damaged, the damage is reported when the stream is read.
    }
    page_ += bytes.bytes();
    document_ += bytes.bytes();
    if (page_ > max) {
        throw Error(fmt::format("its content takes more than {} MB when it is unpacked", max_mb_));
    }
    if (document_ > max_of_document) {
        throw Error(
            fmt::format("the content of the pages so far takes more than {} MB when it is unpacked",
                        max_of_document >> 20));
    }
}

void UnpackedBytes::count_object_streams(QPDF& pdf) {
    constexpr int kInObjectStream = 2;
    std::set<int> streams;
    for (const auto& [id, entry] : pdf.getXRefTable()) {
        if (entry.getType() == kInObjectStream) streams.insert(entry.getObjStreamNumber());
    }
    for (const int number : streams) {
        start_page();
        count(pdf.getObjectByID(number, 0));
    }
}

}  // namespace dotpose::print
