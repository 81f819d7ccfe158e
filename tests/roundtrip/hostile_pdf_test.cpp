// Tests documents that are designed to exhaust stack, memory or time.
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "../temporary_directory.hpp"
#include "dotpose/tools/overlay.hpp"
#include "small_pdf.hpp"

namespace dotpose::roundtrip {
namespace {

using testing::HasSubstr;

constexpr const char* kCatalogue = "<< /Type /Catalog /Pages 2 0 R >>";
constexpr int kDeep = 9000;

/// Compresses data `times` times for the FlateDecode filter.
std::string packed(std::string data, int times = 1) {
    for (int i = 0; i < times; ++i) {
        uLongf size = compressBound(data.size());
        std::string out(size, '\0');
        compress(reinterpret_cast<Bytef*>(out.data()), &size,
                 reinterpret_cast<const Bytef*>(data.data()), data.size());
        data = out.substr(0, size);
    }
    return data;
}

std::string stream_with(const std::string& keys, const std::string& data) {
    return fmt::format("<< /Length {} {} >>\nstream\n{}\nendstream", data.size(), keys, data);
}

/// Returns the objects of a one-page document. `more` contains the objects numbered from 5.
std::vector<std::string> page_with(const std::string& keys, const std::string& content = stream(""),
                                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> objects = {
        kCatalogue, "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 200 100] /Contents 4 0 R " + keys + " >>",
        content};
    objects.insert(objects.end(), more.begin(), more.end());
    return objects;
}

/// Returns objects numbered from 5, each of which refers to the next object. `names(number)`
/// returns the text of an object that refers to object `number`.
std::vector<std::string> chain(const std::function<std::string(int)>& names) {
    std::vector<std::string> objects;
    for (int number = 5; number < 5 + kDeep; ++number)
        objects.push_back(names(number + 1));
    objects.emplace_back("1");
    return objects;
}

std::vector<std::string> forms(const std::string& content) {
    return chain([&](int next) {
        return stream_with(fmt::format("/Type /XObject /Subtype /Form /BBox [0 0 9 9] /Resources "
                                       "<< /XObject << /A {} 0 R >> >>",
                                       next),
                           content);
    });
}

class HostileDocument : public testing::Test {
  protected:
    HostileDocument() { change_colours_.black_to_cmy = true; }

    void expect_refused(const std::vector<std::string>& objects, const std::string& reason,
                        const OverlayOptions& options = {}) {
        write_pdf(in_, objects);
        EXPECT_THAT([&] { overlay_pdf(in_, out_, options); },
                    testing::ThrowsMessage<Error>(HasSubstr(reason)));
        EXPECT_FALSE(std::filesystem::exists(out_));
    }

    OverlayReport overlaid(const std::vector<std::string>& objects,
                           const OverlayOptions& options = {}) {
        write_pdf(in_, objects);
        return overlay_pdf(in_, out_, options);
    }

