// Port for the AI-Thinker ESP32-CAM (OV2640) with ESP-IDF 5.1 or later and version 2 of the
// espressif/esp32-camera component. The port was reviewed, but neither compiled nor run.
//
// The driver delivers whole frames by DMA to two buffers. The port reads the central 188 x 120 px
// of each frame (or the size set in board.hpp). Focus the lens at a distance of about 19 mm
// (docs/hardware.md). Packets are sent at 115200 baud on the UART that is also used for
// programming, so logging must be disabled: CONFIG_LOG_DEFAULT_LEVEL_NONE. The main task needs a
// larger stack: CONFIG_ESP_MAIN_TASK_STACK_SIZE=8192.
#include <algorithm>

#include <driver/uart.h>
#include <esp_camera.h>
#include <esp_timer.h>
#include <freertos/FreeRTOS.h>
#include <freertos/task.h>

#include "board.hpp"
#include "pose_sender.hpp"

namespace {

constexpr int kWidth_px = board::kMaxWidth_px;
constexpr int kHeight_px = board::kMaxHeight_px;
/// Exposure time, in units of sensor rows. A short, fixed exposure avoids motion blur. Try 20 to
/// 200 rows.
constexpr int kExposure_rows = 60;
/// Approximate number of sensor rows per frame in CIF mode, which the driver uses for QVGA.
/// Includes the blanking rows between frames.
constexpr int kRowsPerFrame = 336;

camera_fb_t* frame = nullptr;
const std::uint8_t* row = nullptr;
/// Time from the driver's time stamp of a frame to the middle of the exposure.
std::int64_t middle_of_exposure_us = 0;

camera_config_t wiring() {
    camera_config_t config{};
    config.pin_pwdn = 32;
    config.pin_reset = -1;
    config.pin_xclk = 0;
    config.pin_sccb_sda = 26;
    config.pin_sccb_scl = 27;
    config.pin_d7 = 35;
    config.pin_d6 = 34;
    config.pin_d5 = 39;
    config.pin_d4 = 36;
    config.pin_d3 = 21;
    config.pin_d2 = 19;
    config.pin_d1 = 18;
    config.pin_d0 = 5;
    config.pin_vsync = 25;
    config.pin_href = 23;
    config.pin_pclk = 22;
    return config;
}

/// Returns the driver's time stamp for a frame: the start of the frame, on the esp_timer clock.
std::int64_t stamp_us(const camera_fb_t& of) {
    return of.timestamp.tv_sec * std::int64_t{1'000'000} + of.timestamp.tv_usec;
}

/// Returns the frame period. Measures the time from one frame to the next several times and returns
/// the shortest time. Longer times are due to frames that the driver skipped.
std::int64_t frame_period_us() {
    std::int64_t shortest_us = 1'000'000;
    std::int64_t last_us = 0;
    for (int count = 0; count < 10;) {
        camera_fb_t* const next = esp_camera_fb_get();
        if (next == nullptr) continue;
        const std::int64_t now_us = stamp_us(*next);
        esp_camera_fb_return(next);
        if (count++ > 0) shortest_us = std::min(shortest_us, now_us - last_us);
        last_us = now_us;
    }
    return shortest_us;
}

void set_up() {
    uart_driver_install(UART_NUM_0, 256, 1024, 0, nullptr, 0);
    uart_set_baudrate(UART_NUM_0, 115200);
    camera_config_t config = wiring();
    config.xclk_freq_hz = 20'000'000;
    config.ledc_timer = LEDC_TIMER_0;
    config.ledc_channel = LEDC_CHANNEL_0;
    config.pixel_format = PIXFORMAT_GRAYSCALE;
    config.frame_size = FRAMESIZE_QVGA;
    config.fb_count = 2;
    // The frames are stored in the internal RAM, which is large enough for QVGA frames and faster
    // than external PSRAM.
    config.fb_location = CAMERA_FB_IN_DRAM;
    // In this mode, the driver returns the newest frame after a pause, instead of the oldest
    // queued frame.
    config.grab_mode = CAMERA_GRAB_LATEST;
    while (esp_camera_init(&config) != ESP_OK)
        vTaskDelay(pdMS_TO_TICKS(500));
    sensor_t* sensor = esp_camera_sensor_get();
    sensor->set_exposure_ctrl(sensor, 0);
    sensor->set_aec_value(sensor, kExposure_rows);
    // The time stamp is the time of VSYNC. The exposure of the middle row ends about half a frame
    // later, when this row is read.
    middle_of_exposure_us =
        frame_period_us() * (kRowsPerFrame - kExposure_rows) / (2 * kRowsPerFrame);
}

}  // namespace

namespace board {

Frame start_frame(std::int64_t not_before_us) {
    static bool is_set_up = false;
    if (!is_set_up) set_up();
    is_set_up = true;
    std::int64_t time_us = 0;
    do {
        if (frame != nullptr) esp_camera_fb_return(frame);
        const std::int64_t left_us = not_before_us - esp_timer_get_time();
        if (left_us > 0) vTaskDelay(pdMS_TO_TICKS(left_us / 1000));
        frame = esp_camera_fb_get();
        if (frame != nullptr) time_us = stamp_us(*frame) + middle_of_exposure_us;
    } while (frame == nullptr || time_us < not_before_us);
    const int left = (static_cast<int>(frame->width) - kWidth_px) / 2 / 4 * 4;
    const int top = (static_cast<int>(frame->height) - kHeight_px) / 2;
    row = frame->buf + (top - 1) * static_cast<int>(frame->width) + left;
    return {kWidth_px, kHeight_px, time_us};
}

const std::uint8_t* next_row() {
    return row += frame->width;
}

void send(const std::uint8_t* bytes, std::size_t count) {
    uart_write_bytes(UART_NUM_0, bytes, count);
}

}  // namespace board

// Entry point of ESP-IDF programs. It replaces main.cpp, which must not be compiled.
extern "C" void app_main() {
    static PoseSender sender;
    for (;;)
        sender.send_next();
}
