#include <cstdio>
#include <filesystem>

#include <dotpose/files/camera_file.hpp>
#include <dotpose/locate.hpp>
#include <dotpose/tools/calibrate.hpp>
#include <dotpose/tools/draw.hpp>
#include <dotpose/tools/image_file.hpp>
#include <dotpose/tools/overlay.hpp>
#include <dotpose/tools/print.hpp>
#include <dotpose/tools/simulate.hpp>

namespace {

using namespace dotpose;

void print(const std::filesystem::path& folder) {
    SheetOptions options;
    options.paper = {20, 20};
    const Sheet sheet = make_sheet(options);
    for (const char* name : {"sheet.svg", "sheet.tif", "sheet.pdf"})
        write_sheet(sheet, folder / name);
    const OverlayReport report = overlay_pdf(folder / "sheet.pdf", folder / "twice.pdf");
    std::printf("%d x %d dots on %zu page\n", sheet.columns, sheet.rows, report.pages.size());
}

bool locate_simulated(const std::filesystem::path& folder) {
    const Shot shot = draw_shot(Setup{}, 0);
    write_png(folder / "frame.png", render(shot).view());
    const GreyImage image = read_image(folder / "frame.png");
    Locator locator;
    const Fix fix = locator.locate(image.view());
    draw_frame(folder / "drawn.png", image.view(), locator.trace());
    std::printf("%s: %s\n", name(fix.status), message(fix.status));
    return fix.status == Status::ok && fix.cell == shot.pose.cell;
}

bool calibrate(const std::filesystem::path& folder) {
    const auto frame_at = [](int i) { return render(draw_shot(Setup{}, i)); };
    const LensCalibration lens = calibrate_lens(kWantedFrames, frame_at, {});
    write_camera(folder / "camera.yaml", lens.camera);
    const Camera camera = read_camera(folder / "camera.yaml");
    std::printf("%s, %d px wide\n", name(lens.verdict), camera.width_px);
    return camera.width_px == lens.camera.width_px;
}

}  // namespace

// Uses each library that the tools depend on, to check that it is found, links and runs.
int main() {
    const std::filesystem::path folder = "consumer-out";
    std::filesystem::create_directories(folder);
    print(folder);
    return locate_simulated(folder) && calibrate(folder) ? 0 : 1;
}
