# Read by the assembler before what the compiler wrote (cmake/mips32r2.cmake): swm, which stores several
# registers, becomes a sw of each. QEMU 7.2's swm stores only 16 bits of each. To the core it is the same
# number of cycles; the code grows by 2 %.

# Of "swm $16-$18,$31,24($sp)": `first` $16-$18, `more` $31, `memory` 24($sp).
    .macro store_each memory, first, more:vararg
    .set offset, 0
    .irp n, 16, 17, 18, 19, 20, 21, 22, 23
    sw $\n, offset+\memory
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
    sw \register, offset+\memory
    .set offset, offset + 4
    .endif
    .endr
    .endm

# The memory is the last of two to four operands.
    .macro swm first, second, third, fourth
    .ifnb \fourth
    store_each \fourth, \first, \second, \third
    .else
    .ifnb \third
    store_each \third, \first, \second
    .else
    store_each \second, \first
    .endif
    .endif
    .endm
