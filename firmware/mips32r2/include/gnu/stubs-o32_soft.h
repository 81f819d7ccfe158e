/* Debian's C library for MIPS has no soft-float build, so this header, which other headers of
   the library include, is missing there. The header would name functions that the library lacks;
   the firmware calls none of them. */
