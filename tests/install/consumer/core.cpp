#include <cstdio>
#include <vector>

#include <dotpose/locate.hpp>

// Locates a blank frame through the public interface. Prints the reason why there is no fix.
int main() {
    static dotpose::SmallMemory memory;
    const std::vector<std::uint8_t> pixels(188 * 120, 200);
    const dotpose::Fix fix = dotpose::Locator(memory).locate({pixels.data(), 188, 120, 188});
    std::printf("%s: %s\n", dotpose::name(fix.status), dotpose::message(fix.status));
    return fix.status == dotpose::Status::no_contrast ? 0 : 1;
}
