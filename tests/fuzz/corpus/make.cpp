// Generates the seeds of the fuzz targets: dotpose_fuzz_corpus DIRECTORY
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "../../exif.hpp"
#include "../../unit/capture/encoders.hpp"
#include "../locate_input.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/tools/simulate.hpp"
#include "texts.hpp"

namespace {

using namespace dotpose;
using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

void write(const fs::path& path, const Bytes& bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw Error("cannot write " + path.string());
}

Bytes locate_input(const fuzz::LocateHeader& header, const Bytes& rest) {
    Bytes bytes(sizeof header);
    std::memcpy(bytes.data(), &header, sizeof header);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}

GreyImage frame(Preset preset, int side_px, double spacing_px, std::uint64_t index) {
    Setup setup;
    setup.preset = preset;
    setup.camera.width_px = setup.camera.height_px = side_px;
    setup.camera.mm_per_px = kDefaultSpacing_mm / spacing_px;
    return render(draw_shot(setup, index));
}

void make_frames(const fs::path& folder) {
    struct Seed {
        Preset preset;
        int side_px;
        double spacing_px;
        std::uint8_t flags;
    };
    constexpr std::uint8_t kDefault = fuzz::LocateHeader::default_options;
    const Seed seeds[] = {
        {Preset::clean, 64, 6.4, kDefault},
        {Preset::nominal, 72, 7, fuzz::LocateHeader::one_attempt},
        {Preset::nominal, 96, 8, fuzz::LocateHeader::window_decoder},
        {Preset::hard, 96, 8, 0},
        {Preset::nominal, 96, 8, kDefault | fuzz::LocateHeader::own_prediction},
    };
    std::uint64_t n = 0;
    for (const Seed& seed : seeds) {
        fuzz::LocateHeader header;
        header.width_px = header.height_px = static_cast<std::uint16_t>(seed.side_px);
        header.flags = seed.flags;
        GreyImage image = frame(seed.preset, seed.side_px, seed.spacing_px, n);
        // An input ends with the displacement of its prediction. Zero bytes mean no displacement.
        image.pixels.insert(image.pixels.end(), sizeof(Prediction), 0);
        write(folder / ("frame-" + std::to_string(n++)), locate_input(header, image.pixels));
    }
}

void make_drawn(const fs::path& folder) {
    for (std::uint16_t n = 0; n < 3; ++n) {
        fuzz::LocateHeader header;
        header.width_px = 96;
        header.height_px = 80;
        header.code = static_cast<std::uint8_t>(n);
        header.flags = fuzz::LocateHeader::drawn;
        header.angle = static_cast<std::uint16_t>(n * 11000);
        Bytes symbols;
        for (std::uint32_t y = 0; y < fuzz::kDrawnSide; ++y) {
            for (std::uint32_t x = 0; x < fuzz::kDrawnSide; ++x) {
                const Cell cell{1000003u * (n + 1u) + x, 4000037u * (n + 1u) + y};
                symbols.push_back(static_cast<std::uint8_t>(
                    symbol_at(static_cast<CodeVariant>(n), cell, {3, 5})));
            }
        }
        write(folder / ("drawn-" + std::to_string(n)), locate_input(header, symbols));
    }
}

void make_images(const fs::path& folder) {
    constexpr int kSide_px = 12;
    for (const int channels : {1, 3, 4}) {
        test::Raster raster{kSide_px, kSide_px, channels, 8, {}};
        for (int i = 0; i < kSide_px * kSide_px * channels; ++i) {
            raster.samples.push_back(static_cast<std::uint16_t>(i * 37 % 256));
        }
        const std::string stem = "image-" + std::to_string(channels);
        write(folder / (stem + ".png"), test::encode_png(raster));
        write(folder / (stem + ".tif"), test::encode_tiff(raster, channels == 1));
        test::Raster small = raster;
        small.width_px = small.height_px = 2;
        small.samples.resize(static_cast<std::size_t>(4 * channels));
        const Bytes jpeg = test::encode_jpeg(small);
        write(folder / (stem + ".jpg"), jpeg);
        const std::string photo = test::with_exif(
            {jpeg.begin(), jpeg.end()}, test::exif_of({test::f_number}, channels == 1), 2);
        write(folder / (stem + "-photo.jpg"), {photo.begin(), photo.end()});
        if (channels == 4) continue;
        write(folder / (stem + ".pnm"), test::encode_pnm(raster, false, 255));
        write(folder / (stem + "-text.pnm"), test::encode_pnm(small, true, 255));
        if (channels == 3) write(folder / (stem + ".bmp"), test::encode_bmp(raster));
    }
    const std::string stem = (folder / "image-3").string();
    for (const std::string& command :
         {"cwebp -quiet " + stem + ".png -o " + stem + ".webp",
          "cwebp -quiet -lossless " + stem + ".png -o " + stem + "-lossless.webp",
          "heif-enc " + stem + ".png -o " + stem + ".heic",
          "heif-enc " + stem + ".png -o " + stem + ".avif"}) {
        if (std::system(command.c_str()) != 0) throw Error("cannot run " + command);
    }
}

/// Writes one seed for each option in options_fuzz.cpp. Each seed changes only its own option.
void make_options(const fs::path& folder) {
    constexpr std::uint8_t kFields = 20;
    for (std::uint8_t field = 0; field < kFields; ++field) {
        const auto frame = static_cast<std::uint8_t>(field % 3);
        write(folder / ("field-" + std::to_string(field)), {frame, field, 1, 0, 0, 0});
    }
}

/// Writes a small print map without its checksum, which the fuzz target adds.
void make_print_map(const fs::path& folder) {
    MapPage page;
    page.name = "desk";
    page.origin = {2000, 3000};
    page.columns = 8;
    page.rows = 9;
    page.spacing_mm = kDefaultSpacing_mm;
    page.frames = 500;
    page.noise = 0.003;
    page.jitter = 0.02;
    page.offsets.resize(72, {-5, 300});
    page.views.resize(72, 20);
    page.errors = {2, 3, std::vector(6, MapErrors::Node{2e-8F, 1e-9F, 3e-8F, 0, -1e-10F, 1e-11F})};
    std::string bytes = print_map_bytes({{page}});
    write(folder / "page", {bytes.begin(), bytes.end() - 4});
    // Version 1 has no error grid, so the 8 bytes that contain the size of this grid are removed.
    // The checksum (4 bytes) is also removed, because the fuzz target adds it.
    page.errors = {};
    bytes = print_map_bytes({{page}});
    bytes[8] = 1;
    write(folder / "version-1", {bytes.begin(), bytes.end() - 12});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("usage: dotpose_fuzz_corpus DIRECTORY\n", stderr), 2;
    const fs::path folder = argv[1];
    make_frames(folder / "locate");
    make_drawn(folder / "locate");
    make_images(folder / "image_file");
    make_options(folder / "options");
    make_print_map(folder / "print_map");
    for (const fuzz::TextSeed& seed : fuzz::text_seeds())
        write(folder / seed.path, {seed.bytes.begin(), seed.bytes.end()});
}
