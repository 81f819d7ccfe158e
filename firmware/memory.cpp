// C library functions that compilers call implicitly. The programs do not link a C library, because
// Debian's library for MIPS requires an FPU, and because the instruction counts would depend on the
// library version.
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

using Word [[gnu::may_alias]] = std::uint32_t;
bool are_aligned(const void* a, const void* b) {
    const auto bits = reinterpret_cast<std::uintptr_t>(a) | reinterpret_cast<std::uintptr_t>(b);
    return bits % sizeof(Word) == 0;
}

}  // namespace

extern "C" {

// memcpy.S overrides memcpy with a faster version on Cortex-M0+ and MIPS.
[[gnu::weak]] void* memcpy(void* __restrict to, const void* __restrict from, std::size_t size) {
    auto* target_word = static_cast<Word*>(to);
    const auto* source_word = static_cast<const Word*>(from);
    if (are_aligned(to, from)) {
        constexpr std::size_t kBlock = 10;
        for (; size >= kBlock * sizeof(Word); size -= kBlock * sizeof(Word)) {
#pragma GCC unroll 10
            for (std::size_t i = 0; i < kBlock; ++i)
                target_word[i] = source_word[i];
            target_word += kBlock;
            source_word += kBlock;
        }
        for (; size >= sizeof(Word); size -= sizeof(Word))
            *target_word++ = *source_word++;
    }
    auto* target = reinterpret_cast<unsigned char*>(target_word);
    const auto* source = reinterpret_cast<const unsigned char*>(source_word);
    while (size-- > 0)
        *target++ = *source++;
    return to;
}

void* memmove(void* to, const void* from, std::size_t size) {
    auto* target = static_cast<unsigned char*>(to);
    const auto* source = static_cast<const unsigned char*>(from);
    if (target < source) {
        while (size-- > 0)
            *target++ = *source++;
    } else {
        while (size-- > 0)
            target[size] = source[size];
    }
    return to;
}

void* memset(void* to, int value, std::size_t size) {
    const auto byte = static_cast<unsigned char>(value);
    auto* target = static_cast<unsigned char*>(to);
    for (; size > 0 && !are_aligned(target, nullptr); --size)
        *target++ = byte;
    auto* word = static_cast<Word*>(static_cast<void*>(target));
    const Word four = 0x01010101U * byte;
    for (; size >= 4 * sizeof(Word); size -= 4 * sizeof(Word)) {
        *word++ = four;
        *word++ = four;
        *word++ = four;
        *word++ = four;
    }
    for (; size >= sizeof(Word); size -= sizeof(Word))
        *word++ = four;
    target = static_cast<unsigned char*>(static_cast<void*>(word));
    for (; size > 0; --size)
        *target++ = byte;
    return to;
}

int memcmp(const void* a, const void* b, std::size_t size) {
    const auto* left = static_cast<const unsigned char*>(a);
    const auto* right = static_cast<const unsigned char*>(b);
    for (; size > 0; --size, ++left, ++right) {
        if (*left != *right) return *left - *right;
    }
    return 0;
}

std::size_t strlen(const char* text) {
    const char* end = text;
    while (*end != '\0')
        ++end;
    return static_cast<std::size_t>(end - text);
}
}
