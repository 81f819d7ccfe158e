# The assembler reads this file before the compiler's output (cmake/mips32r2.cmake). It replaces swm, which
# stores several registers, by one sw for each, because swm in QEMU 7.2 stores only 16 bits of each. The
# processor takes the same number of cycles; the code grows by 2 %.

# In "swm $16-$18,$31,24($sp)", `first` is $16-$18, `more` is $31 and `memory` is 24($sp).
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

# The memory operand is the last of two to four operands.
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
