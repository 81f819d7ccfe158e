// Defines a function of fmt 9 that clang mangles differently than GCC, with which the library was
// compiled.
#include <fmt/format.h>

template void fmt::detail::vformat_to(buffer<char>&, string_view,
                                      basic_format_args<buffer_context<char>>, locale_ref);
