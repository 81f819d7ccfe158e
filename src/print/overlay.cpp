#include "dotpose/tools/overlay.hpp"

#include <algorithm>
#include <fstream>
#include <memory>
#include <new>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFSystemError.hh>
#include <qpdf/QUtil.hh>

#include "pdf_colours.hpp"
#include "pdf_cross_references.hpp"
#include "pdf_file.hpp"
#include "pdf_limits.hpp"
#include "pdf_page_frame.hpp"
#include "pdf_scan.hpp"
#include "regions.hpp"

namespace dotpose {
namespace fs = std::filesystem;
namespace {

/// Whether "%PDF-" stands among the first 1024 bytes, where readers look for it.
bool begins_like_pdf(const fs::path& path) {
    std::string head(1024, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.find("%PDF-") != std::string::npos;
}

[[noreturn]] void throw_damaged(const fs::path& path, const std::string& reason) {
    if (!begins_like_pdf(path)) {
        throw Error(
            fmt::format("{} is no PDF: save or print the document as a PDF first", path.string()));
    }
    throw Error(fmt::format("{}: damaged PDF: {}; 'qpdf {} repaired.pdf' may mend it",
                            path.string(), reason, path.string()));
}

[[noreturn]] void throw_too_deep(const fs::path& path) {
    throw Error(fmt::format("{}: its objects are nested too deeply", path.string()));
}

/// Returns the warnings of qpdf about faults that it repaired, which the new file no longer has.
/// Throws Error for faults that it cannot repair: it would copy such content unchanged.
std::set<std::string> small_faults(QPDF& pdf, const fs::path& path) {
    std::set<std::string> faults;
    for (const QPDFExc& warning : pdf.getWarnings()) {
        const std::string& detail = warning.getMessageDetail();
        if (print::is_too_deep(detail)) throw_too_deep(path);
        const bool is_in_content = warning.getObject() == "content";
        if (is_in_content || detail.find("stream data") != std::string::npos) {
            throw_damaged(path, detail);
        }
        faults.insert(detail);
    }
    return faults;
}

/// Runs `work` and puts `name` in front of the message of an Error that it throws.
template <typename Work>
void with_name(const std::string& name, const Work& work) {
    try {
        work();
    } catch (const BadArgument& error) {
        throw BadArgument(fmt::format("{}: {}", name, error.what()));
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", name, error.what()));
    }
}

void open(QPDF& pdf, const fs::path& path, const std::string& password,
          print::UnpackedBytes& unpacked) {
    pdf.setSuppressWarnings(true);
    pdf.setAttemptRecovery(false);
    try {
        const auto file = print::open_pdf(path);
        with_name(path.string(), [&] { print::count_cross_references(path, unpacked); });
        pdf.processInputSource(file, password.c_str());
    } catch (const QPDFSystemError& error) {
        throw Error(fmt::format("cannot read {}: {}", path.string(),
                                std::generic_category().message(error.getErrno())));
    } catch (const QPDFExc& error) {
        if (error.getErrorCode() != qpdf_e_password) {
            throw_damaged(path, error.getMessageDetail());
        }
        throw Error(fmt::format(
            "{}: {}", path.string(),
            password.empty() ? "the file is encrypted; a password is needed" : "wrong password"));
    }
}

std::set<int> page_numbers(const std::string& range, int count) {
    if (range.empty()) {
        std::set<int> all;
        for (int number = 1; number <= count; ++number)
            all.insert(number);
        return all;
    }
    try {
        const std::vector<int> numbers = QUtil::parse_numrange(range.c_str(), count);
        return {numbers.begin(), numbers.end()};
    } catch (const std::runtime_error&) {
        throw BadArgument(
            fmt::format("pages '{}': give numbers from 1 to {} such as 1-3,7; z is the last page",
                        range, count));
    }
}

/// Lists page numbers as in "pages 1, 2, 5", but no more than the first few.
std::string page_list(const std::vector<int>& numbers) {
    constexpr std::size_t kShown = 8;
    const auto shown = std::span(numbers).first(std::min(kShown, numbers.size()));
    return fmt::format("page{} {}{}", numbers.size() > 1 ? "s" : "", fmt::join(shown, ", "),
                       numbers.size() > kShown ? " ..." : "");
}

/// Runs `work` and reports what qpdf throws as damage of the document.
template <typename Work>
auto understood(const fs::path& path, const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const QPDFExc& error) {
        throw_damaged(path, error.getMessageDetail());
    } catch (const std::exception& error) {
        throw_damaged(path, error.what());
    }
}

/// Throws Error if the page is so large that it would get too many dots: a document may give its
/// pages any size, through a user unit even kilometres.
void require_few_dots(const Sheet& sheet) {
    constexpr double kMostDots = 5e7;
    const double dots = double{1} * sheet.columns * sheet.rows;
    if (dots <= kMostDots) return;
    throw Error(
        fmt::format("a page of {:.0f} x {:.0f} mm needs {:.0f} million dots; at most {:.0f} "
                    "million are laid on a page",
                    sheet.width_mm, sheet.height_mm, dots / 1e6, kMostDots / 1e6));
}

/// Adds dots to one document.
class Overlay {
  public:
    Overlay(const fs::path& in, const OverlayOptions& options)
        : in_(in),
          options_(options),
          change_{options.black_to_cmy, options.lighten},
          rows_(std::make_shared<print::RowCount>()),
          dots_(pdf_, options.dpi, options.drawing, rows_),
          regions_(options.origin),
          unpacked_(options.max_content_mb),
          colours_(change_, unpacked_) {
        rows_->progress = options.progress;
        open(pdf_, in, options.password, unpacked_);
        with_name(in_.string(), [&] {
            unpacked_.count_object_streams(pdf_);
            print::require_shallow_page_tree(pdf_);
        });
    }

