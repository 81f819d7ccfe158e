#include "scanned_page.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "dotpose/code.hpp"

namespace dotpose::test {
namespace {

/// Maps positions on the sheet to pixel coordinates in the scan. The page is rotated about its
/// centre, which is at the centre of the scan.
class ScanGeometry {
  public:
    ScanGeometry(double width_mm, double height_mm, const ScanSettings& settings)
        : s_(settings),
          centre_x_mm_(width_mm / 2),
          centre_y_mm_(height_mm / 2),
          width_px_(static_cast<int>(std::lround(width_mm * settings.dpi / 25.4))),
          height_px_(static_cast<int>(std::lround(height_mm * settings.dpi / 25.4))) {}

    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    void see(double x_mm, double y_mm, double& u_px, double& v_px) const {
        const double down_mm = s_.scale_y * (y_mm - centre_y_mm_);
        const double x = s_.scale_x * (x_mm - centre_x_mm_) - std::sin(s_.skew_rad) * down_mm;
        const double y = std::cos(s_.skew_rad) * down_mm;
        const double c = std::cos(s_.rotation_rad);
        const double s = std::sin(s_.rotation_rad);
        const double along = s * x + c * y;
        const double wave = s_.wave_mm * std::sin(2 * std::numbers::pi * along / 100);
        const double per_mm = s_.dpi / 25.4;
        u_px = (c * x - s * y) * per_mm + 0.5 * (width_px_ - 1);
        v_px = (along + wave) * per_mm + 0.5 * (height_px_ - 1);
    }

  private:
    ScanSettings s_;
    double centre_x_mm_;
    double centre_y_mm_;
    int width_px_;
    int height_px_;
};

/// The ink coverage of each pixel of a scan: 0 for paper, 1 for ink.
class InkLayer {
  public:
    InkLayer(int width_px, int height_px)
        : width_(width_px),
          height_(height_px),
          ink_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

    /// Draws a disc with 8 x 8 samples per pixel.
    void disc(double u_px, double v_px, double radius_px) {
        constexpr int kSamples = 8;
        const int reach = static_cast<int>(std::ceil(radius_px + 1));
        const int u0 = static_cast<int>(std::lround(u_px));
        const int v0 = static_cast<int>(std::lround(v_px));
        for (int v = std::max(v0 - reach, 0); v <= std::min(v0 + reach, height_ - 1); ++v) {
            for (int u = std::max(u0 - reach, 0); u <= std::min(u0 + reach, width_ - 1); ++u) {
                int inside = 0;
                for (int k = 0; k < kSamples * kSamples; ++k) {
                    const double x = u - u_px + (k % kSamples + 0.5) / kSamples - 0.5;
                    const double y = v - v_px + (k / kSamples + 0.5) / kSamples - 0.5;
                    inside += x * x + y * y <= radius_px * radius_px ? 1 : 0;
                }
                float& ink = at(u, v);
                ink = std::max(ink, static_cast<float>(inside) / (kSamples * kSamples));
            }
        }
    }

    void blur(double sigma_px) {
        const int reach = static_cast<int>(std::ceil(3.5 * sigma_px));
        if (reach == 0) return;
        std::vector<float> kernel;
        float sum = 0;
        for (int k = -reach; k <= reach; ++k) {
            kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma_px * sigma_px))));
            sum += kernel.back();
        }
        for (float& weight : kernel)
            weight /= sum;
        for (const bool along_rows : {true, false}) {
            const std::vector<float> before = ink_;
            for (int v = 0; v < height_; ++v) {
                for (int u = 0; u < width_; ++u) {
                    float value = 0;
                    for (int k = -reach; k <= reach; ++k) {
                        const int x = along_rows ? std::clamp(u + k, 0, width_ - 1) : u;
                        const int y = along_rows ? v : std::clamp(v + k, 0, height_ - 1);
                        value +=
                            kernel[static_cast<std::size_t>(k + reach)] *
                            before[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                   static_cast<std::size_t>(x)];
                    }
                    at(u, v) = value;
                }
            }
        }
    }

    GreyImage develop(const ScanSettings& s, std::mt19937& random) const {
        std::normal_distribution<double> noise(0, s.noise_sigma);
        GreyImage image{{}, width_, height_};
        image.pixels.reserve(ink_.size());
        for (const float ink : ink_) {
            const double level = s.paper_level + double(ink) * (s.ink_level - s.paper_level) +
                                 (s.noise_sigma > 0 ? noise(random) : 0);
            image.pixels.push_back(
                static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L)));
        }
        return image;
    }

  private:
    float& at(int u, int v) {
        return ink_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(u)];
    }
    int width_;
    int height_;
    std::vector<float> ink_;
};

}  // namespace

GreyImage scan_page(std::span<const Sheet> sheets, const ScanSettings& settings) {
    const ScanGeometry geometry(sheets[0].width_mm, sheets[0].height_mm, settings);
    InkLayer ink(geometry.width_px(), geometry.height_px());
    std::mt19937 random(settings.seed);
    std::normal_distribution<double> jitter(0, settings.jitter_mm);
    std::uniform_real_distribution<double> chance(0, 1);
    for (const Sheet& sheet : sheets) {
        const Pattern& pattern = sheet.pattern;
        const double radius_px = 0.5 * pattern.dot_mm * settings.dot_growth * settings.dpi / 25.4;
        for (int j = 0; j < sheet.rows; ++j) {
            for (int i = 0; i < sheet.columns; ++i) {
                if (chance(random) < settings.missing) continue;
                const Cell cell{sheet.origin.x + static_cast<std::uint32_t>(i),
                                sheet.origin.y + static_cast<std::uint32_t>(j)};
                const Symbol symbol = symbol_at(pattern.code, cell, pattern.section);
                double u_px = 0;
                double v_px = 0;
                geometry.see(sheet.origin_x_mm + i * pattern.spacing_mm +
                                 dx(symbol) * pattern.displacement_mm + jitter(random),
                             sheet.origin_y_mm + j * pattern.spacing_mm +
                                 dy(symbol) * pattern.displacement_mm + jitter(random),
                             u_px, v_px);
                ink.disc(u_px, v_px, radius_px);
            }
        }
    }
    ink.blur(settings.blur_sigma_px);
    return ink.develop(settings, random);
}

}  // namespace dotpose::test
