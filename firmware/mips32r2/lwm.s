# Read by the assembler before what the compiler wrote (cmake/mips32r2.cmake): lwm and swm, which load and
# store several registers, become a lw or sw of each. QEMU 7.2's lwm loads only 16 bits of each. To the
# core it is the same number of cycles; the code grows by 5 %.

# Of "lwm $16-$18,$31,24($sp)": `first` $16-$18, `more` $31, `memory` 24($sp).
    .macro access_each access, memory, first, more:vararg
    .set offset, 0
    .irp n, 16, 17, 18, 19, 20, 21, 22, 23
    \access $\n, offset+\memory
    .set offset, offset + 4
    .ifc \first, $16-$\n
    .exitm
    .endif
    .ifc \first, $\n
    .exitm
    .endif
    .endr
    .irp register, \more
    .ifnb \register
    \access \register, offset+\memory
    .set offset, offset + 4
    .endif
    .endr
    .endm

# The memory is the last of two to four operands.
    .macro access_all access, first, second, third, fourth
    .ifnb \fourth
    access_each \access, \fourth, \first, \second, \third
    .else
    .ifnb \third
    access_each \access, \third, \first, \second
    .else
    access_each \access, \second, \first
    .endif
    .endif
    .endm

    .macro lwm operands:vararg
    access_all lw, \operands
    .endm

    .macro swm operands:vararg
    access_all sw, \operands
    .endm
