/* Replaces a header that other headers of the C library include. Debian's C library for MIPS has no
 * soft-float build, so its package lacks this header. The original header lists functions that the
 * library lacks, none of which the firmware calls. */
