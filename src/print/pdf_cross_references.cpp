#include "pdf_cross_references.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <string>

#include <qpdf/FileInputSource.hh>
#include <qpdf/QPDFExc.hh>
#include <qpdf/QPDFTokenizer.hh>

#include "dotpose/files/error.hpp"

namespace dotpose::print {
namespace {

using Token = QPDFTokenizer::Token;

/// Reads the cross-reference tables and streams of a document. The number after `startxref`, near
/// the end of the file, is the offset of the newest table or stream. Its entries /Prev and /XRefStm
/// contain the offsets of further tables and streams.
class CrossReferences {
  public:
    CrossReferences(const std::filesystem::path& path, UnpackedBytes& unpacked)
        : file_(std::make_shared<FileInputSource>(path.string().c_str())), unpacked_(unpacked) {
        file_->seek(0, SEEK_END);
        size_ = file_->tell();
        stray_.emptyPDF();
        stray_.setSuppressWarnings(true);
        tokenizer_.allowEOF();
    }

    void count() {
        // Number of bytes to search for the header at the beginning of the file, and for
        // `startxref` at its end. Some files contain other data before or after the document.
        constexpr qpdf_offset_t kNear = 1100;
        const std::string begin = text(0, kNear);
        std::smatch header;
        if (std::regex_search(begin, header, std::regex("%PDF-[0-9]+\\.[0-9]+"))) {
            start_ = header.position();
        }
        const std::string end = text(std::max<qpdf_offset_t>(size_ - kNear, 0), kNear);
        const std::size_t mark = end.rfind("startxref");
        if (mark == std::string::npos) return;
        const std::string number = end.substr(mark + std::string("startxref").size(), 32);
        waiting_ = {static_cast<qpdf_offset_t>(std::strtoll(number.c_str(), nullptr, 10))};
        while (!waiting_.empty()) {
            const qpdf_offset_t offset = *waiting_.begin();
            waiting_.erase(waiting_.begin());
            if (offset >= 0 && offset < size_ && seen_.insert(offset).second) follow(offset);
        }
    }

  private:
    std::string text(qpdf_offset_t offset, qpdf_offset_t length) {
        std::string bytes(static_cast<std::size_t>(std::min(length, size_ - offset)), '\0');
        file_->seek(offset, SEEK_SET);
        bytes.resize(file_->read(bytes.data(), bytes.size()));
        return bytes;
    }

    Token next() {
        constexpr bool kBadToo = true;
        constexpr std::size_t kMaxTokenBytes = 1 << 16;
        return tokenizer_.readToken(file_, "cross references", kBadToo, kMaxTokenBytes);
    }

    /// Reads one cross-reference table with its trailer, or one cross-reference stream, at
    /// `offset`.
    void follow(qpdf_offset_t offset) {
        file_->seek(start_ + offset, SEEK_SET);
        Token token = next();
        const bool is_table = token.isWord("xref");
        const char* const before = is_table ? "trailer" : "obj";
        while (!token.isWord(before) && token.getType() != QPDFTokenizer::tt_eof)
            token = next();
        auto dictionary = read_dictionary();
        if (!dictionary) return;
        for (const char* key : {"/Prev", "/XRefStm"}) {
            QPDFObjectHandle place = dictionary->getKey(key);
            if (place.isInteger()) waiting_.insert(place.getIntValue());
        }
        if (!is_table && next().isWord("stream")) count_stream(*dictionary);
    }

    /// Adds the unpacked size of a stream. Must be called right after `dictionary` has been read,
    /// because the data follow at the current position.
    void count_stream(QPDFObjectHandle dictionary) {
        QPDFObjectHandle length = dictionary.getKey("/Length");
        if (!length.isInteger() || length.getIntValue() < 0) {
            throw Error("damaged PDF: the length of its list of objects is not known");
        }
        constexpr qpdf_offset_t kLineBreak = 2;
        const qpdf_offset_t size = std::min<qpdf_offset_t>(length.getIntValue(), size_);
        std::string bytes = text(file_->tell(), size + kLineBreak);
        bytes.erase(0, bytes.find_first_not_of("\r\n"));
        QPDFObjectHandle stream = QPDFObjectHandle::newStream(&stray_, bytes);
        for (const char* key : {"/Filter", "/DecodeParms"}) {
            if (dictionary.hasKey(key)) stream.getDict().replaceKey(key, dictionary.getKey(key));
        }
        unpacked_.start_page();
        unpacked_.count(stream);
    }

    /// Reads the dictionary at the current position. Returns an empty optional if there is no
    /// dictionary.
    std::optional<QPDFObjectHandle> read_dictionary() {
        const qpdf_offset_t begin = file_->tell();
        int level = 0;
        do {
            const auto type = next().getType();
            if (type == QPDFTokenizer::tt_eof) return std::nullopt;
            level += type == QPDFTokenizer::tt_dict_open ? 1 : 0;
            level -= type == QPDFTokenizer::tt_dict_close ? 1 : 0;
        } while (level > 0);
        const qpdf_offset_t end = file_->tell();
        QPDFObjectHandle dictionary = QPDFObjectHandle::parse(&stray_, text(begin, end - begin));
        file_->seek(end, SEEK_SET);
        return dictionary.isDictionary() ? std::optional(dictionary) : std::nullopt;
    }

    std::shared_ptr<InputSource> file_;
    QPDFTokenizer tokenizer_;
    QPDF stray_;  ///< empty document that owns the streams, because qpdf requires an owner
    UnpackedBytes& unpacked_;
    qpdf_offset_t size_ = 0;
    qpdf_offset_t start_ = 0;
    std::set<qpdf_offset_t> waiting_;
    std::set<qpdf_offset_t> seen_;
};

}  // namespace

void count_cross_references(const std::filesystem::path& path, UnpackedBytes& unpacked) {
    try {
        CrossReferences(path, unpacked).count();
    } catch (const QPDFExc&) {
        return;  // qpdf reports the same fault when it opens the document
    }
}

}  // namespace dotpose::print