    void add_dots() {
        std::vector<QPDFPageObjectHelper> pages = all_pages();
        if (pages.empty()) throw Error(fmt::format("{}: the document has no pages", in_.string()));
        const auto page = [&](int number) { return pages[static_cast<std::size_t>(number - 1)]; };
        for (const int number : page_numbers(options_.pages, static_cast<int>(pages.size()))) {
            on_page(number, [&] { lay_out(number, page(number)); });
        }
        if (options_.place) options_.place(report_.pages);
        for (const OverlaidPage& laid_out : report_.pages) {
            on_page(laid_out.number, [&] { add_page(laid_out, page(laid_out.number)); });
        }
        warn();
    }

    void write(const fs::path& out) {
        base::OutputFile file(out);
        print::write_document(pdf_, *rows_, file);
        for (const std::string& fault : small_faults(pdf_, in_))
            report_.warnings.push_back("the document had a fault that was mended: " + fault);
        file.commit();
    }

    OverlayReport report() && { return std::move(report_); }

  private:
    std::vector<QPDFPageObjectHelper> all_pages() {
        std::vector<QPDFPageObjectHelper> pages = QPDFPageDocumentHelper(pdf_).getAllPages();
        small_faults(pdf_, in_);
        return pages;
    }

    /// Runs `work` and adds the number of the page to the message of an Error that it throws.
    template <typename Work>
    void on_page(int number, const Work& work) {
        with_name(fmt::format("{}, page {}", in_.string(), number), work);
    }

    void lay_out(int number, const QPDFPageObjectHelper& page) {
        Sheet sheet = make_sheet({.pattern = options_.pattern,
                                  .origin = options_.origin,
                                  .paper = print::page_frame(page).paper,
                                  .margin_mm = options_.margin_mm});
        validate_resolution(sheet, options_.dpi);
        require_few_dots(sheet);
        sheet.origin = regions_.take(sheet.columns, sheet.rows);
        report_.pages.push_back({number, sheet});
    }

    void add_page(const OverlaidPage& laid_out, QPDFPageObjectHelper page) {
        const auto& [number, sheet] = laid_out;
        validate(sheet);
        const print::PageFrame frame = print::page_frame(page);
        const print::PageContent content = print::scan_page(page, unpacked_);
        if (content.paints_black) black_.push_back(number);
        if (content.paints_images) images_.push_back(number);
        if (content.paints_areas) areas_.push_back(number);
        if (!change_.is_none()) colours_.convert(page);
        print::write_turn_as_integer(page);
        draw(page, frame, sheet, content);
    }

