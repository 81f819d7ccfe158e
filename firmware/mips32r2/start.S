# Entry of the program: the kernel's stack, with the arguments on it, is exchanged for ours.
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
