// Any image, with any options and predictions: `locate` ends, touches nothing that is not its own,
// and a fix is a whole and finite one that keeps the limits asked for.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>

#include "dotpose/locate.hpp"
#include "locate_input.hpp"

namespace {

using namespace dotpose;

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "locate_fuzz: %s\n", what);
    std::abort();
}

void check(const Fix& fix, const Options& options) {
    require(static_cast<int>(fix.status) < kStatusCount, "status");
    require(message(fix.status)[0] != '\0', "message");
    if (fix.status != Status::ok) return;
    require(fix.cell.x < kPositionsPerAxis && fix.cell.y < kPositionsPerAxis, "cell");
    require(fix.section.u < kSections && fix.section.v < kSections, "section");
    require(fix.p_wrong_log2 <= options.integrity.max_p_wrong_log2 && fix.p_wrong_log2 <= 0,
            "p_wrong_log2");
    require(fix.dots_seen >= 0 && fix.dots_used > 0, "dots");
    require(fix.bit_errors >= 0, "bit_errors");
    require(fix.spacing_px_q16 > 0, "spacing");
    require(std::isfinite(fix.residual_px) && fix.residual_px >= 0, "residual");
    for (int i = 0; i < 3; ++i) {
        require(fix.covariance[i][i] >= 0, "variance");
        for (int j = 0; j < 3; ++j) {
            require(std::isfinite(fix.covariance[i][j]), "covariance");
            require(fix.covariance[i][j] == fix.covariance[j][i], "symmetric covariance");
        }
    }
}

/// With a workspace that other frames have left their marks in.
Fix push_rows(const ImageView& image, const Options& options, Workspace& workspace) {
    if (begin(image.width_px, image.height_px, options, workspace) != Status::ok) {
        return workspace.fix;
    }
    for (int v = 0; v < image.height_px; ++v)
        push_row(image.row(v), options, workspace);
    return finish(options, workspace);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto kWorkspace = std::make_unique<LargeWorkspace>();
    static const auto kOther = std::make_unique<LargeWorkspace>();
    fuzz::LocateHeader header;
    if (size < sizeof header) return -1;
    std::memcpy(&header, data, sizeof header);
    const Options options = fuzz::options_of(header);
    const std::span<const std::uint8_t> rest{data + sizeof header, size - sizeof header};
    const fuzz::Pixels image = fuzz::pixels_of(header, rest);

    const Fix fix = locate(image.view(), options, *kWorkspace);
    check(fix, options);
    const Prediction prediction = fuzz::prediction_of(header, rest, fix);
    check(locate(image.view(), options, prediction, *kWorkspace), options);
    if (options.effort == Effort::once && (header.flags & fuzz::LocateHeader::rows_pushed) != 0) {
        check(push_rows(image.view(), options, *kOther), options);
    }
    return 0;
}
