// Parses and serialises print maps.
#include "dotpose/files/print_map.hpp"

#include <algorithm>
#include <array>
#include <concepts>

#include <fmt/core.h>

namespace dotpose {
namespace {

constexpr std::string_view kMagic = "DOTPOSEM";
/// Version of the file format. Files with version 1 do not contain the errors of the map.
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kMaxPages = 10'000;
constexpr std::size_t kMaxName = 4096;

/// Returns the CRC-32 checksum of IEEE 802.3, which PNG also uses.
std::uint32_t crc32_of(std::string_view bytes) {
    static const auto kTable = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t i = 0; i < table.size(); ++i) {
            std::uint32_t crc = i;
            for (int bit = 0; bit < 8; ++bit)
                crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
            table[i] = crc;
        }
        return table;
    }();
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char byte : bytes)
        crc = crc >> 8 ^ kTable[(crc ^ static_cast<std::uint8_t>(byte)) & 0xFF];
    return ~crc;
}

template <std::unsigned_integral Number>
void append(std::string& bytes, Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes += static_cast<char>(number >> (8 * i) & 0xFF);
}

// Uses the compiler builtin, because the standard library of emscripten has no std::bit_cast.
void append(std::string& bytes, double number) {
    append(bytes, __builtin_bit_cast(std::uint64_t, number));
}

void append(std::string& bytes, float number) {
    append(bytes, __builtin_bit_cast(std::uint32_t, number));
}

/// Reads numbers from the front of a byte string. Throws Error on an attempt to read past the end.
class Bytes {
  public:
    explicit Bytes(std::string_view text) : text_(text) {}

    std::string_view take(std::size_t count) {
        if (count > text_.size()) throw Error("it is truncated");
        const std::string_view front = text_.substr(0, count);
        text_.remove_prefix(count);
        return front;
    }
    template <std::unsigned_integral Number>
    Number number() {
        Number number = 0;
        int shift = 0;
        for (const char byte : take(sizeof(Number))) {
            number = static_cast<Number>(number | Number{static_cast<std::uint8_t>(byte)} << shift);
            shift += 8;
        }
        return number;
    }
    double real() { return __builtin_bit_cast(double, number<std::uint64_t>()); }
    float single() { return __builtin_bit_cast(float, number<std::uint32_t>()); }
    bool is_empty() const { return text_.empty(); }

  private:
    std::string_view text_;
};

/// Returns the reason why the header of a page is invalid, or an empty string if it is valid.
std::string fault_of(const MapPage& page) {
    if (static_cast<int>(page.code) >= kCodeVariantCount) return "unknown code variant";
    if (page.section.u >= kSections || page.section.v >= kSections) return "unknown section";
    if (page.columns < kMinSheetCells || page.rows < kMinSheetCells ||
        page.origin.x >= kPositionsPerAxis || page.origin.y >= kPositionsPerAxis ||
        page.origin.x + std::uint32_t(page.columns) > kPositionsPerAxis ||
        page.origin.y + std::uint32_t(page.rows) > kPositionsPerAxis)
        return "a region that is not in the plane of the code";
    const auto is_length = [](double length, double max) { return length >= 0 && length <= max; };
    if (!is_length(page.spacing_mm, kMaxPage_mm) || page.spacing_mm == 0 ||
        !is_length(page.noise, 1) || !is_length(page.jitter, 1))
        return "a spacing or a standard deviation out of range";
    return {};
}

/// Returns the number of dots on a page. Throws Error if the number is too large for a file.
/// Computes the product in 64 bits, because std::size_t has only 32 bits in WebAssembly.
std::size_t dots_of(std::uint64_t columns, std::uint64_t rows) {
    if (columns * rows > kMaxMapBytes) throw Error("a page is too large");
    return static_cast<std::size_t>(columns * rows);
}

/// Returns true if the matrix of a node is a valid covariance matrix: the variances are between 0
/// and kMaxVariance, and no correlation exceeds 1 (with a margin for rounding).
bool is_covariance(const MapErrors::Node& node) {
    constexpr float kMaxVariance = 1e6F;
    const auto& [xx, xy, yy, xr, yr, rr] = node;
    const auto is_variance = [](float variance) {
        return variance >= 0 && variance <= kMaxVariance;
    };
    const auto fits = [](float mixed, float a, float b) { return mixed * mixed <= 1.001F * a * b; };
    return is_variance(xx) && is_variance(yy) && is_variance(rr) && fits(xy, xx, yy) &&
           fits(xr, xx, rr) && fits(yr, yy, rr);
}