    test::TemporaryDirectory directory_;
    std::filesystem::path in_ = directory_.path() / "in.pdf";
    std::filesystem::path out_ = directory_.path() / "out.pdf";
    OverlayOptions change_colours_;
};

TEST_F(HostileDocument, depth_is_bounded_and_named) {
    std::vector<std::string> tree = {kCatalogue};
    for (int number = 2; number < 2 + kDeep; ++number)
        tree.push_back(fmt::format("<< /Type /Pages /Kids [{} 0 R] /Count 1 >>", number + 1));
    tree.emplace_back("<< /Type /Page /MediaBox [0 0 200 100] >>");
    expect_refused(tree, "in.pdf: its groups of pages are nested deeper than 100 levels");

    const char* const kDraws = "/Resources << /XObject << /A 5 0 R >> >>";
    expect_refused(page_with(kDraws, stream("/A Do"), forms("/A Do")),
                   "in.pdf, page 1: its forms are nested deeper than 100 levels");
    // If colours are changed, forms that are not drawn are also converted.
    expect_refused(page_with(kDraws, stream(""), forms("")),
                   "in.pdf, page 1: its resources are nested deeper than 100 levels",
                   change_colours_);
    expect_refused(
        page_with("/Resources << /Pattern << /A 5 0 R >> >>", stream(""), chain([](int next) {
                      return stream_with(fmt::format("/PaintType 1 /Resources << /Pattern << /A {} "
                                                     "0 R >> >>",
                                                     next),
                                         "");
                  })),
        "in.pdf, page 1: its resources are nested deeper than 100 levels", change_colours_);

    expect_refused(page_with("/X " + std::string(100'000, '[')),
                   "in.pdf: its objects are nested too deeply");
    expect_refused(page_with("", stream(std::string(100'000, '['))),
                   "in.pdf, page 1: its arrays are nested deeper than 100 levels");
    expect_refused(page_with("/Resources 5 0 R", stream(""), chain([](int next) {
                                 return fmt::format("<< /Length {} 0 R >>\nstream\nx\nendstream",
                                                    next);
                             })),
                   "in.pdf: its objects are nested too deeply");
}

TEST_F(HostileDocument, depth_that_nobody_follows_does_no_harm) {
    std::vector<std::string> outlines = page_with(
        "", stream(""),
        chain([](int next) { return fmt::format("<< /Title (a) /First {} 0 R >>", next); }));
    outlines[0] = "<< /Type /Catalog /Pages 2 0 R /Outlines 5 0 R /Names << /Dests 5 0 R >> >>";
    EXPECT_EQ(overlaid(outlines).pages.size(), 1U);
    EXPECT_EQ(overlaid(page_with("/Resources << /XObject << /A 5 0 R >> >>",
                                 stream("[[[[[[[[[(a)]]]]]]]]] TJ"), forms("")))
                  .pages.size(),
              1U);
}

TEST_F(HostileDocument, unpacked_content_is_bounded) {
    OverlayOptions options;
    options.max_content_mb = 2;
    const std::string blanks = std::string(3 << 20, ' ');
    const std::string reason =
        "in.pdf, page 1: its content takes more than 2 MB when it is unpacked";
    const char* const kOnce = "/Filter /FlateDecode";
    const char* const kTwice = "/Filter [/FlateDecode /FlateDecode]";
    expect_refused(page_with("", stream_with(kOnce, packed(blanks))), reason, options);
    expect_refused(page_with("", stream_with(kTwice, packed(blanks, 2))), reason, options);
    const char* const kDraws = "/Resources << /XObject << /A 5 0 R >> >>";
    const std::string form = "/Type /XObject /Subtype /Form /BBox [0 0 9 9] ";
    expect_refused(page_with(kDraws, stream("/A Do"), {stream_with(form + kOnce, packed(blanks))}),
                   reason, options);
    options.black_to_cmy = true;
    expect_refused(page_with(kDraws, stream(""), {stream_with(form + kOnce, packed(blanks))}),
                   reason, options);
    options.max_content_mb = 4;
    EXPECT_EQ(overlaid(page_with("", stream_with(kOnce, packed(blanks))), options).pages.size(),
              1U);
}

TEST_F(HostileDocument, the_content_of_all_pages_is_bounded) {
    std::vector<std::string> objects = {kCatalogue, "<< /Type /Pages /Kids ["};
    for (int i = 0; i < 9; ++i)
        objects[1] += "4 0 R ";
    objects[1] += "] /Count 9 >>";
    objects.push_back(
        stream_with("/Filter /FlateDecode", packed(std::string((1 << 20) - 10, ' '))));
    objects.emplace_back("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 200 100] /Contents 3 0 R >>");
    OverlayOptions options;
    options.max_content_mb = 1;
    expect_refused(
        objects,
        "in.pdf, page 9: the content of the pages so far takes more than 8 MB when it is "
        "unpacked",
        options);
}

/// Returns a document with a cross-reference stream that has these keys and data.
std::string with_cross_reference_stream(const std::string& keys, const std::string& data) {
    const std::string catalogue = "%PDF-1.5\n1 0 obj\n<< /Type /Catalog >>\nendobj\n";
    return fmt::format(
        "{}2 0 obj\n<< /Type /XRef /Size 3 /Root 1 0 R /W [1 2 1] {} /Length {} >>\n"
        "stream\n{}\nendstream\nendobj\nstartxref\n{}\n%%EOF\n",
        catalogue, keys, data.size(), data, catalogue.size());
}

TEST_F(HostileDocument, lists_of_objects_are_bounded) {
    const auto write = [&](const std::string& text) {
        std::ofstream(in_, std::ios::binary) << text;
    };
    const auto expect = [&](const std::string& reason) {
        OverlayOptions options;
        options.max_content_mb = 2;
        EXPECT_THAT([&] { overlay_pdf(in_, out_, options); },
                    testing::ThrowsMessage<Error>(HasSubstr(reason)));
    };
    const std::string too_much = "in.pdf: its content takes more than 2 MB when it is unpacked";
    const std::string zeros(3 << 20, '\0');
    write(with_cross_reference_stream("/Filter /FlateDecode", packed(zeros)));
    expect(too_much);
    const std::string twice =
        with_cross_reference_stream("/Filter [/FlateDecode /FlateDecode]", packed(zeros, 2));
    write("junk in front\n" + twice);
    expect(too_much);
    // The limit also applies to an older cross-reference stream that a table points to.
    for (const char* key : {"Prev", "XRefStm"}) {
        const std::size_t place = twice.find("2 0 obj");
        write(twice + fmt::format("xref\n0 1\n0000000000 65535 f \ntrailer\n<< /Size 3 /Root 1 0 R "
                                  "/{} {} >>\nstartxref\n{}\n%%EOF\n",
                                  key, place, twice.size()));
        expect(too_much);
    }
    write(with_cross_reference_stream("/Filter /FlateDecode", packed(std::string(12, '\0'))));
    expect("in.pdf");
    // In these documents, the cross-reference table or stream is truncated.
    for (const char* cut : {"xref\n0 1\n", "2 0 obj\n", "2 0 obj\n<< /Type (", "trailer <<"}) {
        write(std::string("%PDF-1.5\n") + cut + "\nstartxref\n9\n%%EOF\n");
        expect("in.pdf: damaged PDF");
    }
    // This offset does not fit into an integer.
    write("%PDF-1.5\nxref\n0 1\nstartxref\n" + std::string(60, '7') + "\n%%EOF\n");
    expect("in.pdf: damaged PDF");
}

TEST_F(HostileDocument, filters_and_their_rows_are_bounded) {
    std::string filters;
    for (int i = 0; i < 1000; ++i)
        filters += "/FlateDecode ";
    expect_refused(page_with("", stream_with("/Filter [" + filters + "]", "x")),
                   "page 1: it has content compressed 1000 times; at most 8 times are supported");
    expect_refused(page_with("", stream_with("/Filter /FlateDecode /DecodeParms "
                                             "<< /Predictor 12 /Columns 500000000 /Colors 4 >>",
                                             packed("x"))),
                   "page 1: it has content compressed in rows of 2.5e+08 bytes");
}

TEST_F(HostileDocument, what_is_not_drawn_stays_packed) {
    const std::string bomb = packed(std::string(64 << 20, ' '), 2);
    std::vector<std::string> objects = page_with(
        "", stream(""),
        {stream_with("/Type /Metadata /Subtype /XML /Filter [/FlateDecode /FlateDecode]", bomb),
         stream_with("/Filter [/FlateDecode /FlateDecode]", bomb)});
    objects[0] = "<< /Type /Catalog /Pages 2 0 R /Metadata 5 0 R /X 6 0 R >>";
    EXPECT_EQ(overlaid(objects).pages.size(), 1U);
    EXPECT_LT(std::filesystem::file_size(out_), 200'000U);
}

TEST_F(HostileDocument, pages_of_many_metres_are_refused) {
    expect_refused(page_with("/UserUnit 1000"), "in.pdf, page 1: a page of 70556 x 35278 mm needs");
}

TEST_F(HostileDocument, pages_without_content_have_no_colours_to_change) {
    for (const char* contents : {"", "/Contents []", "/Contents null", "/Contents [(x)]"}) {
        EXPECT_EQ(overlaid({kCatalogue, "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
                            fmt::format("<< /Type /Page /MediaBox [0 0 200 100] {} >>", contents)},
                           change_colours_)
                      .pages.size(),
                  1U)
            << contents;
    }
}

TEST_F(HostileDocument, turns_that_readers_do_not_agree_on_are_refused) {
    for (const char* degrees : {"45", "89.5", "1"}) {
        expect_refused(page_with(fmt::format("/Rotate {}", degrees)),
                       fmt::format("in.pdf, page 1: it is turned by {} degrees", degrees));
    }
}

TEST_F(HostileDocument, inline_images_without_an_end_are_refused) {
    const std::string image = "BI /W 10 /H 10 /BPC 8 /CS /G ID " + std::string(100, 'x');
    const std::string reason =
        "in.pdf, page 1: damaged PDF: its content cannot be read: an inline image has no end";
    expect_refused(page_with("", stream(image)), reason);
    expect_refused(page_with("", stream(image)), reason, change_colours_);
    EXPECT_EQ(overlaid(page_with("", stream(image + "\nEI"))).pages.size(), 1U);
}

TEST_F(HostileDocument, endless_files_are_refused) {
    EXPECT_THAT([&] { overlay_pdf("/dev/zero", out_); },
                testing::ThrowsMessage<Error>(HasSubstr("pipes and devices")));
    EXPECT_THAT([&] { overlay_pdf(directory_.path(), out_); },
                testing::ThrowsMessage<Error>(HasSubstr("Is a directory")));
}

}  // namespace
}  // namespace dotpose::roundtrip
