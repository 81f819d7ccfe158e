#include "dotpose/tools/image_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "images/image_format.hpp"
#include "png/png.hpp"
#include "system/files.hpp"

namespace dotpose {
namespace {

using images::ImageFormat;
using Bytes = std::vector<std::uint8_t>;

/// Returns the maximum size of a file in bytes. A limit is needed because a pipe or device may be
/// endless. The limit exceeds the size of any image of `max_pixels` pixels with four 16-bit
/// channels.
std::size_t max_file_bytes(int max_pixels) {
    return std::size_t{8} * static_cast<std::size_t>(max_pixels) + (std::size_t{1} << 20);
}

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

std::string system_reason() {
    switch (errno) {
        case ENOENT:
            return "no such file";
        case EACCES:
            return "permission denied";
        case EISDIR:
            return "it is a directory";
        default:
            return std::strerror(errno);
    }
}

void append(std::FILE* file, std::size_t count, Bytes& bytes) {
    const std::size_t before = bytes.size();
    bytes.resize(before + count);
    errno = 0;
    const std::size_t got = std::fread(bytes.data() + before, 1, count, file);
    if (std::ferror(file) != 0) throw Error(system_reason());
    bytes.resize(before + got);
}

struct Content {
    const ImageFormat& format;
    Bytes bytes;
};

/// Returns advice for the user if the file is of a known type other than an image. Otherwise,
/// returns an empty string.
std::string advice_for(const Bytes& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("%PDF"))
        return ", but a PDF: make an image of a page, for example with pdftoppm -r 600 -png";
    if (text.starts_with("<?xml") || text.starts_with("<svg"))
        return ", but a drawing: make an image of it, for example with rsvg-convert --zoom 4";
    if (text.starts_with("{")) return ", but JSON: a sheet file is given with --sheets";
    return {};
}

Content read_file(const std::filesystem::path& path, int max_pixels) {
    const File file(system::open_file(path, "rb"));
    if (!file) throw Error(system_reason());
    Bytes bytes;
    append(file.get(), images::kMagicBytes, bytes);
    if (bytes.empty()) throw Error("the file is empty");
    const ImageFormat* format = images::format_of(bytes);
    const auto* other = format != nullptr ? nullptr : images::other_format_of(bytes);
    if (other != nullptr) {
        throw Error(std::string(other->name) +
                    ", which is not read: convert it first, for example with " + other->remedy);
    }
    if (format == nullptr) {
        throw Error("not a PNM, PNG, JPEG, BMP, TIFF, WebP or HEIC image" + advice_for(bytes));
    }
    // Pipes have no size, so the file is read to its end.
    const std::size_t max_bytes = max_file_bytes(max_pixels);
    std::size_t chunk = std::size_t{1} << 16;
    while (std::feof(file.get()) == 0) {
        if (bytes.size() > max_bytes) {
            throw Error("the file is larger than an image of " +
                        std::to_string(max_pixels / 1'000'000) + " million px takes");
        }
        append(file.get(), chunk, bytes);
        chunk = std::min(bytes.size(), max_bytes);
    }
    return {*format, std::move(bytes)};
}

void write_file(const std::filesystem::path& path, const Bytes& bytes) {
    File file(system::open_file(path, "wb"));
    const bool written =
        file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    // fclose flushes the buffer, so it fails if the disk is full.
    const bool closed = file && std::fclose(file.release()) == 0;
    if (!written || !closed) throw Error(system_reason());
}

void require_pixels(ImageView image) {
    if (image.pixels == nullptr || image.width_px <= 0 || image.height_px <= 0)
        throw Error("the image is empty");
}

/// Runs `action` and adds the file name to its error messages.
template <class Action>
auto with_name(const char* verb, const std::filesystem::path& path, Action action) {
    const auto sentence = [&](const char* reason) {
        return std::string("cannot ") + verb + " " + path.string() + ": " + reason;
    };
    try {
        return action();
    } catch (const ImageTooLarge& error) {
        throw ImageTooLarge(sentence(error.what()), error.width_px, error.height_px);
    } catch (const Error& error) {
        throw Error(sentence(error.what()));
    } catch (const std::bad_alloc&) {
        throw Error(sentence("not enough memory"));
    }
}

int pages_of(const Content& content) {
    const auto count = content.format.count_pages;
    return count == nullptr ? 1 : std::max(count(content.bytes), 1);
}

/// Throws Error if the file has no page with this number. The message contains only the reason.
void require_page(const Content& content, int page) {
    if (page == 1) return;
    const int pages = pages_of(content);
    if (page >= 1 && page <= pages) return;
    throw Error("it has " + std::to_string(pages) + (pages == 1 ? " page" : " pages") +
                ", and no page " + std::to_string(page));
}

/// Returns true for 72 and 96 dpi. Cameras and programs write these values by default, so they do
/// not indicate the real resolution of the page.
bool is_of_screen(const Resolution& resolution) {
    // PNG and BMP store whole pixels per metre, so the comparison needs a tolerance.
    const auto is = [&](double dpi) {
        return std::abs(resolution.x_dpi - dpi) < 0.1 && std::abs(resolution.y_dpi - dpi) < 0.1;
    };
    return is(72) || is(96);
}

}  // namespace

GreyImage read_image(const std::filesystem::path& path, int max_pixels, int page) {
    std::string note;
    return read_image(path, max_pixels, note, page);
}

GreyImage read_image(const std::filesystem::path& path, int max_pixels, std::string& note,
                     int page) {
    note.clear();
    GreyImage image = with_name("read", path, [&] {
        const Content content = read_file(path, max_pixels);
        require_page(content, page);
        return content.format.decode({content.bytes, page, max_pixels}, note);
    });
    if (!note.empty()) note = path.string() + ": " + note;
    return image;
}

int count_pages(const std::filesystem::path& path) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed)) return 1;
    return with_name("read", path, [&] { return pages_of(read_file(path, kMaxImagePixels)); });
}

ImageOrigin read_origin(const std::filesystem::path& path, int page) {
    return with_name("read", path, [&] {
        const Content content = read_file(path, kMaxImagePixels);
        require_page(content, page);
        ImageOrigin origin = content.format.origin({content.bytes, page});
        const auto& resolution = origin.resolution;
        if (resolution && (origin.is_photo || is_of_screen(*resolution))) origin.resolution.reset();
        return origin;
    });
}

std::vector<std::uint8_t> encode_image(ImageEncoding encoding, ImageView image) {
    require_pixels(image);
    switch (encoding) {
        case ImageEncoding::png:
            return png::encode(image);
        case ImageEncoding::jpeg:
            return images::encode_jpeg(image);
        case ImageEncoding::pgm:
            break;
    }
    return images::encode_pgm(image);
}

void write_pgm(const std::filesystem::path& path, ImageView image) {
    with_name("write", path, [&] { write_file(path, encode_image(ImageEncoding::pgm, image)); });
}

void write_png(const std::filesystem::path& path, ImageView image) {
    with_name("write", path, [&] { write_file(path, encode_image(ImageEncoding::png, image)); });
}

}  // namespace dotpose