/// Returns true if the numbers of nodes along the axes are valid: both 0, or both between kMinNodes
/// and kMaxErrorNodes.
bool is_error_grid(std::uint32_t columns, std::uint32_t rows) {
    constexpr std::uint32_t kMinNodes = 2;
    const auto is_number = [](std::uint32_t n) { return n >= kMinNodes && n <= kMaxErrorNodes; };
    return (columns == 0 && rows == 0) || (is_number(columns) && is_number(rows));
}

MapErrors parse_errors(Bytes& bytes) {
    MapErrors errors;
    const auto columns = bytes.number<std::uint32_t>();
    const auto rows = bytes.number<std::uint32_t>();
    if (!is_error_grid(columns, rows)) throw Error("a page has a wrong number of error nodes");
    errors.columns = static_cast<int>(columns);
    errors.rows = static_cast<int>(rows);
    Bytes numbers(bytes.take(std::size_t{columns} * rows * sizeof(MapErrors::Node)));
    errors.nodes.resize(std::size_t{columns} * rows);
    for (MapErrors::Node& node : errors.nodes) {
        for (float& number : node)
            number = numbers.single();
        if (!is_covariance(node)) throw Error("a page has an error that is not a covariance");
    }
    return errors;
}

void append_errors(const MapErrors& errors, std::string& bytes) {
    const auto columns = static_cast<std::uint32_t>(errors.columns);
    const auto rows = static_cast<std::uint32_t>(errors.rows);
    if (!is_error_grid(columns, rows) || errors.nodes.size() != std::size_t{columns} * rows ||
        !std::all_of(errors.nodes.begin(), errors.nodes.end(), is_covariance))
        throw BadArgument("the errors of a print map are not valid");
    append(bytes, columns);
    append(bytes, rows);
    for (const MapErrors::Node& node : errors.nodes) {
        for (const float number : node)
            append(bytes, number);
    }
}

MapPage parse_page(Bytes& bytes, std::uint32_t version) {
    MapPage page;
    const std::size_t name_bytes = bytes.number<std::uint32_t>();
    if (name_bytes > kMaxName) throw Error("a name is too long");
    page.name = bytes.take(name_bytes);
    page.code = static_cast<CodeVariant>(bytes.number<std::uint8_t>());
    page.section.u = bytes.number<std::uint8_t>();
    page.section.v = bytes.number<std::uint8_t>();
    page.origin.x = bytes.number<std::uint32_t>();
    page.origin.y = bytes.number<std::uint32_t>();
    const auto columns = bytes.number<std::uint32_t>();
    const auto rows = bytes.number<std::uint32_t>();
    if (columns > kPositionsPerAxis || rows > kPositionsPerAxis) throw Error("a page is too large");
    page.columns = static_cast<int>(columns);
    page.rows = static_cast<int>(rows);
    page.spacing_mm = bytes.real();
    page.frames = bytes.number<std::uint32_t>();
    page.noise = bytes.real();
    page.jitter = bytes.real();
    if (const std::string fault = fault_of(page); !fault.empty())
        throw Error(fmt::format("a page has {}", fault));
    // Checks that all bytes are present before allocating the vectors, because the sizes in the
    // file may be wrong.
    const std::size_t dots = dots_of(columns, rows);
    Bytes offsets(bytes.take(4 * dots));
    const std::string_view views = bytes.take(dots);
    page.offsets.resize(dots);
    for (DotOffset& offset : page.offsets) {
        offset.x_q14 = static_cast<std::int16_t>(offsets.number<std::uint16_t>());
        offset.y_q14 = static_cast<std::int16_t>(offsets.number<std::uint16_t>());
    }
    page.views.assign(views.begin(), views.end());
    if (version > 1) page.errors = parse_errors(bytes);
    return page;
}

