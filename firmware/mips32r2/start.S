# Entry of the program: switches from the kernel's stack, which has the arguments, to the program's own.
    .set noreorder
    .text
    .globl start
    .type start, @function
start:
    move    $a0, $sp                # of `start_program`
    lui     $sp, %hi(stack_top)
    addiu   $sp, $sp, %lo(stack_top)
    addiu   $sp, $sp, -16           # room that the o32 ABI owes to who is called
    j       start_program
    nop
    .size start, . - start