    /// Draws the dots over or under the page's own content, whose streams are kept. The operators q
    /// and Q around them restore the graphics state in which the page starts.
    void draw(QPDFPageObjectHelper page, const print::PageFrame& frame, const Sheet& sheet,
              const print::PageContent& content) {
        std::string dots = "q " + frame.matrix + " cm\n";
        for (const std::string& name : add_forms(page, sheet))
            dots += name + " Do\n";
        dots += "Q\n";
        std::string before = "q\n";
        std::string after = "\nQ\n";
        for (int i = 0; i < content.extra_restores; ++i)
            before += "q\n";
        for (int i = 0; i < content.unclosed_saves; ++i)
            after += "Q\n";
        (options_.under ? before : after).insert(options_.under ? 0 : after.size(), dots);
        page.addPageContents(QPDFObjectHandle::newStream(&pdf_, before), true);
        page.addPageContents(QPDFObjectHandle::newStream(&pdf_, after), false);
    }

    /// Adds the dots to the resources of the page as forms and returns the names of the forms.
    std::vector<std::string> add_forms(QPDFPageObjectHelper page, const Sheet& sheet) {
        QPDFObjectHandle resources = page.getAttribute("/Resources", true);
        if (!resources.isDictionary()) {
            resources = QPDFObjectHandle::newDictionary();
            page.getObjectHandle().replaceKey("/Resources", resources);
        }
        // Pages may share the dictionary of objects even if they do not share the resources.
        QPDFObjectHandle shared = resources.getKey("/XObject");
        QPDFObjectHandle objects =
            shared.isDictionary() ? shared.shallowCopy() : QPDFObjectHandle::newDictionary();
        resources.replaceKey("/XObject", objects);
        std::vector<std::string> names;
        int suffix = 1;
        for (const QPDFObjectHandle& form : dots_.forms(sheet)) {
            names.push_back(resources.getUniqueResourceName("/Dots", suffix));
            objects.replaceKey(names.back(), form);
        }
        return names;
    }

    void warn() {
        const auto add = [this](const std::vector<int>& numbers, const char* text) {
            if (!numbers.empty()) report_.warnings.push_back(page_list(numbers) + ": " + text);
        };
        if (!change_.black_to_cmy) {
            add(black_, "black text or drawings hide dots; black can be changed to a CMY mix");
            add(images_, "images may hide dots where they are dark");
        }
        if (options_.under) add(areas_, "filled areas and images cover the dots below them");
        for (const std::string& kind : colours_.left_alone()) {
            report_.warnings.push_back(kind + " were not converted and may hide dots");
        }
        QPDFObjectHandle form = pdf_.getRoot().getKey("/AcroForm");
        if (form.isDictionary() && form.getKey("/SigFlags").isInteger() &&
            form.getKey("/SigFlags").getIntValue() % 2 == 1) {
            report_.warnings.emplace_back(
                "the document is signed: dots make the signature invalid");
        }
    }

    fs::path in_;
    const OverlayOptions& options_;
    print::InkChange change_;
    QPDF pdf_;
    std::shared_ptr<print::RowCount> rows_;
    print::DotContent dots_;
    print::Regions regions_;
    print::UnpackedBytes unpacked_;
    print::ColourConverter colours_;
    OverlayReport report_;
    std::vector<int> black_;
    std::vector<int> images_;
    std::vector<int> areas_;
};

}  // namespace

OverlayReport overlay_pdf(const fs::path& in, const fs::path& out, const OverlayOptions& options) {
    if (!(options.lighten >= 0 && options.lighten < 1)) {
        throw BadArgument(
            fmt::format("lighten by {:g}: it must be at least 0 and under 1", options.lighten));
    }
    std::error_code error;
    if (fs::equivalent(in, out, error)) {
        throw BadArgument(
            fmt::format("{} is the document itself; give the result another name", out.string()));
    }
    return understood(in, [&] {
        Overlay overlay(in, options);
        overlay.add_dots();
        overlay.write(out);
        return std::move(overlay).report();
    });
}

}  // namespace dotpose
