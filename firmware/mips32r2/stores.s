# The assembler reads this file before the output of the compiler (cmake/mips32r2.cmake). The macros replace
# swm, which stores several registers, with swp for each pair of registers and sw for the remaining register,
# because swm in QEMU 7.2 stores only 16 bits of each register. The processor takes the same number of cycles,
# but the code grows by 1.1 KB. Compiler caches do not detect changes to this file, so it must be renamed when
# the macros change.

# In "swm $16-$18,$31,24($sp)", `first` is $16-$18, `more` is $31 and `memory` is 24($sp).
    .macro store_each memory, first, more:vararg
    .set last, 16
    .irp n, 17, 18, 19, 20, 21, 22, 23
    .ifc \first, $16-$\n
    .set last, \n
    .endif
    .endr
    .irp n, 16, 18, 20, 22
    .if last > \n
    swp $\n, 4*(\n-16)+\memory
    .elseif last == \n
    sw $\n, 4*(\n-16)+\memory
    .endif
    .endr
    .set offset, 4*(last-15)
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
