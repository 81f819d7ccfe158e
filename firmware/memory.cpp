// What the compiler calls by itself. No C library is linked: Debian's for MIPS wants an FPU, and
// counts would change with its versions.
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

using Word [[gnu::may_alias]] = std::uint32_t;
/// Three words, which GCC copies with one load and one store on small Arm processors.
struct [[gnu::may_alias]] Words {
    std::uint32_t words[3];
};

bool are_aligned(const void* a, const void* b) {
    const auto bits = reinterpret_cast<std::uintptr_t>(a) | reinterpret_cast<std::uintptr_t>(b);
    return bits % sizeof(Word) == 0;
}

/// Bytes of a block.
constexpr std::size_t kBlock = 40;

/// Copies a block, and steps over it.
[[gnu::always_inline]] inline void copy_block(Word*& to, const Word*& from) {
#if defined(__thumb__)
    // Five words at a time: GCC uses three registers at most.
    asm("ldmia %1!, {r3-r7}\n\tstmia %0!, {r3-r7}\n\tldmia %1!, {r3-r7}\n\tstmia %0!, {r3-r7}"
        : "+l"(to), "+l"(from)
        :
        : "r3", "r4", "r5", "r6", "r7", "memory");
#else
#pragma GCC unroll 10
    for (std::size_t i = 0; i < kBlock / sizeof(Word); ++i)
        to[i] = from[i];
    to += kBlock / sizeof(Word);
    from += kBlock / sizeof(Word);
#endif
}

}  // namespace

extern "C" {

void* memcpy(void* __restrict to, const void* __restrict from, std::size_t size) {
    auto* target_word = static_cast<Word*>(to);
    const auto* source_word = static_cast<const Word*>(from);
    if (are_aligned(to, from)) {
        for (; size >= kBlock; size -= kBlock)
            copy_block(target_word, source_word);
        auto* target_words = reinterpret_cast<Words*>(target_word);
        const auto* source_words = reinterpret_cast<const Words*>(source_word);
        for (; size >= sizeof(Words); size -= sizeof(Words))
            *target_words++ = *source_words++;
        target_word = reinterpret_cast<Word*>(target_words);
        source_word = reinterpret_cast<const Word*>(source_words);
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
    auto* word = static_cast<Word*>(to);
    if (are_aligned(to, nullptr)) {
        const Word four = 0x01010101U * byte;
        for (; size >= 4 * sizeof(Word); size -= 4 * sizeof(Word)) {
            *word++ = four;
            *word++ = four;
            *word++ = four;
            *word++ = four;
        }
        for (; size >= sizeof(Word); size -= sizeof(Word))
            *word++ = four;
    }
    auto* target = reinterpret_cast<unsigned char*>(word);
    while (size-- > 0)
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
