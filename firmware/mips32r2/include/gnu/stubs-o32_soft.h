/* Debian's C library for MIPS has no build without an FPU, and so not this header, which its others
   include. It would name functions that are not there; nothing here calls any. */
