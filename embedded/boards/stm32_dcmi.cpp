// Only read, neither compiled nor run: the port for STM32F4 with DCMI and the HAL of STM32Cube, and
// a monochrome camera of 8 bits, such as the MT9V034 or OV9281, which other code has set up by I2C.
//
// DCMI crops the frame to its middle and writes it by DMA to two rows in turn. In CubeMX: DCMI of 8
// bits with its interrupt; its DMA circular, words to words; TIM2 counts microseconds with 32 bits,
// and runs; USART2 at 115200 baud. Call run_device() where the program of CubeMX has its loop, and
// compile main.cpp with -Dmain=run_device. Chips with a data cache (F7, H7) need `rows` in memory
// that is not cached.
#include "board.hpp"

extern "C" {
#include "main.h"  // of CubeMX, with the HAL

extern DCMI_HandleTypeDef hdcmi;
extern TIM_HandleTypeDef htim2;
extern UART_HandleTypeDef huart2;
}

namespace {

constexpr std::uint32_t kCameraWidth_px = 376;
constexpr std::uint32_t kCameraHeight_px = 240;
constexpr std::uint32_t kWidth_px = board::kMaxWidth_px;
constexpr std::uint32_t kHeight_px = board::kMaxHeight_px;
/// From the end of VSYNC to the middle of the exposure: negative for global shutters, which are
/// read after it.
constexpr std::int64_t kMiddleOfExposure_us = -500;

alignas(4) std::uint8_t rows[2][kWidth_px];
volatile std::uint32_t rows_filled = 0;  // number of rows of this frame, counted by the interrupt
volatile bool has_begun = false;
std::uint32_t rows_read = 0;

/// TIM2 wraps after 71 minutes; this clock does not, if it is read more often than that.
std::int64_t now_us() {
    static std::uint32_t last = 0;
    static std::int64_t total_us = 0;
    const std::uint32_t now = __HAL_TIM_GET_COUNTER(&htim2);
    total_us += static_cast<std::uint32_t>(now - last);
    last = now;
    return total_us;
}

void set_up() {
    // The registers take sizes minus one.
    HAL_DCMI_ConfigCrop(&hdcmi, (kCameraWidth_px - kWidth_px) / 2,
                        (kCameraHeight_px - kHeight_px) / 2, kWidth_px - 1, kHeight_px - 1);
    HAL_DCMI_EnableCrop(&hdcmi);
}

}  // namespace

extern "C" void HAL_DCMI_LineEventCallback(DCMI_HandleTypeDef*) {
    rows_filled = rows_filled + 1;
}

extern "C" void HAL_DCMI_VsyncEventCallback(DCMI_HandleTypeDef*) {
    has_begun = true;
}

namespace board {

Frame start_frame(std::int64_t not_before_us) {
    static bool is_set_up = false;
    if (!is_set_up) set_up();
    is_set_up = true;
    HAL_DCMI_Stop(&hdcmi);
    while (now_us() < not_before_us)
        __WFI();
    rows_filled = rows_read = 0;
    has_begun = false;
    HAL_DCMI_Start_DMA(&hdcmi, DCMI_MODE_SNAPSHOT, reinterpret_cast<std::uint32_t>(rows),
                       sizeof rows / 4);
    // A snapshot switches these off when it ends.
    __HAL_DCMI_ENABLE_IT(&hdcmi, DCMI_IT_LINE | DCMI_IT_VSYNC);
    while (!has_begun) {
    }
    return {static_cast<int>(kWidth_px), static_cast<int>(kHeight_px),
            now_us() + kMiddleOfExposure_us};
}

const std::uint8_t* next_row() {
    while (rows_filled <= rows_read) {
    }
    return rows[rows_read++ % 2];
}

void send(const std::uint8_t* bytes, std::size_t count) {
    HAL_UART_Transmit(&huart2, const_cast<std::uint8_t*>(bytes), static_cast<std::uint16_t>(count),
                      HAL_MAX_DELAY);
}

}  // namespace board