void append_page(const MapPage& page, std::string& bytes) {
    const std::uint64_t dots = std::uint64_t(page.columns) * std::uint64_t(page.rows);
    const std::string fault = fault_of(page);
    if (!fault.empty() || page.name.size() > kMaxName || page.offsets.size() != dots ||
        page.views.size() != dots)
        throw BadArgument("a page of a print map is not valid");
    append(bytes, static_cast<std::uint32_t>(page.name.size()));
    bytes += page.name;
    append(bytes, static_cast<std::uint8_t>(page.code));
    append(bytes, page.section.u);
    append(bytes, page.section.v);
    append(bytes, page.origin.x);
    append(bytes, page.origin.y);
    append(bytes, static_cast<std::uint32_t>(page.columns));
    append(bytes, static_cast<std::uint32_t>(page.rows));
    append(bytes, page.spacing_mm);
    append(bytes, page.frames);
    append(bytes, page.noise);
    append(bytes, page.jitter);
    for (const DotOffset& offset : page.offsets) {
        append(bytes, static_cast<std::uint16_t>(offset.x_q14));
        append(bytes, static_cast<std::uint16_t>(offset.y_q14));
    }
    bytes.append(page.views.begin(), page.views.end());
    append_errors(page.errors, bytes);
}

}  // namespace

std::array<std::array<double, 3>, 3> MapPage::error_covariance(const Place& place) const {
    std::array<std::array<double, 3>, 3> result{};
    const auto index = index_of(place);
    if (!index || errors.nodes.empty()) return result;
    const double u = static_cast<double>(*index % std::size_t(columns)) / std::max(columns - 1, 1) *
                     (errors.columns - 1);
    const double v = static_cast<double>(*index / std::size_t(columns)) / std::max(rows - 1, 1) *
                     (errors.rows - 1);
    const int i = std::min(static_cast<int>(u), errors.columns - 2);
    const int j = std::min(static_cast<int>(v), errors.rows - 2);
    MapErrors::Node sum{};
    for (const auto& [di, dj] : {std::array{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const double weight = (di == 1 ? u - i : 1 - (u - i)) * (dj == 1 ? v - j : 1 - (v - j));
        const auto node = static_cast<std::size_t>((j + dj) * errors.columns + i + di);
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += static_cast<float>(weight) * errors.nodes[node][k];
    }
    const auto& [xx, xy, yy, xr, yr, rr] = sum;
    return {{{xx, xy, xr}, {xy, yy, yr}, {xr, yr, rr}}};
}

const MapPage* find_page(const PrintMap& map, CodeVariant code, const Place& place) {
    for (const MapPage& page : map.pages) {
        if (page.code == code && page.index_of(place)) return &page;
    }
    return nullptr;
}

PrintMap parse_print_map(std::string_view text) {
    constexpr std::size_t kSumBytes = 4;
    if (!text.starts_with(kMagic)) throw Error("it is not a print map of dotpose");
    Bytes bytes(text);
    bytes.take(kMagic.size());
    const auto version = bytes.number<std::uint32_t>();
    if (version == 0 || version > kVersion)
        throw Error(fmt::format(
            "it has version {}, and this program reads versions 1 to {}: update dotpose, or make "
            "the map again",
            version, kVersion));
    if (text.size() < kMagic.size() + 2 * kSumBytes) throw Error("it is truncated");
    Bytes sum(text.substr(text.size() - kSumBytes));
    if (crc32_of(text.substr(0, text.size() - kSumBytes)) != sum.number<std::uint32_t>())
        throw Error("it is truncated or damaged: its checksum is wrong; make the map again");
    const auto pages = bytes.number<std::uint32_t>();
    if (pages > kMaxPages) throw Error("it has too many pages");
    PrintMap map;
    for (std::uint32_t i = 0; i < pages; ++i)
        map.pages.push_back(parse_page(bytes, version));
    bytes.take(kSumBytes);
    if (!bytes.is_empty()) throw Error("it has bytes after its last page");
    return map;
}

std::string print_map_bytes(const PrintMap& map) {
    std::string bytes(kMagic);
    append(bytes, kVersion);
    append(bytes, static_cast<std::uint32_t>(map.pages.size()));
    for (const MapPage& page : map.pages)
        append_page(page, bytes);
    append(bytes, crc32_of(bytes));
    return bytes;
}

}  // namespace dotpose
